//! What the code of a device will consist of: names, places, tables.
//!
//! A plan is in no language. What it has to know of the one it will be printed in, it asks the [`Language`]: how an
//! identifier is spelled, and which are taken. A second language is a printer beside the first.

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

pub(crate) use self::condition::{Compare, Condition, Sum};
pub(crate) use self::directory::{Block, Directory};
pub(crate) use self::foreign::decided;
#[cfg(feature = "runtime")]
pub(crate) use self::foreign::decided_anyhow;
pub(crate) use self::groups::Groups;
#[cfg(feature = "c")]
pub(crate) use self::groups::is_accessible;
pub(crate) use self::language::{Companion, Language, Role, ScopeKind};
#[cfg(feature = "runtime")]
pub(crate) use self::layout::Region;
#[cfg(feature = "c")]
pub(crate) use self::layout::factory;
pub(crate) use self::layout::{Layout, Place, lay_out};
use self::names::Scope;
pub(crate) use self::names::Words;
pub(crate) use self::pool::Pool;
pub(crate) use self::runs::PlannedRun;

/// "None" in the table's 16-bit references.
pub(crate) const NONE: u16 = u16::MAX;

/// The code of one device.
pub(crate) struct Plan<'a> {
    pub system: &'a System,
    pub device: &'a Dictionary,
    /// Name of the dictionary's type.
    pub name: String,
    pub layout: Layout,
    pub objects: Vec<PlannedObject<'a>>,
    pub runs: Vec<PlannedRun>,
    /// By row.
    pub entries: Vec<PlannedEntry<'a>>,
    pub attributes: Pool<Attributes>,
    pub limits: Pool<(i64, i64)>,
    pub values: Pool<Vec<i64>>,
    pub aliases: Vec<PlannedAlias>,
    pub units: Vec<PlannedUnit<'a>>,
    pub types: Vec<PlannedType<'a>>,
    pub specials: Vec<PlannedSpecial>,
    pub pdos: Vec<PlannedPdo<'a>>,
    /// By the number in the attributes.
    pub conditions: Vec<Condition>,
    pub constraints: Vec<PlannedConstraint<'a>>,
    pub machines: Vec<PlannedMachine<'a>>,
    /// Priorities of errors: name, and as they are written.
    pub priorities: Vec<(String, String)>,
    /// Error codes of the device.
    pub errors: Vec<PlannedError<'a>>,
    rows: BTreeMap<EntryId, u16>,
    language: &'a dyn Language,
}

/// An object and how code reaches it.
pub(crate) struct PlannedObject<'a> {
    pub object: &'a Object,
    pub name: String,
    pub first_row: u16,
    pub shape: Shape,
}

/// How code reaches the entries of an object.
pub(crate) enum Shape {
    /// One accessor.
    Var,
    /// One accessor that takes the sub-index, as all elements are alike; with the name of sub-index 0 where it can change.
    Indexed { count: Option<String> },
    /// A group of accessors.
    Group { type_name: String },
}

/// An entry, in the order of the table.
pub(crate) struct PlannedEntry<'a> {
    pub id: EntryId,
    pub object: usize,
    pub entry: &'a Entry,
    /// Name in the enumeration of all entries.
    pub variant: String,
    /// Name where entries of many objects stand together.
    pub name: String,
    /// Name of its accessor, in its object's group.
    pub member: String,
    pub place: Place,
    pub size: usize,
    pub attributes: u16,
    pub kind: ValueKind,
}

/// What values of an entry are in code.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct ValueKind {
    pub data_type: DataType,
    /// The enum or bit field around the number.
    pub named: Option<String>,
    /// The unit around the number.
    pub unit: Option<String>,
    /// The special values beside it.
    pub special: Option<usize>,
}

/// What entries have in common in the table.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Attributes {
    pub data_type: DataType,
    pub flags: Flags,
    pub place: PlaceKind,
    pub storage: Storage,
    pub page: usize,
    pub size: usize,
    pub limits: u16,
    pub values: u16,
    pub condition: u16,
}

/// Yes-or-no facts of an entry.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub(crate) struct Flags {
    pub read: bool,
    pub write: bool,
    pub locked: bool,
    pub receive: bool,
    pub transmit: bool,
    pub sparse: bool,
    pub only_values: bool,
}

/// Where a value lies, without the offset.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum PlaceKind {
    Image,
    Constant,
    Alias,
    Application,
}

/// A view of another entry.
pub(crate) struct PlannedAlias {
    /// Row of the view.
    pub row: u16,
    /// Row of what it shows.
    pub target: u16,
    pub data_type: DataType,
    pub numerator: u32,
    pub denominator: u32,
    pub rounding: Rounding,
    pub outside: Outside,
}

/// A physical unit.
pub(crate) struct PlannedUnit<'a> {
    pub unit: &'a Unit,
    pub name: String,
    /// The unit in its base.
    pub scale: Fraction,
    /// One raw step in the base.
    pub step: Fraction,
    /// What the raw value 0 stands for, where that is not 0.
    pub offset: Option<PlannedOffset>,
}

