//! Units whose symbols make no identifiers, or the same one, get names of their own.

use std::collections::BTreeMap;
use std::sync::Arc;

use od_spec::model::Dictionary;

use crate::plan::language::{Language, Role, ScopeKind};
use crate::plan::names::Words;

/// Gives each unit of the entries a name whose identifier no other one has.
pub(super) fn tell_apart(device: &mut Dictionary, language: &dyn Language) {
    let mut by_identifier: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for unit in
        device.objects.values().flat_map(|object| &object.entries).filter_map(|entry| entry.unit.as_ref())
    {
        let of_name = by_identifier
            .entry(language.identifier(ScopeKind::Units, Role::Type, &Words::of(&spelt(&unit.name))))
            .or_default();
        if !of_name.contains(&unit.name) {
            of_name.push(unit.name.clone());
        }
    }
    let mut names = BTreeMap::new();
    for (identifier, mut of_name) in by_identifier {
        of_name.sort_unstable();
        let are_several = of_name.len() > 1 || identifier.is_empty();
        for (number, name) in (1..).zip(of_name) {
            let spelt = spelt(&name);
            let words = if identifier.is_empty() { "unit" } else { spelt.as_str() };
            let other = if are_several { format!("{words} {number}") } else { spelt.clone() };
            if other != name {
                names.insert(name, other);
            }
        }
    }
    for entry in device.objects.values_mut().flat_map(|object| &mut object.entries) {
        if let Some(unit) = &mut entry.unit
            && let Some(name) = names.get(&unit.name)
        {
            Arc::make_mut(unit).name.clone_from(name);
        }
    }
}

/// A symbol that people have a word for, as the word.
fn spelt(name: &str) -> String {
    if Words::of(name).snake().is_empty() {
        name.replace('%', " percent ").trim().to_owned()
    } else {
        name.to_owned()
    }
}
