//! The top level of a file.

use std::collections::BTreeMap;

use super::constraints;
use super::devices::device;
use super::lexical;
use super::machines::machine;
use super::manual::{erratum, issue, section, source};
use super::objects::objects;
use super::pdos::pdos;
use super::read::{Field, Reader, owned, reader};
use super::types::{named_type, unit};
use crate::ast::{
    AllowDecl, AllowedObject, Axes, CodeRange, ConstraintDecl, ErrorDecl, FeatureDecl, FrontEnd, IndexRange,
    Name, Spec, VendorDecl,
};
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::keys::{self, constraint_keys, error_keys, vendor_keys};
use crate::model::{Direction, Index, Series};
use crate::scalar;
use crate::source::{Span, Spanned};
use crate::yaml::{Node, NodeKind};

vendor_keys! { reader fn vendor() -> VendorDecl }
constraint_keys! { reader fn constraint(name: Name, series: Option<Series>) -> ConstraintDecl }
error_keys! { reader fn written_error(codes: Spanned<CodeRange>, unsure: bool) -> ErrorDecl }

pub(super) fn read(root: &Node, shown: &[String], diagnostics: &mut Diagnostics) -> Spec {
    let languages = Reader { node: root, language: "en", shown }.texts("languages");
    let language = languages.first().map_or("en", |name| name.value.as_str()).to_owned();
    let top = Reader { node: root, language: &language, shown };
    Spec {
        file: root.span.file,
        span: root.span,
        unsure: top.has_unknown_key(&keys::SPEC)
            || root
                .get("devices")
                .is_some_and(|node| !matches!(node.kind, NodeKind::Map(_) | NodeKind::Null)),
        profile: top.text("profile"),
        title: top.text("title"),
        source: top.child("source").map(|r| source(r, diagnostics)),
        revision: top.child("revision").map(|r| issue(r, diagnostics)),
        history: top.items("history").map(|r| issue(r, diagnostics)).collect(),
        vendor: top.child("vendor").map(|r| vendor(r, diagnostics)),
        uses: top.texts("uses"),
        allow: allows(top),
        glossary: top
            .entries("glossary")
            .filter_map(|(name, r)| Some((owned(name), r.translated()?)))
            .collect(),
        devices: top.entries("devices").map(|(key, r)| device(owned(key), r, diagnostics)).collect(),
        units: top.entries("units").map(|(name, r)| unit(name, r, diagnostics)).collect(),
        types: top.entries("types").map(|(name, r)| named_type(name, r, diagnostics)).collect(),
        axes: top.keyed("axes").and_then(|(key, r)| axes(key, r, diagnostics)),
        features: top.entries("features").map(|(name, r)| feature(name, r)).collect(),
        objects: objects(top.entries("objects"), top.text("profile").is_some(), diagnostics),
        pdos: top.entries("pdos").map(|(key, r)| (owned(key), pdos(r, diagnostics))).collect(),
        errors: top.entries("errors").filter_map(|(codes, r)| error(codes, r, diagnostics)).collect(),
        machines: top.entries("state-machines").map(|(name, r)| machine(name, r, diagnostics)).collect(),
        constraints: constraints(top, diagnostics),
        errata: top.items("errata").map(|r| erratum(r, diagnostics)).collect(),
        sections: top.items("document").map(|item| section(item, diagnostics)).collect(),
        mentions: Vec::new(),
        untranslated: Vec::new(),
        front_end: FrontEnd::Specification,
        languages,
    }
}

fn allows(top: Reader<'_>) -> Vec<AllowDecl> {
    let mut written = top.entries("allow").peekable();
    if written.peek().is_none() {
        return Vec::new();
    }
    let places = places(top);
    written.filter_map(|(code, r)| allowed(owned(code), r, &places)).collect()
}

fn allowed(code: Name, r: Reader<'_>, places: &Places) -> Option<AllowDecl> {
    let is_map = matches!(r.node.kind, NodeKind::Map(_));
    let reason = if is_map { r.child("about")?.translated()? } else { r.translated()? };
    let object = |index: Spanned<Index>| AllowedObject {
        places: places.get(&index.value).cloned().unwrap_or_default(),
        index,
    };
    let at = r.child("at").map(|_| r.indices("at").into_iter().map(object).collect());
    Some(AllowDecl { code, reason, at })
}

