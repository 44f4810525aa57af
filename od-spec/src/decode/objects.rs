//! Objects, their elements and members.

use std::collections::BTreeMap;

use super::entry::entry;
use super::lexical;
use super::numbered::twice;
use super::read::Reader;
use super::shape::start;
use crate::ast::{ArrayDecl, EntryDecl, IndexRange, ObjectDecl, RecordDecl};
use crate::diag::{Diagnostic, Diagnostics, codes, shorten};
use crate::keys;
use crate::limits::{ENTRIES_OF_FILE, Room};
use crate::model::{Index, Outside, Rounding, SubIndex};
use crate::order::Arrange as _;
use crate::source::{Span, Spanned};
use crate::yaml::{Node, NodeKind};

/// Reads the objects; a run of indices makes one object for each of them. Where devices have different objects, they are a list.
pub(super) fn objects<'a>(
    entries: impl Iterator<Item = (Spanned<&'a str>, Reader<'a>)>,
    is_library: bool,
    diagnostics: &mut Diagnostics,
) -> Vec<ObjectDecl> {
    let mut before: BTreeMap<Index, Spanned<&str>> = BTreeMap::new();
    // A declaration is large: the list has room for as many as there are, and no more.
    let entries: Vec<_> = entries.collect();
    let mut list = Vec::with_capacity(entries.len());
    let mut room = Room::new(ENTRIES_OF_FILE);
    for (key, r) in entries {
        // A key that lacks its `0x` was refused; what refers to the object is right all the same.
        let range = lexical::indices(key.value).or_else(|| lexical::indices(&lexical::with_0x(key.value)?));
        let Some(range) = range else { continue };
        if let Some((index, earlier)) = before.range(range.first..=range.last).next() {
            diagnostics.push(twice(codes::DUPLICATE_INDEX, &index.to_string(), key, *earlier));
            continue;
        }
        before.extend((range.first.0..=range.last.0).map(|index| (Index(index), key)));
        let NodeKind::List(items) = &r.node.kind else {
            add(range, key.span, r, &mut room, &mut list, diagnostics);
            continue;
        };
        if is_library {
            let message = format!("several objects at {} of a library", range.first);
            diagnostics.push(
                Diagnostic::new(codes::CONFLICTING_KEYS, key.span, message)
                    .help("describe one; a library knows no devices that could have different ones"),
            );
        }
        let first_of_list = list.len();
        for node in items {
            add(range, start(node), r.at(node), &mut room, &mut list, diagnostics);
        }
        if items.len() > 1 {
            belong_to_different_devices(&mut list, first_of_list, diagnostics);
        }
    }
    list
}

/// Reads what is described at an index or a run of indices; `place` represents it.
fn add(
    range: IndexRange,
    place: Span,
    r: Reader<'_>,
    room: &mut Room,
    list: &mut Vec<ObjectDecl>,
    diagnostics: &mut Diagnostics,
) {
    let IndexRange { first, last } = range;
    let written = r.node.weight();
    let one = object(Spanned::new(first, place), written, r, *room, diagnostics);
    let objects = usize::from(last.0 - first.0) + 1;
    let repeated = if objects > 1 { one.weight } else { one.weight - written };
    if let Err(full) = room.take(one.entries() * objects, repeated.saturating_mul(objects)) {
        diagnostics.push(
            Diagnostic::new(
                codes::TOO_MUCH,
                place,
                format!("{} up to here; a file describes less", full.words(ENTRIES_OF_FILE)),
            )
            .help("correct the run or the `count`, or describe the objects in several files"),
        );
    } else if first == last {
        list.push(one);
    } else {
        list.extend(run(&one, place, first, last, diagnostics));
    }
}

