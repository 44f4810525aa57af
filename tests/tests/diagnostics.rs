//! Every message to the user: the cases in `tests/ui` with what the compiler says about them, and rules that hold for
//! every message.
//!
//! The name of a case tells what comes out of it: `err_` errors, `warn_` warnings only, `ok_` nothing at all; the code
//! in the name is among its messages.

#![expect(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use od_spec::diag::render::{Format, render};
use od_spec::diag::{Code, Diagnostic, Diagnostics, Severity, codes};
use od_spec::scalar;
use od_spec::source::{FileId, SourceMap, Span, Spanned};
use od_spec::yaml::{Node, NodeKind};
use od_spec::{Compiled, LIBRARIES, Loader, NoFiles, assign, compile, read_text};
use proptest::prelude::*;

/// Codes that this file does not provoke, and where they are.
const ELSEWHERE: &[(&Code, &str)] = &[
    (codes::UNREADABLE, "`odgen`, when it opens a file: tests of the command line"),
    (codes::BAD_NODE_ID, "`odgen dcf --node`: tests of the command line"),
    (codes::BIT_RATE_UNSUPPORTED, "`odgen dcf --bit-rate`: tests of the command line"),
    (codes::BAD_TEMPLATE, "`odgen docs`, when it prints templates: tests of the command line"),
    (codes::WRITE_FAILED, "`odgen`, when it writes files: tests of the command line"),
    (codes::DEPARTURE, "`odgen check --notes`: tests of the command line"),
    (codes::IDENTIFIER_CLASH, "the Rust backend: `tests/macros/names_clash.rs`"),
    (codes::NO_IDENTIFIER, "the Rust backend: `tests/macros/names_clash.rs`"),
    (codes::NO_CAPACITY, "the Rust backend: `tests/macros/names_clash.rs`"),
    (codes::NOT_IN_FIRMWARE, "the Rust backend: `tests/macros/names_clash.rs`"),
];

/// A large specification that is right.
const PITCH: &str = include_str!("../../od-spec/devices/pitch-control-system.od.yaml");

fn ui() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("ui")
}

/// Name and text of every case.
fn cases() -> Vec<(String, String)> {
    let mut cases: Vec<(String, String)> = fs::read_dir(ui())
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter_map(|path| {
            let name = path.file_name()?.to_str()?.to_owned();
            name.ends_with(".od.yaml").then(|| (name, read(&path)))
        })
        .collect();
    cases.sort();
    assert!(!cases.is_empty());
    cases
}

fn read(path: &Path) -> String {
    let name = path.file_name().unwrap().to_string_lossy();
    read_text(&name, fs::read(path).unwrap()).unwrap()
}

fn run(name: &str, text: &str) -> (SourceMap, FileId, Compiled) {
    let mut sources = SourceMap::new();
    let root = sources.add(name, text);
    let compiled = compile(&mut sources, root, &mut NoFiles);
    (sources, root, compiled)
}

fn human(diagnostics: &Diagnostics, sources: &SourceMap) -> String {
    render(diagnostics, sources, Format::Human, false)
}

fn codes(diagnostics: &Diagnostics) -> BTreeSet<&'static Code> {
    diagnostics.iter().map(|diagnostic| diagnostic.code).collect()
}

/// What is said about one diagnostic that has no `Diagnostics` around it.
fn human_one(diagnostic: Diagnostic, sources: &SourceMap) -> String {
    let mut list = Diagnostics::new();
    list.push(diagnostic);
    human(&list, sources)
}

// ---------------------------------------------------------------------------------------------- the cases of tests/ui

#[test]
fn cases_say_what_was_reviewed() {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("../ui/snapshots");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| {
        insta::glob!("../ui", "*.od.yaml", |path| {
            let name = path.file_name().unwrap().to_str().unwrap();
            let (sources, _, compiled) = run(name, &read(path));
            insta::assert_snapshot!("said", human(&compiled.diagnostics, &sources));
        });
    });
}

#[test]
fn names_of_cases_tell_what_comes_out() {
    for (name, text) in cases() {
        let (_, _, compiled) = run(&name, &text);
        let (errors, warnings) = compiled.diagnostics.count();
        let kind = name.split('_').next().unwrap();
        let fine = match kind {
            "err" => compiled.system.is_none() && errors > 0,
            "warn" => compiled.system.is_some() && errors == 0 && warnings > 0,
            "ok" => compiled.system.is_some() && errors + warnings == 0,
            _ => panic!("{name}: a case is named err_, warn_ or ok_"),
        };
        assert!(fine, "{name}: {errors} errors, {warnings} warnings, system: {}", compiled.system.is_some());
        if let Some(code) = name.split('_').nth(1).and_then(od_spec::code) {
            assert!(codes(&compiled.diagnostics).contains(&code), "{name} does not provoke {code}");
        }
        assert!(text.starts_with("# "), "{name}: the first line tells what is wrong");
    }
}

#[test]
fn every_code_has_a_case() {
    let mut said: BTreeSet<&'static Code> = BTreeSet::new();
    for (name, text) in cases() {
        said.extend(codes(&run(&name, &text).2.diagnostics));
    }
    let tests = include_str!("diagnostics.rs");
    for code in od_spec::all_codes() {
        let elsewhere = ELSEWHERE.iter().any(|(other, _)| *other == code);
        let here = tests.contains(&format!("[{code}]"));
        assert!(said.contains(&code) || here || elsewhere, "{code} ({}) has no case", code.title);
        assert!(!(said.contains(&code) && elsewhere), "{code} has a case: take it out of ELSEWHERE");
    }
}

#[test]
fn snapshots_have_cases() {
    let names: BTreeSet<String> = cases().into_iter().map(|(name, _)| name).collect();
    for entry in fs::read_dir(ui().join("snapshots")).unwrap() {
        let file = entry.unwrap().file_name().into_string().unwrap();
        let case = file.strip_prefix("said@").and_then(|rest| rest.strip_suffix(".snap"));
        assert!(case.is_some_and(|case| names.contains(case)), "{file} belongs to no case");
    }
}

