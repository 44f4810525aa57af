//! The resolved model: what the specification says, with nothing left open.
//!
//! A [`System`] holds what its devices share and one [`Dictionary`] per device. Every backend works
//! from here and from nothing else.

mod document;
mod pdo;
mod ratio;
mod text;
mod types;
mod unit;
mod value;

use std::collections::BTreeMap;
use std::sync::Arc;

pub use document::{
    Document, Erratum, ErratumKind, ErratumPlace, Issue, PdoTable, Section, Table, TableContent,
};
pub use pdo::{Mapped, Pdo, PdoTarget};
pub use ratio::Ratio;
pub use text::Text;
pub use types::{
    Access, Category, DataType, Direction, EntryId, Index, Outside, PdoMapping, Rounding, Storage, SubIndex,
};
pub use unit::{Base, Unit};
pub use value::{Value, convert, format_value};

use crate::expr::Expr;
use crate::source::Span;

/// Everything that one specification describes.
#[derive(Debug, Clone)]
pub struct System {
    /// Title of the product or family.
    pub title: String,
    /// Language codes; the first is the default.
    pub languages: Vec<String>,
    /// The printed manual, its revision and its chapters.
    pub document: Document,
    /// The maker.
    pub vendor: Vendor,
    /// Units by name.
    pub units: BTreeMap<String, Arc<Unit>>,
    /// Named types by name.
    pub types: BTreeMap<String, Arc<NamedType>>,
    /// Error codes, ascending.
    pub errors: Vec<ErrorCode>,
    /// State machines by name.
    pub machines: BTreeMap<String, StateMachine>,
    /// Conditions between entries, in the order of the specification.
    pub constraints: Vec<Constraint>,
    /// What the printed manual says otherwise, in the order of the specification.
    pub errata: Vec<Erratum>,
    /// One dictionary per device, in the order of the specification.
    pub devices: Vec<Dictionary>,
}

impl System {
    /// The device with this key.
    pub fn device(&self, key: &str) -> Option<&Dictionary> {
        self.devices.iter().find(|device| device.key == key)
    }

    /// The default language.
    pub fn language(&self) -> &str {
        self.languages.first().map_or("en", String::as_str)
    }
}

/// The maker of a device.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Vendor {
    /// Company name.
    pub name: String,
    /// Vendor-ID assigned by CiA (1018h.1); 0 when unknown.
    pub number: u32,
}

/// The object dictionary of one device, with what an EDS says about the device.
#[derive(Debug, Clone)]
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
    /// Objects by index.
    pub objects: BTreeMap<Index, Object>,
    /// PDOs, RPDOs first, by number.
    pub pdos: Vec<Pdo>,
    /// Where the device is defined.
    pub span: Span,
}

impl Dictionary {
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
        let entry = object.entry(id.sub)?;
        Some(match object.kind {
            ObjectKind::Var | ObjectKind::Domain => object.name.clone(),
            ObjectKind::Array | ObjectKind::Record => format!("{}.{}", object.name, entry.name),
        })
    }
}

/// What `[DeviceInfo]` says about a device.
#[derive(Debug, Clone, PartialEq, Eq)]
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
    /// Data types that may stand in an RPDO as placeholders.
    pub dummies: Vec<DataType>,
}

/// What `[FileInfo]` says about the EDS.
#[derive(Debug, Clone, PartialEq, Eq)]
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

/// Shape of an object (CiA 301 table 37).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ObjectKind {
    /// One value at sub-index 0.
    Var,
    /// Elements of one type behind a count.
    Array,
    /// Members of any types behind a count.
    Record,
    /// A block of variable length.
    Domain,
}

impl ObjectKind {
    /// `VAR`, `ARRAY`, `RECORD`, `DOMAIN`.
    pub const fn name(self) -> &'static str {
        match self {
            ObjectKind::Var => "VAR",
            ObjectKind::Array => "ARRAY",
            ObjectKind::Record => "RECORD",
            ObjectKind::Domain => "DOMAIN",
        }
    }

    /// Object code of CiA 301.
    pub const fn code(self) -> u8 {
        match self {
            ObjectKind::Domain => 2,
            ObjectKind::Var => 7,
            ObjectKind::Array => 8,
            ObjectKind::Record => 9,
        }
    }
}

/// Where an object of a dictionary comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Origin {
    /// Written in the specification's `objects:`.
    Manual,
    /// Brought in by a feature of a profile library.
    Profile,
    /// Made from `pdos:`.
    Pdo,
}

impl Origin {
    /// `manual`, `profile`, `pdo`.
    pub const fn word(self) -> &'static str {
        match self {
            Origin::Manual => "manual",
            Origin::Profile => "profile",
            Origin::Pdo => "pdo",
        }
    }
}

