//! What the texts define, read from their trees alone.

use super::known::{Known, Scope};
use super::objects::{Described, Member};
use super::{Definition, DefinitionId, Kind, Spelling};
use crate::decode::lexical;
use crate::eds::file_name;
use crate::expr::PLACEHOLDER;
use crate::model::{Index, SubIndex};
use crate::source::{FileId, SourceMap, Span, Spanned};
use crate::yaml::{Node, NodeKind};

/// Something with a name.
fn definition(kind: Kind, name: Spanned<&str>, key: Span) -> Definition {
    let spelling = if name.value.contains(PLACEHOLDER) { Spelling::Pattern } else { Spelling::Written };
    Definition {
        kind,
        name: name.value.to_owned(),
        span: name.span,
        spelling,
        key,
        owner: None,
        indices: None,
        subs: None,
        devices: None,
    }
}

/// Adds something that is found by its name.
fn named<'t>(
    known: &mut Known<'t>,
    kind: Kind,
    scope: Scope,
    name: Spanned<&'t str>,
    key: Span,
) -> DefinitionId {
    let owner = match scope {
        Scope::In(owner) => Some(owner),
        Scope::Everywhere | Scope::At(_) => None,
    };
    known.add_named((kind, scope, name.value), Definition { owner, ..definition(kind, name, key) })
}

/// Adds the keys of a section, each of which names something.
fn keys<'t>(known: &mut Known<'t>, kind: Kind, section: Option<&'t Node>) -> Vec<(DefinitionId, &'t Node)> {
    let entries = section.map(Node::entries).unwrap_or_default().iter();
    entries.map(|(name, node)| (named(known, kind, Scope::Everywhere, text(name), name.span), node)).collect()
}

fn text(name: &Spanned<String>) -> Spanned<&str> {
    Spanned::new(name.value.as_str(), name.span)
}

/// The value of a short form, or of `name:` in the long one.
fn short_name(node: &Node) -> Option<Spanned<&str>> {
    match node.kind {
        NodeKind::Map(_) => node.get("name").and_then(Node::text),
        _ => node.text(),
    }
}

/// Reads all definitions.
pub(super) fn collect<'t>(sources: &'t SourceMap, root: FileId, trees: &[(FileId, &'t Node)]) -> Known<'t> {
    let mut known = Known::new(root);
    for (file, tree) in trees {
        file_itself(sources.file(*file).name(), tree, root, &mut known);
        keys(&mut known, Kind::Device, tree.get("devices"));
        keys(&mut known, Kind::Unit, tree.get("units"));
        for (id, node) in keys(&mut known, Kind::Type, tree.get("types")) {
            members_of_type(id, node, &mut known);
        }
        keys(&mut known, Kind::Feature, tree.get("features"));
        objects(tree, &mut known);
        pdos(tree, &mut known);
        errors(tree, &mut known);
        for (id, node) in keys(&mut known, Kind::Machine, tree.get("state-machines")) {
            for (kind, key) in
                [(Kind::State, "states"), (Kind::Transition, "transitions"), (Kind::Command, "commands")]
            {
                for (name, _) in node.get(key).map(Node::entries).unwrap_or_default() {
                    named(&mut known, kind, Scope::In(id), text(name), name.span);
                }
            }
        }
        keys(&mut known, Kind::Constraint, tree.get("constraints"));
        let sections = tree.get("document").map(Node::items).unwrap_or_default();
        for content in sections.iter().filter_map(|section| section.get("content")).flat_map(Node::items) {
            parts_of_picture(content, &mut known);
        }
    }
    known.objects.sort();
    known
}

/// A file, by the name that `uses:` or `parts:` has for it.
fn file_itself<'t>(name: &'t str, tree: &'t Node, root: FileId, known: &mut Known<'t>) {
    let library = name.strip_prefix('<').and_then(|name| name.strip_suffix('>'));
    let start = tree.span.part(0, 0);
    let profile = tree.get("profile").and_then(Node::text);
    let name = Spanned::new(library.unwrap_or_else(|| file_name(name)), start);
    if let Some(profile) = profile.filter(|_| !tree.span.file.is_one_with(root)) {
        named(known, Kind::Library, Scope::Everywhere, profile, profile.span);
    }
    let file = Definition { spelling: Spelling::Elsewhere, ..definition(Kind::File, name, start) };
    known.add_named((Kind::File, Scope::Everywhere, name.value), file);
}

fn members_of_type<'t>(owner: DefinitionId, node: &'t Node, known: &mut Known<'t>) {
    values(owner, node, known);
    for (bits, node) in node.get("bits").map(Node::entries).unwrap_or_default() {
        let is_usage = |name: &Spanned<&str>| {
            !matches!(node.kind, NodeKind::Map(_)) && matches!(name.value, "reserved" | "unused")
        };
        if let Some(name) = short_name(node).filter(|name| !is_usage(name)) {
            let bit = named(known, Kind::Bit, Scope::In(owner), name, bits.span);
            values(bit, node, known);
        }
        for (_, node) in node.get("modes").map(Node::entries).unwrap_or_default() {
            if let Some(name) = short_name(node) {
                named(known, Kind::Bit, Scope::In(owner), name, name.span);
            }
        }
    }
}

