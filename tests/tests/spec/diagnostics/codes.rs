//! Every code has an explanation, and something that provokes it: a case of `tests/ui`, its example, a row of the table below,
//! or a command line in the table of the command's tests.

use std::collections::BTreeSet;

use od_c as c;
use od_gen::rust::{self, Provenance};
use od_spec::diag::{Code, Diagnostics, Example, Language, Severity, codes as known};
use od_spec::source::SourceMap;
use od_spec::{NoFiles, Strictness, add_source, all_codes, code, compile_as, read_text};

use crate::diagnostics::bytes_and_libraries::{LAMP, compiled_with};
use crate::diagnostics::settings::{HEATER, assigned};
use crate::diagnostics::{codes, parameter_files, parts, plants, run, said_of_cases};

#[path = "../../../../od-gen/cli/tests/cli/provoked.rs"]
mod command_line;

/// Something that provokes a code and is not a specification by itself.
struct Provocation {
    code: &'static Code,
    diagnostics: fn() -> Diagnostics,
}

const PROVOKED: &[Provocation] = &[
    Provocation { code: known::NOT_UTF8, diagnostics: || unread(b"title: L\xe4mpchen".to_vec()) },
    Provocation { code: known::TOO_LARGE, diagnostics: || unread(vec![b' '; (64 << 20) + 1]) },
    Provocation { code: known::OTHER_BUS, diagnostics: || no_eds(b"[File]\n[Device]\n".to_vec()) },
    Provocation { code: known::NOT_A_LIBRARY, diagnostics: lamps_without_profile },
    Provocation { code: known::NOT_A_PART, diagnostics: parts::a_file_that_is_no_part },
    Provocation { code: known::BAD_ASSIGNMENT, diagnostics: || heater(&["2000"]) },
    Provocation { code: known::SET_TWICE, diagnostics: || heater(&["2000=off", "2000=manual"]) },
    Provocation { code: known::IDENTIFIER_CLASH, diagnostics: names_clash },
    Provocation { code: known::NO_IDENTIFIER, diagnostics: names_clash },
    Provocation { code: known::NO_CAPACITY, diagnostics: names_clash },
    Provocation { code: known::NOT_IN_FIRMWARE, diagnostics: names_clash },
    Provocation { code: known::STACK_REFUSES, diagnostics: without_heartbeat },
    Provocation { code: known::STACK_DIFFERS, diagnostics: with_bytes },
    Provocation { code: known::NAMES_ALIKE, diagnostics: names_alike },
];

fn unread(bytes: Vec<u8>) -> Diagnostics {
    let mut diagnostics = Diagnostics::new();
    diagnostics.push(*read_text("lamp.od.yaml", bytes).unwrap_err());
    diagnostics
}

fn no_eds(bytes: Vec<u8>) -> Diagnostics {
    let mut diagnostics = Diagnostics::new();
    diagnostics.push(*add_source(&mut SourceMap::new(), "lamp.eds", bytes).unwrap_err());
    diagnostics
}

fn lamps_without_profile() -> Diagnostics {
    compiled_with(LAMP, &[("../lamps.od.yaml", b"od-spec: 1\ntitle: Lamps\n")]).1.diagnostics
}

fn heater(settings: &[&str]) -> Diagnostics {
    assigned(HEATER, "heater", settings).diagnostics
}

/// What generated code cannot name or do.
fn names_clash() -> Diagnostics {
    let (sources, _, compiled) =
        run("names_clash.od.yaml", include_str!("../../../macros/names_clash.od.yaml"));
    let system = compiled.system.unwrap();
    let mut diagnostics = Diagnostics::new();
    rust::artifacts(&system, system.devices.iter(), &Provenance::of(&sources), &mut diagnostics);
    diagnostics
}

/// A device that lacks what a stack needs.
fn without_heartbeat() -> Diagnostics {
    of_stack("od-spec: 1\ntitle: T\nuses: [cia301]\ndevices: {d: {name: D, bit-rates: [125]}}\n")
}

fn with_bytes() -> Diagnostics {
    of_stack(
        "od-spec: 1\ntitle: T\nuses: [cia301]\ndevices: {d: {name: D, bit-rates: [125], features: [heartbeat producer]}}\n\
         objects:\n  0x2000: {name: raw, type: octet-string, capacity: 4, access: rw}\n",
    )
}