/// What the raw value 0 of a unit stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct PlannedOffset {
    /// In the unit's symbol.
    pub in_symbol: SignedFraction,
    /// In its base.
    pub in_base: SignedFraction,
}

/// A fraction that code computes with, which may be negative.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct SignedFraction {
    pub numerator: i64,
    pub denominator: u64,
}

/// A positive fraction that code computes with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Fraction {
    pub numerator: u64,
    pub denominator: u64,
}

/// An enum or a bit field.
pub(crate) struct PlannedType<'a> {
    pub named: &'a NamedType,
    pub name: String,
    pub members: Members<'a>,
}

/// What a named type consists of.
pub(crate) enum Members<'a> {
    Values(Vec<PlannedValue<'a>>),
    Bits(Vec<PlannedBits<'a>>),
}

/// A value with a name.
pub(crate) struct PlannedValue<'a> {
    pub name: String,
    pub value: &'a EnumValue,
}

/// A bit or a run of bits with one accessor.
pub(crate) struct PlannedBits<'a> {
    pub name: String,
    pub label: String,
    pub first: u8,
    pub last: u8,
    pub about: &'a Text,
    pub field: &'a BitField,
    /// Constants for the values of the run.
    pub values: Vec<PlannedValue<'a>>,
}

/// A set of special values that entries share. Sets of one name have the same meanings, and one type in code.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct PlannedSpecial {
    pub name: String,
    pub values: Vec<PlannedSpecialValue>,
}

impl PlannedSpecial {
    /// Whether both say the same, be it with other raw values.
    pub(crate) fn has_meanings_of(&self, other: &Self) -> bool {
        fn meanings(set: &PlannedSpecial) -> impl Iterator<Item = (&str, &str)> {
            set.values.iter().map(|value| (value.name.as_str(), value.text.as_str()))
        }
        meanings(self).eq(meanings(other))
    }
}

/// A special value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct PlannedSpecialValue {
    pub name: String,
    /// What the specification calls it.
    pub text: String,
    /// Raw value.
    pub value: i128,
}

/// A PDO with its default mapping.
pub(crate) struct PlannedPdo<'a> {
    pub pdo: &'a Pdo,
    pub name: String,
    pub fields: Vec<PlannedField>,
    pub bits: u32,
    /// How the device finds its parameters; `None` where it cannot serve the PDO.
    pub served: Option<ServedPdo>,
}

/// The rows of a PDO's parameters.
pub(crate) struct ServedPdo {
    pub cob_id: u16,
    /// Of the number of mapped entries; the mapping parameters follow.
    pub mapping: u16,
    /// What is mapped after a factory reset; none where the device has to search.
    pub rows: Vec<u16>,
}

/// A mapped entry in a PDO.
pub(crate) struct PlannedField {
    pub name: String,
    pub row: u16,
    pub first_bit: u32,
    pub bits: u8,
}

/// A condition between entries of the device.
pub(crate) struct PlannedConstraint<'a> {
    pub name: &'a str,
    pub function: String,
    pub about: &'a Text,
    pub when: Option<Condition>,
    pub require: Condition,
    /// Whether parts were left out that name other devices.
    pub partial: bool,
}

/// A state machine.
pub(crate) struct PlannedMachine<'a> {
    pub machine: &'a StateMachine,
    /// Begins the names of its types.
    pub name: String,
    /// Rows of the words.
    pub status: u16,
    pub command: u16,
    /// Names of the states and of the commands.
    pub states: Vec<String>,
    pub commands: Vec<String>,
}

/// An error code with a constant.
pub(crate) struct PlannedError<'a> {
    pub name: String,
    /// Its name as one of several.
    pub variant: String,
    pub error: &'a ErrorCode,
}

/// Rows address their values by 24 bits.
const LARGEST_IMAGE: usize = 1 << 24;

/// Plans the code of a device in a language. What cannot be code is reported; the plan is of use only if nothing was.
pub(crate) fn plan<'a>(
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
    let name = language.identifier(Role::Type, &Words::of(&device.key));
    let mut dictionaries = Scope::with_reserved(language.reserved(ScopeKind::Dictionary));
    dictionaries.claim(&name, &format!("device `{}`", device.key), device.span, diagnostics);
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
                format!("`{}` has no object, and code of nothing is no dictionary", device.key),
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
    pub(crate) fn row(&self, id: EntryId) -> Option<u16> {
        self.rows.get(&id).copied()
    }

    /// The entry of a row.
    pub(crate) fn entry(&self, row: u16) -> Option<&PlannedEntry<'a>> {
        self.entries.get(usize::from(row))
    }

    /// The identifier that a name becomes.
    fn identifier(&self, role: Role, name: &str) -> String {
        self.language.identifier(role, &Words::of(name))
    }

    /// An empty scope.
    fn scope(&self, kind: ScopeKind) -> Scope {
        Scope::with_reserved(self.language.reserved(kind))
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
pub(crate) fn default_integer(entry: &Entry) -> Option<i128> {
    entry.default.as_ref().and_then(Value::integer)
}