fn values<'t>(owner: DefinitionId, node: &'t Node, known: &mut Known<'t>) {
    for (value, node) in node.get("values").map(Node::entries).unwrap_or_default() {
        if let Some(name) = short_name(node) {
            named(known, Kind::Value, Scope::In(owner), name, value.span);
        }
    }
}

fn objects<'t>(tree: &'t Node, known: &mut Known<'t>) {
    for (key, node) in tree.get("objects").map(Node::entries).unwrap_or_default() {
        let Some(range) = lexical::indices(&key.value) else { continue };
        for one in node.one_or_more() {
            let place = match &node.kind {
                NodeKind::List(_) => one.entries().first().map_or(one.span, |(name, _)| name.span),
                _ => key.span,
            };
            object(known, (range.first, range.last), place, one);
        }
    }
}

/// Adds what is at a key of `objects:`.
fn object<'t>(known: &mut Known<'t>, (first, last): (Index, Index), place: Span, node: &'t Node) {
    let devices = node.get("devices").map(Node::one_or_more);
    let devices: Option<Vec<&str>> =
        devices.map(|list| list.iter().filter_map(|one| Some(one.text()?.value)).collect());
    let name = node.get("name").and_then(Node::text);
    let number = || Spanned::new("", place);
    let owned = devices.as_ref().map(|list| list.iter().map(|key| (*key).to_owned()).collect());
    let definition = Definition {
        indices: Some((first, last)),
        devices: owned,
        ..definition(Kind::Object, name.unwrap_or_else(number), place)
    };
    let id = known.add(spelt(definition, name.is_some(), || index_text(first, last)));
    let array = node.get("array");
    let lists = [node.get("record"), array.and_then(|array| array.get("elements"))];
    let members = lists.into_iter().flatten().flat_map(Node::entries);
    let members = members.filter_map(|(key, member)| Some((key, subs(&key.value)?, member)));
    let mut members: Vec<Member<'_>> = members
        .map(|(key, range, node)| member(known, id, Spanned::new(&key.value, key.span), range, node))
        .collect();
    if let Some(sub0) = node.get("sub0") {
        let number = Spanned::new("0", sub0.span.part(0, 1));
        members.push(member(known, id, number, (SubIndex(0), SubIndex(0)), sub0));
    }
    let elements = array.map(|array| {
        let place = array.get("name").map_or_else(|| array.span.part(0, 1), |name| name.span);
        let all = member(known, id, Spanned::new("elements", place), (SubIndex(1), SubIndex(254)), array);
        known.definition_mut(all.id).spelling = Spelling::Pattern;
        all
    });
    known.objects.add(Described {
        first,
        last,
        id,
        file: place.file,
        devices,
        from: text_of(node, "from"),
        name: name.map(|name| name.value),
        identifier: text_of(node, "identifier"),
        type_name: text_of(node, "type"),
        members,
        elements,
    });
}

