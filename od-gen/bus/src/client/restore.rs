//! What is to be read in addition to the values of a node, and what has to be written to give it others.

use std::collections::{BTreeMap, BTreeSet};

use od_spec::model::{DataType, Dictionary, Entry, EntryId, EntryRef, NoSuchValue, System, Value, Write};
use od_spec::{Commissioning, ParameterValues};

/// The entries whose values decide, in addition to those that are to be written, whether these can be written: what
/// constraints ask for that name one of them, and their conditions for writing.
pub fn involved(system: &System, device: &Dictionary, written: &BTreeSet<EntryId>) -> BTreeSet<EntryId> {
    let holder = |id: EntryId| {
        device.entry(id).and_then(|entry| entry.alias.as_ref()).map_or(id, |alias| alias.target)
    };
    let of_device = |entry: &EntryRef| entry.device.as_ref().is_none_or(|key| *key == device.key);
    let holders: BTreeSet<EntryId> = written.iter().map(|id| holder(*id)).collect();
    let mut found = BTreeSet::new();
    for constraint in system.constraints_about(&device.key) {
        let parts = [Some(&constraint.require), constraint.when.as_ref()];
        let named: BTreeSet<EntryId> = parts
            .into_iter()
            .flatten()
            .flat_map(|part| part.entries())
            .filter(|entry| of_device(entry))
            .map(|entry| holder(entry.id))
            .collect();
        if !named.is_disjoint(&holders) {
            found.extend(named);
        }
    }
    let conditions = written.iter().filter_map(|id| device.entry(*id)?.writable_when.as_ref());
    found.extend(
        conditions
            .flat_map(|condition| condition.entries())
            .filter(|entry| of_device(entry))
            .map(|entry| holder(entry.id)),
    );
    found.retain(|id| {
        !holders.contains(id) && device.entry(*id).is_some_and(|entry| entry.access.is_readable())
    });
    found
}

/// The entries that rules look at in addition to those that are to be written: the [involved] ones, and with a
/// communication object all others, as the rules about PDOs, COB-IDs and times compare these.
pub fn judged(system: &System, device: &Dictionary, written: &BTreeSet<EntryId>) -> BTreeSet<EntryId> {
    let mut judged = involved(system, device, written);
    if written.iter().any(|id| id.index.is_communication_profile()) {
        judged.extend(kept(device).filter(|id| id.index.is_communication_profile()));
    }
    judged
}

/// The entries that are a node's parameters: they can be read and written, hold a value of their own, and writing them does nothing but
/// change it.
pub fn kept(device: &Dictionary) -> impl Iterator<Item = EntryId> {
    device.entries().filter_map(|(id, _, entry)| {
        let is_command = entry.eds.no_write && !entry.locked;
        let is_parameter = entry.access.is_readable() && entry.access.is_writable() && !is_command;
        (is_parameter && entry.alias.is_none()).then_some(id)
    })
}

/// The value of an entry that a node has sent; a text without the zeros that pad it. `None` where the type has no such value.
pub fn value(entry: &Entry, bytes: &[u8]) -> Option<Value> {
    let bytes = match entry.data_type {
        DataType::VisibleString => {
            let end = bytes.iter().rposition(|byte| *byte != 0).map_or(0, |last| last + 1);
            bytes.get(..end).unwrap_or(bytes)
        }
        _ => bytes,
    };
    Value::from_bytes(entry.data_type, bytes)
}

/// The writes that bring a node from the values that it has now to those that are meant, in the order in which a device takes them.
/// What has its value already is not written, except where what it belongs to is switched off and on.
///
/// # Errors
/// A value that no entry of the device can have.
pub fn plan(
    system: &System,
    device: &Dictionary,
    node: u8,
    now: &ParameterValues,
    meant: &ParameterValues,
) -> Result<Vec<Write>, NoSuchValue> {
    let is_held = |id: &EntryId, value: &Value| {
        now.get(id).is_some_and(|held| {
            held == value || held.integer_for(node).is_some_and(|raw| value.integer_for(node) == Some(raw))
        })
    };
    let differing: BTreeMap<EntryId, Value> = meant
        .iter()
        .filter(|(id, value)| !is_held(id, value))
        .map(|(id, value)| (*id, value.clone()))
        .collect();
    // Where a part of a PDO is written, the rest is what the node has, and conditions begin with what holds there.
    let mut of_node = Commissioning::of_node(device, node);
    of_node.values.clone_from(now);
    od_spec::model::download(system, &of_node.configured(device), &differing, node)
}