/// Checks the devices of different objects at one index, which are those of the list from `first` on: each device has one of them.
fn belong_to_different_devices(list: &mut [ObjectDecl], first: usize, diagnostics: &mut Diagnostics) {
    let mut owners: BTreeMap<(Index, String), Span> = BTreeMap::new();
    for decl in &mut list[first..] {
        let index = decl.index.value;
        let Some(on) = &mut decl.devices else {
            // A run lacks it once.
            if !decl.entry.unsure && diagnostics.is_new(codes::MISSING_KEY, decl.index.span) {
                let message = format!("one of several objects at {index} needs the key `devices`");
                diagnostics.push(
                    Diagnostic::new(codes::MISSING_KEY, decl.index.span, message)
                        .help("add it, with the devices that have this one"),
                );
            }
            decl.devices = Some(Vec::new());
            continue;
        };
        on.retain(|device| {
            let before = owners.get(&(index, device.value.clone())).copied();
            // A run has it once.
            if let Some(before) = before
                && diagnostics.is_new(codes::DUPLICATE_INDEX, device.span)
            {
                let message = format!("{index} of `{}` is defined twice", shorten(&device.value));
                diagnostics.push(
                    Diagnostic::new(codes::DUPLICATE_INDEX, device.span, message)
                        .label("again here")
                        .with(before, "first here")
                        .help("name each device at one of these objects only"),
                );
            }
            owners.entry((index, device.value.clone())).or_insert(device.span);
            before.is_none()
        });
    }
}

/// The objects of a run of indices, all like the first except for their numbers.
fn run(
    one: &ObjectDecl,
    key: Span,
    first: Index,
    last: Index,
    diagnostics: &mut Diagnostics,
) -> Vec<ObjectDecl> {
    check_numbered(&one.entry, "objects", "it means 1, 2, and so on", diagnostics);
    let copies = (1..).zip(first.0..=last.0).map(|(number, index)| {
        let mut copy = ObjectDecl { index: Spanned::new(Index(index), key), ..one.clone() };
        number_names(&mut copy.entry, number);
        copy
    });
    copies.collect()
}

/// Whether the names or identifiers of a run are different ones.
fn is_numbered(entry: &EntryDecl) -> bool {
    entry.names().any(|name| name.value.contains("{n}"))
}

/// Checks that the names or identifiers of a run are different ones.
fn check_numbered(entry: &EntryDecl, what: &str, number: &str, diagnostics: &mut Diagnostics) {
    if let Some(name) = entry.name.as_ref().filter(|_| !is_numbered(entry)) {
        let message = format!("the {what} of a run would all have this name");
        diagnostics.push(
            Diagnostic::new(codes::BAD_NOTATION, name.span, message)
                .help(format!("write `{{n}}` into the name or into `identifier:`; {number}")),
        );
    }
}

/// Writes the number of an object or entry of a run into its names.
fn number_names(entry: &mut EntryDecl, number: u16) {
    // A name without `{n}` was reported; its copies do not have to be reported, too.
    let is_reported = !is_numbered(entry);
    for text in [&mut entry.name, &mut entry.identifier].into_iter().flatten() {
        text.value = text.value.replace("{n}", &number.to_string());
    }
    if let Some(name) = entry.name.as_mut().filter(|_| is_reported) {
        name.value = format!("{} {number}", name.value);
    }
}

