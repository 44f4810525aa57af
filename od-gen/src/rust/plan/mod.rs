//! What the code of a device will consist of: names, places, tables. Nothing here knows Rust's syntax.

mod entries;
mod pool;
mod relations;
mod vocabulary;

use std::collections::BTreeMap;

use od_spec::diag::{Diagnostic, Diagnostics, codes};
use od_spec::model::{
    BitField, DataType, Dictionary, Entry, EntryId, EnumValue, ErrorCode, NamedType, Object, Outside, Pdo,
    Rounding, StateMachine, Storage, System, Text, Unit, Value,
};
use od_spec::source::Span;

use self::pool::Pool;
use super::condition::Condition;
use super::layout::{Layout, Place, lay_out};
use super::names::{Scope, camel};

/// "None" in the table's 16-bit references.
pub(super) const NONE: u16 = u16::MAX;

/// The code of one device.
pub(super) struct Plan<'a> {
    pub system: &'a System,
    pub device: &'a Dictionary,
    /// Name of the dictionary's type.
    pub name: String,
    pub layout: Layout,
    pub objects: Vec<PlannedObject<'a>>,
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
    /// Error codes of the device, with the names of their constants.
    pub errors: Vec<(String, &'a ErrorCode)>,
    rows: BTreeMap<EntryId, u16>,
}

/// An object and how code reaches it.
pub(super) struct PlannedObject<'a> {
    pub object: &'a Object,
    pub name: String,
    pub first_row: u16,
    pub shape: Shape,
}

/// How code reaches the entries of an object.
pub(super) enum Shape {
    /// One accessor.
    Var,
    /// One accessor that takes the sub-index, as all elements are alike; with the name of sub-index 0 where it can change.
    Indexed { count: Option<String> },
    /// A group of accessors.
    Group { type_name: String },
}

/// An entry, in the order of the table.
pub(super) struct PlannedEntry<'a> {
    pub id: EntryId,
    pub object: usize,
    pub entry: &'a Entry,
    /// Name in the enumeration of all entries.
    pub variant: String,
    /// Name among all entries, in lower case.
    pub name: String,
    /// Name of its accessor, in its object's group.
    pub member: String,
    pub place: Place,
    pub size: usize,
    pub attributes: u16,
    pub kind: ValueKind,
}

/// What values of an entry are in code.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct ValueKind {
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
pub(super) struct Attributes {
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
pub(super) struct Flags {
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
pub(super) enum PlaceKind {
    Image,
    Constant,
    Alias,
    Application,
}

/// A view of another entry.
pub(super) struct PlannedAlias {
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
pub(super) struct PlannedUnit<'a> {
    pub unit: &'a Unit,
    pub name: String,
    pub scale: (u64, u64),
    pub step: (u64, u64),
    /// Name of the base.
    pub base: String,
}

/// An enum or a bit field.
pub(super) struct PlannedType<'a> {
    pub named: &'a NamedType,
    pub name: String,
    pub members: Members<'a>,
}

/// What a named type consists of.
pub(super) enum Members<'a> {
    Values(Vec<(String, &'a EnumValue)>),
    Bits(Vec<PlannedBits<'a>>),
}

/// A bit or a run of bits with one accessor.
pub(super) struct PlannedBits<'a> {
    pub name: String,
    pub label: String,
    pub first: u8,
    pub last: u8,
    pub about: &'a Text,
    pub field: &'a BitField,
    /// Constants for the values of the run.
    pub values: Vec<(String, &'a EnumValue)>,
}

/// A set of special values that entries share.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct PlannedSpecial {
    pub name: String,
    /// Name, text and raw value.
    pub values: Vec<(String, String, i128)>,
}

/// A PDO with its default mapping.
pub(super) struct PlannedPdo<'a> {
    pub pdo: &'a Pdo,
    pub name: String,
    pub fields: Vec<PlannedField>,
    pub bits: u32,
}

/// A mapped entry in a PDO.
pub(super) struct PlannedField {
    pub name: String,
    pub row: u16,
    pub first_bit: u32,
    pub bits: u8,
}

/// A condition between entries of the device.
pub(super) struct PlannedConstraint<'a> {
    pub name: &'a str,
    pub function: String,
    pub about: &'a Text,
    pub when: Option<Condition>,
    pub require: Condition,
    /// Whether parts were left out that name other devices.
    pub partial: bool,
}

/// A state machine.
pub(super) struct PlannedMachine<'a> {
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

/// Names that generated code uses where groups of accessors and the dictionary are defined.
const PRELUDE: [&str; 9] = ["Option", "Some", "None", "Result", "Ok", "Err", "Borrow", "BorrowMut", "D"];

/// Plans the code of a device. What cannot be code is reported; the plan is of use only if nothing was.
pub(super) fn plan<'a>(
    system: &'a System,
    device: &'a Dictionary,
    diagnostics: &mut Diagnostics,
) -> Plan<'a> {
    let layout = lay_out(device, diagnostics);
    let name = camel(&device.key);
    let mut top = Scope::with_reserved(&[&PRELUDE[..], &["Entry"]].concat());
    top.claim(&name, &format!("device `{}`", device.key), device.span, diagnostics);
    let mut rows = BTreeMap::new();
    for (row, (id, ..)) in device.entries().enumerate() {
        let Ok(row) =
            u16::try_from(row).map_err(drop).and_then(|row| if row < NONE { Ok(row) } else { Err(()) })
        else {
            diagnostics.push(
                Diagnostic::new(
                    codes::NOT_IN_FIRMWARE,
                    device.span,
                    format!("`{}` has more than {} entries", device.key, NONE - 1),
                )
                .help("leave entries out, or give the device fewer PDOs or mapping entries"),
            );
            break;
        };
        rows.insert(id, row);
    }
    let mut plan = Plan {
        system,
        device,
        name,
        layout,
        objects: Vec::new(),
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
        errors: Vec::new(),
        rows,
    };
    plan.vocabulary(diagnostics);
    plan.objects(diagnostics);
    plan.pdos(diagnostics);
    plan.plan_constraints(diagnostics);
    plan.machines(diagnostics);
    plan.errors(diagnostics);
    plan
}

impl<'a> Plan<'a> {
    /// The row of an entry.
    pub(super) fn row(&self, id: EntryId) -> Option<u16> {
        self.rows.get(&id).copied()
    }

    /// The entry of a row.
    pub(super) fn entry(&self, row: u16) -> Option<&PlannedEntry<'a>> {
        self.entries.get(usize::from(row))
    }

    /// The call that reads each entry.
    pub(super) fn accessors(&self) -> BTreeMap<EntryId, String> {
        let call = |planned: &PlannedEntry<'_>| {
            let object = self.objects.get(planned.object)?;
            Some(match &object.shape {
                Shape::Var => format!("{}()", object.name),
                Shape::Indexed { count } if planned.id.sub.0 == 0 => format!("{}()", count.as_ref()?),
                Shape::Indexed { .. } => format!("{}({})", object.name, planned.id.sub),
                Shape::Group { .. } => format!("{}().{}()", object.name, planned.member),
            })
        };
        self.entries.iter().filter_map(|planned| Some((planned.id, call(planned)?))).collect()
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
pub(super) fn default_integer(entry: &Entry) -> Option<i128> {
    entry.default.as_ref().and_then(Value::integer)
}