fn names_alike() -> Diagnostics {
    let name = "a long name of which the first characters are those of another one";
    of_c(
        &format!(
            "od-spec: 1\ntitle: T\ndevices: {{d: {{name: D, bit-rates: [125]}}}}\n\
             objects:\n  0x2000: {{name: {name} a, type: unsigned8, access: rw}}\n\
             \x20 0x2001: {{name: {name} b, type: unsigned8, access: rw}}\n"
        ),
        c::Kind::Plain,
    )
}

/// What is said when C for a stack is made.
fn of_stack(text: &str) -> Diagnostics {
    of_c(text, c::Kind::CanopenNode)
}

fn of_c(text: &str, kind: c::Kind) -> Diagnostics {
    let (sources, _, compiled) = run("stack.od.yaml", text);
    let system = compiled.system.unwrap();
    let mut diagnostics = Diagnostics::new();
    let options = kind.into();
    c::artifacts(&system, system.devices.iter(), &Provenance::of(&sources), &options, &mut diagnostics);
    diagnostics
}

/// What is said about an EDS or DCF that is an example, with the text.
pub(crate) fn eds_example(example: &Example) -> (Diagnostics, SourceMap) {
    let mut sources = SourceMap::new();
    let file = sources.add(example.language.file_name(), example.language.whole(example.before));
    let compiled = compile_as(Strictness::Standard, &mut sources, file, &mut NoFiles);
    (compiled.diagnostics, sources)
}

/// What is said about the example of a code, with the settings that it gives as comments.
fn example(example: &Example) -> BTreeSet<&'static Code> {
    let text = example.language.whole(example.before);
    match example.language {
        Language::Specification => {}
        Language::Eds | Language::Dcf => return codes(&eds_example(example).0),
        // They have tests and cases of their own.
        Language::Parameters | Language::Plant | Language::Xdd | Language::Concise => return BTreeSet::new(),
    }
    let settings: Vec<&str> = text.lines().filter_map(|line| line.strip_prefix("# --set ")).collect();
    let (_, _, compiled) = run("example.od.yaml", &text);
    match compiled.system {
        Some(system) if !settings.is_empty() => {
            codes(&assigned(&text, &system.devices[0].key, &settings).diagnostics)
        }
        Some(_) | None => codes(&compiled.diagnostics),
    }
}

#[test]
fn every_code_has_a_case() {
    let mut provoked: BTreeSet<&'static Code> = BTreeSet::new();
    let mut of_parameters: BTreeSet<&'static Code> = BTreeSet::new();
    for (.., (_, _, compiled)) in said_of_cases() {
        provoked.extend(codes(&compiled.diagnostics));
    }
    for code in all_codes() {
        provoked.extend(code.example.iter().flat_map(example));
    }
    of_parameters.extend(plants::provoked());
    for (name, text) in parameter_files::cases() {
        of_parameters.extend(codes(&parameter_files::settled(&name, &[&text]).diagnostics));
    }
    for Provocation { code, diagnostics } in PROVOKED {
        assert!(!provoked.contains(code), "{code} has a case: take it out of the table");
        assert!(codes(&diagnostics()).contains(code), "nothing provokes {code} any more");
    }
    provoked.extend(PROVOKED.iter().map(|provocation| provocation.code));
    for command_line::Provocation { code: id, arguments } in command_line::PROVOKED {
        let code = code(id).unwrap();
        assert!(provoked.insert(code), "{code} has a case: take `{}` out of its table", arguments.join(" "));
    }
    provoked.extend(of_parameters);
    for code in all_codes().into_iter().filter(|code| !is_of_the_eds_reader(code)) {
        assert!(provoked.contains(&code), "{code} ({}) has no case", code.title);
    }
}

/// What reading an EDS says about objects and values has its own tests.
fn is_of_the_eds_reader(code: &Code) -> bool {
    ["EDS40", "EDS41", "EDS50", "EDS51"].iter().any(|series| code.id.starts_with(series))
}

#[test]
fn explanations_are_sentences() {
    for code in all_codes() {
        assert!(!code.title.ends_with('.'), "{code}");
        let explanation = code.explanation;
        assert!(explanation.ends_with(['.', '?', '}']), "{code}: {explanation}");
        let is_light = matches!(code.severity, Severity::Warning | Severity::Note);
        let is_of_a_specification = code.id.starts_with("OD");
        assert!(
            !is_of_a_specification || is_light == (code.id.starts_with("OD08") || code.id == "OD0710"),
            "{code}"
        );
    }
}