/// Reads an object that takes so many bytes where it is written.
fn object(
    index: Spanned<Index>,
    written: usize,
    r: Reader<'_>,
    room: Room,
    diagnostics: &mut Diagnostics,
) -> ObjectDecl {
    let mut repeated = 0;
    let decl = ObjectDecl {
        index,
        weight: written,
        devices: r.optional_texts("devices"),
        from: r.text("from"),
        like: r.value("like", lexical::index),
        alias: r.text("alias"),
        outside: r.value("outside", Outside::from_word),
        rounding: r.value("rounding", Rounding::from_word),
        // Few objects have one, and both are large.
        array: r.keyed("array").map(|(key, child)| {
            Box::new(ArrayDecl {
                span: key,
                count: child.integer("count"),
                entry: entry(child, &keys::ARRAY, key, diagnostics),
                elements: members(
                    child.entries("elements"),
                    Kind::Elements,
                    room,
                    &mut repeated,
                    diagnostics,
                ),
            })
        }),
        record: r.keyed("record").map(|(key, _)| RecordDecl {
            span: key,
            members: members(r.entries("record"), Kind::Members, room, &mut repeated, diagnostics),
        }),
        sub0: r.keyed("sub0").map(|(key, child)| Box::new(entry(child, &keys::SUB0, key, diagnostics))),
        omit: r.integers("omit"),
        links: r.optional_indices("links"),
        editor: None,
        entry: entry(r, &keys::OBJECT, index.span, diagnostics),
    };
    // An object that is like something else lacks nothing of its own.
    let lost = decl.like.is_none() && r.node.get("like").is_some();
    let entry = EntryDecl { unsure: decl.entry.unsure || lost, ..decl.entry };
    let decl = ObjectDecl { entry, ..decl };
    if decl.entries() == 1 {
        return decl;
    }
    // What is next to `elements:` or `record:` is about each of them.
    let of = |key: &str| r.node.get(key).map_or(0, Node::weight);
    let elements = r.child("array").and_then(|child| child.node.get("elements")).map_or(0, Node::weight);
    let common = written.saturating_sub(of("record")).saturating_sub(elements);
    let written = written.saturating_add(repeated);
    let weight = written.saturating_add(common.saturating_mul(decl.entries() - 1));
    ObjectDecl { weight, ..decl }
}

/// What a map of entries describes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// Elements of an array, whose number is their sub-index.
    Elements,
    /// Members of a record; those of a run are counted.
    Members,
}

/// Reads elements or members; a run of sub-indices makes one for each of them. `repeated` grows by the bytes that are
/// written once for several.
fn members<'a>(
    entries: impl Iterator<Item = (Spanned<&'a str>, Reader<'a>)>,
    kind: Kind,
    mut room: Room,
    repeated: &mut usize,
    diagnostics: &mut Diagnostics,
) -> Vec<(Spanned<SubIndex>, EntryDecl)> {
    let mut before: BTreeMap<SubIndex, Spanned<&str>> = BTreeMap::new();
    let mut members = Vec::new();
    for (key, r) in entries {
        let Some(range) = lexical::sub_indices(key.value) else { continue };
        if let Some((sub, earlier)) = before.range(range.first..=range.last).next() {
            let number = format!("sub-index {sub}");
            diagnostics.push(twice(codes::DUPLICATE_SUB_INDEX, &number, key, *earlier));
            continue;
        }
        before.extend(range.subs().map(|sub| (sub, key)));
        let one = entry(r, &keys::ENTRY, key.span, diagnostics);
        if range.first == range.last {
            members.push((Spanned::new(range.first, key.span), one));
            continue;
        }
        let text = r.node.weight().saturating_mul(range.subs().len() - 1);
        if let Err(full) = room.take(0, text) {
            diagnostics.push(
                Diagnostic::new(
                    codes::TOO_MUCH,
                    key.span,
                    format!("{} up to here; a file describes less", full.words(ENTRIES_OF_FILE)),
                )
                .help("correct the run, or shorten its texts"),
            );
            continue;
        }
        *repeated = repeated.saturating_add(text);
        let (what, number) = match kind {
            Kind::Elements => ("elements", "it means the sub-index"),
            Kind::Members => ("members", "it means 1, 2, and so on"),
        };
        check_numbered(&one, what, number, diagnostics);
        for (count, sub) in (1..).zip(range.subs()) {
            let number = match kind {
                Kind::Elements => u16::from(sub.0),
                Kind::Members => count,
            };
            let mut copy = one.clone();
            number_names(&mut copy, number);
            members.push((Spanned::new(sub, key.span), copy));
        }
    }
    members.arrange_by_key(|(sub, _)| sub.value);
    members
}