/// One object of a dictionary.
#[derive(Debug, Clone)]
pub struct Object {
    /// Index.
    pub index: Index,
    /// Name, as the manual's heading spells it.
    pub name: String,
    /// Shape.
    pub kind: ObjectKind,
    /// Where it comes from.
    pub origin: Origin,
    /// The library that defines it, such as `cia301`.
    pub profile: Option<String>,
    /// Facts in which the specification departs from the library, such as `name` or `access`.
    pub differs: Vec<String>,
    /// Whether a standard demands it.
    pub category: Option<Category>,
    /// Manual revision that introduced it.
    pub since: Option<String>,
    /// Meaning.
    pub about: Text,
    /// Entries by ascending sub-index; a VAR or DOMAIN has exactly one, at 0.
    pub entries: Vec<Entry>,
    /// Where it is written.
    pub span: Span,
}

impl Object {
    /// The entry at a sub-index.
    pub fn entry(&self, sub: SubIndex) -> Option<&Entry> {
        self.entries.binary_search_by_key(&sub, |entry| entry.sub).ok().map(|at| &self.entries[at])
    }

    /// Whether the object has sub-indices.
    pub const fn is_structured(&self) -> bool {
        matches!(self.kind, ObjectKind::Array | ObjectKind::Record)
    }

    /// Whether a "store parameters" command or the device itself keeps any entry.
    pub fn is_stored(&self) -> bool {
        self.entries.iter().any(|entry| entry.stored != Storage::No)
    }
}

/// One addressable value.
#[derive(Debug, Clone)]
pub struct Entry {
    /// Sub-index.
    pub sub: SubIndex,
    /// Name; for a VAR the object's.
    pub name: String,
    /// Data type on the bus.
    pub data_type: DataType,
    /// The enum or bit field that gives the values their meaning.
    pub named_type: Option<Arc<NamedType>>,
    /// Access over the bus.
    pub access: Access,
    /// Writable only while the device is unlocked for service (the manual's `r(w)`).
    pub locked: bool,
    /// PDO mapping.
    pub pdo: PdoMapping,
    /// Value after factory reset.
    pub default: Option<Value>,
    /// Smallest allowed value (raw), beside the special values.
    pub low: Option<i128>,
    /// Largest allowed value (raw), beside the special values.
    pub high: Option<i128>,
    /// Physical unit and scale.
    pub unit: Option<Arc<Unit>>,
    /// Raw values with a meaning of their own; allowed even outside the limits.
    pub special: Vec<SpecialValue>,
    /// What keeps the value over power-off.
    pub stored: Storage,
    /// The entry this one is another view of.
    pub alias: Option<Alias>,
    /// Whether a standard demands it.
    pub category: Option<Category>,
    /// Manual revision that introduced it.
    pub since: Option<String>,
    /// Condition under which a write is accepted.
    pub writable_when: Option<Expr>,
    /// Error codes of the named type's bits, where the type is shared: bit number, codes.
    pub bit_errors: Vec<(u8, Vec<u16>)>,
    /// What the EDS shows of it.
    pub eds: EdsPolicy,
    /// Meaning.
    pub about: Text,
    /// Where it is written.
    pub span: Span,
}

impl Entry {
    /// Smallest and largest value that an EDS or a server can state as plain limits: the declared
    /// limits, widened to take in the special values. `None` where nothing limits that side.
    pub fn hull(&self) -> (Option<i128>, Option<i128>) {
        let special = self.special.iter().map(|special| special.value);
        let low = self.low.map(|low| special.clone().fold(low, i128::min));
        let high = self.high.map(|high| special.fold(high, i128::max));
        (low, high)
    }

    /// Whether a raw value is allowed: inside the limits, or special.
    pub fn allows(&self, value: i128) -> bool {
        self.special.iter().any(|special| special.value == value)
            || (self.low.is_none_or(|low| value >= low) && self.high.is_none_or(|high| value <= high))
    }
}

/// A raw value with a meaning of its own.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SpecialValue {
    /// Raw value.
    pub value: i128,
    /// What it means, in a few words.
    pub name: String,
    /// More about it.
    pub about: Text,
}

/// A view of another entry in a narrower type or another unit; it has no storage of its own.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Alias {
    /// The entry that holds the value.
    pub target: EntryId,
    /// Raw alias value per raw target value: 1, or the units' quotient.
    pub factor: Ratio,
    /// How a value between two steps is rounded on reading.
    pub rounding: Rounding,
    /// What happens to a value outside the alias' range on reading.
    pub outside: Outside,
}

/// What the EDS shows of an entry beyond its own facts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct EdsPolicy {
    /// Access written into the EDS.
    pub access: Access,
    /// Whether `DefaultValue` is written. Some PLCs write every default back at boot.
    pub default: bool,
    /// `ObjFlags` bit 0: tools must not write the entry on download.
    pub no_write: bool,
    /// `ObjFlags` bit 1: tools must not read the entry on scan.
    pub no_scan: bool,
}

impl EdsPolicy {
    /// Value of `ObjFlags`.
    pub const fn flags(self) -> u32 {
        self.no_write as u32 | (self.no_scan as u32) << 1
    }
}

/// An enum or a bit field with a name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NamedType {
    /// Name.
    pub name: String,
    /// Data type on the bus.
    pub base: DataType,
    /// Meaning.
    pub about: Text,
    /// Values or bits.
    pub kind: TypeKind,
}

