//! How many objects of each kind there are: the stack makes room by these numbers, and leaves out what has none. They follow from the indices,
//! so that an EDS, which has no place for them, gives the same as a specification; what a file calls otherwise is counted, too.

use std::collections::BTreeMap;
use std::ops::RangeInclusive;

use super::super::prefix::Prefix;
use super::objects::StackObject;

/// A name of the stack, and the indices of the objects that it counts.
pub(super) struct Counter {
    /// `RPDO`, of `OD_CNT_RPDO`.
    pub name: &'static str,
    indices: RangeInclusive<u16>,
}

const SDO_SERVERS: &str = "SDO_SRV";

/// In the order of the stack's own files.
pub(super) const COUNTERS: [Counter; 15] = [
    Counter::of("NMT", 0x1000..=0x1000),
    Counter::of("EM", 0x1001..=0x1001),
    Counter::of("SYNC", 0x1005..=0x1005),
    Counter::of("SYNC_PROD", 0x1006..=0x1006),
    Counter::of("STORAGE", 0x1010..=0x1010),
    Counter::of("TIME", 0x1012..=0x1012),
    Counter::of("EM_PROD", 0x1014..=0x1014),
    Counter::of("HB_CONS", 0x1016..=0x1016),
    Counter::of("HB_PROD", 0x1017..=0x1017),
    Counter::of(SDO_SERVERS, 0x1200..=0x127F),
    Counter::of("SDO_CLI", 0x1280..=0x12FF),
    Counter::of("GFC", 0x1300..=0x1300),
    Counter::of("SRDO", 0x1301..=0x1340),
    Counter::of("RPDO", 0x1400..=0x15FF),
    Counter::of("TPDO", 0x1800..=0x19FF),
];

impl Counter {
    const fn of(name: &'static str, indices: RangeInclusive<u16>) -> Self {
        Self { name, indices }
    }

    /// How many of the objects it counts.
    pub(super) fn count(&self, objects: &[StackObject<'_>]) -> usize {
        objects.iter().filter(|object| self.indices.contains(&object.object.index.0)).count()
    }
}

/// Counters that the file names beyond the stack's usual ones, each with the number of its objects.
pub(super) fn of_labels<'a>(objects: &[StackObject<'a>]) -> BTreeMap<&'a str, usize> {
    let labels = objects.iter().filter_map(|object| object.object.editor.as_ref()?.count_label.as_deref());
    let mut counts = BTreeMap::new();
    for label in labels.filter(|label| COUNTERS.iter().all(|counter| counter.name != *label)) {
        *counts.entry(label).or_default() += 1;
    }
    counts
}

/// What fills a member of the stack's configuration, where several dictionaries are compiled together.
pub(super) enum Setting {
    /// `CNT_RPDO`.
    Counter(&'static str),
    /// `CNT_ARR_1016`.
    Elements(u16),
    /// `ENTRY_H1400`.
    Entry(u16),
}

/// The members of the stack's configuration, in its order.
pub(super) const SETTINGS: [Setting; 40] = {
    use Setting::{Counter, Elements, Entry};
    [
        Counter("NMT"),
        Entry(0x1017),
        Counter("HB_CONS"),
        Elements(0x1016),
        Entry(0x1016),
        Counter("EM"),
        Entry(0x1001),
        Entry(0x1014),
        Entry(0x1015),
        Elements(0x1003),
        Entry(0x1003),
        Counter(SDO_SERVERS),
        Entry(0x1200),
        Counter("SDO_CLI"),
        Entry(0x1280),
        Counter("TIME"),
        Entry(0x1012),
        Counter("SYNC"),
        Entry(0x1005),
        Entry(0x1006),
        Entry(0x1007),
        Entry(0x1019),
        Counter("RPDO"),
        Entry(0x1400),
        Entry(0x1600),
        Counter("TPDO"),
        Entry(0x1800),
        Entry(0x1A00),
        Counter("LEDS"),
        Counter("GFC"),
        Entry(0x1300),
        Counter("SRDO"),
        Entry(0x1301),
        Entry(0x1381),
        Entry(0x13FE),
        Entry(0x13FF),
        Counter("LSS_SLV"),
        Counter("LSS_MST"),
        Counter("GTWA"),
        Counter("TRACE"),
    ]
};

impl Setting {
    /// The member and its value: `("CNT_NMT", "OD_CNT_NMT")`. Every device answers SDOs, also without 1200h.
    pub(super) fn assignment(&self, prefix: &Prefix, objects: &[StackObject<'_>]) -> (String, String) {
        let object = |index: u16| objects.iter().find(|object| object.object.index.0 == index);
        let (member, is_there, absent) = match self {
            Self::Counter(name) => {
                let counter = COUNTERS.iter().find(|counter| counter.name == *name);
                let absent = if *name == SDO_SERVERS { "1" } else { "0" };
                let is_counted = counter.is_some_and(|counter| counter.count(objects) > 0);
                (format!("CNT_{name}"), is_counted || of_labels(objects).contains_key(name), absent)
            }
            Self::Elements(index) => {
                let elements = object(*index).and_then(StackObject::elements);
                (format!("CNT_ARR_{index:04X}"), elements.is_some(), "0")
            }
            Self::Entry(index) => (format!("ENTRY_H{index:04X}"), object(*index).is_some(), "NULL"),
        };
        let value = if is_there { format!("{prefix}_{member}") } else { absent.to_owned() };
        (member, value)
    }
}
