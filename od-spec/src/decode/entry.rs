//! Entries.

use super::lexical;
use super::numbered::by_integer;
use super::read::{Field, FromNode, Reader};
use crate::ast::{BitErrorDecl, EdsDecl, EntryDecl, SpecialDecl};
use crate::diag::Diagnostics;
use crate::keys::{Keys, entry_keys};
use crate::model::Access;
use crate::scalar;
use crate::source::{Span, Spanned};

macro_rules! entry_reader {
    ($($group:ident {
        $($key:literal: $shape:expr => $field:ident: $type:ty, $fact:ident, $reach:ident, $about:literal
            $(, $example:literal)? $(, sub0 $sub0:literal)?;)+
    })+) => {
        /// Reads the keys of an entry as far as they stand there.
        fn written(reader: Reader<'_>, span: Span, diagnostics: &mut Diagnostics) -> EntryDecl {
            EntryDecl {
                span,
                unsure: false,
                $($($field: Field::read(reader, $key, diagnostics),)+)+
            }
        }
    };
}
entry_keys!(entry_reader);

/// Reads an entry; `keys` are those of the map in which its keys stand.
pub(super) fn entry(reader: Reader<'_>, keys: &Keys, span: Span, diagnostics: &mut Diagnostics) -> EntryDecl {
    let written = written(reader, span, diagnostics);
    let no_text = |key: &str| reader.node.get(key).is_some_and(|node| node.text().is_none());
    let no_access = written.access.is_none() && reader.node.get("access").is_some();
    let unsure = reader.has_unknown_key(keys) || no_text("name") || no_text("type") || no_access;
    EntryDecl { unsure, ..written }
}

impl FromNode for Vec<SpecialDecl> {
    fn from_node(reader: Reader<'_>, diagnostics: &mut Diagnostics) -> Option<Self> {
        let values = by_integer(reader.pairs(), "value", diagnostics).into_iter();
        Some(
            values
                .map(|(value, r)| SpecialDecl { value, name: r.short("name"), about: r.words("about") })
                .collect(),
        )
    }
}

impl FromNode for Vec<BitErrorDecl> {
    fn from_node(reader: Reader<'_>, _: &mut Diagnostics) -> Option<Self> {
        let integer = |text: &str| scalar::integer(text).ok();
        let errors = reader.pairs().filter_map(|(key, r)| {
            let bits = Spanned::new(lexical::bits(key.value)?, key.span);
            let codes = match r.node.items() {
                [] => r.scalar(integer).into_iter().collect(),
                items => items.iter().filter_map(|node| r.at(node).scalar(integer)).collect(),
            };
            Some(BitErrorDecl { bits, codes })
        });
        Some(errors.collect())
    }
}

impl FromNode for EdsDecl {
    fn from_node(reader: Reader<'_>, _: &mut Diagnostics) -> Option<Self> {
        let flags = reader.texts("flags");
        let flag = |word: &str| flags.iter().any(|flag| flag.value == word);
        Some(EdsDecl {
            default: reader.text("default").map(|word| word.value == "written"),
            access: reader.value("access", Access::from_word).map(|access| access.value),
            no_write: flag("no-write"),
            no_scan: flag("no-scan"),
        })
    }
}
