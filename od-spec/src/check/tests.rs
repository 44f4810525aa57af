//! What can be tried only with some of the rules, or with a model that no text gives. The rest is in `tests/rules`.

use std::collections::BTreeSet;

use super::{Allowed, RULES, Rule, system};
use crate::compile::{compile, compile_with};
use crate::diag::{Diagnostics, Language};
use crate::files::NoFiles;
use crate::model::{Access, DataType, Entry, Index, SubIndex, System};
use crate::parameters::assign_with;
use crate::source::{SourceMap, Spanned};
use crate::standard;

/// What is said about a text of an example; its lines `# --set ENTRY=VALUE` are settings of node 1.
fn said(rules: &[&Rule], text: &str) -> Diagnostics {
    let mut sources = SourceMap::new();
    let root = sources.add("example.od.yaml", Language::Specification.whole(text));
    let compiled = compile_with(standard::rules(rules), &mut sources, root, &mut NoFiles);
    let mut diagnostics = compiled.diagnostics;
    let settings: Vec<_> = text
        .lines()
        .filter_map(|line| line.strip_prefix("# --set "))
        .map(|setting| {
            let file = sources.add("--set", setting);
            Spanned::new(setting.to_owned(), sources.whole(file))
        })
        .collect();
    if let Some(system) = compiled.system.filter(|_| !settings.is_empty()) {
        assign_with(standard::rules(rules), &system, &system.devices[0], 1, &settings, &mut diagnostics);
    }
    diagnostics
}

fn codes(diagnostics: &Diagnostics) -> Vec<&'static str> {
    diagnostics.iter().map(|diagnostic| diagnostic.code.id).collect()
}

/// Switched off, a rule says nothing more: no other rule covers for it, and no other code says the same.
#[test]
fn a_rule_that_is_switched_off_lets_its_example_pass() {
    for rule in RULES.iter().copied() {
        let id = rule.code.id;
        let others: Vec<&Rule> = RULES.iter().copied().filter(|one| !std::ptr::eq(*one, rule)).collect();
        let Some(example) = rule.code.example else { continue };
        let found = codes(&said(&others, example.before));
        assert!(!found.contains(&id), "{id} is said by something else, too: {found:?}");
    }
}

#[test]
fn rules_have_codes_of_their_own_and_are_explained() {
    let ids: Vec<&str> = RULES.iter().map(|rule| rule.code.id).collect();
    let distinct: BTreeSet<&str> = ids.iter().copied().collect();
    assert_eq!(distinct.len(), ids.len(), "a code has one home: {ids:?}");
    for rule in RULES.iter() {
        let explanation = rule.code.explanation;
        assert!(explanation.ends_with('.'), "{}: {explanation}", rule.code.id);
        // What is wrong, why it matters, what to do.
        assert!(explanation.matches(['.', ':', ';']).count() >= 2, "{}: {explanation}", rule.code.id);
    }
}

const NONE: [&str; 0] = [];

/// The model of a specification.
fn model(text: &str) -> System {
    let mut sources = SourceMap::new();
    let root = sources.add("case.od.yaml", Language::Specification.whole(text));
    compile(&mut sources, root, &mut NoFiles).system.unwrap()
}

/// What the rules say about a model.
fn judged(model: &System) -> Vec<&'static str> {
    let mut diagnostics = Diagnostics::new();
    system(standard::rules(&RULES), model, None, &mut Allowed::none(), &mut diagnostics);
    codes(&diagnostics)
}

/// FFh describes the structure of an object and is not one of its entries. The language has no such entry; devices of
/// other makers have.
#[test]
fn the_structure_of_an_object_does_not_count() {
    let text = "objects:
  0x1016: {from: cia301}
  0x1029: {name: behaviour, array: {count: 1, name: class, type: unsigned8, access: rw}}
  0x1800: {name: PDO, record: {1: {name: COB-ID, type: unsigned32, access: rw}, 2: {name: kind, type: unsigned8, access: rw}}}
  0x1A00: {name: map, sub0: {access: rw, default: 1}, record: {1: {name: mapped, type: unsigned32, access: rw, default: 0x20000020}}}
  0x2000: {name: level, type: unsigned32, access: ro, pdo: transmit}
  0x2001: {name: levels, record: {1: {name: level, type: unsigned8, access: ro}}}";
    let mut system = model(text);
    for object in system.devices[0].objects.values_mut().filter(|object| object.is_structured()) {
        let (sub, name) = (SubIndex::STRUCTURE, "structure of object".to_owned());
        object.entries.push(Entry::new(sub, name, DataType::Unsigned32, Access::Ro, object.span));
    }
    assert_eq!(judged(&system), NONE);
    for object in system.devices[0].objects.values_mut().filter(|object| object.is_structured()) {
        object.entries.retain(|entry| entry.sub.0 == 0 || entry.sub == SubIndex::STRUCTURE);
    }
    // The mapping offers none of the entries that it maps, either.
    let [empty @ .., offers] = judged(&system).try_into().unwrap_or([""; 7]);
    assert_eq!((empty, offers), (["OD0314"; 6], "OD0508"));
}

/// A count without a value is not a count of 0.
#[test]
fn a_count_without_a_value_is_said_once() {
    let text = "objects:\n  0x2000: {name: levels, record: {1: {name: level, type: unsigned8, access: ro}}}";
    let mut system = model(text);
    let levels = system.devices[0].objects.get_mut(&Index(0x2000)).unwrap();
    levels.entries[0].default = None;
    assert_eq!(judged(&system), ["OD0818"]);
}
