//! The cases of `tests/ui/parameters`: what is said about parameter files, and what right ones give.

use std::fs;
use std::path::PathBuf;

use od_spec::diag::Diagnostics;
use od_spec::model::System;
use od_spec::source::SourceMap;
use od_spec::{Assigned, Commissioning, Layer, assign_layers, is_parameter_file, parameter_file};

use crate::diagnostics::wording_rules::check_wording;
use crate::diagnostics::{codes, human, read, run, ui};

/// A specification with a parameter of every kind.
pub(crate) const OVEN: &str = include_str!("../../../shared/oven.od.yaml");

/// What some parameter files, laid over each other, give.
pub(crate) struct Settled {
    pub(crate) system: System,
    pub(crate) node: Commissioning,
    pub(crate) assigned: Assigned,
    pub(crate) diagnostics: Diagnostics,
    pub(crate) sources: SourceMap,
}

/// Reads parameter files for the oven; of one, `#2` follows the name of the second.
pub(crate) fn settled(name: &str, texts: &[&str]) -> Settled {
    let (mut sources, _, compiled) = run("oven.od.yaml", OVEN);
    let system = compiled.system.expect("a specification without mistakes");
    let oven = system.device("oven").unwrap();
    let mut diagnostics = Diagnostics::new();
    let mut files = Vec::new();
    for (at, text) in texts.iter().enumerate() {
        let name = if at == 0 { name.to_owned() } else { format!("{name} #{}", at + 1) };
        let file = sources.add(name, *text);
        files.extend(parameter_file(&sources, file, &mut diagnostics));
    }
    let id = files.iter().filter_map(|file| file.node).next_back().map_or(5, |node| node.value);
    let mut node = Commissioning::of_node(oven, id);
    for file in &files {
        file.check_device(&system, oven, &mut diagnostics);
        file.settle(oven, &mut node, &mut diagnostics);
    }
    let layers: Vec<Layer> = files.into_iter().map(|file| file.layer).collect();
    let assigned = assign_layers(&system, oven, node.node, &layers, &mut diagnostics);
    diagnostics.sort();
    Settled { system, node, assigned, diagnostics, sources }
}

fn folder() -> PathBuf {
    ui().join("parameters")
}

/// Name and text of every case.
pub(crate) fn cases() -> Vec<(String, String)> {
    let files = fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().path());
    let cases = files.filter(|path| path.extension().is_some_and(|ending| ending == "yaml"));
    let mut cases: Vec<(String, String)> =
        cases.map(|path| (path.file_name().unwrap().to_str().unwrap().to_owned(), read(&path))).collect();
    cases.sort();
    assert!(cases.len() > 30);
    cases
}

fn shown(Settled { node, assigned, diagnostics, sources, .. }: &Settled) -> String {
    if diagnostics.has_errors() {
        return human(diagnostics, sources);
    }
    let Commissioning { node: id, node_name, bit_rate, net_number, net_name, serial_number, .. } = node;
    let values = assigned.values.iter().map(|(id, value)| {
        let lock = if assigned.unlocked.contains(id) { ", unlocked" } else { "" };
        format!("{id} = {value:?}{lock}\n")
    });
    let head = format!(
        "node {id} `{node_name}`, {bit_rate} kbit/s, network {net_number} `{net_name}`, serial number {serial_number:?}\n"
    );
    human(diagnostics, sources) + &head + &values.collect::<String>()
}

#[test]
fn cases_of_parameter_files_say_what_was_reviewed() {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("../../../ui/parameters/snapshots");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| {
        insta::glob!("../../../ui/parameters", "*.yaml", |path| {
            let name = path.file_name().unwrap().to_str().unwrap();
            insta::assert_snapshot!("said", shown(&settled(name, &[&read(path)])));
        });
    });
    for entry in fs::read_dir(folder().join("snapshots")).unwrap() {
        let file = entry.unwrap().file_name().into_string().unwrap();
        let case = file.strip_prefix("said@").and_then(|rest| rest.strip_suffix(".snap"));
        assert!(case.is_some_and(|case| folder().join(case).is_file()), "{file} belongs to no case");
    }
}

