//! What the code of a device will consist of: names, places, tables. Nothing here knows Rust's syntax.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use od_spec::diag::{Code, Diagnostic, Diagnostics};
use od_spec::model::{
    BitUsage, DataType, Dictionary, Direction, Entry, EntryId, EnumValue, ErrorCode, NamedType, Object,
    ObjectKind, Outside, Pdo, PdoTarget, Ratio, Rounding, StateMachine, Storage, SubIndex, System, TypeKind,
    Unit, Value,
};
use od_spec::source::Span;

use super::condition::{self, Condition, Unusable};
use super::layout::{Layout, Place, lay_out};
use super::names::{Scope, camel, mutable, screaming, setter, snake};

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
    pub about: &'a od_spec::model::Text,
    pub field: &'a od_spec::model::BitField,
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
    pub about: &'a od_spec::model::Text,
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

/// Names that the dictionary's own methods have, and the methods of its traits: an accessor would hide them.
const METHODS: [&str; 21] = [
    "new",
    "clone",
    "entry",
    "row",
    "image",
    "image_mut",
    "condition",
    "find",
    "info",
    "read",
    "upload",
    "write",
    "upload_domain",
    "download_domain",
    "reset",
    "reset_stored",
    "stored",
    "restore",
    "layout",
    "broken_constraint",
    "write_consistent",
];

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
                    Code::NotInFirmware,
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

    /// Units, types and special values that the device's entries use, by name.
    fn vocabulary(&mut self, diagnostics: &mut Diagnostics) {
        let span = self.device.span;
        let (mut units, mut types) = (BTreeMap::new(), BTreeMap::new());
        for (_, _, entry) in self.device.entries() {
            if let Some(unit) = entry.unit.as_deref().filter(|_| entry.data_type.is_integer()) {
                units.insert(unit.name.as_str(), unit);
            }
            if let Some(named) = entry.named_type.as_deref() {
                types.insert(named.name.as_str(), named);
            }
        }
        let mut scope = Scope::with_reserved(&["bases"]);
        for unit in units.into_values() {
            let name = camel(&unit.name);
            scope.claim(&name, &format!("unit `{}`", unit.name), span, diagnostics);
            let small = |ratio: Option<Ratio>| {
                let ratio = ratio?;
                Some((u64::try_from(ratio.numerator()).ok()?, u64::try_from(ratio.denominator()).ok()?))
            };
            let (Some(scale), Some(step)) = (small(Some(unit.scale)), small(unit.step())) else {
                diagnostics.push(too_large(span, &format!("the scale of unit `{}`", unit.name)));
                continue;
            };
            let base = base_name(unit.base_symbol());
            self.units.push(PlannedUnit { unit, name, scale, step, base });
        }
        let mut scope = Scope::default();
        for named in types.into_values() {
            let name = camel(&named.name);
            scope.claim(&name, &format!("type `{}`", named.name), span, diagnostics);
            if matches!(named.kind, TypeKind::Enum(_)) && named.base == DataType::Unsigned64 {
                diagnostics.push(too_large(span, &format!("enum `{}`", named.name)));
            }
            let members = members(named, span, diagnostics);
            self.types.push(PlannedType { named, name, members });
        }
    }

    fn objects(&mut self, diagnostics: &mut Diagnostics) {
        let device = self.device;
        let mut methods = Scope::with_reserved(&METHODS);
        let mut groups = Scope::with_reserved(&PRELUDE);
        let mut variants = Scope::default();
        for object in device.objects.values() {
            let what = format!("{} ({})", object.index, object.name);
            let name = snake(object.identifier.as_ref().unwrap_or(&object.name));
            // What follows from a name that is refused is refused with it.
            if !methods.claim(&name, &what, object.span, diagnostics) {
                continue;
            }
            let shape = shape(object, &name, &self.layout);
            match &shape {
                Shape::Var => {
                    methods.claim(&setter(&name), &format!("the setter of {what}"), object.span, diagnostics);
                }
                Shape::Indexed { count } => {
                    methods.claim(&setter(&name), &format!("the setter of {what}"), object.span, diagnostics);
                    for name in count.iter().flat_map(|count| [count.clone(), setter(count)]) {
                        methods.claim(&name, &format!("sub-index 0 of {what}"), object.span, diagnostics);
                    }
                }
                Shape::Group { type_name } => {
                    methods.claim(
                        &mutable(&name),
                        &format!("{what} to be changed"),
                        object.span,
                        diagnostics,
                    );
                    groups.claim(type_name, &what, object.span, diagnostics);
                }
            }
            let Some(first_row) = object
                .entries
                .first()
                .and_then(|entry| self.row(EntryId { index: object.index, sub: entry.sub }))
            else {
                continue;
            };
            let position = self.objects.len();
            let mut own = Scope::default();
            for entry in &object.entries {
                self.push_entry(object, position, &name, entry, &mut own, &mut variants, diagnostics);
            }
            self.objects.push(PlannedObject { object, name, first_row, shape });
        }
    }

    #[expect(clippy::too_many_arguments, reason = "an entry with all the scopes in which it has a name")]
    fn push_entry(
        &mut self,
        object: &'a Object,
        position: usize,
        object_name: &str,
        entry: &'a Entry,
        own: &mut Scope,
        variants: &mut Scope,
        diagnostics: &mut Diagnostics,
    ) {
        let id = EntryId { index: object.index, sub: entry.sub };
        let member = snake(entry.identifier.as_ref().unwrap_or(&entry.name));
        let name = if object.is_structured() {
            snake(&format!("{object_name} {}", entry.identifier.as_ref().unwrap_or(&entry.name)))
        } else {
            object_name.to_owned()
        };
        let variant = camel(&name);
        let what = format!("{id} ({})", entry.name);
        let its_setter = format!("the setter of {what}");
        let named = own.claim(&member, &what, entry.span, diagnostics)
            && own.claim(&setter(&member), &its_setter, entry.span, diagnostics)
            && variants.claim(&variant, &what, entry.span, diagnostics);
        if !named {
            return;
        }
        let Some((place, size)) = self.layout.places.get(&id).copied() else { return };
        let attributes = self.attributes(id, object, entry, place, size, diagnostics);
        let kind = self.kind(entry, diagnostics);
        if let Some(alias) = &entry.alias {
            self.push_alias(id, entry, alias, diagnostics);
        }
        self.entries.push(PlannedEntry {
            id,
            object: position,
            entry,
            variant,
            name,
            member,
            place,
            size,
            attributes,
            kind,
        });
    }

    fn kind(&mut self, entry: &Entry, diagnostics: &mut Diagnostics) -> ValueKind {
        let named = entry.named_type.as_deref().map(|named| camel(&named.name));
        let integer = entry.data_type.is_integer() && named.is_none();
        let unit = entry.unit.as_deref().filter(|_| integer).map(|unit| camel(&unit.name));
        let special = (integer && !entry.special.is_empty()).then(|| self.special(entry, diagnostics));
        ValueKind { data_type: entry.data_type, named, unit, special }
    }

    /// The set of special values of an entry; equal sets are one type.
    fn special(&mut self, entry: &Entry, diagnostics: &mut Diagnostics) -> usize {
        let values: Vec<_> = entry
            .special
            .iter()
            .map(|special| (camel(&special.name), special.name.clone(), special.value))
            .collect();
        let name = values.iter().map(|(name, ..)| name.as_str()).collect::<Vec<_>>().join("Or");
        let set = PlannedSpecial { name, values };
        if let Some(at) = self.specials.iter().position(|other| *other == set) {
            return at;
        }
        if self.specials.iter().any(|other| other.name == set.name) {
            diagnostics.push(
                Diagnostic::new(
                    Code::IdentifierClash,
                    entry.span,
                    format!("`{}` would name two sets of special values", set.name),
                )
                .help("give special values that differ different names"),
            );
        }
        let mut scope = Scope::default();
        for (name, text, _) in &set.values {
            scope.claim(name, &format!("special value `{text}`"), entry.span, diagnostics);
        }
        self.specials.push(set);
        self.specials.len() - 1
    }

    fn push_alias(
        &mut self,
        id: EntryId,
        entry: &Entry,
        alias: &od_spec::model::Alias,
        diagnostics: &mut Diagnostics,
    ) {
        let target = self.device.entry(alias.target);
        let range = target.and_then(|target| target.data_type.range());
        let small = |value: i128| u32::try_from(value).ok();
        let (numerator, denominator) = (small(alias.factor.numerator()), small(alias.factor.denominator()));
        // Twice the product, for rounding to the nearest, stays within 64 bits.
        let fits = range.zip(numerator).is_some_and(|((low, high), numerator)| {
            let fits =
                |end: i128| end.checked_mul(numerator.into()).is_some_and(|end| i64::try_from(end).is_ok());
            fits(low) && fits(high)
        });
        let (Some(row), Some(target)) = (self.row(id), self.row(alias.target)) else { return };
        let (Some(numerator), Some(denominator), true, false) =
            (numerator, denominator, fits, entry.data_type.bits() == Some(64))
        else {
            diagnostics.push(too_large(entry.span, &format!("alias {id}")));
            return;
        };
        self.aliases.push(PlannedAlias {
            row,
            target,
            data_type: entry.data_type,
            numerator,
            denominator,
            rounding: alias.rounding,
            outside: alias.outside,
        });
    }

    fn attributes(
        &mut self,
        id: EntryId,
        object: &Object,
        entry: &Entry,
        place: Place,
        size: usize,
        diagnostics: &mut Diagnostics,
    ) -> u16 {
        let subs = object.entries.iter().map(|entry| usize::from(entry.sub.0));
        let listed = listed_values(entry);
        let (place, offset) = match place {
            Place::Image(at) => (PlaceKind::Image, at),
            Place::Constant(at) => (PlaceKind::Constant, at),
            Place::Alias => (PlaceKind::Alias, 0),
            Place::Application => (PlaceKind::Application, 0),
        };
        let flags = Flags {
            read: entry.access.is_readable(),
            write: entry.access.is_writable(),
            locked: entry.locked,
            receive: entry.pdo.allows(Direction::Receive),
            transmit: entry.pdo.allows(Direction::Transmit),
            sparse: !subs.eq(0..object.entries.len()),
            only_values: matches!(listed, Some((true, _))),
        };
        let limits = limits(entry).map_or(NONE, |limits| self.limits.position(limits));
        let values = listed.map_or(NONE, |(_, values)| self.values.position(values));
        let condition = match entry.writable_when.as_ref().filter(|_| flags.write) {
            None => NONE,
            Some(written) => match condition::plan(written, self.device) {
                Ok(condition) => self.condition(condition),
                // A condition about other devices is theirs to keep.
                Err(Unusable::Elsewhere) => NONE,
                Err(Unusable::TooLarge) => {
                    diagnostics.push(too_large(entry.span, &format!("the write condition of {id}")));
                    NONE
                }
            },
        };
        let attributes = Attributes {
            data_type: entry.data_type,
            flags,
            place,
            storage: entry.stored,
            page: offset >> 16,
            size,
            limits,
            values,
            condition,
        };
        self.attributes.position(attributes)
    }

    fn condition(&mut self, condition: Condition) -> u16 {
        let at = self.conditions.iter().position(|other| *other == condition).unwrap_or_else(|| {
            self.conditions.push(condition);
            self.conditions.len() - 1
        });
        u16::try_from(at).unwrap_or(NONE)
    }

    fn pdos(&mut self, diagnostics: &mut Diagnostics) {
        for pdo in &self.device.pdos {
            let name = format!(
                "{}{}",
                if pdo.direction == Direction::Receive { "Rpdo" } else { "Tpdo" },
                pdo.number
            );
            let (mut fields, mut first_bit) = (Vec::new(), 0);
            let mut scope = Scope::default();
            for mapped in &pdo.map {
                if let PdoTarget::Entry(id) = mapped.target
                    && let Some(row) = self.row(id)
                    && let Some(entry) = self.entry(row)
                {
                    scope.claim(&entry.name, &format!("{id} in {name}"), pdo.span, diagnostics);
                    fields.push(PlannedField { name: entry.name.clone(), row, first_bit, bits: mapped.bits });
                }
                first_bit += u32::from(mapped.bits);
            }
            self.pdos.push(PlannedPdo { pdo, name, fields, bits: first_bit });
        }
    }

    fn machines(&mut self, diagnostics: &mut Diagnostics) {
        let (system, device) = (self.system, self.device);
        let here = |devices: &[String]| devices.is_empty() || devices.contains(&device.key);
        let mut scope = Scope::default();
        for machine in system.machines.values().filter(|machine| here(&machine.devices)) {
            let (Some(status), Some(command)) = (self.row(machine.status), self.row(machine.command)) else {
                continue;
            };
            let name = camel(&machine.name);
            scope.claim(&name, &format!("state machine `{}`", machine.name), device.span, diagnostics);
            let mut named = |names: Vec<&str>, what: &str| -> Vec<String> {
                let mut own = Scope::default();
                let names = names.into_iter().map(|text| {
                    let name = camel(text);
                    own.claim(
                        &name,
                        &format!("{what} `{text}` of `{}`", machine.name),
                        device.span,
                        diagnostics,
                    );
                    name
                });
                names.collect()
            };
            let states = named(machine.states.iter().map(|state| state.name.as_str()).collect(), "state");
            let commands =
                named(machine.commands.iter().map(|command| command.name.as_str()).collect(), "command");
            self.machines.push(PlannedMachine { machine, name, status, command, states, commands });
        }
    }

    fn errors(&mut self, diagnostics: &mut Diagnostics) {
        let (system, device) = (self.system, self.device);
        let mut scope = Scope::default();
        for error in &system.errors {
            if error.devices.is_empty() || error.devices.contains(&device.key) {
                let name = screaming(&error.name);
                scope.claim(&name, &format!("error {:04X}h", error.code), device.span, diagnostics);
                self.errors.push((name, error));
            }
        }
    }

    fn plan_constraints(&mut self, diagnostics: &mut Diagnostics) {
        let (system, device) = (self.system, self.device);
        let mut scope = Scope::default();
        for constraint in
            system.constraints.iter().filter(|constraint| constraint.devices.contains(&device.key))
        {
            let planned = |expr| condition::plan(expr, device);
            let foreign = |expr: &od_spec::expr::Expr| {
                expr.entries().iter().any(|entry| {
                    entry.device.as_ref().is_some_and(|key| *key != device.key)
                        || device.entry(entry.id).is_none()
                })
            };
            // Whether the condition counts at all cannot be told from here.
            if constraint.when.as_ref().is_some_and(foreign) {
                continue;
            }
            let when = constraint.when.as_ref().map(planned).transpose();
            let (when, require) = match (when, planned(&constraint.require)) {
                (Ok(when), Ok(require)) => (when, require),
                (Err(Unusable::Elsewhere), _) | (_, Err(Unusable::Elsewhere)) => continue,
                _ => {
                    diagnostics
                        .push(too_large(constraint.span, &format!("constraint `{}`", constraint.name)));
                    continue;
                }
            };
            let function = snake(&constraint.name);
            scope.claim(
                &function,
                &format!("constraint `{}`", constraint.name),
                constraint.span,
                diagnostics,
            );
            self.constraints.push(PlannedConstraint {
                name: &constraint.name,
                function,
                about: &constraint.about,
                when,
                require,
                partial: foreign(&constraint.require),
            });
        }
    }
}

