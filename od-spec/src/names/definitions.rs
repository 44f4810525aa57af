//! What the texts define, read from their trees alone.

use std::collections::BTreeMap;

use super::objects::Objects;
use super::{Definition, DefinitionId, Kind, Spelling};
use crate::decode::lexical;
use crate::eds::file_name;
use crate::expr::PLACEHOLDER;
use crate::model::{Index, SubIndex};
use crate::source::{FileId, SourceMap, Span, Spanned};
use crate::yaml::{Node, NodeKind};

/// In what a name has to be unique.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Scope {
    /// In all files together.
    Everywhere,
    /// In something that is defined.
    In(DefinitionId),
    /// In what is described at a place, which has no name.
    At(Span),
}

/// All definitions, and how they are found.
pub(super) struct Known<'t> {
    /// The maker's file.
    pub(super) root: FileId,
    list: Vec<Definition>,
    by_name: BTreeMap<(Kind, Scope, &'t str), Vec<DefinitionId>>,
    /// Error codes from the first to the last.
    errors: Vec<(u16, u16, DefinitionId)>,
    pub(super) objects: Objects<'t>,
}

impl<'t> Known<'t> {
    pub(super) fn into_list(self) -> Vec<Definition> {
        self.list
    }

    pub(super) fn definition(&self, id: DefinitionId) -> &Definition {
        &self.list[id.0 as usize]
    }

    pub(super) fn definition_mut(&mut self, id: DefinitionId) -> &mut Definition {
        &mut self.list[id.0 as usize]
    }

    /// What has a name, as a text of `file` means it: what it defines itself, or else the maker, or else the first library.
    pub(super) fn named(&self, kind: Kind, scope: Scope, name: &str, file: FileId) -> Option<DefinitionId> {
        let all = self.by_name.get(&(kind, scope, name))?;
        let is_in = |file: FileId| {
            all.iter().find(move |id| self.definition(**id).span.file.is_one_with(file)).copied()
        };
        is_in(file).or_else(|| is_in(self.root)).or_else(|| all.first().copied())
    }

    /// The file of a library, by the name that `from:` has for it.
    pub(super) fn library(&self, name: &str) -> Option<FileId> {
        let first = self.by_name.get(&(Kind::Library, Scope::Everywhere, name))?.first()?;
        Some(self.definition(*first).span.file)
    }

    /// All that has a name: a state machine of the maker lies over that of a library.
    pub(super) fn all_named(&self, kind: Kind, scope: Scope, name: &str) -> Vec<DefinitionId> {
        self.by_name.get(&(kind, scope, name)).cloned().unwrap_or_default()
    }

    /// The error codes of a run, as a text of `file` means them.
    pub(super) fn errors(&self, first: u16, last: u16, file: FileId) -> Vec<DefinitionId> {
        let found =
            || self.errors.iter().filter(|(from, to, _)| *from <= last && first <= *to).map(|one| one.2);
        let of_file = |file: FileId| -> Vec<DefinitionId> {
            found().filter(|id| self.definition(*id).span.file.is_one_with(file)).collect()
        };
        let of_maker = of_file(file);
        if of_maker.is_empty() { found().collect() } else { of_maker }
    }

    pub(super) fn add(&mut self, definition: Definition) -> DefinitionId {
        // There are fewer definitions than bytes.
        let id = DefinitionId(u32::try_from(self.list.len()).unwrap_or(u32::MAX));
        self.list.push(definition);
        id
    }

    fn add_named(&mut self, kind: Kind, scope: Scope, name: Spanned<&'t str>, key: Span) -> DefinitionId {
        let owner = match scope {
            Scope::In(owner) => Some(owner),
            Scope::Everywhere | Scope::At(_) => None,
        };
        let id = self.add(Definition { owner, ..definition(kind, name, key) });
        self.by_name.entry((kind, scope, name.value)).or_default().push(id);
        id
    }

    /// The keys of a section, each of which names something.
    fn keys(&mut self, kind: Kind, section: Option<&'t Node>) -> Vec<(DefinitionId, &'t Node)> {
        let entries = section.map(Node::entries).unwrap_or_default();
        entries
            .iter()
            .map(|(name, node)| {
                let id = self.add_named(kind, Scope::Everywhere, text(name), name.span);
                (id, node)
            })
            .collect()
    }
}

