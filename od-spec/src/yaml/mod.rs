//! YAML text to a tree in which every node knows its place.
//!
//! This is the only file that names the YAML crate. Scalars stay text here: what a scalar means is
//! decided by the place that expects it (see [`crate::scalar`]), so that `no`, `1.10` and `0x6040` never
//! change their meaning without the author's notice.

mod characters;
pub(crate) mod gaps;
mod lenient;
pub mod packed;

use std::collections::{BTreeMap, BTreeSet};

use granit_parser::{Event, Parser, ScalarStyle};

use crate::diag::{Diagnostic, Diagnostics, codes, shorten};
use crate::order::Arrange as _;
use crate::source::{FileId, SourceFile, Span, Spanned};
use crate::visible::turning;

pub use lenient::lenient;

/// Deepest nesting that is read.
const MAX_DEPTH: usize = 64;
/// The merge key of YAML 1.1, which the language does not have.
pub(crate) const MERGE: &str = "<<";
/// Most bytes that anchors and aliases may add to a document, and what they may in any: in between, so many for each byte of the file.
const MAX_ALIAS_BYTES: usize = 16 << 20;
/// Entries of a map among which equal keys are looked for one by one.
const SMALL: usize = 16;
const LEAST_ALIAS_BYTES: usize = 1 << 20;
const ALIAS_BYTES_PER_BYTE: usize = 256;
/// What a value counts in addition to its text.
const BYTES_PER_VALUE: usize = 64;

/// A value and its place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Node {
    /// The place; for an alias, the `*name`.
    pub span: Span,
    /// The value.
    pub kind: NodeKind,
}

/// What a [`Node`] is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum NodeKind {
    /// Nothing: an empty value, `~` or `null`.
    Null,
    /// Text; `plain` when it was written without quotes.
    Scalar {
        /// The text, after quotes and escapes.
        text: String,
        /// Written without quotes.
        plain: bool,
    },
    /// A sequence.
    List(Vec<Node>),
    /// A mapping, in the order of the text; keys are unique as texts.
    Map(Vec<(Spanned<String>, Node)>),
    /// Something that was reported already.
    Broken,
}

impl Node {
    /// What to call this node in a message.
    pub fn describe(&self) -> String {
        match &self.kind {
            NodeKind::Null => "nothing".to_owned(),
            NodeKind::Scalar { text, .. } => format!("`{}`", shorten(text)),
            NodeKind::List(_) => "a list".to_owned(),
            NodeKind::Map(_) => "a map".to_owned(),
            NodeKind::Broken => "something broken".to_owned(),
        }
    }

    /// The text of a scalar, without the line breaks that end a block scalar.
    pub fn text(&self) -> Option<Spanned<&str>> {
        match &self.kind {
            NodeKind::Scalar { text, .. } => {
                Some(Spanned::new(text.trim_end_matches(['\n', '\r']), self.span))
            }
            _ => None,
        }
    }

    /// The entries of a map; none for anything else.
    pub fn entries(&self) -> &[(Spanned<String>, Node)] {
        match &self.kind {
            NodeKind::Map(entries) => entries,
            _ => &[],
        }
    }

    /// The items of a list; none for anything else.
    pub fn items(&self) -> &[Node] {
        match &self.kind {
            NodeKind::List(items) => items,
            _ => &[],
        }
    }

    /// The items of a list, or the one thing that is there without one.
    pub fn one_or_more(&self) -> &[Node] {
        match &self.kind {
            NodeKind::List(items) => items,
            _ => std::slice::from_ref(self),
        }
    }

    /// The value of a key.
    pub fn get(&self, key: &str) -> Option<&Node> {
        self.entries().iter().find(|(name, _)| name.value == key).map(|(_, node)| node)
    }

    /// What it takes, about: its texts, and something for each value.
    pub(crate) fn weight(&self) -> usize {
        BYTES_PER_VALUE
            + match &self.kind {
                NodeKind::Null | NodeKind::Broken => 0,
                NodeKind::Scalar { text, .. } => text.len(),
                NodeKind::List(items) => items.iter().map(Node::weight).sum(),
                NodeKind::Map(entries) => {
                    entries.iter().map(|(name, node)| name.value.len() + node.weight()).sum()
                }
            }
    }

