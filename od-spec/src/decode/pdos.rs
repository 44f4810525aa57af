//! PDOs.

use std::collections::BTreeMap;

use super::numbered::numbered;
use super::read::{Field, Reader, reader};
use crate::ast::{
    PdoCommunicationDecl, PdoDecl, PdoMappingDecl, PdoParameterDecl, PdoParametersDecl, PdosDecl,
};
use crate::diag::{Diagnostics, codes};
use crate::keys::{pdo_communication_keys, pdo_keys, pdo_mapping_keys, pdo_parameters_keys};
use crate::model::{Access, Direction, Storage};
use crate::name_pattern::NamePattern;
use crate::scalar;
use crate::source::{Span, Spanned};
use crate::yaml::Node;

pdo_keys! { reader fn pdo(direction: Direction, number: Spanned<u16>, span: Span) -> PdoDecl }

pdo_parameters_keys! { reader fn parameters() -> PdoParametersDecl }
pdo_communication_keys! { reader fn communication() -> PdoCommunicationDecl }
pdo_mapping_keys! { reader fn mapping() -> PdoMappingDecl }

macro_rules! maps {
    ($($name:ident = $read:ident,)+) => {
        $(impl Field for Option<$name> {
            fn read(reader: Reader<'_>, key: &str, diagnostics: &mut Diagnostics) -> Self {
                reader.child(key).map(|child| $read(child, diagnostics))
            }
        })+
    };
}

maps! {
    PdoCommunicationDecl = communication,
    PdoMappingDecl = mapping,
    PdoParameterDecl = parameter,
}

impl Field for Option<Box<PdoParametersDecl>> {
    fn read(reader: Reader<'_>, key: &str, diagnostics: &mut Diagnostics) -> Self {
        reader.child(key).map(|child| Box::new(parameters(child, diagnostics)))
    }
}

/// A name, or a map with what is said about a parameter.
fn parameter(reader: Reader<'_>, _: &mut Diagnostics) -> PdoParameterDecl {
    PdoParameterDecl {
        name: reader.scalar(pattern).or_else(|| reader.value("name", pattern)),
        identifier: reader.value("identifier", pattern),
        access: reader.value("access", Access::from_word),
        default: reader.integer("default"),
        min: reader.integer("min"),
        max: reader.integer("max"),
    }
}

fn pattern(text: &str) -> Option<NamePattern> {
    NamePattern::parse(text).ok()
}

impl Field for BTreeMap<u8, Spanned<NamePattern>> {
    fn read(reader: Reader<'_>, key: &str, diagnostics: &mut Diagnostics) -> Self {
        let number = |text: &str| u8::try_from(scalar::integer(text).ok()?).ok();
        let show = |sub: u8| format!("the name of mapped entry {sub}");
        let entries = numbered(reader.entries(key), number, diagnostics, codes::DUPLICATE_VALUE, show);
        entries.into_iter().filter_map(|(sub, r)| Some((sub.value, r.scalar(pattern)?))).collect()
    }
}

/// `pdos:` of a device.
pub(super) fn pdos(r: Reader<'_>, diagnostics: &mut Diagnostics) -> PdosDecl {
    let of_all = r.child("parameters");
    let mut of = |direction: Direction| of_all.and_then(|r| Field::read(r, direction.word(), diagnostics));
    let (receive, transmit) = (of(Direction::Receive), of(Direction::Transmit));
    PdosDecl { stored: r.value("stored", Storage::from_word), receive, transmit, list: list(r, diagnostics) }
}

fn list(r: Reader<'_>, diagnostics: &mut Diagnostics) -> Vec<PdoDecl> {
    let number = |text: &str| {
        let number = u16::try_from(scalar::integer(text).ok()?).ok()?;
        (1..=512).contains(&number).then_some(number)
    };
    let mut list = Vec::new();
    for direction in [Direction::Receive, Direction::Transmit] {
        let show = |number: u16| format!("{} {number}", direction.pdo());
        let entries = numbered(r.entries(direction.word()), number, diagnostics, codes::DUPLICATE_PDO, show);
        for (number, r) in entries {
            let span = r.keyed("map").map_or(number.span, |(key, map)| place_of_list(key, map.node));
            list.push(pdo(direction, number, span, r, diagnostics));
        }
    }
    list
}

/// A list in one line, else its key.
fn place_of_list(key: Span, list: &Node) -> Span {
    let one_line =
        list.span.file == key.file && list.items().last().is_none_or(|last| last.span.end < list.span.end);
    if one_line { list.span } else { key }
}
