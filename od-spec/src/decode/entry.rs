//! Entries.

use super::lexical;
use super::numbered::by_integer;
use super::read::{Field, FromNode, Reader, owned};
use crate::ast::{BitErrorDecl, DefaultDecl, EdsDecl, EntryDecl, SpecialDecl};
use crate::diag::Diagnostics;
use crate::keys::{Keys, entry_keys};
use crate::model::Access;
use crate::source::{Span, Spanned};
use crate::yaml::NodeKind;

macro_rules! entry_reader {
    ($($group:ident {
        $($key:literal $($need:ident)?: $shape:expr => $field:ident: $type:ty, $fact:ident, $reach:ident, $about:literal
            $(, $example:literal)? $(, sub0 $sub0:literal)?;)+
    })+) => {
        /// Reads the keys of an entry as far as they are there. An entry has few of them: it is quicker to ask each
        /// which field it fills than to look for the key of each field.
        fn written(reader: Reader<'_>, span: Span, diagnostics: &mut Diagnostics) -> EntryDecl {
            let mut entry = EntryDecl { span, unsure: false, $($($field: Default::default(),)+)+ };
            for (name, _) in reader.node.entries() {
                match name.value.as_str() {
                    $($($key => entry.$field = Field::read(reader, $key, diagnostics),)+)+
                    _ => {}
                }
            }
            entry
        }
    };
}
entry_keys!(entry_reader);

/// Reads an entry; `keys` are those of the map in which its keys are.
pub(super) fn entry(reader: Reader<'_>, keys: &Keys, span: Span, diagnostics: &mut Diagnostics) -> EntryDecl {
    let mut entry = written(reader, span, diagnostics);
    let no_text = |key: &str| reader.node.get(key).is_some_and(|node| node.text().is_none());
    let no_access = entry.access.is_none() && reader.node.get("access").is_some();
    entry.unsure = reader.has_unknown_key(keys) || no_text("name") || no_text("type") || no_access;
    entry
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

impl FromNode for DefaultDecl {
    fn from_node(reader: Reader<'_>, _: &mut Diagnostics) -> Option<Self> {
        default(reader).map(|default| default.value)
    }
}

/// A value, a list of values, or a map of them.
pub(super) fn default(reader: Reader<'_>) -> Option<Spanned<DefaultDecl>> {
    let value = match &reader.node.kind {
        NodeKind::List(items) => {
            DefaultDecl::Each(items.iter().filter_map(|item| default(reader.at(item))).collect())
        }
        NodeKind::Map(_) => DefaultDecl::ByDevice(
            reader.pairs().filter_map(|(key, reader)| Some((owned(key), default(reader)?))).collect(),
        ),
        NodeKind::Scalar { .. } | NodeKind::Null | NodeKind::Broken => {
            DefaultDecl::One(reader.scalar(|text| Some(text.to_owned()))?.value)
        }
    };
    Some(Spanned::new(value, reader.node.span))
}

impl FromNode for Vec<BitErrorDecl> {
    fn from_node(reader: Reader<'_>, _: &mut Diagnostics) -> Option<Self> {
        let errors = reader.pairs().filter_map(|(key, r)| {
            let bits = Spanned::new(lexical::bits(key.value)?, key.span);
            let codes = match r.node.items() {
                [] => r.scalar(lexical::error_code).into_iter().collect(),
                items => items.iter().filter_map(|node| r.at(node).scalar(lexical::error_code)).collect(),
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::keys::ENTRY;
    use crate::model::{Author, Fact, Facts};
    use crate::source::SourceMap;
    use crate::yaml;

    const EVERY_KEY: &str = "{name: n, identifier: i, type: unsigned8, unit: volt, access: rw, pdo: receive, default: 1, min: 0, \
        max: 9, special: {255: off}, stored: application, category: optional, since: 1.04, writable-when: 0x2000 == 0, \
        bit-errors: {0: 0x1000}, capacity: 4, eds: {flags: [no-write]}, warning: text, about: text, gap: text, search: {en: word}}";

    fn words(facts: &Facts) -> Vec<&'static str> {
        facts.said_by(Author::Maker).map(Fact::word).collect()
    }

    #[test]
    fn every_key_states_its_fact() {
        let mut sources = SourceMap::new();
        let id = sources.add("test", EVERY_KEY);
        let mut diagnostics = Diagnostics::new();
        let root = yaml::parse(id, sources.file(id), &mut diagnostics).unwrap();
        let reader = Reader { node: &root, language: "en", shown: &[] };
        let decl = entry(reader, &ENTRY, root.span, &mut diagnostics);
        assert!(!decl.unsure);

        let mut keys: Vec<&str> = ENTRY.keys.iter().map(|key| key.name).collect();
        let mut stated = words(&decl.facts(id));
        keys.sort_unstable();
        stated.sort_unstable();
        assert_eq!(stated, keys);

        let inherited = words(&decl.inherited().facts(id));
        assert_eq!(inherited, ["type", "unit", "access", "pdo", "stored", "writable-when", "eds"]);
        let about_one_value: Vec<&str> = decl.about_one_value().map(|key| key.value).collect();
        assert_eq!(about_one_value, ["default", "min", "max", "special", "bit-errors", "capacity"]);
    }
}
