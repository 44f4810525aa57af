//! Texts from outside never command: whatever a specification, an EDS or a name holds, it stays a text in every output.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::BTreeSet;

use od_diff::{self as diff, Question, Scope, compare};
use od_formats::findings::{self, Findings, sarif};
use od_reference::explanation;
use od_spec::diag::codes;
use od_spec::diag::render::{Format, render};
use od_spec::source::SourceMap;
use od_spec::visible::is_hidden;
use od_spec::{Compiled, NoFiles, compile};
use od_tests::plant::{Accepted, KeyName, TEXTS, accepted, compiled, planted, sites, text_keys};

mod outputs;

use outputs::skeleton;

/// Keys whose text is one of a fixed set or the name of a file, or that only libraries have.
const LIBRARIES: [KeyName; 8] = [
    ("a specification", "parts"),
    ("a state machine", "from"),
    ("a specification", "profile"),
    ("a specification", "features"),
    ("a feature", "about"),
    ("a feature", "needs"),
    ("a feature", "channels-of"),
    ("an error code", "from"),
];

/// What a message shows, in every form.
fn check_messages(sources: &SourceMap, compiled: &Compiled, complaints: &mut Vec<String>) {
    let all = &compiled.diagnostics;
    let findings = Findings { name: "\u{9b}2J", diagnostics: all, sources };
    let mut texts = vec![("SARIF", sarif("1", explanation, &[findings]))];
    texts.push(("human", render(all, sources, Format::Human, false)));
    texts.push(("short", render(all, sources, Format::Short, false)));
    texts.push(("JSON", findings::json(all, sources)));
    texts.push(("GitHub", findings::github(all, sources)));
    for (name, text) in texts {
        if let Some(c) = text.chars().find(|c| is_hidden(*c) && *c != '\n') {
            complaints.push(format!("{name} shows {c:?}"));
        }
        let commands = text.lines().filter(|line| line.trim_start().starts_with("::"));
        if name != "GitHub" && commands.count() > 0 {
            complaints.push(format!("{name} commands"));
        }
    }
}

#[test]
fn every_key_that_takes_a_text_is_planted() {
    let planted: BTreeSet<KeyName> = sites(TEXTS).into_iter().flat_map(|site| site.keys).collect();
    let missing: Vec<KeyName> =
        text_keys().difference(&planted).filter(|key| !LIBRARIES.contains(key)).copied().collect();
    assert_eq!(missing, []);
}

#[test]
fn a_text_stays_a_text_in_every_output() {
    let mut complaints = Vec::new();
    let sites = sites(TEXTS);
    let payloads = [
        (
            r#"x <b>x</b> *e* [l](javascript:x) `c` | & &lt "q" 'p' \ ${z} */ ]]> --> </script><script>alert(1)</script> ~~s~~"#,
            80,
        ),
        (r"a;b#c=d [2000] {{ y }} {% z %} !include(x) #[x] //! _u_", 50),
        (
            "first\n[2000]\nParameterName=x\n::error::x\n# heading\n<b>x</b>\n\n- item\n\n> q\n\n    code\n",
            25,
        ),
        ("> quote - item # h 1. ```", 60),
        ("\u{1b}[31m\u{1b}]0;x\u{7}\u{9b}2J\u{7f}\u{b}\r::error::x", 25),
        ("\u{202e}cba\u{2066}", 0),
    ];
    for (number, (payload, least)) in payloads.into_iter().enumerate() {
        if !od_tests::is_tried(number, 2) {
            continue;
        }
        let mut look = |sources: &SourceMap, compiled: &Compiled| {
            check_messages(sources, compiled, &mut complaints);
        };
        let Accepted { chosen, sources, compiled: result } =
            accepted(TEXTS, &sites, payload, &mut look).unwrap();
        assert!(
            chosen.len() >= least,
            "{payload:?}: only {} of {} texts are taken",
            chosen.len(),
            sites.len()
        );
        let found = skeleton(result.system.as_ref().unwrap(), &sources, &mut complaints);
        // Harmless texts in the same places, with as many dots – these make a section one of a section – and lines, which make
        // paragraphs.
        let plain = format!("plain{}", ".".repeat(payload.matches('.').count()));
        let lines = payload.split('\n').map(|line| if line.trim().is_empty() { "" } else { plain.as_str() });
        let harmless = lines.collect::<Vec<_>>().join("\n");
        let (sources, plain) = compiled(&planted(TEXTS, &sites, &chosen, &harmless).0);
        let expected = skeleton(plain.system.as_ref().unwrap(), &sources, &mut complaints);
        for part in expected.keys().chain(found.keys()).collect::<BTreeSet<_>>() {
            let (before, now) = (expected.get(part), found.get(part));
            if before != now {
                complaints.push(format!("{payload:.20?}: {part}: {before:?}, now {now:?}"));
            }
        }
    }
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}

#[test]
fn a_text_that_turns_is_refused_wherever_it_is() {
    let payloads = [("\u{202e}", true), ("\u{200f}", true), ("\u{2069}", false)];
    for (at, site) in sites(TEXTS).into_iter().enumerate() {
        // Each site has one of them in turn, and all of a long run.
        let first = if od_tests::is_long() { 0 } else { at % payloads.len() };
        let count = if od_tests::is_long() { payloads.len() } else { 1 };
        for (payload, escaped) in payloads.into_iter().skip(first).take(count) {
            let (text, _) = planted(TEXTS, std::slice::from_ref(&site), &[0], payload);
            let text = if escaped { text } else { text.replace("\\u2069", payload) };
            let (_, compiled) = compiled(&text);
            assert!(compiled.system.is_none(), "{}", site.text);
            assert!(compiled.diagnostics.iter().any(|one| one.code == codes::TURNED_TEXT), "{}", site.text);
        }
    }
    let (_, compiled) = compiled(&TEXTS.replacen("title:", "# \u{202e}\ntitle:", 1));
    assert!(compiled.diagnostics.iter().any(|one| one.code == codes::TURNED_TEXT));
}

/// A difference of foreign files is reported in lines, and what is coloured in them is ours.
#[test]
fn a_difference_of_foreign_files_shows_what_they_hide() {
    const NAMES: [&str; 2] = ["level \u{1b}[31m\u{9b}2J\u{7f}", "level \u{1b}]0;x\u{7}\u{85}::error::"];
    let systems = NAMES.map(|name| {
        let eds = format!(
            "[FileInfo]\nFileVersion=1\n[DeviceInfo]\nProductName={name}\nVendorNumber=7\n[2000]\nParameterName={name}\n\
             ObjectType=7\nDataType=5\nAccessType=rw\n"
        );
        let mut sources = SourceMap::new();
        let root = sources.add("a.eds", eds);
        compile(&mut sources, root, &mut NoFiles).system.unwrap()
    });
    let [old, new] = &systems;
    let question = Question { old, new, scope: Scope::Everything, device: None, nodes: None };
    let found = compare(&question).unwrap();
    assert!(found.changes().count() > 0);
    for text in [diff::human(&found, false), diff::short(&found), diff::markdown(&found)] {
        let shown = text.chars().find(|c| is_hidden(*c) && *c != '\n');
        assert_eq!(shown, None, "{text:?}");
    }
    // Without our own colours it is the same text.
    let coloured = diff::human(&found, true);
    let styles = ["31", "32", "33", "1", "1;31", "0"].map(|code| format!("\u{1b}[{code}m"));
    let plain = styles.iter().fold(coloured, |text, style| text.replace(style, ""));
    assert_eq!(plain, diff::human(&found, false));
}
