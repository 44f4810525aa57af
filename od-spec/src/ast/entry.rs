//! What is written about an entry.

use super::{BitRange, ConditionDecl, Name, Words};
use crate::keys::entry_keys;
use crate::model::{
    Access, AccessRight, Category, Fact, Facts, PdoMapping, Phrases, Statement, Storage, Text,
};
use crate::source::{FileId, Span, Spanned};

/// How far a key of an entry reaches that is written at an object with elements or members.
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
        $($key:literal $($need:ident)?: $shape:expr => $field:ident: $type:ty, $fact:ident, $reach:ident, $about:literal
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

            /// What references may call it: its name and its identifier.
            pub(crate) fn names(&self) -> impl Iterator<Item = &Name> {
                [&self.name, &self.identifier].into_iter().flatten()
            }

            /// What elements and members take from their object.
            pub(crate) fn inherited(&self) -> EntryDecl {
                EntryDecl {
                    span: self.span,
                    unsure: self.unsure,
                    $($($field: self.$field.clone().filter(|_| Reach::$reach == Reach::Entries),)+)+
                }
            }

            /// What is written here and not there.
            pub(crate) fn without(&self, there: &EntryDecl) -> EntryDecl {
                EntryDecl {
                    span: self.span,
                    unsure: self.unsure,
                    $($($field: self.$field.clone().filter(|_| there.$field.is_none()),)+)+
                }
            }

            /// The same, as if the maker, whose file is `maker`, had said at `place` what a library says.
            pub(crate) fn adopted(&self, maker: FileId, place: Span) -> EntryDecl {
                EntryDecl {
                    span: adopted(self.span, maker, place),
                    unsure: self.unsure,
                    $($($field: self.$field.clone().map(|fact| Spanned {
                        span: adopted(fact.span, maker, place),
                        ..fact
                    }),)+)+
                }
            }

            /// The keys written here, each with its place, the fact that it states, and how far it reaches.
            fn keys(&self) -> impl Iterator<Item = (Spanned<&'static str>, Fact, Reach)> {
                let places = [$($(($key, Fact::$fact, Reach::$reach, self.$field.as_ref().map(|fact| fact.span)),)+)+];
                let stated = places.into_iter();
                stated.filter_map(|(key, fact, reach, span)| Some((Spanned::new(key, span?), fact, reach)))
            }

            /// The keys written here that are about one value, each with its place.
            pub(crate) fn about_one_value(&self) -> impl Iterator<Item = Spanned<&'static str>> {
                self.keys().filter(|(.., reach)| *reach == Reach::Value).map(|(key, ..)| key)
            }

            /// The keys written here, each with its place, and the fact that it states.
            pub(crate) fn stated(&self) -> impl Iterator<Item = (Spanned<&'static str>, Fact)> {
                self.keys().map(|(key, fact, _)| (key, fact))
            }

            /// Where each fact is written, and whether by the maker, whose file is `maker`.
            pub(crate) fn facts(&self, maker: FileId) -> Facts {
                self.keys().map(|(key, fact, _)| (fact, Statement::written(key.span, maker))).collect()
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

impl EntryDecl {
    /// Whether its default says something for a device.
    pub(crate) fn is_for(&self, device: Option<&str>) -> bool {
        match self.default.as_ref().map(|default| &default.value) {
            Some(DefaultDecl::ByDevice(values)) => {
                values.iter().any(|(key, _)| Some(key.value.as_str()) == device)
            }
            Some(DefaultDecl::One(_) | DefaultDecl::Each(_)) | None => true,
        }
    }
}

/// A place of the maker's as it is; of any other, the place at which the maker refers to it.
pub(crate) fn adopted(written: Span, maker: FileId, place: Span) -> Span {
    if written.file.is_one_with(maker) { written } else { place }
}

/// A raw value with a meaning of its own.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SpecialDecl {
    pub value: Spanned<i128>,
    pub name: Option<Name>,
    pub about: Words,
}

/// The value of `default:`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum DefaultDecl {
    /// One value.
    One(String),
    /// The values of the elements of an array, in their order.
    Each(Vec<Spanned<DefaultDecl>>),
    /// The values of devices, by their keys.
    ByDevice(Vec<(Name, Spanned<DefaultDecl>)>),
}

impl DefaultDecl {
    /// A default that is one value.
    pub(crate) fn one(text: Name) -> Spanned<Self> {
        text.map(Self::One)
    }

    /// The same, as if the maker, whose file is `maker`, had said at `place` what a library says.
    pub(crate) fn adopted(&self, maker: FileId, place: Span) -> Self {
        let value = |value: &Spanned<Self>| {
            Spanned::new(value.value.adopted(maker, place), adopted(value.span, maker, place))
        };
        match self {
            Self::One(text) => Self::One(text.clone()),
            Self::Each(values) => Self::Each(values.iter().map(value).collect()),
            Self::ByDevice(values) => {
                Self::ByDevice(values.iter().map(|(key, one)| (key.clone(), value(one))).collect())
            }
        }
    }

    /// The text of a default that is one value.
    pub(crate) fn text(&self) -> Option<&str> {
        match self {
            Self::One(text) => Some(text),
            Self::Each(_) | Self::ByDevice(_) => None,
        }
    }
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