/// The text of a key.
fn text_of<'t>(node: &'t Node, key: &str) -> Option<&'t str> {
    node.get(key).and_then(Node::text).map(|text| text.value)
}

/// Adds what describes entries of an object; without a name, a number represents it.
fn member<'t>(
    known: &mut Known<'t>,
    owner: DefinitionId,
    number: Spanned<&str>,
    (first, last): (SubIndex, SubIndex),
    node: &'t Node,
) -> Member<'t> {
    let name = node.get("name").and_then(Node::text);
    let entry = Definition {
        owner: Some(owner),
        subs: Some((first, last)),
        ..definition(Kind::Entry, name.unwrap_or(Spanned::new("", number.span)), number.span)
    };
    let id = known.add(spelt(entry, name.is_some(), || number.value.to_owned()));
    Member {
        first,
        last,
        id,
        name: name.map(|name| name.value),
        identifier: text_of(node, "identifier"),
        type_name: text_of(node, "type"),
    }
}

/// A definition that has its number for a name where none is written.
fn spelt(definition: Definition, is_named: bool, number: impl FnOnce() -> String) -> Definition {
    if is_named {
        return definition;
    }
    Definition { name: number(), spelling: Spelling::Elsewhere, ..definition }
}

fn index_text(first: Index, last: Index) -> String {
    if first == last { first.notation() } else { format!("0x{:04X}..0x{:04X}", first.0, last.0) }
}

fn pdos<'t>(tree: &'t Node, known: &mut Known<'t>) {
    for (device, node) in tree.get("pdos").map(Node::entries).unwrap_or_default() {
        for direction in [crate::model::Direction::Receive, crate::model::Direction::Transmit] {
            for (key, _) in node.get(direction.word()).map(Node::entries).unwrap_or_default() {
                let number = crate::scalar::integer(&key.value).ok();
                let number =
                    number.and_then(|number| u16::try_from(number).ok()).filter(|number| *number > 0);
                let index = number.and_then(|n| direction.first_communication_index().checked_add(n - 1));
                let Some(index) = index else { continue };
                let id = known.add(Definition {
                    spelling: Spelling::Elsewhere,
                    indices: Some((Index(index), Index(index))),
                    devices: Some(vec![device.value.clone()]),
                    ..definition(Kind::Pdo, text(key), key.span)
                });
                known.objects.add_pdo(Index(index), &device.value, id);
            }
        }
    }
}

fn errors<'t>(tree: &'t Node, known: &mut Known<'t>) {
    for (key, node) in tree.get("errors").map(Node::entries).unwrap_or_default() {
        let Some(codes) = lexical::error_codes(&key.value) else { continue };
        let definition = match node.get("name").and_then(Node::text) {
            Some(name) => definition(Kind::Error, name, key.span),
            None => {
                Definition { spelling: Spelling::Elsewhere, ..definition(Kind::Error, text(key), key.span) }
            }
        };
        known.add_errors((codes.first, codes.last), definition);
    }
}

/// Blocks and marks, whose names are unique in their picture, in whichever language.
fn parts_of_picture<'t>(content: &'t Node, known: &mut Known<'t>) {
    let scope = Scope::At(content.span);
    let blocks = content.get("flow").map(Node::one_or_more).unwrap_or_default();
    let blocks = blocks.iter().filter_map(|block| Some((Kind::Block, block.get("block")?)));
    let marks =
        content.get("axis").and_then(|axis| axis.get("marks")).map(Node::one_or_more).unwrap_or_default();
    let marks = marks.iter().filter_map(|mark| Some((Kind::Mark, mark.get("mark")?)));
    for (kind, words) in blocks.chain(marks) {
        let in_languages = words.entries().iter().filter_map(|(_, text)| text.text());
        for name in words.text().into_iter().chain(in_languages) {
            named(known, kind, scope, name, name.span);
        }
    }
}

/// A sub-index or a run of them, as a key.
fn subs(key: &str) -> Option<(SubIndex, SubIndex)> {
    lexical::sub_indices(key).map(|range| (range.first, range.last))
}
