//! Texts from outside never command: whatever a specification, an EDS or a name holds, it stays a text in every output.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::BTreeSet;

use od_gen::diff::{self, Question, Scope, compare};
use od_spec::diag::codes;
use od_spec::diag::render::{Findings, Format, render, sarif};
use od_spec::source::SourceMap;
use od_spec::visible::is_hidden;
use od_spec::{Compiled, NoFiles, compile};

mod outputs;
mod plant;

use outputs::skeleton;
use plant::{KeyName, planted, sites, text_keys};

const TEXTS: &str = include_str!("../../shared/texts.od.yaml");

/// Keys whose text is one of a fixed set or names a file, or that only libraries have.
const LIBRARIES: [KeyName; 7] = [
    ("a specification", "parts"),
    ("a state machine", "from"),
    ("a specification", "profile"),
    ("a specification", "features"),
    ("a feature", "about"),
    ("a feature", "needs"),
    ("an error code", "from"),
];

fn compiled(text: &str) -> (SourceMap, Compiled) {
    let mut sources = SourceMap::new();
    let root = sources.add("texts\u{1b}[31m\n::error::.od.yaml", text);
    let compiled = compile(&mut sources, root, &mut NoFiles);
    (sources, compiled)
}

/// What a message shows, in every form.
fn check_messages(sources: &SourceMap, compiled: &Compiled, complaints: &mut Vec<String>) {
    let all = &compiled.diagnostics;
    let findings = Findings { name: "\u{9b}2J", diagnostics: all, sources };
    let mut texts = vec![("SARIF", sarif("1", &[findings]))];
    for (name, format) in [
        ("human", Format::Human),
        ("short", Format::Short),
        ("JSON", Format::Json),
        ("GitHub", Format::Github),
    ] {
        texts.push((name, render(all, sources, format, false)));
    }
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
    for (payload, least) in [
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
    ] {
        let mut chosen: Vec<usize> = (0..sites.len()).collect();
        // What is refused is left out until the rest is accepted.
        let (sources, accepted) = loop {
            let (text, places) = planted(TEXTS, &sites, &chosen, payload);
            let (sources, result) = compiled(&text);
            check_messages(&sources, &result, &mut complaints);
            if result.system.is_some() {
                break (sources, result);
            }
            let refused: BTreeSet<usize> = result
                .diagnostics
                .iter()
                .filter(|one| one.severity() == od_spec::diag::Severity::Error)
                .flat_map(|one| &one.labels)
                .flat_map(|label| {
                    let (start, end) = (label.span.start as usize, label.span.end as usize);
                    // Of a message about a key, everything below it.
                    let line = block(&text, start);
                    let exact: Vec<usize> = places
                        .iter()
                        .filter(|(place, _)| place.start < end.max(start + 1) && start < place.end)
                        .map(|(_, at)| *at)
                        .collect();
                    if exact.is_empty() {
                        places
                            .iter()
                            .filter(|(place, _)| line.contains(&place.start))
                            .map(|(_, at)| *at)
                            .collect()
                    } else {
                        exact
                    }
                })
                .collect();
            let refused = if refused.is_empty() {
                // The message is about something else that has the text: each is tried alone.
                let is_taken = |at: usize| {
                    let (_, alone) = compiled(&planted(TEXTS, &sites, &[at], payload).0);
                    alone.system.is_some()
                };
                chosen.iter().copied().filter(|at| !is_taken(*at)).collect()
            } else {
                refused
            };
            let before = chosen.len();
            chosen.retain(|at| !refused.contains(at));
            let messages = render(&result.diagnostics, &sources, Format::Short, false);
            assert!(chosen.len() < before, "{payload:?}: {messages}");
        };
        assert!(
            chosen.len() >= least,
            "{payload:?}: only {} of {} texts are taken",
            chosen.len(),
            sites.len()
        );
        let found = skeleton(accepted.system.as_ref().unwrap(), &sources, &mut complaints);
        // Harmless texts in the same places, with as many dots: these make a section one of a section.
        let harmless = format!("plain{}", ".".repeat(payload.matches('.').count()));
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

/// The line of a place, and those below it that are indented further.
fn block(text: &str, at: usize) -> std::ops::Range<usize> {
    let indent = |line: &str| line.len() - line.trim_start().len();
    let start = text[..at].rfind('\n').map_or(0, |at| at + 1);
    let mut lines = text[start..].split_inclusive('\n');
    let first = lines.next().unwrap_or_default();
    let below = lines.take_while(|line| indent(line) > indent(first)).map(str::len).sum::<usize>();
    start..start + first.len() + below
}

#[test]
fn a_text_that_turns_is_refused_wherever_it_stands() {
    for site in sites(TEXTS) {
        for (payload, escaped) in [("\u{202e}", true), ("\u{200f}", true), ("\u{2069}", false)] {
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

/// A difference of foreign files is told in lines, and what is coloured in them is ours.
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
