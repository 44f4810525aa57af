//! What tables say, each fact with its cell.

use std::collections::BTreeMap;
use std::ops::RangeInclusive;

use od_spec::model::{Access, DataType, Fact, ObjectKind};
use od_spec::source::{Span, Spanned};

use crate::spelling::Language;

/// Everything that the tables of a file say.
#[derive(Debug, Default)]
pub(crate) struct Facts {
    pub objects: BTreeMap<u16, ObjectFacts>,
    pub lists: Vec<ListFacts>,
    pub units: Vec<UnitFacts>,
    pub errors: BTreeMap<u16, ErrorFacts>,
    /// Facts about the device, by their keys.
    pub device: BTreeMap<String, Spanned<String>>,
    /// How many title rows are in each language.
    pub languages: BTreeMap<Language, usize>,
    /// What is about no object.
    pub comments: Vec<String>,
    /// What tables of PDOs say, which the objects say, too.
    pub pdos: Vec<Spanned<Vec<String>>>,
}

impl Facts {
    /// The language of most titles.
    pub(crate) fn language(&self) -> Language {
        let count = |language: Language| self.languages.get(&language).copied().unwrap_or(0);
        if count(Language::German) > count(Language::English) { Language::German } else { Language::English }
    }
}

/// Texts by language code; without a code, they are in the language of the table.
pub(crate) type Texts = BTreeMap<Option<String>, Spanned<String>>;

/// What a table says about an object.
#[derive(Debug)]
pub(crate) struct ObjectFacts {
    pub kind: Option<Spanned<ObjectKind>>,
    /// About the object as a whole; of a VAR, about its entry.
    pub own: EntryFacts,
    pub subs: BTreeMap<u8, EntryFacts>,
    /// Where it is named first.
    pub span: Span,
}

impl ObjectFacts {
    pub(crate) const fn new(span: Span) -> Self {
        Self { kind: None, own: EntryFacts::new(span), subs: BTreeMap::new(), span }
    }

    /// What is said about a sub-index, or about the object.
    pub(crate) fn entry(&mut self, sub: Option<u8>, span: Span) -> &mut EntryFacts {
        match sub {
            None => &mut self.own,
            Some(sub) => self.subs.entry(sub).or_insert_with(|| EntryFacts::new(span)),
        }
    }
}

/// An access type, with the lock of `rw locked`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Accessed {
    pub access: Access,
    pub locked: bool,
}

/// What a table says about an entry.
#[derive(Debug, Clone)]
pub(crate) struct EntryFacts {
    pub data_type: Option<Spanned<DataType>>,
    /// The name of its list of values or bits.
    pub list: Option<Spanned<String>>,
    pub access: Option<Spanned<Accessed>>,
    /// The other facts as their cells have them, and after [`settle`](crate::settle) as a specification writes them.
    pub stated: BTreeMap<Fact, Spanned<String>>,
    /// What one step of the unit is worth, where a column says it.
    pub scale: Option<Spanned<String>>,
    pub about: Texts,
    pub warning: Texts,
    pub comments: Vec<String>,
    /// Where it is named first.
    pub span: Span,
}

impl EntryFacts {
    pub(crate) const fn new(span: Span) -> Self {
        Self {
            data_type: None,
            list: None,
            access: None,
            stated: BTreeMap::new(),
            scale: None,
            about: Texts::new(),
            warning: Texts::new(),
            comments: Vec::new(),
            span,
        }
    }

    /// A stated fact.
    pub(crate) fn get(&self, fact: Fact) -> Option<&Spanned<String>> {
        self.stated.get(&fact)
    }
}

/// The type that a list of values or bits belongs to.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum ListOf {
    /// The type of this name.
    Named(String),
    /// That of the entry above the list.
    Entry(u16, Option<u8>),
}

/// A list of values or bits.
#[derive(Debug)]
pub(crate) struct ListFacts {
    pub of: ListOf,
    pub base: Option<Spanned<DataType>>,
    pub about: Texts,
    pub rows: Vec<ListRow>,
    pub span: Span,
}

impl ListFacts {
    /// Whether it has bits, not values.
    pub(crate) fn is_bits(&self) -> bool {
        self.rows.iter().any(|row| !matches!(row.at, ListAt::Value(_)))
    }
}

/// A value or a field of bits.
#[derive(Debug)]
pub(crate) struct ListRow {
    pub at: ListAt,
    pub name: Option<Spanned<String>>,
    /// Whether the device takes or sends the value.
    pub supported: bool,
    /// The error codes that a bit shows.
    pub errors: Option<Spanned<String>>,
    pub about: Texts,
    pub span: Span,
}

/// What a row of a list is about.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum ListAt {
    /// A value of an enum.
    Value(i128),
    /// A field of bits.
    Bits(RangeInclusive<u8>),
    /// A value of a field of bits.
    ValueOfBits(RangeInclusive<u8>, i128),
}

/// A unit of a table of units.
#[derive(Debug)]
pub(crate) struct UnitFacts {
    pub name: Spanned<String>,
    /// Keys of the language with their values.
    pub keys: BTreeMap<&'static str, Spanned<String>>,
    pub about: Texts,
}

/// An error code.
#[derive(Debug)]
pub(crate) struct ErrorFacts {
    /// Keys of the language with their values.
    pub keys: BTreeMap<&'static str, Spanned<String>>,
    pub texts: BTreeMap<&'static str, Texts>,
    pub span: Span,
}
