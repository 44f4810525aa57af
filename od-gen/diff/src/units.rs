//! Units that entries of both devices have under one name.

use std::collections::BTreeMap;

use od_spec::model::{Dictionary, EntryId, Fact, Unit};

use super::change::{Change, Place};
use super::rules;
use super::texts::texts;
use super::words;

type Shared<'a> = BTreeMap<&'a str, (&'a Unit, &'a Unit, Vec<EntryId>)>;

/// What one step is worth, and texts; said once for all entries that have the unit.
pub(super) fn changes(old: &Dictionary, new: &Dictionary, language: &str) -> Vec<Change> {
    let mut shared = Shared::new();
    for (id, _, entry) in new.entries() {
        let before = old.entry(id).and_then(|entry| entry.unit.as_deref());
        if let (Some(before), Some(after)) = (before, entry.unit.as_deref())
            && before.name == after.name
        {
            shared.entry(&after.name).or_insert_with(|| (before, after, Vec::new())).2.push(id);
        }
    }
    let mut changes = Vec::new();
    for (name, (before, after, users)) in shared {
        let users = users.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
        let found = of(&Place::Unit(name.to_owned()), before, after, language);
        changes.extend(found.into_iter().map(|change| change.named(users.clone())));
    }
    changes
}

/// What differs between two units.
pub(super) fn of(place: &Place, before: &Unit, after: &Unit, language: &str) -> Vec<Change> {
    let step = Change::text(place.clone(), Fact::Unit, &words::unit(before), &words::unit(after));
    let step = step.map(|change| change.with(rules::unit(Some(before), Some(after))));
    step.into_iter().chain(texts(place, Fact::About, &before.about, &after.about, language)).collect()
}
