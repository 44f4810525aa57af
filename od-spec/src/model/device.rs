//! A device: its dictionary and what an EDS says about it.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::{
    DataType, Direction, DynamicChannel, Entry, EntryId, Fact, Facts, Further, Index, Object, ObjectKind,
    Pdo, Text,
};
use crate::source::Span;

/// The bit rates of CiA 301 in kbit/s, for which an EDS has keys.
pub const BIT_RATES: [u16; 8] = [10, 20, 50, 125, 250, 500, 800, 1000];

/// The object dictionary of one device, with what an EDS says about the device.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Dictionary {
    /// The device's key in the specification, such as `pmc`.
    pub key: String,
    /// Full name.
    pub name: String,
    /// Facts for `[DeviceInfo]`.
    pub info: DeviceInfo,
    /// Facts for `[FileInfo]`.
    pub file: FileInfo,
    /// Description.
    pub about: Text,
    /// What holds for every error of the device.
    pub any_error: AnyError,
    /// Objects by index.
    pub objects: BTreeMap<Index, Object>,
    /// PDOs, RPDOs first, by number.
    pub pdos: Vec<Pdo>,
    /// Of an EDS or DCF: what it says in addition to all this.
    pub further: Option<Arc<Further>>,
    /// Where the facts about the device are written.
    pub facts: Facts,
    /// Where the device is defined.
    pub span: Span,
}

/// What holds for every error of a device, whatever its code; empty where nothing is said.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct AnyError {
    /// What shows that there is an error.
    pub shown: Text,
    /// What the device does.
    pub reaction: Text,
    /// What resets an error that says nothing of its own about that.
    pub reset: Text,
}

impl Dictionary {
    /// Where a fact about the device is written; where it is not stated, the device's own place.
    pub fn place(&self, fact: Fact) -> Span {
        self.facts.get(fact).map_or(self.span, |statement| statement.span)
    }

    /// Whether an object, or some of its sub-indices, comes with modules that are plugged in.
    pub fn is_of_modules(&self, index: Index) -> bool {
        self.further.as_ref().is_some_and(|further| further.is_of_modules(index))
    }

    /// An entry.
    pub fn entry(&self, id: EntryId) -> Option<&Entry> {
        self.objects.get(&id.index)?.entry(id.sub)
    }

    /// All entries with their ids, ascending.
    pub fn entries(&self) -> impl Iterator<Item = (EntryId, &Object, &Entry)> {
        self.objects.values().flat_map(|object| {
            object
                .entries
                .iter()
                .map(move |entry| (EntryId { index: object.index, sub: entry.sub }, object, entry))
        })
    }

    /// PDOs of one direction.
    pub fn pdos_of(&self, direction: Direction) -> impl Iterator<Item = &Pdo> {
        self.pdos.iter().filter(move |pdo| pdo.direction == direction)
    }

    /// The name of an entry as a person would look it up: `controlword`, `drive data.error mask`.
    pub fn entry_name(&self, id: EntryId) -> Option<String> {
        let object = self.objects.get(&id.index)?;
        Some(dotted(object, &object.name, &object.entry(id.sub)?.name))
    }

    /// The name of an entry that no other entry has: identifiers replace names where they are given.
    pub fn entry_label(&self, id: EntryId) -> Option<String> {
        let object = self.objects.get(&id.index)?;
        Some(dotted(object, object.label(), object.entry(id.sub)?.label()))
    }
}

/// The name of an entry: that of its object, with its own after it where the object has several.
fn dotted(object: &Object, name: &str, entry: &str) -> String {
    match object.kind {
        ObjectKind::Var | ObjectKind::Domain => name.to_owned(),
        ObjectKind::Array | ObjectKind::Record => format!("{name}.{entry}"),
    }
}

/// What `[DeviceInfo]` says about a device.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct DeviceInfo {
    /// Product name.
    pub product_name: String,
    /// Product code, 1018h.2.
    pub product: u32,
    /// Product revision, 1018h.3; upper half major, lower half minor.
    pub product_revision: u32,
    /// Order code.
    pub order_code: String,
    /// Supported bit rates in kbit/s, ascending.
    pub bit_rates: Vec<u16>,
    /// Device type, 1000h.
    pub device_type: u32,
    /// Smallest unit of PDO mapping in bits; 0 when no mapping can be changed.
    pub granularity: u8,
    /// Simple boot-up master.
    pub boot_up_master: bool,
    /// Simple boot-up slave.
    pub boot_up_slave: bool,
    /// Multiplexed PDOs.
    pub group_messaging: bool,
    /// LSS slave.
    pub lss: bool,
    /// Data types that may be in an RPDO as placeholders.
    pub dummies: Vec<DataType>,
    /// Where a PLC may create network variables; segments that do not overlap.
    pub dynamic_channels: Vec<DynamicChannel>,
}

/// What `[FileInfo]` says about the EDS.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct FileInfo {
    /// Description.
    pub description: String,
    /// When the file was first made.
    pub created: DateTime,
    /// Who made it.
    pub created_by: String,
    /// When it was last changed.
    pub modified: DateTime,
    /// Who changed it.
    pub modified_by: String,
    /// Version of the file.
    pub version: u8,
    /// Revision of the file.
    pub revision: u8,
}

/// A calendar date.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Date {
    /// Four digits.
    pub year: u16,
    /// 1 to 12.
    pub month: u8,
    /// 1 to 31.
    pub day: u8,
}

impl Date {
    /// A day of the calendar; `None` for one that there is not.
    pub fn of(year: u16, month: u16, day: u16) -> Option<Self> {
        let is_leap = year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400));
        let days = match month {
            1 | 3 | 5 | 7 | 8 | 10 | 12 => 31,
            4 | 6 | 9 | 11 => 30,
            2 => 28 + u16::from(is_leap),
            _ => return None,
        };
        let date = Self { year, month: u8::try_from(month).ok()?, day: u8::try_from(day).ok()? };
        (1..=days).contains(&day).then_some(date)
    }
}

/// A date and a time of day, to the minute.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct DateTime {
    /// The day.
    pub date: Date,
    /// 0 to 23.
    pub hour: u8,
    /// 0 to 59.
    pub minute: u8,
}
