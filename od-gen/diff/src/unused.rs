//! Units and types that no device uses: only who reads the specification sees them.

use std::collections::BTreeSet;

use od_spec::model::{Dictionary, Entry, Fact, NamedType, System, Unit};

use super::change::{Change, Class, Consequence, Place};
use super::types::{Members, Names};
use super::units;

const UNUSED: Consequence = Consequence::new(Class::Documents, "no entry uses it");

/// What differs.
pub(super) fn changes(old: &System, new: &System, language: &str) -> Vec<Change> {
    let mut changes = of(
        (old.units.keys(), new.units.keys()),
        &used(old, new, |entry| entry.unit.as_ref().map(|unit| unit.name.clone())),
        &|name| (old.units.get(name).map(AsRef::as_ref), new.units.get(name).map(AsRef::as_ref)),
        &|name| Place::Unit(name.to_owned()),
        &|before: &Unit, after: &Unit, place| units::of(&place, before, after, language),
    );
    changes.extend(of(
        (old.types.keys(), new.types.keys()),
        &used(old, new, |entry| entry.named_type.as_ref().map(|named| named.name.clone())),
        &|name| (old.types.get(name).map(AsRef::as_ref), new.types.get(name).map(AsRef::as_ref)),
        &|name| Place::Type(name.to_owned()),
        &|before: &NamedType, after: &NamedType, place: Place| {
            let base = Change::text(place.clone(), Fact::Type, before.base.name(), after.base.name());
            let members = Members { place, names: Names::Nowhere, language };
            members.of(before, after).into_iter().chain(base).collect()
        },
    ));
    for change in &mut changes {
        change.consequences.clear();
        change.follows([UNUSED]);
    }
    changes
}

/// Names that an entry on either side uses.
fn used(old: &System, new: &System, name: impl Fn(&Entry) -> Option<String>) -> BTreeSet<String> {
    let devices = old.devices.iter().chain(&new.devices);
    devices.flat_map(Dictionary::entries).filter_map(|(.., entry)| name(entry)).collect()
}

type Both<'a, T> = (Option<&'a T>, Option<&'a T>);

fn of<'a, T: 'a>(
    names: (impl Iterator<Item = &'a String>, impl Iterator<Item = &'a String>),
    used: &BTreeSet<String>,
    find: &impl Fn(&str) -> Both<'a, T>,
    place: &impl Fn(&str) -> Place,
    compare: &impl Fn(&T, &T, Place) -> Vec<Change>,
) -> Vec<Change> {
    let names: BTreeSet<&String> = names.0.chain(names.1).filter(|name| !used.contains(*name)).collect();
    let mut changes = Vec::new();
    for name in names {
        match find(name) {
            (Some(before), Some(after)) => changes.extend(compare(before, after, place(name))),
            (Some(_), None) => changes.push(Change::removed(place(name), "not used")),
            (None, Some(_)) => changes.push(Change::added(place(name), "not used")),
            (None, None) => {}
        }
    }
    changes
}
