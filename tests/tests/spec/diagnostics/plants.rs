//! The cases of `tests/ui/plant`: what is said about plant files, and what right ones give.

use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;

use od_spec::Loader;
use od_spec::diag::{Code, Diagnostics};
use od_spec::plant::{Plant, PlantLayer, Settled, is_plant, plant};
use od_spec::source::SourceMap;

use crate::diagnostics::wording_rules::check_wording;
use crate::diagnostics::{codes, human, read, ui};

/// A supply and a drive, with a condition between them.
const PRESS: &str = include_str!("../../../shared/press.od.yaml");

/// Gives the specification, and counts how often.
#[derive(Default)]
struct Press {
    loaded: usize,
}

impl Loader for Press {
    fn load(&mut self, path: &str, _from: &str) -> Result<Vec<u8>, String> {
        match path {
            "press.od.yaml" => {
                self.loaded += 1;
                Ok(PRESS.as_bytes().to_vec())
            }
            _ => Err("no such file".to_owned()),
        }
    }
}

/// A plant with what is wrong with it.
struct Checked {
    plant: Option<Plant>,
    settled: Vec<Settled>,
    diagnostics: Diagnostics,
    sources: SourceMap,
}

fn checked(name: &str, text: &str) -> Checked {
    let (mut sources, mut loader) = (SourceMap::new(), Press::default());
    let root = sources.add(name, text);
    let read = plant(&mut sources, root, &mut loader);
    assert!(loader.loaded <= 1, "the specification is read once");
    let mut diagnostics = read.diagnostics;
    for file in read.files {
        diagnostics.append(file.diagnostics);
    }
    let mut settled = Vec::new();
    if let Some(plant) = &read.plant {
        settled.extend((0..plant.classes.len()).filter_map(|class| plant.settle(class)));
        diagnostics.append(plant.check(&settled));
    }
    diagnostics.sort();
    Checked { plant: read.plant, settled, diagnostics, sources }
}

fn folder() -> PathBuf {
    ui().join("plant")
}

fn shown(checked: &Checked) -> String {
    let mut text = human(&checked.diagnostics, &checked.sources);
    let Some(plant) = checked.plant.as_ref().filter(|_| !checked.diagnostics.has_errors()) else {
        return text;
    };
    for (class, settled) in plant.classes.iter().zip(&checked.settled) {
        let first = &plant.nodes[class.first];
        let node = plant.commissioning(first, settled);
        let _ = writeln!(
            text,
            "{} of {}: `{}`, {} kbit/s, network {} `{}`, serial {:?}",
            class.count,
            plant.name_of(first),
            node.node_name,
            node.bit_rate,
            node.net_number,
            node.net_name,
            node.serial_number,
        );
        let layers: Vec<String> = plant.layers_of(&class.own).map(PlantLayer::words).collect();
        for (id, value) in &node.values {
            let origin = settled.assigned.origins[id];
            let lock = if node.unlocked.contains(id) { ", unlocked" } else { "" };
            let _ = writeln!(text, "  {id} = {value:?}{lock}, from {}", layers[origin.layer]);
        }
    }
    text
}

#[test]
fn cases_of_plants_say_what_was_reviewed() {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("../../../ui/plant/snapshots");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| {
        insta::glob!("../../../ui/plant", "*.yaml", |path| {
            let name = path.file_name().unwrap().to_str().unwrap();
            insta::assert_snapshot!("said", shown(&checked(name, &read(path))));
        });
    });
    for entry in fs::read_dir(folder().join("snapshots")).unwrap() {
        let file = entry.unwrap().file_name().into_string().unwrap();
        let case = file.strip_prefix("said@").and_then(|rest| rest.strip_suffix(".snap"));
        assert!(case.is_some_and(|case| folder().join(case).is_file()), "{file} belongs to no case");
    }
}

/// Name and text of every case.
pub(crate) fn cases() -> Vec<(String, String)> {
    let files = fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().path());
    let cases = files.filter(|path| path.extension().is_some_and(|ending| ending == "yaml"));
    let mut cases: Vec<(String, String)> =
        cases.map(|path| (path.file_name().unwrap().to_str().unwrap().to_owned(), read(&path))).collect();
    cases.sort();
    assert!(cases.len() > 20);
    cases
}

/// The codes that the cases provoke.
pub(crate) fn provoked() -> Vec<&'static Code> {
    let all = cases();
    all.iter().flat_map(|(name, text)| codes(&checked(name, text).diagnostics)).collect()
}

#[test]
fn names_of_cases_of_plants_say_what_comes_out() {
    for (name, text) in cases() {
        let Checked { diagnostics, sources, plant, settled } = checked(&name, &text);
        let (errors, warnings) = diagnostics.count();
        let is_of_kind = match name.split('_').next().unwrap() {
            "err" => errors > 0,
            "warn" => errors == 0 && warnings > 0,
            "ok" => diagnostics.is_empty() && plant.is_some() && !settled.is_empty(),
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
        assert_eq!(is_plant(&text), name != "err_od0110_empty.yaml", "{name}");
        for diagnostic in &diagnostics {
            check_wording(diagnostic, &sources, &name);
            assert!(!diagnostic.labels.is_empty(), "{name}: {} has no place", diagnostic.message);
        }
    }
}

#[test]
fn an_inherited_mistake_is_said_once_however_many_nodes_have_it() {
    let text = read(&folder().join("err_od0406_inherited.yaml")).replace("1..3", "1..2000");
    let Checked { diagnostics, .. } = checked("plant.yaml", &text);
    assert_eq!(diagnostics.count(), (1, 0));
    let note = &diagnostics.iter().next().unwrap().notes.last().unwrap();
    assert_eq!(*note, "on Hall 1, position left, supply (node 1), and 3999 more nodes");
}
