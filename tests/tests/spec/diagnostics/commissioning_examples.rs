//! The examples of `odgen explain` about parameter files, plants, XDDs and concise DCFs, tried: what is refused is refused for this
//! code alone, and what is accepted is.

use std::collections::BTreeSet;

use od_formats::concise;
use od_spec::diag::{Diagnostics, Example, Language};
use od_spec::plant::{Settled, plant};
use od_spec::source::SourceMap;
use od_spec::{
    Commissioning, Layer, Loader, NoFiles, add_source, all_codes, assign_layers, compile, parameter_file,
};

use crate::diagnostics::wording_rules::check_wording;

struct Devices;

impl Loader for Devices {
    fn load(&mut self, path: &str, _from: &str) -> Result<Vec<u8>, String> {
        assert_eq!(path, Example::DEVICES_FILE);
        Ok(Example::DEVICES.into())
    }
}

/// What is said about a parameter file for the drive.
fn of_parameters(text: &str) -> (Diagnostics, SourceMap) {
    let mut sources = SourceMap::new();
    let root = sources.add(Example::DEVICES_FILE, Example::DEVICES);
    let system = compile(&mut sources, root, &mut NoFiles).system.unwrap();
    let drive = system.device("drive").unwrap();
    let mut diagnostics = Diagnostics::new();
    let file = sources.add(Language::Parameters.file_name(), text);
    let file = parameter_file(&sources, file, &mut diagnostics).unwrap();
    let mut node = Commissioning::of_node(drive, 11);
    file.settle(drive, &mut node, &mut diagnostics);
    let layers: Vec<Layer> = vec![file.layer];
    assign_layers(&system, drive, 11, &layers, &mut diagnostics);
    (diagnostics, sources)
}

fn of_plant(text: &str) -> (Diagnostics, SourceMap) {
    let mut sources = SourceMap::new();
    let root = sources.add(Language::Plant.file_name(), text);
    let read = plant(&mut sources, root, &mut Devices);
    let mut diagnostics = read.diagnostics;
    read.files.into_iter().for_each(|file| diagnostics.append(file.diagnostics));
    if let Some(plant) = &read.plant {
        let settled: Vec<Settled> =
            (0..plant.classes.len()).filter_map(|class| plant.settle(class)).collect();
        diagnostics.append(plant.check(&settled));
    }
    (diagnostics, sources)
}

/// What is said about an XDD as such; that it describes half a device is not of interest.
fn of_xdd(text: &str) -> (Diagnostics, SourceMap) {
    let mut sources = SourceMap::new();
    let root = add_source(&mut sources, Language::Xdd.file_name(), text.into()).unwrap();
    let mut diagnostics = Diagnostics::new();
    let said = compile(&mut sources, root, &mut NoFiles).diagnostics;
    said.iter().filter(|one| one.code.id.starts_with("XDD")).for_each(|one| diagnostics.push(one.clone()));
    (diagnostics, sources)
}

fn of_concise(text: &str) -> (Diagnostics, SourceMap) {
    let numbers = text.lines().filter_map(|line| line.split('#').next()).flat_map(str::split_whitespace);
    let bytes: Vec<u8> = numbers.map(|number| u8::from_str_radix(number, 16).unwrap()).collect();
    let mut diagnostics = Diagnostics::new();
    let fault = concise::read(&bytes).fault;
    if let Some(fault) = fault {
        diagnostics.push(fault.diagnostic(Language::Concise.file_name()));
    }
    (diagnostics, SourceMap::new())
}

fn said(example: &Example, text: &str) -> Option<(Diagnostics, SourceMap)> {
    let whole = example.language.whole(text);
    match example.language {
        Language::Specification | Language::Eds | Language::Dcf => None,
        Language::Parameters => Some(of_parameters(&whole)),
        Language::Plant => Some(of_plant(&whole)),
        Language::Xdd => Some(of_xdd(&whole)),
        Language::Concise => Some(of_concise(&whole)),
    }
}

fn ids(diagnostics: &Diagnostics) -> BTreeSet<&'static str> {
    diagnostics.iter().map(|diagnostic| diagnostic.code.id).collect()
}

#[test]
fn each_is_refused_for_its_code_alone_and_accepted_when_fixed() {
    let mut tried = BTreeSet::new();
    let mut wrong = Vec::new();
    for code in all_codes() {
        let Some(example) = code.example else { continue };
        let Some((before, sources)) = said(&example, example.before) else { continue };
        let (after, _) = said(&example, example.after).unwrap();
        if ids(&before) != BTreeSet::from([code.id]) || !after.is_empty() {
            let words = |all: &Diagnostics| {
                all.iter()
                    .map(|one| format!("\n  {}: {}", one.code, one.message))
                    .collect::<Vec<_>>()
                    .concat()
            };
            wrong.push(format!("{code}, before:{}\n after:{}", words(&before), words(&after)));
        }
        before.iter().for_each(|diagnostic| check_wording(diagnostic, &sources, code.id));
        tried.insert(code.id);
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let of = |prefixes: &[&str]| {
        let all = all_codes().into_iter().map(|code| code.id);
        all.filter(|id| prefixes.iter().any(|prefix| id.starts_with(prefix))).collect::<BTreeSet<_>>()
    };
    let expected =
        of(&["OD0702", "OD0706", "OD0708", "OD0712", "OD0713", "OD0720", "OD073", "OD074", "OD085", "XDD"]);
    assert_eq!(tried, expected);
}