/// Different items, each with its position. There are never more of them than rows.
pub(super) struct Pool<T> {
    list: Vec<T>,
    positions: BTreeMap<T, u16>,
}

impl<T> Default for Pool<T> {
    fn default() -> Self {
        Self { list: Vec::new(), positions: BTreeMap::new() }
    }
}

impl<T: Ord + Clone> Pool<T> {
    /// The position of an item, which is added if it is not there.
    fn position(&mut self, item: T) -> u16 {
        if let Some(at) = self.positions.get(&item) {
            return *at;
        }
        let at = u16::try_from(self.list.len()).unwrap_or(NONE);
        self.positions.insert(item.clone(), at);
        self.list.push(item);
        at
    }
}

impl<T> std::ops::Deref for Pool<T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        &self.list
    }
}

fn too_large(span: Span, what: &str) -> Diagnostic {
    Diagnostic::new(
        Code::NotInFirmware,
        span,
        format!("{what} needs numbers that generated code does not have"),
    )
    .help("firmware computes with 64 bits; use a narrower type or a simpler fraction")
}

/// `V`, `PU/s²` as an identifier of its own, whatever characters a symbol has.
fn base_name(symbol: &str) -> String {
    symbol.chars().fold("Base".to_owned(), |mut name, c| {
        match c {
            c if c.is_ascii_alphanumeric() => name.push(c),
            '/' => name.push_str("Per"),
            '°' => name.push_str("Degree"),
            '%' => name.push_str("Percent"),
            c => {
                let _ = write!(name, "U{:X}", u32::from(c));
            }
        }
        name
    })
}