/// What a [`NamedType`] consists of.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum TypeKind {
    /// Named values, ascending.
    Enum(Vec<EnumValue>),
    /// Fields by ascending bit; they cover every bit of the base type.
    Bits(Vec<BitField>),
}

/// One value of an enum.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct EnumValue {
    /// Raw value.
    pub value: i128,
    /// Name.
    pub name: String,
    /// Whether this device accepts or sends it; `false` for values that only a standard defines.
    pub supported: bool,
    /// Meaning.
    pub about: Text,
}

/// One bit, or a run of bits that belong together.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BitField {
    /// Lowest bit.
    pub first: u8,
    /// Highest bit.
    pub last: u8,
    /// What the bits are for.
    pub usage: BitUsage,
    /// Name; empty for bits without use.
    pub name: String,
    /// Meaning.
    pub about: Text,
    /// Error codes that the device reports with this bit.
    pub errors: Vec<u16>,
    /// Terminal at which the signal is found.
    pub clamp: Option<String>,
    /// The level that means "active"; 1 unless stated.
    pub active: u8,
    /// The change that triggers the function, where a level does not.
    pub edge: Option<Edge>,
    /// Error priority, as the manual classes it.
    pub priority: Option<String>,
    /// Named values of a run of bits.
    pub values: Vec<EnumValue>,
    /// Meanings that apply only in one mode of operation: mode, name, meaning.
    pub modes: Vec<(String, String, Text)>,
}

/// What bits are for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BitUsage {
    /// They mean something.
    Used,
    /// Reserved by a standard or for later.
    Reserved,
    /// Free.
    Unused,
}

/// A change of a bit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Edge {
    /// 0 to 1.
    Rising,
    /// 1 to 0.
    Falling,
    /// Either.
    Both,
}

impl Edge {
    /// The word that a specification uses.
    pub const fn word(self) -> &'static str {
        match self {
            Edge::Rising => "rising",
            Edge::Falling => "falling",
            Edge::Both => "both",
        }
    }
}

/// An emergency and error code (603Fh, 1003h).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ErrorCode {
    /// The code.
    pub code: u16,
    /// Name.
    pub name: String,
    /// Devices that report it; empty means all.
    pub devices: Vec<String>,
    /// Priority, as the manual classes it.
    pub priority: Option<String>,
    /// What the device does.
    pub reaction: Text,
    /// More about it.
    pub about: Text,
}

/// A state machine that a command entry drives and a status entry shows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StateMachine {
    /// Name.
    pub name: String,
    /// Devices that have it; empty means all.
    pub devices: Vec<String>,
    /// Entry that shows the state.
    pub status: EntryId,
    /// Entry that takes the commands.
    pub command: EntryId,
    /// States, in the order of the specification.
    pub states: Vec<State>,
    /// Transitions by number.
    pub transitions: Vec<Transition>,
    /// Commands, in the order of the specification.
    pub commands: Vec<Command>,
}

/// A state and how the status entry shows it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct State {
    /// Name.
    pub name: String,
    /// Bits that show it.
    pub pattern: BitPattern,
    /// Meaning.
    pub about: Text,
}

/// A transition between states.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Transition {
    /// Number in the standard or the manual.
    pub number: u8,
    /// States it leaves; empty for the start.
    pub from: Vec<String>,
    /// State it enters.
    pub to: String,
    /// What causes it.
    pub event: Text,
    /// What the device does.
    pub action: Text,
}

/// A command and its coding in the command entry.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Command {
    /// Name.
    pub name: String,
    /// Bits that make it.
    pub pattern: BitPattern,
    /// A value that gives the command.
    pub send: Option<u32>,
    /// Transitions it causes.
    pub transitions: Vec<u8>,
    /// Meaning.
    pub about: Text,
}

/// Fixed, free and changing bits of a word, most significant bit first.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BitPattern(pub Vec<PatternBit>);

/// One place of a [`BitPattern`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PatternBit {
    /// 0.
    Zero,
    /// 1.
    One,
    /// Either.
    Any,
    /// A change from 0 to 1.
    Rising,
    /// A change from 1 to 0.
    Falling,
}

impl BitPattern {
    /// Mask of the bits that matter and their values (an edge counts as its final level).
    pub fn mask_and_value(&self) -> (u64, u64) {
        self.0.iter().fold((0, 0), |(mask, value), bit| {
            let (matters, level) = match bit {
                PatternBit::Zero | PatternBit::Falling => (1, 0),
                PatternBit::One | PatternBit::Rising => (1, 1),
                PatternBit::Any => (0, 0),
            };
            (mask << 1 | matters, value << 1 | level)
        })
    }
}

/// A condition between entries that every configuration must meet.
#[derive(Debug, Clone)]
pub struct Constraint {
    /// Name.
    pub name: String,
    /// Why.
    pub about: Text,
    /// The condition.
    pub require: Expr,
    /// The condition counts only while this one holds.
    pub when: Option<Expr>,
    /// Devices whose entries it names.
    pub devices: Vec<String>,
    /// Where it is written.
    pub span: Span,
}