/// What a file says of objects, each with its key.
type Places = BTreeMap<Index, Vec<Span>>;

fn places(top: Reader<'_>) -> Places {
    let mut places = Places::new();
    let has_any =
        |places: &Places, range: IndexRange| places.range(range.first..=range.last).next().is_some();
    for (key, r) in top.entries("objects") {
        // Of two objects with one index, the second is refused.
        let range = lexical::indices(key.value);
        if let Some(IndexRange { first, last }) = range.filter(|range| !has_any(&places, *range)) {
            let place = key.span.to(r.node.span);
            places.extend((first.0..=last.0).map(|index| (Index(index), vec![place])));
        }
    }
    for (_, r) in top.entries("pdos") {
        for direction in [Direction::Receive, Direction::Transmit] {
            for (key, r) in r.entries(direction.word()) {
                let number = scalar::integer(key.value).ok().and_then(|number| u16::try_from(number).ok());
                let offset = number.and_then(|number| number.checked_sub(1));
                let first = direction.first_communication_index();
                let communication = offset.and_then(|offset| first.checked_add(offset));
                let mapping = communication.and_then(|index| index.checked_add(0x200));
                for index in communication.into_iter().chain(mapping) {
                    places.entry(Index(index)).or_default().push(key.span.to(r.node.span));
                }
            }
        }
    }
    places
}

fn axes(key: Span, r: Reader<'_>, diagnostics: &mut Diagnostics) -> Option<Axes> {
    let (first, last) = (r.value("first", lexical::index)?, r.value("last", lexical::index)?);
    let count = r.integer("count")?;
    let mut refuse = |span, problem: String, help: &str| {
        diagnostics.push(Diagnostic::new(codes::NUMBER_OUT_OF_RANGE, span, problem).help(help.to_owned()));
        None
    };
    if last.value < first.value {
        let problem = format!("axis 1 ends at {} and begins at {}", last.value, first.value);
        return refuse(last.span, problem, "write the smaller index at `first:`");
    }
    let size = i128::from(last.value.0 - first.value.0) + 1;
    let room = (0x1_0000 - i128::from(first.value.0)) / size;
    // What no number of axes can be is refused with the other numbers.
    let number = u16::try_from(count.value).ok().filter(|number| (2..=16).contains(number))?;
    if i128::from(number) > room {
        let problem = format!("found {number} axes; there is room for {room}");
        return refuse(count.span, problem, "an axis takes as many indices as the one before, up to FFFFh");
    }
    Some(Axes { span: key, first: first.value, last: last.value, count: number })
}

fn constraints(top: Reader<'_>, diagnostics: &mut Diagnostics) -> Vec<ConstraintDecl> {
    let written = top.entries("constraints").flat_map(|(name, r)| {
        let decl = constraint(owned(name), None, r, diagnostics);
        // Numbers that cannot be read were reported.
        let is_broken = r.child("n").is_some() && decl.numbers.is_empty();
        if is_broken { Vec::new() } else { constraints::numbered(decl, diagnostics) }
    });
    let written: Vec<ConstraintDecl> = written.collect();
    constraints::of_distinct_names(written, diagnostics)
}

fn feature(name: Spanned<&str>, r: Reader<'_>) -> FeatureDecl {
    FeatureDecl {
        name: owned(name),
        implied: r.yes_no("implied").is_some_and(|implied| implied.value),
        objects: r.indices("objects"),
        needs: r.texts("needs"),
        channels: r.integer("channels"),
        channels_of: r.text("channels-of"),
    }
}

fn error(codes: Spanned<&str>, reader: Reader<'_>, diagnostics: &mut Diagnostics) -> Option<ErrorDecl> {
    let range = Spanned::new(lexical::error_codes(codes.value)?, codes.span);
    let no_name = reader.child("name").is_some() && reader.text("name").is_none();
    Some(written_error(range, reader.has_unknown_key(&keys::ERROR) || no_name, reader, diagnostics))
}
