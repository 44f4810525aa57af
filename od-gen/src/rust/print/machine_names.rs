//! What the states, commands and transitions of a machine have in common in code: names, and the words of the dictionary.

use quote::format_ident;

use crate::plan::{PlannedEntry, ValueKind};

/// The name of a machine as the beginning of another: what sets it apart from a keyword is not needed there.
pub(super) fn stem(name: &str) -> &str {
    name.trim_end_matches('_')
}

/// The variant of a transition: its number after a letter.
pub(super) fn transition_variant(number: u8) -> proc_macro2::Ident {
    format_ident!("T{number}")
}

/// Whether a word is a plain signed number, whose bits have to be taken as unsigned ones.
pub(super) fn is_signed(kind: &ValueKind) -> bool {
    kind.named.is_none() && kind.data_type.is_signed()
}

/// What a word is in code: a bit field or a plain number; a unit or special values say nothing about its bits.
pub(super) fn word_kind(entry: &PlannedEntry<'_>) -> ValueKind {
    ValueKind { unit: None, special: None, ..entry.kind.clone() }
}
