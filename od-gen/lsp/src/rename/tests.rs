use std::path::Path;

use od_spec::model::System;
use od_spec::source::{FileId, SourceMap};
use od_spec::yaml::{Node, parse};
use od_spec::{Loader, compile};

use super::edits::edits;
use super::*;

/// Files by their names.
struct Files(BTreeMap<String, String>);

impl Loader for Files {
    fn load(&mut self, path: &str, _from: &str) -> Result<Vec<u8>, String> {
        self.0.get(path).map(|text| text.clone().into_bytes()).ok_or_else(|| "no such file".to_owned())
    }
}

struct Read {
    sources: SourceMap,
    root: FileId,
    system: Option<System>,
    names: Names,
    said: Vec<String>,
}

fn read(files: &BTreeMap<String, String>, main: &str) -> Read {
    let mut sources = SourceMap::new();
    let root = sources.add(main, files[main].as_str());
    let compiled = compile(&mut sources, root, &mut Files(files.clone()));
    let trees: BTreeMap<FileId, Node> = sources
        .files()
        .filter_map(|(id, file)| Some((id, parse(id, file, &mut od_spec::diag::Diagnostics::new())?)))
        .collect();
    let names = Names::of(&sources, root, |file| trees.get(&file), compiled.system.as_ref());
    let said = compiled.diagnostics.iter().map(|one| format!("{} {}", one.code.id, one.message)).collect();
    Read { sources, root, system: compiled.system, names, said }
}

/// The files with changes.
fn changed(read: &Read, changes: &[(Span, String)]) -> BTreeMap<String, String> {
    let own = read.sources.files().filter(|(id, _)| id.is_one_with(read.root));
    own.map(|(id, file)| (file.name().to_owned(), trial::changed(id, file.text(), changes))).collect()
}

/// What can be renamed, and what it is called.
fn renameable(read: &Read) -> BTreeMap<DefinitionId, String> {
    let is_own = |id: &DefinitionId| read.names.definition(*id).span.file.is_one_with(read.root);
    let all = read.names.definitions().filter(|(id, one)| {
        let has_name = !matches!(one.kind, Kind::File | Kind::Library | Kind::Pdo | Kind::Transition);
        has_name && one.spelling == Spelling::Written && same(&read.names, *id).iter().all(is_own)
    });
    all.map(|(id, one)| (id, one.name.clone())).collect()
}

fn shipped(name: &str) -> (String, BTreeMap<String, String>) {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../od-spec/devices");
    let texts = ["", ".document", ".errata"].map(|part| {
        let file = format!("{name}{part}.od.yaml");
        let text = std::fs::read_to_string(Path::new(folder).join(&file)).unwrap();
        (file, text)
    });
    (format!("{name}.od.yaml"), texts.into_iter().collect())
}

/// What a model says, as texts in which names have lost what was appended to them; what is in the order of names is sorted.
fn dump(system: &System, suffix: &str) -> serde_json::Value {
    fn sorted(value: serde_json::Value, suffix: &str) -> serde_json::Value {
        use serde_json::Value;
        match value {
            Value::String(text) => Value::String(text.replace(suffix, "").to_lowercase()),
            Value::Array(list) => {
                let mut list: Vec<Value> = list.into_iter().map(|one| sorted(one, suffix)).collect();
                list.sort_by_key(ToString::to_string);
                Value::Array(list)
            }
            // What has another name than in its library departs from it in that, and is next to the library's.
            Value::Object(map) => map
                .into_iter()
                .filter(|(key, _)| !matches!(key.as_str(), "differs" | "units"))
                .map(|(key, one)| (key.replace(suffix, ""), sorted(one, suffix)))
                .collect(),
            other => other,
        }
    }
    let text = od_formats::json::dump(system, &[]);
    sorted(serde_json::from_slice(&text).unwrap(), suffix)
}

/// Where two dumps differ first.
fn difference(one: &serde_json::Value, other: &serde_json::Value) -> Option<String> {
    use serde_json::Value;
    match (one, other) {
        (Value::Array(one), Value::Array(other)) if one.len() == other.len() => {
            one.iter().zip(other).find_map(|(one, other)| difference(one, other))
        }
        (Value::Object(one), Value::Object(other)) if one.len() == other.len() => {
            one.iter().find_map(|(key, one)| match other.get(key) {
                Some(other) => difference(one, other).map(|found| format!("{key}.{found}")),
                None => Some(format!("{key} is new")),
            })
        }
        (one, other) if one == other => None,
        (one, other) => Some(format!(": {one} and {other}")),
    }
}

