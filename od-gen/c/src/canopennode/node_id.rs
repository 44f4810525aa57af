//! Defaults with the node-ID in them. The dictionary of the stack is made for no node: the stack adds the node-ID where a COB-ID is the base of the
//! pre-defined connection set, and nowhere else. What else has it gets it from a generated function.

use od_spec::model::{Dictionary, Direction, Entry, EntryId, Value};

/// The bits of a COB-ID that are the identifier.
const IDENTIFIER: u64 = 0x7FF;
/// PDOs of the pre-defined connection set in each direction.
const PREDEFINED_PDOS: usize = 4;

/// An entry whose default has the node-ID in it, and the number that is added to it.
pub(super) struct NodeIdDefault<'a> {
    pub id: EntryId,
    pub entry: &'a Entry,
    pub offset: u64,
}

/// The entries to which the stack does not add the node-ID by itself.
pub(super) fn left_to_the_device(device: &Dictionary) -> Vec<NodeIdDefault<'_>> {
    device
        .entries()
        .filter_map(|(id, _, entry)| match entry.default {
            Some(Value::NodeId(offset)) if entry.alias.is_none() => Some(NodeIdDefault { id, entry, offset }),
            Some(
                Value::NodeId(_) | Value::Integer(_) | Value::Real(_) | Value::Text(_) | Value::Bytes(_),
            )
            | None => None,
        })
        .filter(|default| base_in_stack(device, default.id) != Some(default.offset & IDENTIFIER))
        .collect()
}

/// The entries to which the stack adds the node-ID although their default does not have it.
pub(super) fn changed_by_stack(device: &Dictionary) -> Vec<(EntryId, &Entry)> {
    let is_valid = |raw: u64| raw >> 31 & 1 == 0;
    let fixed = |entry: &Entry| {
        entry.default.as_ref().and_then(Value::integer).and_then(|raw| u64::try_from(raw).ok())
    };
    device
        .entries()
        .filter(|(id, _, entry)| {
            let base = base_in_stack(device, *id);
            base.is_some() && fixed(entry).is_some_and(|raw| is_valid(raw) && base == Some(raw & IDENTIFIER))
        })
        .map(|(id, _, entry)| (id, entry))
        .collect()
}

/// The identifier to which the stack adds the node-ID where an entry holds it. PDOs count by their place in the list of the objects, not by their
/// number; the first SDO server is set by the stack, whatever the dictionary says.
fn base_in_stack(device: &Dictionary, id: EntryId) -> Option<u64> {
    let place = |direction: Direction| {
        let first = direction.first_communication_index();
        let indices = device.objects.range(od_spec::model::Index(first)..id.index);
        (id.sub.0 == 1).then(|| indices.count()).filter(|place| *place < PREDEFINED_PDOS)
    };
    let pdo = |direction, first: u64| {
        place(direction).and_then(|place| Some(first + 0x100 * u64::try_from(place).ok()?))
    };
    match id.index.0 {
        0x1014 => Some(0x80),
        0x1200 => match id.sub.0 {
            1 => Some(0x600),
            2 => Some(0x580),
            _ => None,
        },
        0x1400..0x1600 => pdo(Direction::Receive, 0x200),
        0x1800..0x1A00 => pdo(Direction::Transmit, 0x180),
        _ => None,
    }
}
