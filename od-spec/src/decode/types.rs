//! Units, enums and bit fields.

use super::lexical;
use super::numbered::by_integer;
use super::read::{Field, Reader, owned, reader};
use crate::ast::{BitDecl, ModeBitDecl, Name, TypeDecl, UnitDecl, ValueDecl};
use crate::diag::Diagnostics;
use crate::keys::{self, unit_keys};
use crate::model::{BitUsage, Edge};
use crate::source::Spanned;
use crate::yaml::NodeKind;

unit_keys! { reader fn written(name: Name) -> UnitDecl }

pub(super) fn unit(name: Spanned<&str>, reader: Reader<'_>, diagnostics: &mut Diagnostics) -> UnitDecl {
    let unit = written(owned(name), reader, diagnostics);
    // A unit whose scale cannot be read is not a unit of scale 1, and one whose offset cannot be read does not count
    // from 0.
    let unreadable = |key: &str, readable: bool| reader.node.get(key).is_some() && !readable;
    let broken = unreadable("scale", unit.scale.is_some())
        || unreadable("offset", unit.offset.is_some())
        || unreadable("base", unit.base.is_some());
    UnitDecl { symbol: unit.symbol.filter(|_| !broken), ..unit }
}

fn usage(word: &str) -> Option<BitUsage> {
    match word {
        "reserved" => Some(BitUsage::Reserved),
        "unused" => Some(BitUsage::Unused),
        _ => None,
    }
}

pub(super) fn named_type(name: Spanned<&str>, r: Reader<'_>, diagnostics: &mut Diagnostics) -> TypeDecl {
    let has = |key: &str| r.node.get(key).is_some();
    let broken_bits = r.entries("bits").any(|(key, _)| lexical::bits(key.value).is_none());
    TypeDecl {
        unsure: broken_bits || r.has_unknown_key(&keys::TYPE),
        name: owned(name),
        base: r.text("base"),
        about: r.words("about"),
        gap: r.words("gap"),
        values: has("values").then(|| values(r, diagnostics)),
        bits: has("bits")
            .then(|| r.entries("bits").filter_map(|(key, r)| bit(key, r, diagnostics)).collect()),
        rest: r.value("rest", usage),
    }
}

fn values(r: Reader<'_>, diagnostics: &mut Diagnostics) -> Vec<ValueDecl> {
    by_integer(r.entries("values"), "value", diagnostics)
        .into_iter()
        .map(|(value, r)| ValueDecl {
            value,
            name: r.short("name"),
            supported: r.yes_no("supported"),
            about: r.words("about"),
            gap: r.words("gap"),
            search: Field::read(r, "search", diagnostics),
        })
        .collect()
}

fn bit(key: Spanned<&str>, r: Reader<'_>, diagnostics: &mut Diagnostics) -> Option<BitDecl> {
    let bits = Spanned::new(lexical::bits(key.value)?, key.span);
    let name = r.short("name");
    // A name that was refused is not missing as well.
    let refused = name.is_none() && (r.child("name").is_some() || !matches!(r.node.kind, NodeKind::Map(_)));
    let name = name.or_else(|| refused.then(|| Spanned::new(format!("bit {}", key.value), key.span)));
    let flag = |key: &str| r.yes_no(key).is_some_and(|flag| flag.value);
    let usage = match r.scalar(usage) {
        Some(usage) => usage.value,
        None if flag("reserved") => BitUsage::Reserved,
        None if flag("unused") => BitUsage::Unused,
        None => BitUsage::Used,
    };
    Some(BitDecl {
        bits,
        usage,
        name: if r.node.text().is_some() && usage != BitUsage::Used { None } else { name },
        about: r.words("about"),
        gap: r.words("gap"),
        search: Field::read(r, "search", diagnostics),
        errors: r.items("error").filter_map(|item| item.scalar(lexical::error_code)).collect(),
        mnemonic: r.text("mnemonic"),
        clamp: r.text("clamp"),
        active: r.integer("active"),
        edge: r.value("edge", edge).map(|edge| edge.value),
        priority: r.text("priority"),
        values: values(r, diagnostics),
        modes: r
            .entries("modes")
            .map(|(mode, r)| ModeBitDecl {
                mode: owned(mode),
                name: r.short("name"),
                about: r.words("about"),
                gap: r.words("gap"),
            })
            .collect(),
    })
}

fn edge(word: &str) -> Option<Edge> {
    match word {
        "rising" => Some(Edge::Rising),
        "falling" => Some(Edge::Falling),
        "both" => Some(Edge::Both),
        _ => None,
    }
}
