//! Objects and their entries.

use std::borrow::Cow;
use std::sync::Arc;

use super::{
    Access, Author, BitErrors, BitField, Category, DataType, Departure, EditorNotes, EntryId, Expr, Fact,
    Facts, Index, NamedType, Outside, PdoMapping, Phrases, Ratio, Real, Rounding, Statement, Storage,
    SubIndex, Text, TypeKind, Unit, Value,
};
use crate::ascii::name_in_ascii;
use crate::source::{Span, Spanned};

/// Shape of an object (CiA 301 table 37).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ObjectKind {
    /// One value at sub-index 0.
    Var,
    /// Elements of one type after a count.
    Array,
    /// Members of any types after a count.
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
#[non_exhaustive]
pub struct Object {
    /// Index.
    pub index: Index,
    /// Name, as the manual's heading spells it.
    pub name: String,
    /// Name in generated code and in references, where the specification gives one.
    pub identifier: Option<String>,
    /// Shape.
    pub kind: ObjectKind,
    /// Where it comes from.
    pub origin: Origin,
    /// The library that defines it, such as `cia301`.
    pub profile: Option<String>,
    /// Facts in which the specification departs from the library.
    pub departures: Vec<Departure>,
    /// Whether a standard demands it.
    pub category: Option<Category>,
    /// Manual revision that introduced it.
    pub since: Option<String>,
    /// Objects that belong together with it, as they are written.
    pub links: Vec<Spanned<Index>>,
    /// What CANopenEditor keeps of it, if the file is from there.
    pub editor: Option<Box<EditorNotes>>,
    /// Danger that comes from it as a whole; that of a VAR is at its entry, too.
    pub warning: Text,
    /// Meaning.
    pub about: Text,
    /// Words by which readers look for it.
    pub search: Phrases,
    /// Entries by ascending sub-index; a VAR or DOMAIN has exactly one, at 0.
    pub entries: Vec<Entry>,
    /// Where it is written.
    pub span: Span,
}

impl Object {
    /// Whether references may call it so: by its name or its identifier.
    pub(crate) fn is_called(&self, text: &str) -> bool {
        self.name == text || self.identifier.as_deref() == Some(text)
    }

    /// What distinguishes the object from all others of its device: the identifier, or else the name.
    pub fn label(&self) -> &str {
        self.identifier.as_ref().unwrap_or(&self.name)
    }

    /// The name in an EDS, which is ASCII: transcribed, or the number where it has no form.
    pub fn eds_name(&self) -> Cow<'_, str> {
        name_in_ascii(&self.name, || format!("object {}", self.index))
    }

    /// [`eds_name`](Self::eds_name) of one of its entries: in a VAR or DOMAIN, that of the object.
    pub fn eds_name_of<'o>(&'o self, entry: &'o Entry) -> Cow<'o, str> {
        if self.is_structured() {
            name_in_ascii(&entry.name, || format!("entry {}", entry.sub))
        } else {
            self.eds_name()
        }
    }

    /// The entry at a sub-index.
    pub fn entry(&self, sub: SubIndex) -> Option<&Entry> {
        self.entries.binary_search_by_key(&sub, |entry| entry.sub).ok().map(|at| &self.entries[at])
    }

    /// The entries after sub-index 0; without FFh, which does not count.
    pub fn counted(&self) -> impl DoubleEndedIterator<Item = &Entry> + Clone {
        self.entries.iter().filter(|entry| entry.sub.0 > 0 && entry.sub != SubIndex::STRUCTURE)
    }

    /// The highest sub-index that counts; 0 for a VAR.
    pub fn highest(&self) -> SubIndex {
        self.counted().next_back().map_or(SubIndex(0), |entry| entry.sub)
    }

    /// The objects that belong together with it.
    pub fn linked(&self) -> impl ExactSizeIterator<Item = Index> + Clone {
        self.links.iter().map(|link| link.value)
    }

    /// Whether the object has sub-indices.
    pub const fn is_structured(&self) -> bool {
        matches!(self.kind, ObjectKind::Array | ObjectKind::Record)
    }

    /// An entry that is stored by something else than the group that is named for the values of the object.
    pub fn stored_beside_group(&self) -> Option<&Entry> {
        let group = self.editor.as_ref()?.storage_group.as_deref()?;
        let storage = Storage::of_group(group);
        self.entries.iter().find(|entry| entry.stored != Storage::No && entry.stored != storage)
    }

    /// Whether a "store parameters" command or the device itself keeps any entry.
    pub fn is_stored(&self) -> bool {
        self.entries.iter().any(|entry| entry.stored != Storage::No)
    }
}

/// One addressable value.
#[derive(Debug, Clone)]
#[non_exhaustive]
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
    /// Smallest allowed value (raw), apart from the special values.
    pub low: Option<i128>,
    /// Largest allowed value (raw), apart from the special values.
    pub high: Option<i128>,
    /// Smallest and largest allowed value of a REAL.
    pub real_limits: RealLimits,
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
    /// Most bytes of a string that the device can hold, where that is stated or follows from a constant.
    pub capacity: Option<u16>,
    /// Name in generated code and in references, where the specification gives one.
    pub identifier: Option<String>,
    /// Error codes of the named type's bits, where the type is shared; by ascending bit.
    pub bit_errors: Vec<BitErrors>,
    /// What the EDS shows of it.
    pub eds: EdsPolicy,
    /// Where each fact is written, and who states it.
    pub facts: Facts,
    /// Danger for people, machine or data that comes from it.
    pub warning: Text,
    /// Meaning.
    pub about: Text,
    /// Words by which readers look for it.
    pub search: Phrases,
    /// Where it is written.
    pub span: Span,
}

