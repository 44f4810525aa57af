//! What the value of an entry means: the raw value of a physical one, the number of a name.

use od_spec::model::{Dictionary, Entry, EntryId, Fact, System, Value};
use od_spec::names::{Place, Spot, Step};
use od_spec::source::Span;

use super::{Words, code, escaped};
use crate::cursor::{Cursor, entry_around};

/// What is known about a value of an entry.
pub(super) fn of_value(cursor: &Cursor<'_>, place: &Place<'_>, words: Words<'_>) -> Option<String> {
    let Spot::Value { node, .. } = place.spot else { return None };
    let key = place.path.iter().rev().find_map(|step| match step {
        Step::Key { key, .. } => Some(key.name),
        Step::Data { .. } | Step::Item { .. } => None,
    })?;
    let fact = fact_of(key)?;
    let system = cursor.snapshot.now.system()?;
    let (device, id, entry) = stated_at(system, node.span, fact).next().or_else(|| {
        let id = entry_around(&place.path)?;
        let device = system.devices.iter().find(|device| device.entry(id).is_some())?;
        Some((device, id, device.entry(id)?))
    })?;
    let value = value_of(entry, fact)?;
    let shown = words.wording.value(Some(id.index), entry, &value);
    let name = device.entry_name(id).unwrap_or_default();
    Some(format!(
        "{}: {}\n\n{} {}",
        words.wording.fact(fact),
        escaped(&shown),
        code(&id.to_string()),
        escaped(&name)
    ))
}

/// The fact that a key states, if it is a value.
pub(crate) fn fact_of(key: &str) -> Option<Fact> {
    [Fact::Default, Fact::LowLimit, Fact::HighLimit].into_iter().find(|fact| fact.word() == key)
}

/// The value that a fact is about.
pub(crate) fn value_of(entry: &Entry, fact: Fact) -> Option<Value> {
    let (low, high) = entry.limits();
    match fact {
        Fact::LowLimit => low,
        Fact::HighLimit => high,
        _ => entry.default.clone(),
    }
}

/// The entries whose fact is stated at a place.
fn stated_at(
    system: &System,
    place: Span,
    fact: Fact,
) -> impl Iterator<Item = (&Dictionary, EntryId, &Entry)> {
    let is_there = move |entry: &Entry| entry.facts.get(fact).is_some_and(|stated| stated.span == place);
    system.devices.iter().flat_map(move |device| {
        device
            .entries()
            .filter(move |(_, _, entry)| is_there(entry))
            .map(move |(id, _, entry)| (device, id, entry))
    })
}
