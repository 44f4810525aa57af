//! What the code of a device will consist of: names, places, tables.
//!
//! A plan is in no language. What it has to know of the one it will be printed in, it asks the [`Language`]: how an
//! identifier is spelled, and which are taken. A second language is a printer next to the first.

mod condition;
mod directory;
mod entries;
mod foreign;
mod groups;
mod language;
mod layout;
mod names;
mod pool;
mod relations;
mod runs;
mod vocabulary;

use std::collections::BTreeMap;

use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::model::{
    BitField, DataType, Dictionary, Entry, EntryId, EnumValue, ErrorCode, NamedType, Object, Outside, Pdo,
    Rounding, StateMachine, Storage, System, SystemSource, Text, Unit, Value,
};
use od_spec::source::Span;
use od_spec::start_of_code;

pub use self::condition::{Compare, Condition, Sum};
pub use self::directory::{Block, Directory};
pub use self::foreign::decided;
pub use self::foreign::decided_anyhow;
pub use self::foreign::tell_apart;
pub use self::groups::Groups;
pub use self::groups::is_accessible;
pub use self::language::{Companion, Language, Role, ScopeKind};
pub use self::layout::Region;
pub use self::layout::factory;
pub use self::layout::{Layout, Place, lay_out};
use self::names::Scope;
pub use self::names::Words;
pub use self::pool::Pool;
pub use self::runs::PlannedRun;

/// "None" in the table's 16-bit references.
pub const NONE: u16 = u16::MAX;

/// The code of one device.
pub struct Plan<'a> {
    /// All that the specification describes.
    pub system: &'a System,
    /// The device.
    pub device: &'a Dictionary,
    /// Name of the dictionary's type.
    pub name: String,
    /// Where values are in memory.
    pub layout: Layout,
    /// By ascending index.
    pub objects: Vec<PlannedObject<'a>>,
    /// Objects that one accessor reaches by their number.
    pub runs: Vec<PlannedRun>,
    /// By row.
    pub entries: Vec<PlannedEntry<'a>>,
    /// What entries have in common.
    pub attributes: Pool<Attributes>,
    /// Lowest and highest raw values.
    pub limits: Pool<(i64, i64)>,
    /// Lists of permitted raw values.
    pub values: Pool<Vec<i64>>,
    /// Views of other entries.
    pub aliases: Vec<PlannedAlias>,
    /// Physical units of the values.
    pub units: Vec<PlannedUnit<'a>>,
    /// Enums and bit fields.
    pub types: Vec<PlannedType<'a>>,
    /// Sets of special values.
    pub specials: Vec<PlannedSpecial>,
    /// PDOs with their default mapping.
    pub pdos: Vec<PlannedPdo<'a>>,
    /// By the number in the attributes.
    pub conditions: Vec<Condition>,
    /// Conditions between entries.
    pub constraints: Vec<PlannedConstraint<'a>>,
    /// State machines.
    pub machines: Vec<PlannedMachine<'a>>,
    /// Priorities of errors: name, and as they are written.
    pub priorities: Vec<(String, String)>,
    /// Error codes of the device.
    pub errors: Vec<PlannedError<'a>>,
    rows: BTreeMap<EntryId, u16>,
    language: &'a dyn Language,
}

/// An object and how code reaches it.
pub struct PlannedObject<'a> {
    /// The object.
    pub object: &'a Object,
    /// Name of its accessor.
    pub name: String,
    /// Row of its first entry.
    pub first_row: u16,
    /// How code reaches its entries.
    pub shape: Shape,
}

/// How code reaches the entries of an object.
pub enum Shape {
    /// One accessor.
    Var,
    /// One accessor that takes the sub-index, as all elements are alike; with the name of sub-index 0 where it can change.
    Indexed {
        /// Name of the accessor of sub-index 0.
        count: Option<String>,
    },
    /// A group of accessors.
    Group {
        /// Name of the type of the group.
        type_name: String,
    },
}