    fn depth(&self) -> usize {
        match &self.kind {
            NodeKind::List(items) => 1 + items.iter().map(Node::depth).max().unwrap_or(0),
            NodeKind::Map(entries) => 1 + entries.iter().map(|(_, node)| node.depth()).max().unwrap_or(0),
            _ => 0,
        }
    }
}

/// What a document is expected to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Document {
    /// A specification, a part of one or a library.
    Specification,
    /// The values of a node.
    Parameters,
    /// The nodes of many machines.
    Plant,
}

impl Document {
    /// What is said about an empty one.
    const fn missing(self) -> (&'static str, &'static str) {
        match self {
            Document::Specification => (
                "the file holds no specification",
                "start with `od-spec: 1`; `odgen explain OD0110` shows the smallest specification",
            ),
            Document::Parameters => (
                "the file holds no parameters",
                "start with `od-parameters: 1`, and put values under `parameters:`",
            ),
            Document::Plant => (
                "the file holds no plant",
                "start with `od-plant: 1`; the reference shows the smallest plant",
            ),
        }
    }
}

/// Reads one YAML document. `None` when nothing usable was found; the reason is in `diagnostics` then.
pub fn parse(id: FileId, file: &SourceFile, diagnostics: &mut Diagnostics) -> Option<Node> {
    parse_as(Document::Specification, id, file, diagnostics)
}

/// [`parse`], of a document that is to hold this.
pub(crate) fn parse_as(
    what: Document,
    id: FileId,
    file: &SourceFile,
    diagnostics: &mut Diagnostics,
) -> Option<Node> {
    characters::check(id, file.text(), diagnostics);
    let options = granit_parser::options! { emit_comments: false, emit_unresolved_aliases: true };
    let mut builder = Builder {
        id,
        text: file.text(),
        diagnostics,
        stack: Vec::new(),
        anchors: BTreeMap::new(),
        alias_bytes: 0,
        most_alias_bytes: MAX_ALIAS_BYTES
            .min(LEAST_ALIAS_BYTES + file.text().len().saturating_mul(ALIAS_BYTES_PER_BYTE)),
        root: None,
        documents: 0,
    };
    for event in Parser::new_from_str_with_options(file.text(), options) {
        let proceed = match event {
            Ok((event, span)) => builder.event(event, span),
            Err(error) => {
                let message = error.kind().to_string().replace(['`', '\n'], "'");
                let at = error.marker().byte_offset().unwrap_or_default();
                builder.syntax(&message, at);
                return None;
            }
        };
        if !proceed {
            return None;
        }
    }
    match builder.root {
        Some(Node { kind: NodeKind::Null, .. }) | None => {
            let span = builder.point(0);
            let (message, help) = what.missing();
            diagnostics.push(Diagnostic::new(codes::EMPTY_DOCUMENT, span, message).help(help));
            None
        }
        root => root,
    }
}

/// A collection that is being read.
enum Open {
    List { start: Span, anchor: usize, items: Vec<Node> },
    Map { start: Span, anchor: usize, entries: Vec<(Spanned<String>, Node)>, key: Key },
}

enum Key {
    /// The next node is a key.
    Expected,
    /// The next node is the value of this key.
    Read(Spanned<String>),
    /// The next node is the value of a key that was reported; it is dropped.
    Dropped,
}

struct Builder<'a> {
    id: FileId,
    text: &'a str,
    diagnostics: &'a mut Diagnostics,
    stack: Vec<Open>,
    anchors: BTreeMap<usize, Node>,
    alias_bytes: usize,
    most_alias_bytes: usize,
    root: Option<Node>,
    documents: usize,
}

