//! Enums and bit fields.

use std::ops::Deref;

use super::{DataType, Phrases, Statement, Text};
use crate::order::Arrange as _;
use crate::source::Spanned;

/// An enum or a bit field with a name.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct NamedType {
    /// Name.
    pub name: String,
    /// Data type on the bus.
    pub base: DataType,
    /// Meaning.
    pub about: Text,
    /// Values or bits.
    pub kind: TypeKind,
    /// Where it is defined, and by whom.
    pub stated: Statement,
}

/// What a [`NamedType`] consists of.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum TypeKind {
    /// Named values, ascending.
    Enum(EnumValues),
    /// Fields by ascending bit; they cover every bit of the base type.
    Bits(Vec<BitField>),
}

/// The values of an enum, ascending; each is found without looking at the others.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct EnumValues {
    ascending: Vec<EnumValue>,
    /// Where the names are in it, by name.
    by_name: Vec<usize>,
}

impl EnumValues {
    /// The value with a number.
    pub fn of(&self, raw: i128) -> Option<&EnumValue> {
        let at = self.ascending.binary_search_by_key(&raw, |value| value.value).ok()?;
        self.ascending.get(at)
    }

    /// The value with a name.
    pub fn named(&self, name: &str) -> Option<&EnumValue> {
        let name_at = |at: &usize| self.ascending.get(*at).map_or("", |value| value.name.as_str());
        let at = self.by_name.partition_point(|at| name_at(at) < name);
        self.ascending.get(*self.by_name.get(at)?).filter(|value| value.name == name)
    }
}

impl From<Vec<EnumValue>> for EnumValues {
    fn from(mut ascending: Vec<EnumValue>) -> Self {
        ascending.arrange_by_key(|value| value.value);
        let mut by_name: Vec<usize> = (0..ascending.len()).collect();
        by_name.arrange_by_key(|at| ascending.get(*at).map(|value| value.name.as_str()));
        Self { ascending, by_name }
    }
}

impl Deref for EnumValues {
    type Target = [EnumValue];

    fn deref(&self) -> &[EnumValue] {
        &self.ascending
    }
}

impl<'a> IntoIterator for &'a EnumValues {
    type Item = &'a EnumValue;
    type IntoIter = std::slice::Iter<'a, EnumValue>;

    fn into_iter(self) -> Self::IntoIter {
        self.ascending.iter()
    }
}

/// One value of an enum.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct EnumValue {
    /// Raw value.
    pub value: i128,
    /// Name.
    pub name: String,
    /// Whether this device accepts or sends it; `false` for values that only a standard defines.
    pub supported: bool,
    /// Meaning.
    pub about: Text,
    /// Words by which readers look for it.
    pub search: Phrases,
    /// Where its name is written, which is not part of what it is.
    pub place: Spanned<()>,
}

/// One bit, or a run of bits that belong together.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
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
    /// Words by which readers look for it.
    pub search: Phrases,
    /// Error codes that the device reports with this bit.
    pub errors: Vec<Spanned<u16>>,
    /// Short name, as register pictures and tables of commands have it.
    pub mnemonic: Option<String>,
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
    /// Meanings that apply only in one mode of operation.
    pub modes: Vec<ModeMeaning>,
    /// Where its name is written, which is not part of what it is.
    pub place: Spanned<()>,
}

/// What bits mean in one mode of operation.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct ModeMeaning {
    /// The mode, and where it is named.
    pub mode: Spanned<String>,
    /// Name of the bits in this mode.
    pub name: String,
    /// Meaning.
    pub about: Text,
}

impl NamedType {
    /// Whether it gives no value or bit a meaning that a standard's type does not know, whatever words it has for them. It may have
    /// fewer; negative values are the maker's.
    pub(crate) fn agrees_with(&self, standard: &Self) -> bool {
        match (&self.kind, &standard.kind) {
            (TypeKind::Enum(own), TypeKind::Enum(known)) => own
                .iter()
                .filter(|value| value.supported && value.value >= 0)
                .all(|value| known.iter().any(|one| one.value == value.value)),
            (TypeKind::Bits(own), TypeKind::Bits(known)) => own
                .iter()
                .filter(|field| field.usage == BitUsage::Used)
                .all(|field| known.iter().any(|one| field.agrees_with(one))),
            (TypeKind::Enum(_), TypeKind::Bits(_)) | (TypeKind::Bits(_), TypeKind::Enum(_)) => false,
        }
    }
}

impl BitField {
    /// Whether a standard has these bits with the same level, alone or in a longer run.
    fn agrees_with(&self, standard: &Self) -> bool {
        standard.usage == BitUsage::Used
            && (standard.first..=standard.last).contains(&self.first)
            && self.last <= standard.last
            && self.active == standard.active
    }

    /// Whether the bits have a stated meaning: under a name of their own, or in some mode.
    pub fn is_told(&self) -> bool {
        self.usage == BitUsage::Used && (!self.name.is_empty() || !self.modes.is_empty())
    }

    /// The error codes that the device reports with this bit.
    pub fn error_codes(&self) -> impl Iterator<Item = u16> {
        self.errors.iter().map(|code| code.value)
    }
}

/// Error codes that one entry adds to a bit of its shared type.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct BitErrors {
    /// Lowest bit of the field.
    pub bit: u8,
    /// The codes.
    pub codes: Vec<Spanned<u16>>,
}

impl BitErrors {
    /// The codes without their places.
    pub fn error_codes(&self) -> impl Iterator<Item = u16> {
        self.codes.iter().map(|code| code.value)
    }
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