/// How code reaches an object: elements whose names differ only by their number are reached by it.
fn shape(object: &Object, name: &str, layout: &Layout) -> Shape {
    if !object.is_structured() {
        return Shape::Var;
    }
    let Some((sub0, elements)) = object.entries.split_first() else { return Shape::Var };
    let pattern = |entry: &Entry| entry.name.replacen(&entry.sub.to_string(), "{n}", 1);
    let alike = elements.split_first().is_some_and(|(first, others)| {
        pattern(first).contains("{n}")
            && others.iter().all(|other| {
                pattern(other) == pattern(first)
                    && other.data_type == first.data_type
                    && other.named_type == first.named_type
                    && other.unit == first.unit
                    && other.special == first.special
                    && other.stored == first.stored
                    && other.access == first.access
                    && other.capacity == first.capacity
            })
    });
    let gapless = elements.iter().zip(1u8..).all(|(entry, sub)| entry.sub == SubIndex(sub));
    let fixed =
        elements.iter().all(|entry| entry.data_type.bits().is_some()) && object.kind != ObjectKind::Domain;
    if alike && gapless && fixed && lies_in_a_row(object, elements, layout) {
        let changes = sub0.access.is_writable() || object.index.0 == 0x1003;
        let count = changes.then(|| snake(&format!("{name} {}", sub0.name)));
        Shape::Indexed { count }
    } else {
        Shape::Group { type_name: camel(name) }
    }
}