// ---------------------------------------------------------------------------------------------- rules for all messages

/// The wording rules: what the message says, how it starts and ends, that there is help, and that places exist.
fn check_wording(diagnostic: &Diagnostic, sources: &SourceMap, case: &str) {
    let message = diagnostic.message.as_str();
    let at = || format!("{case}: {}: {message}", diagnostic.code);
    let help = diagnostic.help.as_deref().unwrap_or_else(|| panic!("{}: no help", at()));
    assert!(!message.ends_with(['.', '!']) && !message.trim().is_empty(), "{}", at());
    let first = message.chars().next().unwrap();
    let word = message.split([' ', ',', ':']).next().unwrap_or_default();
    let acronym =
        word.len() > 1 && word.chars().all(|c| c.is_ascii_uppercase() || c.is_ascii_digit() || c == '_');
    assert!(
        first.is_lowercase() || matches!(first, '`' | '-' | '$' | '0'..='9') || acronym || is_index(word),
        "{}",
        at()
    );
    assert!(
        help.chars().next().is_some_and(|c| c.is_lowercase() || c == '`' || c.is_ascii_digit()),
        "{}: {help}",
        at()
    );
    for text in [message, help].into_iter().chain(diagnostic.notes.iter().map(String::as_str)) {
        assert!(!text.contains(['\n', '\r', '\t']), "{}: {text:?} has several lines", at());
        assert!(text.matches('`').count() % 2 == 0, "{}: odd backticks in {text:?}", at());
        assert!(text.chars().count() <= 600, "{}: {text:?} is too long", at());
    }
    for label in &diagnostic.labels {
        assert!(is_inside(label.span, sources), "{}: {:?} lies outside", at(), label.span);
        assert!(!label.text.contains('\n'), "{}: {:?}", at(), label.text);
    }
}

/// `607Ah`, `607Ah.1`.
fn is_index(word: &str) -> bool {
    let (digits, rest) = word.split_at_checked(4).unwrap_or(("", ""));
    !digits.is_empty() && digits.chars().all(|c| c.is_ascii_hexdigit()) && rest.starts_with('h')
}

fn is_inside(span: Span, sources: &SourceMap) -> bool {
    let text = sources.file(span.file).text();
    let (start, end) = (span.start as usize, span.end as usize);
    start <= end && end <= text.len() && text.is_char_boundary(start) && text.is_char_boundary(end)
}

#[test]
fn messages_keep_the_wording_rules() {
    for (name, text) in cases() {
        let (sources, _, compiled) = run(&name, &text);
        for diagnostic in &compiled.diagnostics {
            check_wording(diagnostic, &sources, &name);
            assert!(!diagnostic.labels.is_empty(), "{name}: {} has no place", diagnostic.message);
        }
    }
}

/// A library of the compiler is right: what is wrong is wrong in the user's file.
#[test]
fn messages_are_about_the_users_file() {
    for (name, text) in cases() {
        let (_, root, compiled) = run(&name, &text);
        for diagnostic in &compiled.diagnostics {
            assert_eq!(
                diagnostic.labels.first().map(|label| label.span.file),
                Some(root),
                "{name}: {}",
                diagnostic.message
            );
        }
    }
}

#[test]
fn messages_are_sorted_and_not_repeated() {
    for (name, text) in cases() {
        let (_, _, compiled) = run(&name, &text);
        let places: Vec<_> = compiled
            .diagnostics
            .iter()
            .map(|diagnostic| {
                (diagnostic.labels[0].span.file, diagnostic.labels[0].span.start, diagnostic.code)
            })
            .collect();
        assert!(places.is_sorted(), "{name}");
        let mut seen: Vec<&Diagnostic> = Vec::new();
        for diagnostic in &compiled.diagnostics {
            assert!(!seen.contains(&diagnostic), "{name}: {}", diagnostic.message);
            seen.push(diagnostic);
        }
    }
}

#[test]
fn short_and_json_are_one_line_each() {
    for (name, text) in cases() {
        let (sources, _, compiled) = run(&name, &text);
        let count = compiled.diagnostics.iter().count();
        let short = render(&compiled.diagnostics, &sources, Format::Short, false);
        assert_eq!(short.lines().count(), count, "{name}: {short}");
        assert!(short.lines().all(|line| line.starts_with(&format!("{name}:"))), "{name}: {short}");
        let json = render(&compiled.diagnostics, &sources, Format::Json, false);
        assert_eq!(json.lines().count(), count, "{name}: {json}");
        for (line, diagnostic) in json.lines().zip(&compiled.diagnostics) {
            let value: serde_json::Value = serde_json::from_str(line).unwrap();
            assert_eq!(value["code"], diagnostic.code.id);
            assert_eq!(value["severity"], diagnostic.severity().word());
            assert_eq!(value["message"], diagnostic.message.as_str());
            assert_eq!(value["help"].as_str(), diagnostic.help.as_deref());
            assert_eq!(value["labels"].as_array().unwrap().len(), diagnostic.labels.len());
            assert_eq!(value["labels"][0]["file"], name.as_str());
        }
    }
}

#[test]
fn line_ends_of_other_systems_change_nothing() {
    for (name, text) in cases() {
        let (sources, _, compiled) = run(&name, &text);
        let (other_sources, _, other) = run(&name, &text.replace('\n', "\r\n"));
        let short = |diagnostics, sources| render(diagnostics, sources, Format::Short, false);
        assert_eq!(
            short(&other.diagnostics, &other_sources),
            short(&compiled.diagnostics, &sources),
            "{name}"
        );
        assert_eq!(
            human(&other.diagnostics, &other_sources),
            human(&compiled.diagnostics, &sources),
            "{name}"
        );
        assert_eq!(other.system.is_some(), compiled.system.is_some(), "{name}");
    }
}

