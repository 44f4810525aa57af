//! What is written about an entry.

use super::{BitRange, ConditionDecl, Name, Words};
use crate::keys::entry_keys;
use crate::model::{Access, AccessRight, Category, Fact, Facts, PdoMapping, Statement, Storage, Text};
use crate::source::{FileId, Span, Spanned};

/// How far a key of an entry reaches that stands at an object with elements or members.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Reach {
    /// It is about the object itself.
    Object,
    /// Elements and members take it, unless they have their own.
    Entries,
    /// It is about one value, and has no effect there.
    Value,
}

macro_rules! entry_decl {
    ($($group:ident {
        $($key:literal: $shape:expr => $field:ident: $type:ty, $fact:ident, $reach:ident, $about:literal
            $(, $example:literal)? $(, sub0 $sub0:literal)?;)+
    })+) => {
        /// What is written about an entry, at the entry itself or at something it inherits from.
        #[derive(Debug, Clone)]
        pub(crate) struct EntryDecl {
            pub span: Span,
            /// Something here was refused: what seems to be missing may be meant by it.
            pub unsure: bool,
            $($(pub $field: Option<Spanned<$type>>,)+)+
        }

        impl EntryDecl {
            /// Nothing written.
            pub(crate) const fn empty(span: Span) -> Self {
                Self { span, unsure: false, $($($field: None,)+)+ }
            }

            /// What is written here, and where nothing is, what is written below.
            pub(crate) fn over(&self, below: &EntryDecl) -> EntryDecl {
                EntryDecl {
                    span: self.span,
                    unsure: self.unsure || below.unsure,
                    $($($field: self.$field.clone().or_else(|| below.$field.clone()),)+)+
                }
            }

            /// What elements and members take from their object.
            pub(crate) fn inherited(&self) -> EntryDecl {
                EntryDecl {
                    span: self.span,
                    unsure: self.unsure,
                    $($($field: self.$field.clone().filter(|_| Reach::$reach == Reach::Entries),)+)+
                }
            }

            /// The keys written here that are about one value, each with its place.
            pub(crate) fn about_one_value(&self) -> impl Iterator<Item = Spanned<&'static str>> {
                let places = [$($(($key, Reach::$reach, self.$field.as_ref().map(|fact| fact.span)),)+)+];
                let about_value = places.into_iter().filter(|(_, reach, _)| *reach == Reach::Value);
                about_value.filter_map(|(key, _, span)| Some(Spanned::new(key, span?)))
            }

            /// Where each fact is written, and whether by the maker, whose file is `maker`.
            pub(crate) fn facts(&self, maker: FileId) -> Facts {
                let places = [$($((Fact::$fact, self.$field.as_ref().map(|fact| fact.span)),)+)+];
                let stated = places.into_iter().filter_map(|(fact, span)| Some((fact, span?)));
                stated.map(|(fact, span)| (fact, Statement::written(span, maker))).collect()
            }

            /// The facts written here that differ from those below.
            pub(crate) fn differences(&self, below: &EntryDecl) -> Vec<Fact> {
                let mut facts = Vec::new();
                $($(if self.$field.is_some() && self.$field != below.$field {
                    facts.push(Fact::$fact);
                })+)+
                facts
            }
        }
    };
}
entry_keys!(entry_decl);

/// A default.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum DefaultDecl {
    /// A number, a name or a text.
    Value(String),
    /// The fields of a bit field that are not 0.
    Bits(Vec<SetBits>),
}

impl DefaultDecl {
    /// The text of what is no list.
    pub(crate) fn text(&self) -> Option<&str> {
        match self {
            Self::Value(text) => Some(text),
            Self::Bits(_) => None,
        }
    }
}

/// A field of a bit field with a value.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SetBits {
    pub name: Name,
    /// Its value; 1 where none is written.
    pub value: Option<Name>,
}

/// A raw value with a meaning of its own.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SpecialDecl {
    pub value: Spanned<i128>,
    pub name: Option<Name>,
    pub about: Words,
}

/// Error codes of a bit of the entry's type.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct BitErrorDecl {
    pub bits: Spanned<BitRange>,
    pub codes: Vec<Spanned<i128>>,
}

/// What the EDS shows of an entry.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct EdsDecl {
    pub default: Option<bool>,
    pub access: Option<Access>,
    pub no_write: bool,
    pub no_scan: bool,
}