impl Builder<'_> {
    /// Takes one event; `false` stops the reading.
    fn event(&mut self, event: Event<'_>, span: granit_parser::Span) -> bool {
        let span = self.span(span);
        match event {
            Event::DocumentStart(..) => {
                self.documents += 1;
                if self.documents > 1 {
                    self.diagnostics.push(
                        Diagnostic::new(codes::SEVERAL_DOCUMENTS, span, "a second YAML document starts here")
                            .help("a specification is one document: remove `---`, or split the file"),
                    );
                    return false;
                }
            }
            Event::Scalar(text, style, anchor, tag) => {
                if tag.is_some() {
                    self.refuse_tag(span);
                }
                let plain = style == ScalarStyle::Plain;
                let kind = if plain && matches!(&*text, "" | "~" | "null") {
                    NodeKind::Null
                } else {
                    NodeKind::Scalar { text: text.into_owned(), plain }
                };
                let span = if plain { span } else { self.trimmed(span) };
                self.refuse_escape_that_turns(&kind, span);
                return self.add(Node { span, kind }, anchor);
            }
            Event::SequenceStart(_, anchor, tag) => {
                if tag.is_some() {
                    self.refuse_tag(span);
                }
                self.stack.push(Open::List { start: span, anchor, items: Vec::new() });
                return self.depth_is_fine(span);
            }
            Event::MappingStart(_, anchor, tag) => {
                if tag.is_some() {
                    self.refuse_tag(span);
                }
                self.stack.push(Open::Map { start: span, anchor, entries: Vec::new(), key: Key::Expected });
                return self.depth_is_fine(span);
            }
            Event::SequenceEnd | Event::MappingEnd => return self.close(span),
            Event::Alias(anchor) => return self.alias(anchor, span),
            Event::UnresolvedAlias(name) => {
                self.diagnostics.push(
                    Diagnostic::new(
                        codes::UNKNOWN_ANCHOR,
                        span,
                        format!("there is no anchor `&{name}` before this alias"),
                    )
                    .label("nothing to refer to")
                    .help(format!("write `&{name}` before the value that is to be repeated here")),
                );
                return self.add(Node { span, kind: NodeKind::Broken }, 0);
            }
            _ => {}
        }
        true
    }

    /// An escape means the character; the character itself is reported already.
    fn refuse_escape_that_turns(&mut self, kind: &NodeKind, span: Span) {
        if let NodeKind::Scalar { text, plain: false } = kind
            && let Some((_, c)) = turning(text).next()
            && turning(&self.text[span.start as usize..span.end as usize]).next().is_none()
        {
            self.diagnostics.push(characters::turned(span, c));
        }
    }

    /// The parser stopped.
    fn syntax(&mut self, message: &str, at: usize) {
        let span = self.point(at);
        let diagnostic = Diagnostic::new(codes::YAML_SYNTAX, span, format!("this is not YAML: {message}"));
        let help = if self.text[..span.start as usize].ends_with('\t') {
            "indent with spaces; YAML does not allow tabs"
        } else {
            "check indentation, quotes, and that `: ` and ` #` inside a text are quoted"
        };
        self.diagnostics.push(match self.unclosed() {
            Some((bracket, closing)) => {
                let help = format!(
                    "close it with `{closing}`; inside, put texts that hold a comma or a bracket in quotes"
                );
                let is_marked = bracket.start == span.start;
                let diagnostic =
                    if is_marked { diagnostic } else { diagnostic.with(bracket, "this bracket is open") };
                diagnostic.help(help)
            }
            None => diagnostic.help(help),
        });
    }

    /// The innermost bracket that is open, and what closes it.
    fn unclosed(&self) -> Option<(Span, char)> {
        let (start, bracket, closing) = match self.stack.last()? {
            Open::List { start, .. } => (start, '[', ']'),
            Open::Map { start, .. } => (start, '{', '}'),
        };
        let is_bracket = self.text.get(start.start as usize..)?.starts_with(bracket);
        is_bracket.then(|| (start.part(0, 1), closing))
    }

    fn refuse_tag(&mut self, value: Span) {
        let span = self.tag_before(value);
        let diagnostic = Diagnostic::new(codes::YAML_TAG, span, "YAML tags (`!name`) have no meaning here")
            .help("remove the tag; the place decides how a value is read");
        self.diagnostics.push(if span == value {
            diagnostic
        } else {
            let behind = self.text.get(span.end as usize..).unwrap_or_default();
            let blanks = behind.len() - behind.trim_start_matches(' ').len();
            diagnostic.edit(self.range(span.start as usize, span.end as usize + blanks), "")
        });
    }

    /// The tag that is before a value, perhaps with an anchor between them; else the value.
    fn tag_before(&self, value: Span) -> Span {
        let mut before = self.text.get(..value.start as usize).unwrap_or_default().trim_end();
        for _ in 0..2 {
            let start = before
                .rfind(|c: char| c.is_whitespace() || matches!(c, '[' | '{' | ','))
                .map_or(0, |at| at + before[at..].chars().next().map_or(0, char::len_utf8));
            if before[start..].starts_with('!') {
                return self.range(start, before.len());
            }
            before = before[..start].trim_end();
        }
        value
    }

    fn depth_is_fine(&mut self, span: Span) -> bool {
        self.stack.len() <= MAX_DEPTH || self.too_deep(span)
    }

    fn too_deep(&mut self, span: Span) -> bool {
        self.diagnostics.push(
            Diagnostic::new(codes::TOO_DEEP, span, format!("more than {MAX_DEPTH} levels of lists and maps"))
                .help("no specification needs this depth; is a bracket missing?"),
        );
        false
    }

    fn alias(&mut self, anchor: usize, span: Span) -> bool {
        let Some(target) = self.anchors.get(&anchor) else {
            // The anchor is on a collection that is still open, or on something that was dropped.
            self.diagnostics.push(
                Diagnostic::new(codes::UNKNOWN_ANCHOR, span, "this alias refers to a value that contains it")
                    .label("the anchored value is not complete yet")
                    .help("write the value out; it cannot be a part of itself"),
            );
            return self.add(Node { span, kind: NodeKind::Broken }, 0);
        };
        self.alias_bytes += target.weight();
        if self.alias_bytes > self.most_alias_bytes {
            return self.too_much(span);
        }
        if self.stack.len() + target.depth() > MAX_DEPTH {
            return self.too_deep(span);
        }
        let node = Node { span, kind: target.kind.clone() };
        self.add(node, 0)
    }

    fn too_much(&mut self, span: Span) -> bool {
        self.diagnostics.push(
            Diagnostic::new(
                codes::ALIAS_BOMB,
                span,
                format!("aliases expand to more than {} MiB", self.most_alias_bytes >> 20),
            )
            .label("expansion stopped here")
            .help("aliases of aliases multiply; write the values out, or name a type once"),
        );
        false
    }

    /// Hands a complete node to the collection it is in; `false` stops the reading.
    fn add(&mut self, node: Node, anchor: usize) -> bool {
        if anchor != 0 {
            // What has an anchor is kept for its aliases, and an anchor may be in another one.
            self.alias_bytes += node.weight();
            if self.alias_bytes > self.most_alias_bytes {
                return self.too_much(node.span);
            }
            self.anchors.insert(anchor, node.clone());
        }
        match self.stack.last_mut() {
            None => self.root = Some(node),
            Some(Open::List { items, .. }) => items.push(node),
            Some(Open::Map { entries, key, .. }) => match std::mem::replace(key, Key::Expected) {
                Key::Read(name) => entries.push((name, node)),
                Key::Dropped => {}
                Key::Expected => *key = read_key(node, entries, self.diagnostics),
            },
        }
        true
    }

    fn close(&mut self, end: Span) -> bool {
        let Some(open) = self.stack.pop() else { return true };
        let (start, anchor, kind, last) = match open {
            Open::List { start, anchor, items, .. } => {
                let last = items.last().map(|node| node.span);
                (start, anchor, NodeKind::List(items), last)
            }
            Open::Map { start, anchor, mut entries, .. } => {
                let last = entries.last().map(|(_, node)| node.span);
                if entries.len() > SMALL {
                    refuse_equal_keys(&mut entries, self.diagnostics);
                }
                (start, anchor, NodeKind::Map(entries), last)
            }
        };
        // A block collection's end event is at the next token; its last child shows where it really ends.
        let span = if end.end > end.start { start.to(end) } else { start.to(last.unwrap_or(start)) };
        self.add(Node { span, kind }, anchor)
    }

    fn span(&self, span: granit_parser::Span) -> Span {
        let range = span.byte_range().unwrap_or(0..0);
        self.range(range.start, range.end)
    }

    /// A block scalar's span runs on to the next key: cut the white space.
    fn trimmed(&self, span: Span) -> Span {
        let text = self.text.get(span.start as usize..span.end as usize).unwrap_or_default();
        span.part(0, text.trim_end().len())
    }

    fn range(&self, start: usize, end: usize) -> Span {
        let clamp = |at: usize| {
            let mut at = at.min(self.text.len());
            while !self.text.is_char_boundary(at) {
                at -= 1;
            }
            u32::try_from(at).unwrap_or(u32::MAX)
        };
        Span { file: self.id, start: clamp(start), end: clamp(end.max(start)) }
    }

    fn point(&self, at: usize) -> Span {
        let length = self.text.get(at..).and_then(|rest| rest.chars().next()).map_or(0, char::len_utf8);
        self.range(at, at + length)
    }
}