/// Something with a name.
pub(super) fn definition(kind: Kind, name: Spanned<&str>, key: Span) -> Definition {
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

fn text(name: &Spanned<String>) -> Spanned<&str> {
    Spanned::new(name.value.as_str(), name.span)
}

/// The value of a short form, or of `name:` in the long one.
pub(super) fn short_name(node: &Node) -> Option<Spanned<&str>> {
    match node.kind {
        NodeKind::Map(_) => node.get("name").and_then(Node::text),
        _ => node.text(),
    }
}

/// The items of a list, or the one thing that stands there without one.
pub(super) fn one_or_more(node: &Node) -> &[Node] {
    match &node.kind {
        NodeKind::List(items) => items,
        _ => std::slice::from_ref(node),
    }
}

/// Reads all definitions.
pub(super) fn collect<'t>(sources: &'t SourceMap, root: FileId, trees: &[(FileId, &'t Node)]) -> Known<'t> {
    let mut known = Known {
        root,
        list: Vec::new(),
        by_name: BTreeMap::new(),
        errors: Vec::new(),
        objects: Objects::default(),
    };
    for (file, tree) in trees {
        file_itself(sources.file(*file).name(), tree, root, &mut known);
        known.keys(Kind::Device, tree.get("devices"));
        known.keys(Kind::Unit, tree.get("units"));
        for (id, node) in known.keys(Kind::Type, tree.get("types")) {
            members_of_type(id, node, &mut known);
        }
        known.keys(Kind::Feature, tree.get("features"));
        objects(tree, &mut known);
        pdos(tree, &mut known);
        errors(tree, &mut known);
        for (id, node) in known.keys(Kind::Machine, tree.get("state-machines")) {
            for (kind, key) in
                [(Kind::State, "states"), (Kind::Transition, "transitions"), (Kind::Command, "commands")]
            {
                for (name, _) in node.get(key).map(Node::entries).unwrap_or_default() {
                    known.add_named(kind, Scope::In(id), text(name), name.span);
                }
            }
        }
        known.keys(Kind::Constraint, tree.get("constraints"));
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
        known.add_named(Kind::Library, Scope::Everywhere, profile, profile.span);
    }
    let id = known.add(Definition { spelling: Spelling::Elsewhere, ..definition(Kind::File, name, start) });
    known.by_name.entry((Kind::File, Scope::Everywhere, name.value)).or_default().push(id);
}

fn members_of_type<'t>(owner: DefinitionId, node: &'t Node, known: &mut Known<'t>) {
    values(owner, node, known);
    for (bits, node) in node.get("bits").map(Node::entries).unwrap_or_default() {
        let is_usage = |name: &Spanned<&str>| {
            !matches!(node.kind, NodeKind::Map(_)) && matches!(name.value, "reserved" | "unused")
        };
        if let Some(name) = short_name(node).filter(|name| !is_usage(name)) {
            let bit = known.add_named(Kind::Bit, Scope::In(owner), name, bits.span);
            values(bit, node, known);
        }
        for (_, node) in node.get("modes").map(Node::entries).unwrap_or_default() {
            if let Some(name) = short_name(node) {
                known.add_named(Kind::Bit, Scope::In(owner), name, name.span);
            }
        }
    }
}

fn values<'t>(owner: DefinitionId, node: &'t Node, known: &mut Known<'t>) {
    for (value, node) in node.get("values").map(Node::entries).unwrap_or_default() {
        if let Some(name) = short_name(node) {
            known.add_named(Kind::Value, Scope::In(owner), name, value.span);
        }
    }
}

fn objects<'t>(tree: &'t Node, known: &mut Known<'t>) {
    for (key, node) in tree.get("objects").map(Node::entries).unwrap_or_default() {
        let Some(range) = lexical::indices(&key.value) else { continue };
        for one in one_or_more(node) {
            let place = match &node.kind {
                NodeKind::List(_) => one.entries().first().map_or(one.span, |(name, _)| name.span),
                _ => key.span,
            };
            Objects::add(known, (range.first, range.last), place, one);
        }
    }
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
        let id = known.add(definition);
        known.errors.push((codes.first, codes.last, id));
    }
}

/// Blocks and marks, whose names are unique in their picture, in whichever language.
fn parts_of_picture<'t>(content: &'t Node, known: &mut Known<'t>) {
    let scope = Scope::At(content.span);
    let blocks = content.get("flow").map(one_or_more).unwrap_or_default();
    let blocks = blocks.iter().filter_map(|block| Some((Kind::Block, block.get("block")?)));
    let marks = content.get("axis").and_then(|axis| axis.get("marks")).map(one_or_more).unwrap_or_default();
    let marks = marks.iter().filter_map(|mark| Some((Kind::Mark, mark.get("mark")?)));
    for (kind, words) in blocks.chain(marks) {
        let in_languages = words.entries().iter().filter_map(|(_, text)| text.text());
        for name in words.text().into_iter().chain(in_languages) {
            known.add_named(kind, scope, name, name.span);
        }
    }
}

/// A sub-index or a run of them, as a key.
pub(super) fn subs(key: &str) -> Option<(SubIndex, SubIndex)> {
    lexical::sub_indices(key).map(|range| (range.first, range.last))
}