impl Entry {
    /// Whether references may call it so: by its name or its identifier.
    pub(crate) fn is_called(&self, text: &str) -> bool {
        self.name == text || self.identifier.as_deref() == Some(text)
    }

    /// What distinguishes the entry from all others of its object: the identifier, or else the name.
    pub fn label(&self) -> &str {
        self.identifier.as_ref().unwrap_or(&self.name)
    }

    /// An entry about which nothing more is said: without value, limits, mapping and storage, and in an EDS as it is.
    pub(crate) fn new(sub: SubIndex, name: String, data_type: DataType, access: Access, span: Span) -> Self {
        Self {
            sub,
            name,
            data_type,
            named_type: None,
            access,
            locked: false,
            pdo: PdoMapping::None,
            default: None,
            low: None,
            high: None,
            real_limits: RealLimits::default(),
            unit: None,
            special: Vec::new(),
            stored: Storage::No,
            alias: None,
            category: None,
            since: None,
            writable_when: None,
            capacity: None,
            identifier: None,
            bit_errors: Vec::new(),
            eds: EdsPolicy { access, default: true, no_write: false, no_scan: false },
            facts: Facts::none(),
            warning: Text::default(),
            about: Text::default(),
            search: Phrases::default(),
            span,
        }
    }

    /// Smallest and largest value that an EDS or a server can state as plain limits: the declared
    /// limits, widened to take in the special values. `None` where nothing limits that side.
    pub fn hull(&self) -> (Option<i128>, Option<i128>) {
        let special = self.special.iter().map(|special| special.value);
        let low = self.low.map(|low| special.clone().fold(low, i128::min));
        let high = self.high.map(|high| special.fold(high, i128::max));
        (low, high)
    }

    /// The declared limits, apart from the special values. `None` where nothing limits that side.
    pub fn limits(&self) -> (Option<Value>, Option<Value>) {
        let of = |raw: Option<i128>, real: &Option<Real>| {
            raw.map(Value::Integer).or_else(|| real.clone().map(Value::Real))
        };
        (of(self.low, &self.real_limits.low), of(self.high, &self.real_limits.high))
    }

    /// Whether anything limits its values beyond their type.
    pub const fn is_limited(&self) -> bool {
        self.low.is_some()
            || self.high.is_some()
            || self.real_limits.low.is_some()
            || self.real_limits.high.is_some()
    }

    /// Lowest bits of the fields that are set together with an error code.
    pub fn bits_of_error(&self, code: u16) -> Vec<u8> {
        let Some(TypeKind::Bits(fields)) = self.named_type.as_ref().map(|named| &named.kind) else {
            return Vec::new();
        };
        let added = |field: &BitField| {
            let mut errors = self.bit_errors.iter();
            errors.any(|errors| {
                (field.first..=field.last).contains(&errors.bit)
                    && errors.codes.iter().any(|added| added.value == code)
            })
        };
        let reports = |field: &&BitField| field.error_codes().any(|listed| listed == code) || added(field);
        fields.iter().filter(reports).map(|field| field.first).collect()
    }

    /// Where a fact is written; where it is not stated, the entry's own place.
    pub fn place(&self, fact: Fact) -> Span {
        self.facts.get(fact).map_or(self.span, |statement| statement.span)
    }

    /// Whether only a library of a standard says the fact, and the maker says nothing about it.
    pub fn is_only_standard(&self, fact: Fact) -> bool {
        self.facts.is_said_by(fact, Author::Library)
    }

    /// Whether the value is a setting that a configuration lays over the maker's default.
    pub fn is_set(&self) -> bool {
        self.facts.is_said_by(Fact::Default, Author::Setting)
    }

    /// Gives the entry another default, with the place where that is said.
    pub(crate) fn set_default(&mut self, value: Option<Value>, statement: Statement) {
        self.default = value;
        self.facts.state(Fact::Default, statement);
    }

    /// What an EDS shows of it while the device is unlocked for service: the lock keeps no tool from writing it.
    pub const fn eds_while_unlocked(&self) -> EdsPolicy {
        EdsPolicy { access: self.access.joined(self.pdo), no_write: false, ..self.eds }
    }

    /// Whether a raw value is allowed: inside the limits, or special.
    pub fn allows(&self, value: i128) -> bool {
        self.special.iter().any(|special| special.value == value)
            || (self.low.is_none_or(|low| value >= low) && self.high.is_none_or(|high| value <= high))
    }
}

/// Smallest and largest allowed value of a REAL. `None` where nothing limits that side.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct RealLimits {
    /// Smallest.
    pub low: Option<Real>,
    /// Largest.
    pub high: Option<Real>,
}

impl RealLimits {
    /// Whether a number lies within them, all as the type keeps them.
    pub fn allow(&self, number: &Real, data_type: DataType) -> bool {
        let is_below = self.low.as_ref().is_some_and(|low| number.compare(low, data_type).is_lt());
        !is_below && !self.high.as_ref().is_some_and(|high| number.compare(high, data_type).is_gt())
    }

    /// Whether nothing lies within them.
    pub fn are_swapped(&self, data_type: DataType) -> bool {
        self.low
            .as_ref()
            .zip(self.high.as_ref())
            .is_some_and(|(low, high)| low.compare(high, data_type).is_gt())
    }
}

/// A raw value with a meaning of its own.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct SpecialValue {
    /// Raw value.
    pub value: i128,
    /// What it means, in a few words.
    pub name: String,
    /// More about it.
    pub about: Text,
    /// Where its name is written, which is not part of what it is.
    pub place: Spanned<()>,
}

/// A view of another entry in a narrower type or another unit; it has no storage of its own.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
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
#[non_exhaustive]
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