/// Whether elements lie one behind the other in the image, or are all constants.
fn lies_in_a_row(object: &Object, elements: &[Entry], layout: &Layout) -> bool {
    let place = |entry: &Entry| layout.places.get(&EntryId { index: object.index, sub: entry.sub }).copied();
    let Some((Place::Image(start), size)) = elements.first().and_then(place) else {
        return elements.iter().all(|entry| matches!(place(entry), Some((Place::Constant(_), _))));
    };
    elements
        .iter()
        .enumerate()
        .all(|(at, entry)| place(entry) == Some((Place::Image(start + at * size), size)))
}

fn members<'a>(named: &'a NamedType, span: Span, diagnostics: &mut Diagnostics) -> Members<'a> {
    let mut scope = Scope::with_reserved(&["known", "bits", "name", "number", "is_known"]);
    let label = &named.name;
    match &named.kind {
        TypeKind::Enum(values) => {
            Members::Values(constants("", values, label, span, &mut scope, diagnostics))
        }
        TypeKind::Bits(fields) => {
            let mut planned = Vec::new();
            for field in fields.iter().filter(|field| field.usage == BitUsage::Used) {
                let general =
                    [(field.name.clone(), &field.about)].into_iter().filter(|(name, _)| !name.is_empty());
                let said = |mode: &&(String, String, od_spec::model::Text)| {
                    !matches!(mode.1.as_str(), "reserved" | "unused")
                };
                let modes = field
                    .modes
                    .iter()
                    .filter(said)
                    .map(|(mode, name, about)| (format!("{mode} {name}"), about));
                for (label_of_field, about) in general.chain(modes) {
                    let name = snake(&label_of_field);
                    let what = format!("bit {} of type `{label}`", field.first);
                    scope.claim(&name, &what, span, diagnostics);
                    scope.claim(&format!("with_{name}"), &what, span, diagnostics);
                    let values =
                        constants(&label_of_field, &field.values, label, span, &mut scope, diagnostics);
                    planned.push(PlannedBits {
                        name,
                        label: label_of_field,
                        first: field.first,
                        last: field.last,
                        about,
                        field,
                        values,
                    });
                }
            }
            Members::Bits(planned)
        }
    }
}

