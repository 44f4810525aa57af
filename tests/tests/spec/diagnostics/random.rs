//! Random specifications: nothing panics, and a refusal has a reason with a place.

use od_formats::findings::{github, json};
use od_import::parameters::{About, write};
use od_spec::diag::render::{Format, render};
use od_spec::diag::{Diagnostic, Severity, codes};
use od_spec::read_text;
use proptest::prelude::*;

use crate::diagnostics::parameter_files::{Settled, settled};
use crate::diagnostics::wording_rules::check_wording;
use crate::diagnostics::{human, read, run, ui};

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
    let found = &compiled.diagnostics;
    render(found, &sources, Format::Human, false);
    for out in [render(found, &sources, Format::Short, false), json(found, &sources), github(found, &sources)]
    {
        assert_eq!(out.lines().count(), found.iter().count());
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

/// A parameter file that sets everything.
fn every_parameter() -> String {
    read(&ui().join("parameters/ok_everything.yaml"))
}

/// Reads a parameter file; nothing may panic, and what is wrong has a place. What is right can be downloaded, and comes back from
/// the file that is written for it.
fn settle_anything(text: &str) {
    let Settled { system, mut node, assigned, diagnostics, sources } = settled("random.yaml", &[text]);
    for diagnostic in &diagnostics {
        check_wording(diagnostic, &sources, text);
        assert!(!diagnostic.labels.is_empty(), "{} has no place:\n{text}", diagnostic.message);
    }
    if diagnostics.has_errors() {
        return;
    }
    let oven = system.device("oven").unwrap();
    (node.values, node.unlocked) = (assigned.values, assigned.unlocked);
    assert!(node.download(&system, oven).is_ok(), "{text}");
    let node_id = Some(node.node);
    let about = About { system: &system, sources: &sources, device: oven, names_device: true, node_id };
    let written = write(about, &node, Vec::new());
    let back = settled("back.yaml", &[&written.text]);
    assert!(!back.diagnostics.has_errors(), "{}\n{}", written.text, human(&back.diagnostics, &back.sources));
    node.keep_differences(oven);
    assert_eq!(back.assigned.values, node.values, "{text}\n{}", written.text);
    assert_eq!(back.assigned.unlocked, node.unlocked);
    assert_eq!((back.node.node, back.node.bit_rate), (node.node, node.bit_rate));
    assert_eq!((back.node.net_number, back.node.serial_number), (node.net_number, node.serial_number));
    assert_eq!((&back.node.node_name, &back.node.net_name), (&node.node_name, &node.net_name));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: od_tests::cases(250), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn damaged_specifications_are_refused_with_a_place(list in prop::collection::vec(damage(), 1..5)) {
        let text = list.iter().fold(everything(), |text, damage| apply(&text, damage));
        compile_anything(&text);
    }

    #[test]
    fn damaged_parameter_files_are_refused_or_come_back(list in prop::collection::vec(damage(), 1..4)) {
        let text = list.iter().fold(every_parameter(), |text, damage| apply(&text, damage));
        settle_anything(&text);
    }

    #[test]
    fn parameters_come_back(
        (position, low, label, bits, real) in (any::<i32>(), -500..1500i16, "[ -~]{0,8}", 0..64u16, any::<f32>()),
    ) {
        prop_assume!(real.is_finite());
        let label = serde_yaml::to_string(&label).unwrap();
        settle_anything(&format!(
            "od-parameters: 1\nparameters:\n  position: {position}\n  2001.1: {low}\n  label: {label}  2004: {bits}\n  2007: {real:?}\n"
        ));
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