#[test]
fn colour_changes_nothing_but_colour() {
    let (name, text) = cases().into_iter().find(|(name, _)| name == "err_many_mistakes.od.yaml").unwrap();
    let (sources, _, compiled) = run(&name, &text);
    let coloured = render(&compiled.diagnostics, &sources, Format::Human, true);
    assert!(coloured.contains("\u{1b}["));
    let mut plain = String::new();
    let mut rest = coloured.as_str();
    while let Some((before, after)) = rest.split_once("\u{1b}[") {
        plain.push_str(before);
        rest = after.split_once('m').unwrap().1;
    }
    plain.push_str(rest);
    assert_eq!(plain, human(&compiled.diagnostics, &sources));
}

#[test]
fn explanations_are_sentences() {
    for code in od_spec::all_codes() {
        assert!(!code.title.ends_with('.'), "{code}");
        let explanation = code.explanation;
        assert!(explanation.ends_with(['.', '?', '}']), "{code}: {explanation}");
        assert_eq!(
            matches!(code.severity, Severity::Warning | Severity::Note),
            code.id.starts_with("OD08") || code.id == "OD0710"
        );
    }
}

// ---------------------------------------------------------------------------------------------- bytes and libraries

#[test]
fn bytes_that_are_no_text() {
    let sources = SourceMap::new();
    let refused =
        |name: &str, bytes: &[u8]| human_one(*read_text(name, bytes.to_vec()).unwrap_err(), &sources);
    insta::assert_snapshot!(refused("lamp.od.yaml", b"od-spec: 1\ntitle: L\xe4mpchen\n"), @r#"
        error[OD0102]: `lamp.od.yaml:2:9` holds the byte 0xE4, expected UTF-8 text
        help: convert the file, for example with `iconv -f latin1 -t utf-8`
        "#);
    insta::assert_snapshot!(refused("lamp.od.yaml", "title: Gr\u{f6}\u{df}e 5 \u{b5}".as_bytes().split_last().unwrap().1), @r#"
        error[OD0102]: `lamp.od.yaml:1:16` holds the byte 0xC2, expected UTF-8 text
        help: convert the file, for example with `iconv -f latin1 -t utf-8`
        "#);
    insta::assert_snapshot!(human_one(*read_text("disk.img", vec![b' '; (64 << 20) + (9 << 20)]).unwrap_err(), &sources), @r#"
        error[OD0103]: `disk.img` has 73 MiB; the limit is 64 MiB
        help: is this the right file?
        "#);
}

#[test]
fn a_byte_order_mark_is_no_text() {
    assert_eq!(read_text("lamp.od.yaml", b"\xef\xbb\xbfod-spec: 1\n".to_vec()).unwrap(), "od-spec: 1\n");
    assert_eq!(read_text("lamp.od.yaml", vec![b' '; 64 << 20]).unwrap().len(), 64 << 20);
}

/// Library files for tests.
struct Files(&'static [(&'static str, &'static [u8])]);

impl Loader for Files {
    fn load(&mut self, path: &str, from: &str) -> Result<Vec<u8>, String> {
        assert_eq!(from, "plant/lamp.od.yaml");
        let file = self.0.iter().find(|(name, _)| *name == path);
        file.map(|(_, bytes)| bytes.to_vec()).ok_or_else(|| "no such file".to_owned())
    }
}

fn with_libraries(text: &str, files: &'static [(&'static str, &'static [u8])]) -> String {
    let mut sources = SourceMap::new();
    let root = sources.add("plant/lamp.od.yaml", text);
    let compiled = compile(&mut sources, root, &mut Files(files));
    for diagnostic in &compiled.diagnostics {
        check_wording(diagnostic, &sources, text);
    }
    assert_eq!(compiled.system.is_some(), !compiled.diagnostics.has_errors());
    human(&compiled.diagnostics, &sources)
}

const LAMP: &str = "\
od-spec: 1
title: Lamp
uses: [cia301, ../lamps.od.yaml]
devices:
  lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer, dimmer]}
";

#[test]
fn libraries_from_files() {
    let lamps: &[(&str, &[u8])] = &[(
        "../lamps.od.yaml",
        b"od-spec: 1\nprofile: lamps\ntitle: Lamps\nfeatures:\n  dimmer: {objects: [0x2000]}\nobjects:\n  0x2000: {name: brightness, type: unsigned8, access: rw}\n",
    )];
    insta::assert_snapshot!(with_libraries(LAMP, lamps), @"");
    insta::assert_snapshot!(with_libraries(LAMP, &[]), @r#"
        error[OD0113]: cannot read library `../lamps.od.yaml`: no such file
         --> plant/lamp.od.yaml:3:16
          |
        3 | uses: [cia301, ../lamps.od.yaml]
          |                ^^^^^^^^^^^^^^^^
          |
        help: name a built-in library (`cia301`, `cia402`), or a file relative to this one
        "#);
    insta::assert_snapshot!(with_libraries(&LAMP.replace("cia301, ../lamps.od.yaml", "cia31"), &[]), @r#"
        error[OD0113]: cannot read library `cia31`: no such file
         --> plant/lamp.od.yaml:3:8
          |
        3 | uses: [cia31]
          |        ^^^^^
          |
        help: did you mean `cia301`?
        "#);
    insta::assert_snapshot!(with_libraries(LAMP, &[("../lamps.od.yaml", b"od-spec: 1\ntitle: L\xe4mpchen\n")]), @r#"
        error[OD0102]: `../lamps.od.yaml:2:9` holds the byte 0xE4, expected UTF-8 text
         --> plant/lamp.od.yaml:3:16
          |
        3 | uses: [cia301, ../lamps.od.yaml]
          |                ^^^^^^^^^^^^^^^^ used here
          |
        help: convert the file, for example with `iconv -f latin1 -t utf-8`
        "#);
    insta::assert_snapshot!(with_libraries(LAMP, &[("../lamps.od.yaml", b"od-spec: 1\ntitle: Lamps\n")]), @r#"
        error[OD0114]: `../lamps.od.yaml` is no library
         --> plant/lamp.od.yaml:3:16
          |
        3 | uses: [cia301, ../lamps.od.yaml]
          |                ^^^^^^^^^^^^^^^^
          |
        help: a library has `profile: NAME` at its top level and no `uses:` of its own
        "#);
    insta::assert_snapshot!(
        with_libraries(LAMP, &[("../lamps.od.yaml", b"od-spec: 1\nprofile: lamps\ntitle: Lamps\nuses: [cia301]\n")]),
        @r#"
        error[OD0114]: `../lamps.od.yaml` is no library
         --> plant/lamp.od.yaml:3:16
          |
        3 | uses: [cia301, ../lamps.od.yaml]
          |                ^^^^^^^^^^^^^^^^
          |
        help: a library has `profile: NAME` at its top level and no `uses:` of its own
        "#
    );
    insta::assert_snapshot!(with_libraries(LAMP, &[("../lamps.od.yaml", b"od-spec: 1\nprofile: [lamps\n")]), @r#"
        error[OD0104]: this is not YAML: unclosed bracket '['
         --> ../lamps.od.yaml:2:10
          |
        2 | profile: [lamps
          |          ^
          |
        help: check indentation, quotes, and that `: ` and ` #` inside a text are quoted
        "#);
    insta::assert_snapshot!(
        with_libraries(
            LAMP,
            &[("../lamps.od.yaml", b"od-spec: 1\nprofile: lamps\ntitle: Lamps\nfeatures:\n  dimmer: {objects: [0x2001]}\n")]
        ),
        @r#"
        error[OD0309]: feature `dimmer` names 2001h, which the library does not define
         --> ../lamps.od.yaml:5:22
          |
        5 |   dimmer: {objects: [0x2001]}
          |                      ^^^^^^
          |
        help: define the object in the library, or correct the index
        "#
    );
}

// ---------------------------------------------------------------------------------------------- parameter settings

/// What is said about settings, given as on a command line.
fn settings(spec: &str, device: &str, list: &[&str]) -> String {
    let (mut sources, _, compiled) = run("spec.od.yaml", spec);
    let system = compiled.system.expect("a specification without mistakes");
    let mut spans = Vec::new();
    for (at, text) in list.iter().enumerate() {
        let name = if list.len() == 1 { "--set".to_owned() } else { format!("--set #{}", at + 1) };
        let file = sources.add(name, *text);
        let end = u32::try_from(text.len()).unwrap();
        spans.push(Spanned::new((*text).to_owned(), Span { file, start: 0, end }));
    }
    let mut diagnostics = Diagnostics::new();
    let values = assign(&system, system.device(device).unwrap(), 5, &spans, &mut diagnostics);
    diagnostics.sort();
    for diagnostic in &diagnostics {
        check_wording(diagnostic, &sources, &list.join(" "));
    }
    if diagnostics.is_empty() {
        return values.iter().map(|(id, value)| format!("{id} = {value:?}\n")).collect::<Vec<_>>().concat();
    }
    human(&diagnostics, &sources)
}

/// A small specification with an entry of every kind that settings can touch.
const HEATER: &str = "\
od-spec: 1
title: Heater
uses: [cia301]
devices:
  heater: {name: Heater, bit-rates: [125], features: [heartbeat producer, store parameters]}
units:
  decicelsius: {symbol: °C, scale: 1/10}
types:
  mode:
    base: unsigned8
    values: {0: off, 1: manual, 2: automatic}
objects:
  0x2000: {name: mode of operation, type: mode, access: rw, default: off}
  0x2001:
    name: temperature
    type: integer16
    unit: decicelsius
    access: rw
    record:
      1: {name: low limit, default: 5.0 °C}
      2: {name: high limit, default: 40.0 °C, min: 0.0 °C, max: 60.0 °C, special: {32767: no limit}}
      3: {name: target, default: 20.0 °C, writable-when: \"0x2000 == 2\"}
      4: {name: measured, access: ro}
  0x2002: {name: calibration, type: unsigned16, access: rw locked, default: 100}
  0x2003: {name: position, type: integer32, access: rw, default: 0}
  0x5003: {name: short position, alias: 0x2003, type: integer16}
constraints:
  limits keep their order: {require: \"0x2001.1 < 0x2001.2\"}
";

#[test]
fn settings_that_are_right() {
    insta::assert_snapshot!(
        settings(HEATER, "heater", &["2000=automatic", "temperature.target = 21.5 °C", "2001.2=32767", "short position=-5"]),
        @r#"
        2000h = Integer(2)
        2001h.2 = Integer(32767)
        2001h.3 = Integer(215)
        5003h = Integer(-5)
        "#
    );
}

#[test]
fn settings_that_cannot_be_understood() {
    insta::assert_snapshot!(settings(HEATER, "heater", &["2000"]), @r#"
        error[OD0702]: found `2000`, expected ENTRY=VALUE
         --> --set:1:1
          |
        1 | 2000
          | ^^^^
          |
        help: write an index or a name, `=`, and a value: `607D.2=9000`
        "#);
    insta::assert_snapshot!(settings(HEATER, "heater", &["2999=5"]), @r#"
        error[OD0310]: `heater` has no entry `2999`
         --> --set:1:1
          |
        1 | 2999=5
          | ^^^^
          |
        help: write an index in hexadecimal (`607D.2`), an object's name, or `object.entry`
        "#);
    insta::assert_snapshot!(settings(HEATER, "heater", &["temperature.targte=5"]), @r#"
        error[OD0310]: `heater` has no entry `temperature.targte`
         --> --set:1:1
          |
        1 | temperature.targte=5
          | ^^^^^^^^^^^^^^^^^^
          |
        help: did you mean `temperature.target`?
        "#);
    insta::assert_snapshot!(settings(HEATER, "heater", &["2000=automatc"]), @r#"
        error[OD0403]: `automatc` is not a value of this enum
         --> --set:1:6
          |
        1 | 2000=automatc
          |      ^^^^^^^^
          |
        help: did you mean `automatic`?
        "#);
    insta::assert_snapshot!(settings(HEATER, "heater", &["temperature.low limit=5.05 °C"]), @r#"
        error[OD0412]: the value does not fit the unit's scale
         --> --set:1:23
          |
        1 | temperature.low limit=5.05 °C
          |                       ^^^^^^^ 50.5 steps of 0.1 °C
          |
        help: write 5.0 °C (raw 50) or 5.1 °C (raw 51), or a raw value
        "#);
    insta::assert_snapshot!(settings(HEATER, "heater", &["2001.1=5 K", "2001.2=40000"]), @r#"
        error[OD0405]: `K` is not the symbol of unit `decicelsius`
         --> --set #1:1:8
          |
        1 | 2001.1=5 K
          |        ^^^
          |
        help: write the value in `°C`

        error[OD0404]: 40000 does not fit INTEGER16
         --> --set #2:1:8
          |
        1 | 2001.2=40000
          |        ^^^^^ allowed: -32768 to 32767
          |
        help: correct the value or the type
        note: as a bit pattern this would be -25536; write signed values in decimal
        "#);
}

#[test]
fn settings_that_are_refused() {
    insta::assert_snapshot!(settings(HEATER, "heater", &["temperature.measured=5"]), @r#"
        error[OD0703]: 2001h.4 (measured) is `ro`
         --> --set:1:22
          |
        1 | temperature.measured=5
          |                      ^
          |
        help: only entries that can be written over the bus can be set
        "#);
    insta::assert_snapshot!(settings(HEATER, "heater", &["2002=101"]), @r#"
        error[OD0704]: 2002h (calibration) is locked: factory-set, writable only in service
         --> --set:1:6
          |
        1 | 2002=101
          |      ^^^
          |
        help: leave the entry out; a PLC cannot write it
        "#);
    insta::assert_snapshot!(settings(HEATER, "heater", &["1010.1=save"]), @r#"
        error[OD0707]: 1010h.1 (Save all parameters) must not be written by configuration tools
         --> --set:1:1
          |
        1 | 1010.1=save
          | ^^^^^^^^^^^
          |
        help: leave the entry out; writing it triggers a command
        "#);
    insta::assert_snapshot!(settings(HEATER, "heater", &["2001.2=-0.5 °C"]), @r#"
        error[OD0406]: 2001h.2 (high limit): -0.5 °C is outside 0.0 °C to 60.0 °C
         --> --set:1:8
          |
        1 | 2001.2=-0.5 °C
          |        ^^^^^^^
          |
        help: write a value within the limits; the device refuses any other
        "#);
    insta::assert_snapshot!(settings(HEATER, "heater", &["2000=off", "mode of operation=manual"]), @r#"
        error[OD0708]: 2000h is set twice
         --> --set #2:1:1
          |
        1 | mode of operation=manual
          | ^^^^^^^^^^^^^^^^^^^^^^^^ again here
          |
         ::: --set #1:1:1
          |
        1 | 2000=off
          | -------- first here
          |
        help: keep one of the two
        "#);
    insta::assert_snapshot!(settings(HEATER, "heater", &["2003=7", "5003=8"]), @r#"
        error[OD0708]: 2003h is set twice
         --> --set #2:1:1
          |
        1 | 5003=8
          | ^^^^^^ again here, as 5003h
          |
         ::: --set #1:1:1
          |
        1 | 2003=7
          | ------ first here
          |
        help: keep one of the two
        "#);
}

#[test]
fn settings_that_break_conditions() {
    insta::assert_snapshot!(settings(HEATER, "heater", &["2001.1=50.0 °C"]), @r#"
        error[OD0606]: the values of `heater` break `limits keep their order`
          --> --set:1:8
           |
         1 | 2001.1=50.0 °C
           |        ^^^^^^^ 2001h.1 is 50, 2001h.2 is 40: not <
           |
          ::: spec.od.yaml:21:38
           |
        21 |       2: {name: high limit, default: 40.0 °C, min: 0.0 °C, max: 60.0 °C, special: {32767: no limit}}
           |                                      ------- 2001h.2 is 40
        ...
        28 |   limits keep their order: {require: "0x2001.1 < 0x2001.2"}
           |                                      --------------------- the constraint
           |
        help: set values that meet the condition; entries that are not set have their defaults
        "#);
    insta::assert_snapshot!(settings(HEATER, "heater", &["2001.3=25.0 °C", "2000=manual"]), @r#"
        warning[OD0710]: the device accepts 2001h.3 only while `0x2000 == 2`
         --> --set #1:1:8
          |
        1 | 2001.3=25.0 °C
          |        ^^^^^^^
          |
        help: a download at boot will be refused unless the device is brought into that state first
        "#);
}

/// Entries with views, formulas, texts and PDOs.
const VIEWS: &str = "\
od-spec: 1
title: Views
uses: [cia301]
devices:
  views: {name: Views, bit-rates: [125], features: [heartbeat producer], dummies: [unsigned8]}
units:
  millivolt: {symbol: mV, base: 1/1000 V}
  volt: {symbol: V}
objects:
  0x2000: {name: mode, type: unsigned8, access: rw, default: 0}
  0x2001: {name: label, type: visible-string, access: rw, default: none}
  0x2002: {name: key, type: octet-string, access: rw}
  0x2003: {name: ratio, type: real32, access: rw}
  0x2004: {name: not in tools, type: unsigned8, access: rw, default: 0, eds: {access: ro}}
  0x2005: {name: own identifier, type: unsigned16, access: rw, default: $NODEID + 0x10, max: 0x100}
  0x2006: {name: other identifier, type: unsigned16, access: rw, default: 0x10}
  0x2007: {name: title, type: unicode-string, access: rw}
  0x5064: {alias: 0x6064, type: integer16, name: short position}
  0x5065: {alias: 0x6065, type: unsigned16, unit: volt, name: coarse voltage, writable-when: \"0x2000 == 1\"}
  0x5066: {alias: 0x6066, type: unsigned16, unit: millivolt, name: fine voltage}
  0x6064: {name: position, type: integer32, access: rw, pdo: both, default: 100, min: 0, max: 1000}
  0x6065: {name: voltage, type: unsigned32, unit: millivolt, access: rw, default: 2000 mV, max: 9000 mV}
  0x6066: {name: battery, type: unsigned16, unit: volt, access: rw, default: 12 V}
  0x6067: {name: speed, type: integer32, access: rw, pdo: transmit, default: 0}
pdos:
  views:
    receive:
      1: {map: [position]}
      2: {map: [position], valid: no}
    transmit: {1: {map: [speed], sync-start: 0}}
constraints:
  position keeps below: {require: \"0x5064 < 900\"}
  voltage keeps below: {require: \"0x6065 < 8\"}
  only in mode 0: {when: \"0x2000 == 3\", require: \"0x6066 < 12\"}
  identifiers differ: {require: \"0x2005 != 0x2006\"}
";

/// The first line about each setting: message or values.
fn first_lines(device: &str, spec: &str, list: &[&[&str]]) -> String {
    let line = |settings_of_one: &&[&str]| {
        let said = settings(spec, device, settings_of_one);
        format!("{}: {}\n", settings_of_one.join(", "), said.lines().next().unwrap_or_default())
    };
    list.iter().map(line).collect()
}

#[test]
fn settings_through_a_view_keep_the_limits_of_its_target() {
    insta::assert_snapshot!(settings(VIEWS, "views", &["5064=30000"]), @r#"
        error[OD0406]: 6064h (position): 30000 is outside 0 to 1000
         --> --set:1:6
          |
        1 | 5064=30000
          |      ^^^^^
          |
        help: write a value within the limits; the device refuses any other
        note: 5064h is a view of 6064h
        "#);
    insta::assert_snapshot!(first_lines("views", VIEWS, &[
        &["5064=-1"],
        &["5064=800"],
        &["5065=10 V", "2000=1"],
        &["5065=7 V", "2000=1"],
        &["5066=1500 mV"],
        &["5066=3000 mV"],
    ]), @r#"
        5064=-1: error[OD0406]: 6064h (position): -1 is outside 0 to 1000
        5064=800: 5064h = Integer(800)
        5065=10 V, 2000=1: error[OD0406]: 6065h (voltage): 10000 mV is outside 0 mV to 9000 mV
        5065=7 V, 2000=1: 2000h = Integer(1)
        5066=1500 mV: error[OD0412]: 5066h (fine voltage): 1500 mV is no whole number of steps of 6066h (battery)
        5066=3000 mV: 5066h = Integer(3000)
        "#);
}

#[test]
fn settings_with_a_formula_are_those_of_the_node() {
    insta::assert_snapshot!(first_lines("views", VIEWS, &[
        &["2005=$NODEID + 0x80"],
        &["2005=$NODEID + 0xFB"],
        &["2005=$NODEID + 0xFC"],
        &["2006=0x15"],
        &["2006=$NODEID + 0x10"],
        &["2005=0x10"],
    ]), @r#"
        2005=$NODEID + 0x80: 2005h = NodeId(128)
        2005=$NODEID + 0xFB: 2005h = NodeId(251)
        2005=$NODEID + 0xFC: error[OD0406]: 2005h (own identifier): 257 is outside 0 to 256
        2006=0x15: error[OD0606]: the values of `views` break `identifiers differ`
        2006=$NODEID + 0x10: error[OD0606]: the values of `views` break `identifiers differ`
        2005=0x10: error[OD0606]: the values of `views` break `identifiers differ`
        "#);
}

#[test]
fn settings_are_seen_by_conditions_under_every_name() {
    insta::assert_snapshot!(first_lines("views", VIEWS, &[
        &["2000=3"],
        &["6064=950"],
        &["5064=950"],
        &["6065=8500 mV"],
        &["5065=8 V", "2000=1"],
        &["5065=7 V"],
        &["6065=7 V"],
    ]), @r#"
        2000=3: error[OD0606]: the values of `views` break `only in mode 0`
        6064=950: error[OD0606]: the values of `views` break `position keeps below`
        5064=950: error[OD0606]: the values of `views` break `position keeps below`
        6065=8500 mV: error[OD0606]: the values of `views` break `voltage keeps below`
        5065=8 V, 2000=1: error[OD0606]: the values of `views` break `voltage keeps below`
        5065=7 V: warning[OD0710]: the device accepts 5065h only while `0x2000 == 1`
        6065=7 V: 6065h = Integer(7000)
        "#);
}

#[test]
fn settings_of_pdo_parameters_are_checked_like_pdos() {
    insta::assert_snapshot!(first_lines("views", VIEWS, &[
        &["1400.1=0x1"],
            &["1400.1=0x80000601"],
        &["1400.1=0x800"],
        &["1400.1=0x20000300"],
        &["1400.1=0xC0000300"],
        &["1400.1=0x80000000"],
        &["1400.1=$NODEID+0x180"],
        &["1400.1=$NODEID+0x80"],
        &["1400.1=$NODEID+0x300"],
        &["1401.1=$NODEID+0x200"],
        &["1401.1=$NODEID+0x200", "1400.1=0x80000000"],
        &["1400.2=245"],
        &["1400.2=252"],
        &["1800.2=252"],
        &["1800.6=240"],
        &["1800.6=241"],
        &["1600.0=9"],
        &["1600.0=0"],
        &["1600.0=2"],
        &["1600.2=0x60670020"],
        &["1600.2=0x60640010"],
        &["1600.2=0x70640010"],
        &["1600.2=0x20000008"],
        &["1600.0=2", "1600.2=0x60640020"],
        &["1600.0=3", "1600.2=0x60640020", "1600.3=0x00050008"],
        &["1600.2=0x00060010"],
        &["1A00.2=0x00050008"],
    ]), @r#"
        1400.1=0x1: error[OD0503]: 1400h.1: 001h is kept for another service
        1400.1=0x80000601: error[OD0503]: 1400h.1: 601h is kept for another service
        1400.1=0x800: error[OD0503]: 1400h.1: 800h is no 11-bit identifier
        1400.1=0x20000300: error[OD0503]: 1400h.1: 20000300h is no 11-bit identifier
        1400.1=0xC0000300: error[OD0508]: 1400h.1: an RPDO is not asked for by remote frames
        1400.1=0x80000000: 1400h.1 = Integer(2147483648)
        1400.1=$NODEID+0x180: error[OD0504]: RPDO 1 and TPDO 1 of `views` have one COB-ID
        1400.1=$NODEID+0x80: 1400h.1 = NodeId(128)
        1400.1=$NODEID+0x300: 1400h.1 = NodeId(768)
        1401.1=$NODEID+0x200: error[OD0504]: RPDO 1 and RPDO 2 of `views` have one COB-ID
        1401.1=$NODEID+0x200, 1400.1=0x80000000: 1400h.1 = Integer(2147483648)
        1400.2=245: error[OD0505]: 1400h.2: transmission type 245 is reserved for RPDO 1
        1400.2=252: error[OD0505]: 1400h.2: transmission type 252 is reserved for RPDO 1
        1800.2=252: 1800h.2 = Integer(252)
        1800.6=240: 1800h.6 = Integer(240)
        1800.6=241: error[OD0508]: 1800h.6: the SYNC counter never reaches 241
        1600.0=9: error[OD0508]: 1600h: RPDO 1 maps 9 entries, but offers 8
        1600.0=0: 1600h = Integer(0)
        1600.0=2: error[OD0508]: 1600h: RPDO 1 maps 2 entries, but entry 2 is empty
        1600.2=0x60670020: error[OD0502]: 1600h.2: 6067h (speed) cannot be mapped into RPDOs
        1600.2=0x60640010: error[OD0502]: 1600h.2: 6064h has 32 bits, not 16
        1600.2=0x70640010: error[OD0310]: 1600h.2: there is no entry 7064h
        1600.2=0x20000008: error[OD0502]: 1600h.2: 2000h (mode) cannot be mapped into PDOs
        1600.0=2, 1600.2=0x60640020: 1600h = Integer(2)
        1600.0=3, 1600.2=0x60640020, 1600.3=0x00050008: error[OD0507]: RPDO 1 carries 72 bits
        1600.2=0x00060010: error[OD0506]: 1600h.2: RPDO 1 takes no UNSIGNED16 placeholder
        1A00.2=0x00050008: error[OD0506]: 1A00h.2: a TPDO has no placeholders
        "#);
}

#[test]
fn settings_that_a_dcf_cannot_hold() {
    let long = format!("label={}", "x".repeat(241));
    let fits = format!("label={}", "x".repeat(240));
    let octets = format!("key={}", "A5".repeat(121));
    let lines = first_lines(
        "views",
        VIEWS,
        &[
            &["not in tools=1"],
            &[&long],
            &[&fits],
            &[&octets],
            &["label=a;b"],
            &["label=a=b"],
            &["label= a"],
            &["label="],
            &["title=≤ 5"],
            &["title=Größe"],
            &["title=a\tb"],
            &["ratio=1e39"],
            &["ratio= 0.5 "],
        ],
    );
    let lines = lines.replace(&"x".repeat(230), "x…").replace(&"A5".repeat(110), "A5…").replace('\t', "→");
    insta::assert_snapshot!(lines, @r#"
        not in tools=1: error[OD0703]: 2004h (not in tools) is `ro` in the EDS
        label=x…xxxxxxxxxxx: error[OD0319]: 2001h (label): the value has 241 characters, a line holds 240
        label=x…xxxxxxxxxx: 2001h = Text("x…xxxxxxxxxx")
        key=A5…A5A5A5A5A5A5A5A5A5A5A5: error[OD0319]: 2002h (key): the value has 121 bytes, a line holds 120
        label=a;b: error[OD0319]: 2001h (label): the value holds `;`, which EDS readers misread
        label=a=b: error[OD0319]: 2001h (label): the value holds `=`, which EDS readers misread
        label= a: error[OD0319]: 2001h (label): the value has blanks at its ends, which are lost
        label=: error[OD0319]: 2001h (label): the value is empty, which reads as no value
        title=≤ 5: error[OD0319]: 2007h (title): the value holds `=`, which EDS readers misread
        title=Größe: error[OD0319]: 2007h (title): the value has characters that an EDS cannot hold
        title=a→b: error[OD0319]: 2007h (title): the value holds a control character, which EDS readers misread
        ratio=1e39: error[OD0401]: found `1e39`, expected a finite number
        ratio= 0.5 : 2003h = Real(0.5)
        "#);
}

#[test]
fn settings_of_a_large_specification() {
    // The first line only: the others show lines of a file that grows.
    let said = |setting| {
        settings(PITCH, "pmm", &[setting]).lines().next().map(ToOwned::to_owned).unwrap_or_default()
    };
    insta::assert_snapshot!(said("30FA.3=700 V"), @"error[OD0606]: the values of `pmm` break `dc-link voltage ladder`");
    insta::assert_snapshot!(
        said("dc-link voltage.nominal valu=1"),
        @"error[OD0310]: `pmm` has no entry `dc-link voltage.nominal valu`"
    );
}

// ---------------------------------------------------------------------------------------------- random specifications

/// A valid specification that has every section.
fn everything() -> String {
    read(&ui().join("ok_everything.od.yaml"))
}

#[derive(Debug, Clone)]
enum Damage {
    Cut(usize, usize),
    Double(usize),
    Swap(usize, usize),
    Insert(usize, String),
    Replace(usize, usize),
}

fn damage() -> impl Strategy<Value = Damage> {
    let at = || any::<prop::sample::Index>().prop_map(|index| index.index(1 << 16));
    let strange = prop_oneof![
        "[ -_a-~]{1,3}", // no backtick: messages put names between two
        prop::sample::select(
            [
                ":", " ", "\n", "\t", "- ", "{", "}", "[", "]", "\"", "'", "#", "&a ", "*a", "!x ", "<<: ",
                "|\n", ">-\n", "? ", "---\n", "...\n", "%", "0", "-", "0x", "é", "日", "\u{0}", "\u{feff}",
                "\u{2028}", "$NODEID", "..", "yes", "\r\n",
            ]
            .map(ToOwned::to_owned)
            .to_vec()
        ),
    ];
    prop_oneof![
        (at(), 1..40usize).prop_map(|(at, length)| Damage::Cut(at, length)),
        at().prop_map(Damage::Double),
        (at(), at()).prop_map(|(a, b)| Damage::Swap(a, b)),
        (at(), strange).prop_map(|(at, text)| Damage::Insert(at, text)),
        (at(), at()).prop_map(|(a, b)| Damage::Replace(a, b)),
    ]
}

fn apply(text: &str, damage: &Damage) -> String {
    let boundary =
        |at: usize| text.char_indices().map(|(at, _)| at).nth(at % text.chars().count().max(1)).unwrap_or(0);
    let mut lines: Vec<&str> = text.lines().collect();
    let count = lines.len().max(1);
    match damage {
        Damage::Cut(at, length) => {
            let start = boundary(*at);
            let rest: String = text[start..].chars().skip(*length).collect();
            return format!("{}{rest}", &text[..start]);
        }
        Damage::Insert(at, what) => {
            let start = boundary(*at);
            return format!("{}{what}{}", &text[..start], &text[start..]);
        }
        Damage::Double(at) => {
            if let Some(line) = lines.get(at % count).copied() {
                lines.insert(at % count, line);
            }
        }
        Damage::Swap(a, b) if !lines.is_empty() => lines.swap(a % count, b % count),
        Damage::Replace(a, b) if !lines.is_empty() => lines[a % count] = lines[b % count],
        _ => {}
    }
    lines.join("\n") + "\n"
}

/// Compiles and renders in every format; nothing may panic, and a refusal has a reason with a place.
fn compile_anything(text: &str) {
    let (sources, root, compiled) = run("random.od.yaml", text);
    for format in [Format::Human, Format::Short, Format::Json] {
        let out = render(&compiled.diagnostics, &sources, format, false);
        if format != Format::Human {
            assert_eq!(out.lines().count(), compiled.diagnostics.iter().count());
        }
    }
    for diagnostic in &compiled.diagnostics {
        check_wording(diagnostic, &sources, text);
    }
    if compiled.system.is_none() {
        let has_place =
            |diagnostic: &Diagnostic| diagnostic.labels.iter().any(|label| label.span.file == root);
        let mut errors =
            compiled.diagnostics.iter().filter(|diagnostic| diagnostic.severity() == Severity::Error);
        assert!(errors.any(has_place), "no reason for a refusal of:\n{text}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 250, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn damaged_specifications_are_refused_with_a_place(list in prop::collection::vec(damage(), 1..5)) {
        let text = list.iter().fold(everything(), |text, damage| apply(&text, damage));
        compile_anything(&text);
    }

    #[test]
    fn arbitrary_bytes_do_no_harm(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        match read_text("random.od.yaml", bytes) {
            Ok(text) => compile_anything(&text),
            Err(diagnostic) => prop_assert_eq!(diagnostic.code, codes::NOT_UTF8),
        }
    }

    #[test]
    fn arbitrary_text_does_no_harm(text in "(od-spec: 1\n)?([a-z0-9x:.&*!'\"{}\\[\\]|>%@#, -]{0,12}\n?){0,20}") {
        compile_anything(&text);
    }
}

// ---------------------------------------------------------------------------------------------- another YAML reader

/// What two YAML readers must agree about: structure, order, and scalars by what they mean.
fn same(ours: &Node, theirs: &serde_yaml::Value, place: &str) {
    use serde_yaml::Value;
    match (&ours.kind, theirs) {
        (NodeKind::Null, Value::Null) => {}
        (NodeKind::List(items), Value::Sequence(others)) => {
            assert_eq!(items.len(), others.len(), "{place}");
            for (at, (item, other)) in items.iter().zip(others).enumerate() {
                same(item, other, &format!("{place}[{at}]"));
            }
        }
        (NodeKind::Map(entries), Value::Mapping(others)) => {
            assert_eq!(entries.len(), others.len(), "{place}");
            for ((name, node), (key, other)) in entries.iter().zip(others) {
                let key_text = name.value.as_str();
                same_scalar(key_text, key, &format!("{place}, key {key_text}"));
                same(node, other, &format!("{place}.{key_text}"));
            }
        }
        (NodeKind::Scalar { text, .. }, other) => same_scalar(text, other, place),
        (kind, other) => panic!("{place}: {kind:?} is not {other:?}"),
    }
}

/// YAML readers give plain scalars a type; ours keeps the text. Numbers are compared as numbers.
fn same_scalar(text: &str, other: &serde_yaml::Value, place: &str) {
    use serde_yaml::Value;
    let fine = match other {
        Value::String(string) => string == text,
        Value::Bool(value) => text == value.to_string(),
        Value::Number(number) => match (number.as_i64().map(i128::from), number.as_u64().map(i128::from)) {
            (Some(value), _) | (None, Some(value)) => scalar::integer(text) == Ok(value),
            _ => text.parse::<f64>().ok() == number.as_f64(),
        },
        Value::Null => matches!(text, "" | "~" | "null"),
        _ => false,
    };
    assert!(fine, "{place}: `{text}` is not {other:?}");
}

#[test]
fn another_yaml_reader_sees_the_same() {
    let fine = cases().into_iter().filter(|(name, _)| name.starts_with("ok_"));
    let libraries = LIBRARIES.iter().map(|(name, text)| ((*name).to_owned(), (*text).to_owned()));
    for (name, text) in fine.chain(libraries).chain([("pitch".to_owned(), PITCH.to_owned())]) {
        let mut sources = SourceMap::new();
        let id = sources.add(name.as_str(), text.as_str());
        let mut diagnostics = Diagnostics::new();
        let ours = od_spec::yaml::parse(id, sources.file(id), &mut diagnostics).expect("YAML");
        assert!(diagnostics.is_empty(), "{name}");
        let theirs: serde_yaml::Value =
            serde_yaml::from_str(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
        same(&ours, &theirs, &name);
    }
}