/// An entry, in the order of the table.
pub struct PlannedEntry<'a> {
    /// Index and sub-index.
    pub id: EntryId,
    /// Position of its object.
    pub object: usize,
    /// The entry.
    pub entry: &'a Entry,
    /// Name in the enumeration of all entries.
    pub variant: String,
    /// Name where entries of many objects are together.
    pub name: String,
    /// Name of its accessor, in its object's group.
    pub member: String,
    /// Where its value is.
    pub place: Place,
    /// Bytes of its value; of a string its capacity.
    pub size: usize,
    /// Position of its attributes.
    pub attributes: u16,
    /// What its values are.
    pub kind: ValueKind,
}

/// What values of an entry are in code.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct ValueKind {
    /// The type on the bus.
    pub data_type: DataType,
    /// The enum or bit field around the number.
    pub named: Option<String>,
    /// The unit around the number.
    pub unit: Option<String>,
    /// The special values in addition to it.
    pub special: Option<usize>,
}

/// What entries have in common in the table.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Attributes {
    /// The type on the bus.
    pub data_type: DataType,
    /// Yes-or-no facts.
    pub flags: Flags,
    /// Where the value is.
    pub place: PlaceKind,
    /// The group that it is stored with.
    pub storage: Storage,
    /// Offset of the value without its lowest 16 bits.
    pub page: usize,
    /// Bytes of the value; of a string its capacity.
    pub size: usize,
    /// Position of its limits, or [`NONE`].
    pub limits: u16,
    /// Position of its permitted values, or [`NONE`].
    pub values: u16,
    /// Position of the condition of writing it, or [`NONE`].
    pub condition: u16,
}

/// Yes-or-no facts of an entry.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub struct Flags {
    /// It can be read.
    pub read: bool,
    /// It can be written.
    pub write: bool,
    /// Writing it has a condition.
    pub locked: bool,
    /// It can be mapped in a receive PDO.
    pub receive: bool,
    /// It can be mapped in a transmit PDO.
    pub transmit: bool,
    /// Sub-indices between those of its object are missing.
    pub sparse: bool,
    /// Only some values are permitted.
    pub only_values: bool,
}

/// Where a value lies, without the offset.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum PlaceKind {
    /// In the image.
    Image,
    /// Among the constants.
    Constant,
    /// Nowhere: it is a view of another entry.
    Alias,
    /// With the application.
    Application,
}

/// A view of another entry.
pub struct PlannedAlias {
    /// Row of the view.
    pub row: u16,
    /// Row of what it shows.
    pub target: u16,
    /// The type of the view.
    pub data_type: DataType,
    /// The value is multiplied by this …
    pub numerator: u32,
    /// … and divided by this.
    pub denominator: u32,
    /// How the result is rounded.
    pub rounding: Rounding,
    /// What becomes of a result that the type cannot hold.
    pub outside: Outside,
}

/// A physical unit.
pub struct PlannedUnit<'a> {
    /// The unit.
    pub unit: &'a Unit,
    /// Name of its type.
    pub name: String,
    /// The unit in its base.
    pub scale: Fraction,
    /// One raw step in the base.
    pub step: Fraction,
    /// What the raw value 0 means, where that is not 0.
    pub offset: Option<PlannedOffset>,
}

/// What the raw value 0 of a unit means.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PlannedOffset {
    /// In the unit's symbol.
    pub in_symbol: SignedFraction,
    /// In its base.
    pub in_base: SignedFraction,
}

/// A fraction that code computes with, which may be negative.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SignedFraction {
    /// The numerator.
    pub numerator: i64,
    /// The denominator.
    pub denominator: u64,
}

/// A positive fraction that code computes with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Fraction {
    /// The numerator.
    pub numerator: u64,
    /// The denominator.
    pub denominator: u64,
}

/// An enum or a bit field.
pub struct PlannedType<'a> {
    /// The type.
    pub named: &'a NamedType,
    /// Its name in code.
    pub name: String,
    /// What it consists of.
    pub members: Members<'a>,
}