fn read_key(node: Node, entries: &[(Spanned<String>, Node)], diagnostics: &mut Diagnostics) -> Key {
    let span = node.span;
    let NodeKind::Scalar { text, .. } = node.kind else {
        if !matches!(node.kind, NodeKind::Broken) {
            diagnostics.push(
                Diagnostic::new(
                    codes::BAD_KEY,
                    span,
                    format!("a key must be a word or a number, found {}", node.describe()),
                )
                .help("write `key: value`; inside `{}` put keys that hold `: ` in quotes"),
            );
        }
        return Key::Dropped;
    };
    if text == MERGE {
        diagnostics.push(
            Diagnostic::new(codes::BAD_KEY, span, "merge keys (`<<`) are not part of the language")
                .help("name a type or take an object with `from:` instead"),
        );
        // The key stays, so that what it would have brought is not reported as missing.
        return Key::Read(Spanned::new(text, span));
    }
    let key = Spanned::new(text, span);
    if entries.len() <= SMALL
        && let Some((first, _)) = entries.iter().find(|(name, _)| *name == key)
    {
        diagnostics.push(stands_twice(&key, first.span));
        return Key::Dropped;
    }
    Key::Read(key)
}

/// Takes keys that were there before out of a large map, which nearly no map is.
fn refuse_equal_keys(entries: &mut Vec<(Spanned<String>, Node)>, diagnostics: &mut Diagnostics) {
    let mut order: Vec<usize> = (0..entries.len()).collect();
    // Of equal keys, the first in the text stays the first.
    order.arrange_by(|one, other| entries[*one].0.value.cmp(&entries[*other].0.value));
    let mut again = BTreeSet::new();
    for equal in order.chunk_by(|one, other| entries[*one].0 == entries[*other].0) {
        let first = &entries[equal[0]].0;
        if first.value != MERGE {
            for at in &equal[1..] {
                diagnostics.push(stands_twice(&entries[*at].0, first.span));
                again.insert(*at);
            }
        }
    }
    if !again.is_empty() {
        let mut at = 0..;
        entries.retain(|_| at.next().is_none_or(|at| !again.contains(&at)));
    }
}

/// A key has been there before.
pub(crate) fn stands_twice(again: &Spanned<String>, first: Span) -> Diagnostic {
    let message = format!("key `{}` is written twice in this map", shorten(&again.value));
    Diagnostic::new(codes::DUPLICATE_KEY, again.span, message)
        .label("again here")
        .with(first, "first here")
        .help("remove one of the two, or join their values")
}
