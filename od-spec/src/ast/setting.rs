//! Settings as they are written: in a text, or as the entries of a YAML map.

use super::{DefaultDecl, Name};
use crate::keys::CONSUMER;
use crate::source::{Span, Spanned};

/// A setting as it is written: which entry, and its value.
#[derive(Debug, Clone)]
pub struct SettingDecl {
    /// The entry.
    pub(crate) reference: Reference,
    /// The value.
    pub(crate) value: Spanned<DefaultDecl>,
    /// Where the setting is written.
    pub(crate) span: Span,
}

/// How a setting names its entry.
#[derive(Debug, Clone)]
pub(crate) enum Reference {
    /// In one text: `607D.2`, `position limits.upper`.
    Whole(Name),
    /// An object, and one of its entries below it.
    Member {
        /// The object, by index or name.
        object: Name,
        /// The entry, by sub-index or name.
        entry: Name,
    },
}

impl SettingDecl {
    /// A key of a YAML map with its value. What is below the name of an object are values of its entries.
    pub(crate) fn of_key(key: &Name, value: &Spanned<DefaultDecl>) -> Vec<Self> {
        let one = |reference, key: &Name, value: &Spanned<DefaultDecl>| Self {
            reference,
            value: value.clone(),
            span: key.span.to(value.span),
        };
        // `1016.1: {node: 7, time: 1 s}` is the value of one entry.
        let is_value = |members: &[(Name, Spanned<DefaultDecl>)]| {
            key.value.contains('.') && members.iter().all(|(name, _)| CONSUMER.get(&name.value).is_some())
        };
        match &value.value {
            DefaultDecl::ByDevice(members) if !is_value(members) => members
                .iter()
                .map(|(entry, value)| {
                    let reference = Reference::Member { object: key.clone(), entry: entry.clone() };
                    one(reference, entry, value)
                })
                .collect(),
            DefaultDecl::One(_) | DefaultDecl::Each(_) | DefaultDecl::ByDevice(_) => {
                vec![one(Reference::Whole(key.clone()), key, value)]
            }
        }
    }
}
