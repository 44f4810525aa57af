//! What can be written at the cursor.
//!
//! A sign that no text has is put in at the cursor, and the text is read leniently: so there is always a word to be completed, and the
//! table of keys says what it may be. Names come from all files of the specification as they are now; the facts about entries
//! from the last model.

mod eds;
mod entries;
mod items;
mod keys;
mod names;
mod settings;

use lsp_types::{Command, CompletionItem, Position};
use od_spec::keys::{Keys, Shape};
use od_spec::names::{Names, Place, Spot};
use od_spec::source::Span;
use od_spec::yaml::{self, Node};

use super::analysis::Kind;
use super::snapshot::Snapshot;
use items::Written;

/// Marks where the cursor is.
const MARK: char = '\u{F8FF}';

/// How a client wants completions.
#[derive(Debug, Clone, Default)]
pub(crate) struct Insertion {
    /// Whether it knows snippets: texts with places for the cursor.
    pub snippets: bool,
    /// The command of the client that offers completions once more, for the value after a key.
    pub next: Option<Command>,
}

/// What can be written at a position.
pub(super) fn completion(
    snapshot: &Snapshot,
    position: Position,
    insertion: &Insertion,
) -> Vec<CompletionItem> {
    match snapshot.now.kind {
        Kind::Specification | Kind::Plant | Kind::Parameters => {}
        Kind::Eds => return eds::completion(snapshot, position, insertion),
        Kind::Xdd | Kind::Foreign | Kind::TooLarge => return Vec::new(),
    }
    let (text, offset) = (snapshot.text(), snapshot.offset(position));
    let mut marked = String::with_capacity(text.len() + MARK.len_utf8());
    marked.push_str(&text[..offset]);
    marked.push(MARK);
    marked.push_str(&text[offset..]);
    let tree = yaml::lenient(snapshot.file, &marked);
    let Some(place) = u32::try_from(offset).ok().and_then(|offset| Place::of(&tree, offset)) else {
        return Vec::new();
    };
    let word = match place.spot {
        Spot::Key { name, .. } | Spot::Data { name, .. } => Some(name),
        Spot::Value { node, .. } => node.text(),
    };
    let Some(word) = word.filter(|word| word.value.contains(MARK)) else { return Vec::new() };
    let written = Written::of(&marked, word.value, word.span, offset);
    let wanted = Wanted { snapshot, names: snapshot.names(), tree: &tree, place: &place, insertion };
    let offers = match place.spot {
        Spot::Key { map, keys, .. } => keys::of_map(map, keys, &written, &wanted),
        Spot::Data { map, kind, .. } => settings::of_keys(map, kind, &written, &wanted)
            .unwrap_or_else(|| names::of_keys(map, kind, &written, &wanted)),
        Spot::Value { shape: Shape::Setting, .. } => settings::of_value(&written, &wanted),
        Spot::Value { shape: Shape::Text, .. } => settings::of_text(&wanted),
        Spot::Value { shape, .. } => names::of_value(shape, &written, &wanted),
    };
    let encoding = snapshot.encoding;
    let position = |byte: usize| snapshot.lines().position(text, byte, encoding);
    offers.into_iter().map(|offer| offer.into_item(&written, insertion, position)).collect()
}

/// What is asked for.
struct Wanted<'a> {
    snapshot: &'a Snapshot,
    /// What the files define.
    names: &'a Names,
    /// The text with the mark in it.
    tree: &'a Node,
    place: &'a Place<'a>,
    insertion: &'a Insertion,
}

impl Wanted<'_> {
    /// The text of a place of the files of now.
    fn text(&self, span: Span) -> &str {
        self.snapshot.now.sources.text(span)
    }
}

/// Whether a value of this shape is written in brackets or in lines below its key.
const fn is_collection(shape: Shape) -> bool {
    matches!(shape, Shape::Map(_) | Shape::MapOf(..) | Shape::List(_))
}

/// The keys that a value of a shape has in its long form.
const fn long_form(shape: Shape) -> Option<&'static Keys> {
    match shape {
        Shape::ShortOr(_, keys) | Shape::Map(keys) => Some(keys),
        _ => None,
    }
}
