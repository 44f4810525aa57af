//! Which entries the SRDOs of a device carry by default: the stack maps only those that have an attribute for it.

use std::collections::BTreeSet;

use od_spec::model::{Dictionary, Direction, EntryId, Index, Mapped, PdoTarget, SubIndex, Value};

/// Indices of the communication parameters; those of the mapping parameters follow at a distance.
const COMMUNICATION: std::ops::RangeInclusive<u16> = 0x1301..=0x1340;
const MAPPING: u16 = 0x80;

/// The entries in SRDOs, by direction.
#[derive(Default)]
pub(super) struct Srdos {
    transmitted: BTreeSet<EntryId>,
    received: BTreeSet<EntryId>,
}

impl Srdos {
    pub(super) fn of(device: &Dictionary) -> Self {
        let mut srdos = Self::default();
        for (index, _) in device.objects.range(Index(*COMMUNICATION.start())..=Index(*COMMUNICATION.end())) {
            let entries = match number(device, *index, 1) {
                Some(1) => &mut srdos.transmitted,
                Some(2) => &mut srdos.received,
                // Without a direction there is no SRDO.
                Some(_) | None => continue,
            };
            let mapping = Index(index.0 + MAPPING);
            let count = number(device, mapping, 0).and_then(|count| u8::try_from(count).ok()).unwrap_or(0);
            entries.extend((1..=count).filter_map(|sub| mapped(number(device, mapping, sub)?)));
        }
        srdos
    }

    /// Whether an SRDO of a direction carries an entry.
    pub(super) fn carry(&self, id: EntryId, direction: Direction) -> bool {
        match direction {
            Direction::Transmit => self.transmitted.contains(&id),
            Direction::Receive => self.received.contains(&id),
        }
    }

    /// Whether they carry nothing.
    pub(super) fn are_empty(&self) -> bool {
        self.transmitted.is_empty() && self.received.is_empty()
    }
}

/// The default of an entry.
fn number(device: &Dictionary, index: Index, sub: u8) -> Option<u32> {
    let entry = device.entry(EntryId { index, sub: SubIndex(sub) })?;
    entry.default.as_ref().and_then(Value::integer).and_then(|number| u32::try_from(number).ok())
}

/// The entry that a mapping value names.
fn mapped(value: u32) -> Option<EntryId> {
    match Mapped::from_parameter(value)?.target {
        PdoTarget::Entry(id) => Some(id),
        PdoTarget::Dummy(_) => None,
    }
}