/// Appended to every name; no text of the specifications has it.
const SUFFIX: &str = "qxqz";

#[test]
fn every_name_of_the_shipped_specifications_can_be_another_and_what_it_was() {
    let large = std::env::var_os("OD_TESTS_LONG").map(|_| "pitch-control-system");
    for name in ["fullmo-drive"].into_iter().chain(large) {
        let (main, files) = shipped(name);
        let before = read(&files, &main);
        let system = before.system.as_ref().unwrap();
        let all = renameable(&before);
        assert!(all.len() > 300, "{}", all.len());
        let renamed = all.iter().map(|(id, name)| (*id, format!("{name}{SUFFIX}"))).collect();
        let changes = edits(&before.sources, &before.names, &renamed).unwrap();
        let after = read(&changed(&before, &changes), &main);
        let is_news = |said: &&String| !before.said.contains(&said.replace(SUFFIX, ""));
        let news: Vec<&String> = after.said.iter().filter(is_news).collect();
        assert!(after.system.is_some(), "{name}: {news:#?}");
        let (left, right) = (dump(after.system.as_ref().unwrap(), SUFFIX), dump(system, SUFFIX));
        assert_eq!(difference(&left, &right), None, "{name}");
        for (id, name) in &all {
            if let Some(unit) =
                system.units.get(name).filter(|_| before.names.definition(*id).kind == Kind::Unit)
            {
                let other = &after.system.as_ref().unwrap().units[&format!("{name}{SUFFIX}")];
                assert_eq!(
                    (&unit.symbol, unit.scale, unit.offset),
                    (&other.symbol, other.scale, other.offset)
                );
            }
        }
        // Everything that can be renamed has the other name, and refers to the same.
        for (id, one) in before.names.definitions() {
            assert_eq!(after.names.definition(id).name, renamed.get(&id).unwrap_or(&one.name).as_str());
        }
        for (one, other) in before.names.references().iter().zip(after.names.references()) {
            assert_eq!((one.kind, one.by, &one.targets), (other.kind, other.by, &other.targets));
        }
        let back = renamed.iter().map(|(id, name)| (*id, name.replace(SUFFIX, ""))).collect();
        let changes = edits(&after.sources, &after.names, &back).unwrap();
        for (file, text) in changed(&after, &changes) {
            let lines = text.lines().zip(files[&file].lines()).find(|(one, other)| one != other);
            assert_eq!(lines, None, "{file}");
            assert_eq!(text.len(), files[&file].len(), "{file}");
        }
    }
}

#[test]
fn a_reference_by_identifier_stays_when_the_name_changes() {
    const TEXT: &str = "od-spec: 1\ntitle: Lamp\nuses: [cia301]\n\
        devices: {lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer]}}\nobjects:\n  \
        0x2000: {name: level, identifier: upper, type: unsigned8, access: rw, pdo: receive}\n  \
        0x2001: {name: level, identifier: lower, type: unsigned8, access: rw, pdo: receive}\n  \
        0x2002: {name: list, array: {count: 2, name: element, identifier: 'element_{n}', type: unsigned8, access: rw, pdo: receive}}\n\
        pdos: {lamp: {receive: {1: {map: [lower, list.element_2]}}}}\n";
    let read = read(&BTreeMap::from([("lamp.od.yaml".to_owned(), TEXT.to_owned())]), "lamp.od.yaml");
    assert!(read.system.is_some(), "{:?}", read.said);
    let at = |from: &str| {
        let start = u32::try_from(TEXT.find(from).unwrap()).unwrap();
        match read.names.at(read.root, start) {
            Some(Found::Reference(one)) => (one.by, one.entry.map(|id| id.to_string())),
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(at("lower, list"), (By::Identifier, Some("2001h".to_owned())));
    assert_eq!(at("list.element_2"), (By::Name, Some("2002h.2".to_owned())));
    assert_eq!(at("element_2]"), (By::Identifier, Some("2002h.2".to_owned())));
    let lower = read.names.definitions().find(|(_, one)| {
        one.span.start > 0 && one.key.start == { u32::try_from(TEXT.find("0x2001").unwrap()).unwrap() }
    });
    let renamed = BTreeMap::from([(lower.unwrap().0, "depth".to_owned())]);
    let changes = edits(&read.sources, &read.names, &renamed).unwrap();
    let text = &changed(&read, &changes)["lamp.od.yaml"];
    assert_eq!(*text, TEXT.replace("name: level, identifier: lower", "name: depth, identifier: lower"));
}