#[test]
fn names_of_cases_of_parameter_files_say_what_comes_out() {
    for (name, text) in cases() {
        let Settled { diagnostics, sources, .. } = settled(&name, &[&text]);
        let (errors, warnings) = diagnostics.count();
        let is_of_kind = match name.split('_').next().unwrap() {
            "err" => errors > 0,
            "warn" => errors == 0 && warnings > 0,
            "ok" => diagnostics.is_empty(),
            _ => panic!("{name}: a case is named err_, warn_ or ok_"),
        };
        assert!(
            is_of_kind,
            "{name}: {errors} errors, {warnings} warnings\n{}",
            human(&diagnostics, &sources)
        );
        if let Some(code) = name.split('_').nth(1).and_then(od_spec::code) {
            assert!(codes(&diagnostics).contains(&code), "{name} does not provoke {code}");
        }
        assert!(text.starts_with("# "), "{name}: the first line says what is wrong");
        for diagnostic in &diagnostics {
            check_wording(diagnostic, &sources, &name);
            assert!(!diagnostic.labels.is_empty(), "{name}: {} has no place", diagnostic.message);
        }
    }
}

#[test]
fn a_later_layer_takes_the_place_of_an_earlier_one() {
    let file = |parameters: &str| format!("od-parameters: 1\nparameters: {parameters}\n");
    let (of_type, of_blade) = (
        file("{position: 5, supply: {lowest: 200 V, nominal: 240 V}}"),
        file("{short position: 7, supply.nominal: 250 V}"),
    );
    let Settled { assigned, diagnostics, sources, .. } = settled("type.yaml", &[&of_type, &of_blade]);
    assert!(diagnostics.is_empty(), "{}", human(&diagnostics, &sources));
    let lines = assigned.values.iter().map(|(id, value)| {
        let origin = assigned.origins[id];
        let line = |span: od_spec::source::Span| sources.file(span.file).line_col(span.start).to_string();
        let before: Vec<String> = assigned
            .overridden
            .get(id)
            .into_iter()
            .flatten()
            .map(|before| format!("{} of layer {} at {}", before.id, before.layer, line(before.span)))
            .collect();
        format!("{id} = {value:?} of layer {} at {}, over {before:?}\n", origin.layer, line(origin.span))
    });
    insta::assert_snapshot!("layers_of_parameters", lines.collect::<String>());
    // What breaks a condition is shown with all places, in whichever layer they are.
    let of_blade = file("{supply.nominal: 190 V}");
    let Settled { diagnostics, sources, .. } = settled("type.yaml", &[&of_type, &of_blade]);
    insta::assert_snapshot!("constraint_over_layers", human(&diagnostics, &sources));
    // In one layer, nothing is set twice.
    let twice = file("{supply.nominal: 240 V, 2006.2: 240 V}");
    assert_eq!(settled("type.yaml", &[&of_type, &twice]).diagnostics.count(), (1, 0));
}

#[test]
fn an_unlock_lifts_the_lock_of_one_entry_alone() {
    let text =
        |unlock: &str| format!("od-parameters: 1\nparameters: {{calibration: 101}}\nunlock: [{unlock}]\n");
    for name in ["calibration", "2002", "0x2002"] {
        let Settled { assigned, diagnostics, .. } = settled("oven.yaml", &[&text(name)]);
        assert!(diagnostics.is_empty() && assigned.unlocked.len() == 1, "{name}");
    }
    // It may be in another layer than the value.
    let unlock = "od-parameters: 1\nunlock: [calibration]\n";
    let value = "od-parameters: 1\nparameters: {calibration: 101}\n";
    assert!(settled("oven.yaml", &[unlock, value]).diagnostics.is_empty());
    assert!(settled("oven.yaml", &[value, unlock]).diagnostics.is_empty());
    // What is unlocked and not set is not shown as set.
    assert!(settled("oven.yaml", &[unlock]).assigned.unlocked.is_empty());
    // The other rules stay: a value has to be one of the type.
    let wrong = text("calibration").replace("101", "65536");
    let found = settled("oven.yaml", &[&wrong]).diagnostics;
    assert_eq!(found.iter().map(|one| one.code.id).collect::<Vec<_>>(), ["OD0404"]);
}

#[test]
fn a_parameter_file_is_known_by_the_first_key_that_says_what_it_is() {
    let right = [
        "od-parameters: 1",
        "# a comment\n\n---\nod-parameters : 1\n",
        "od-parameters:",
        "spec: oven.od.yaml\nod-parameters: 1",
    ];
    let wrong =
        ["", "od-spec: 1\nod-parameters: 1", "od-parameters-x: 1", "  od-parameters: 1", "[FileInfo]\n"];
    assert!(right.iter().all(|text| is_parameter_file(text)));
    assert!(!wrong.iter().any(|text| is_parameter_file(text)));
}