fn constants<'a>(
    prefix: &str,
    values: &'a [EnumValue],
    label: &str,
    span: Span,
    scope: &mut Scope,
    diagnostics: &mut Diagnostics,
) -> Vec<(String, &'a EnumValue)> {
    let named = values.iter().map(|value| {
        let name = screaming(&format!("{prefix} {}", value.name));
        scope.claim(&name, &format!("value {} of type `{label}`", value.value), span, diagnostics);
        (name, value)
    });
    named.collect()
}

/// The number by which the table compares: of UNSIGNED64 the value minus 2^63.
fn ordered(data_type: DataType, value: i128) -> i64 {
    let number = if data_type == DataType::Unsigned64 { value - (1 << 63) } else { value };
    i64::try_from(number).unwrap_or(if number < 0 { i64::MIN } else { i64::MAX })
}

fn limits(entry: &Entry) -> Option<(i64, i64)> {
    if entry.low.is_none() && entry.high.is_none() {
        return None;
    }
    let (low, high) = entry.data_type.range()?;
    Some((
        ordered(entry.data_type, entry.low.unwrap_or(low)),
        ordered(entry.data_type, entry.high.unwrap_or(high)),
    ))
}

/// Values that can be written beside the limits, or the only ones.
fn listed_values(entry: &Entry) -> Option<(bool, Vec<i64>)> {
    let number = |value: i128| ordered(entry.data_type, value);
    let specials = entry.special.iter().map(|special| special.value);
    if let Some(TypeKind::Enum(values)) = entry.named_type.as_ref().map(|named| &named.kind) {
        let supported = values.iter().filter(|value| value.supported && entry.allows(value.value));
        let mut list: Vec<i64> = supported.map(|value| value.value).chain(specials).map(number).collect();
        list.sort_unstable();
        list.dedup();
        return Some((true, list));
    }
    let limited = entry.low.is_some() || entry.high.is_some();
    (limited && !entry.special.is_empty()).then(|| (false, specials.map(number).collect()))
}

/// The raw default of an entry, where it is an integer.
pub(super) fn default_integer(entry: &Entry) -> Option<i128> {
    entry.default.as_ref().and_then(Value::integer)
}