/// What a named type consists of.
pub enum Members<'a> {
    /// The values of an enum.
    Values(Vec<PlannedValue<'a>>),
    /// The fields of a bit field.
    Bits(Vec<PlannedBits<'a>>),
}

/// A value with a name.
pub struct PlannedValue<'a> {
    /// Name of its constant.
    pub name: String,
    /// The value.
    pub value: &'a EnumValue,
}

/// A bit or a run of bits with one accessor.
pub struct PlannedBits<'a> {
    /// Name of the accessor.
    pub name: String,
    /// What the specification calls it.
    pub label: String,
    /// Its lowest bit.
    pub first: u8,
    /// Its highest bit.
    pub last: u8,
    /// What it means.
    pub about: &'a Text,
    /// The field.
    pub field: &'a BitField,
    /// Constants for the values of the run.
    pub values: Vec<PlannedValue<'a>>,
}

/// A set of special values that entries share. Sets of one name have the same meanings, and one type in code.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PlannedSpecial {
    /// Name of the type.
    pub name: String,
    /// The values.
    pub values: Vec<PlannedSpecialValue>,
}

impl PlannedSpecial {
    /// Whether both say the same, be it with other raw values.
    pub fn has_meanings_of(&self, other: &Self) -> bool {
        fn meanings(set: &PlannedSpecial) -> impl Iterator<Item = (&str, &str)> {
            set.values.iter().map(|value| (value.name.as_str(), value.text.as_str()))
        }
        meanings(self).eq(meanings(other))
    }
}

/// A special value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PlannedSpecialValue {
    /// Name of the variant.
    pub name: String,
    /// What the specification calls it.
    pub text: String,
    /// Raw value.
    pub value: i128,
}

/// A PDO with its default mapping.
pub struct PlannedPdo<'a> {
    /// The PDO.
    pub pdo: &'a Pdo,
    /// Name of its type.
    pub name: String,
    /// What is mapped.
    pub fields: Vec<PlannedField>,
    /// How many bits are mapped.
    pub bits: u32,
    /// How the device finds its parameters; `None` where it cannot serve the PDO.
    pub served: Option<ServedPdo>,
}

/// The rows of a PDO's parameters.
pub struct ServedPdo {
    /// Row of the COB-ID.
    pub cob_id: u16,
    /// Of the number of mapped entries; the mapping parameters follow.
    pub mapping: u16,
    /// What is mapped after a factory reset; none where the device has to search.
    pub rows: Vec<u16>,
}

/// A mapped entry in a PDO.
pub struct PlannedField {
    /// Name of the field.
    pub name: String,
    /// Row of the mapped entry.
    pub row: u16,
    /// Where it begins in the frame.
    pub first_bit: u32,
    /// How many bits it has.
    pub bits: u8,
}

/// A condition between entries of the device.
pub struct PlannedConstraint<'a> {
    /// What the specification calls it.
    pub name: &'a str,
    /// Name of the function that checks it.
    pub function: String,
    /// What it is for.
    pub about: &'a Text,
    /// It holds only where this holds.
    pub when: Option<Condition>,
    /// What has to hold.
    pub require: Condition,
    /// Whether parts were left out that name other devices.
    pub partial: bool,
}

/// A state machine.
pub struct PlannedMachine<'a> {
    /// The state machine.
    pub machine: &'a StateMachine,
    /// Begins the names of its types.
    pub name: String,
    /// Row of the status word.
    pub status: u16,
    /// Row of the control word.
    pub command: u16,
    /// Names of the states.
    pub states: Vec<String>,
    /// Names of the commands.
    pub commands: Vec<String>,
}

/// An error code with a constant.
pub struct PlannedError<'a> {
    /// Name of its constant.
    pub name: String,
    /// Its name as one of several.
    pub variant: String,
    /// The error.
    pub error: &'a ErrorCode,
}

/// Rows address their values by 24 bits.
const LARGEST_IMAGE: usize = 1 << 24;

/// Plans the code of a device in a language. What cannot be code is reported; the plan is of use only if nothing was.
pub fn plan<'a>(
    system: &'a System,
    device: &'a Dictionary,
    language: &'a dyn Language,
    diagnostics: &mut Diagnostics,
) -> Plan<'a> {
    if let Some(start) = start_of_code(device).filter(|_| system.source == SystemSource::Eds) {
        diagnostics.push(start);
    }
    let layout = lay_out(device, diagnostics);
    if layout.factory.len().max(layout.constants.len()) > LARGEST_IMAGE {
        diagnostics.push(
            Diagnostic::new(
                codes::NOT_IN_FIRMWARE,
                device.span,
                format!("the values of `{}` take more than {} MiB", device.key, LARGEST_IMAGE >> 20),
            )
            .help(
                "give strings a smaller `capacity:`, or let the application keep large values: as a `domain`",
            ),
        );
    }
    let name = language.identifier(ScopeKind::Dictionary, Role::Type, &Words::of(&device.key));
    Scope::default().claim(&name, &format!("device `{}`", device.key), device.span, diagnostics);
    let rows = rows(device, diagnostics);
    let mut plan = Plan {
        system,
        device,
        name,
        layout,
        objects: Vec::new(),
        runs: Vec::new(),
        entries: Vec::new(),
        attributes: Pool::default(),
        limits: Pool::default(),
        values: Pool::default(),
        aliases: Vec::new(),
        units: Vec::new(),
        types: Vec::new(),
        specials: Vec::new(),
        pdos: Vec::new(),
        conditions: Vec::new(),
        constraints: Vec::new(),
        machines: Vec::new(),
        priorities: Vec::new(),
        errors: Vec::new(),
        rows,
        language,
    };
    plan.vocabulary(diagnostics);
    plan.objects(diagnostics);
    plan.pdos(diagnostics);
    plan.plan_constraints(diagnostics);
    plan.machines(diagnostics);
    plan.errors(diagnostics);
    plan
}

/// The row of every entry; not more of them than the table can number.
fn rows(device: &Dictionary, diagnostics: &mut Diagnostics) -> BTreeMap<EntryId, u16> {
    let count = device.entries().count();
    if count == 0 {
        diagnostics.push(
            Diagnostic::new(
                codes::NOT_IN_FIRMWARE,
                device.span,
                format!("`{}` has no object, and code of nothing is not a dictionary", device.key),
            )
            .help("describe objects, or take those that every device has with `uses: [cia301]`"),
        );
    }
    if count > usize::from(NONE) {
        diagnostics.push(
            Diagnostic::new(
                codes::NOT_IN_FIRMWARE,
                device.span,
                format!("`{}` has more than {} entries", device.key, NONE),
            )
            .help("leave entries out, or give the device fewer PDOs or mapping entries"),
        );
    }
    device.entries().zip(0..NONE).map(|((id, ..), row)| (id, row)).collect()
}

impl<'a> Plan<'a> {
    /// The row of an entry.
    pub fn row(&self, id: EntryId) -> Option<u16> {
        self.rows.get(&id).copied()
    }

    /// The entry of a row.
    pub fn entry(&self, row: u16) -> Option<&PlannedEntry<'a>> {
        self.entries.get(usize::from(row))
    }

    /// The identifier that a name becomes.
    fn identifier(&self, scope: ScopeKind, role: Role, name: &str) -> String {
        self.language.identifier(scope, role, &Words::of(name))
    }

    /// The place of a name, or that of the device where the name comes from a library.
    fn place(&self, span: Span) -> Span {
        if span.file.is_one_with(self.device.span.file) { span } else { self.device.span }
    }
}

fn too_large(span: Span, what: &str) -> Diagnostic {
    Diagnostic::new(
        codes::NOT_IN_FIRMWARE,
        span,
        format!("{what} needs numbers that generated code does not have"),
    )
    .help("firmware computes with 64 bits; use a narrower type or a simpler fraction")
}

/// The raw default of an entry, where it is an integer.
pub fn default_integer(entry: &Entry) -> Option<i128> {
    entry.default.as_ref().and_then(Value::integer)
}
