//! A tree of a text that is not quite YAML, such as one that is being written.
//!
//! [`parse`](super::parse) stops at the first mistake, because what follows it is uncertain. An editor still asks: what
//! is at this place, what could be there? So here lines and their indentation decide, which an author keeps right for
//! the most part: a bracket or quote that is never closed ends where the lines around it go on, and a word without a
//! colon among keys is a key. Of a text that is right, the tree is that of `parse`.

mod flow;
mod scalars;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use self::scalars::{quoted_length, unquoted};
use super::{MAX_DEPTH, Node, NodeKind};
use crate::source::{FileId, Span, Spanned};

/// Most bytes that aliases may repeat.
const MOST_REPEATED: usize = 1 << 20;

/// Reads what can be read.
pub fn lenient(id: FileId, text: &str) -> Node {
    let mut reader = Reader { id, text, at: 0, depth: 0, anchors: BTreeMap::new(), repeated: 0 };
    reader.next_line();
    match reader.column() {
        Some(column) => reader.block(column, -1),
        None => reader.null(),
    }
}

struct Reader<'a> {
    id: FileId,
    text: &'a str,
    at: usize,
    depth: usize,
    anchors: BTreeMap<&'a str, Node>,
    repeated: usize,
}

impl<'a> Reader<'a> {
    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    /// What is left of the line.
    fn line(&self) -> &'a str {
        let rest = self.rest();
        let line = rest.split('\n').next().unwrap_or_default();
        line.strip_suffix('\r').unwrap_or(line)
    }

    fn line_start(&self, at: usize) -> usize {
        self.text[..at].rfind('\n').map_or(0, |at| at + 1)
    }

    /// The column of what is read next; `None` at the end.
    fn column(&self) -> Option<i32> {
        (self.at < self.text.len())
            .then(|| i32::try_from(self.at - self.line_start(self.at)).unwrap_or(i32::MAX))
    }

    fn blanks(&mut self) {
        self.at += self.line().len() - self.line().trim_start_matches([' ', '\t']).len();
    }

    /// Whether nothing but a comment is left of the line.
    fn is_at_end_of_line(&self) -> bool {
        let line = self.line();
        let is_comment = || {
            let before = self.text[..self.at].chars().next_back();
            line.starts_with('#') && before.is_none_or(char::is_whitespace)
        };
        line.is_empty() || is_comment()
    }

    /// Goes on to the next thing that is not a space or a comment, if the line holds nothing more.
    fn next_line(&mut self) {
        loop {
            self.blanks();
            let is_marker = |line: &str| {
                self.at == self.line_start(self.at)
                    && (line == "---" || line == "..." || line.starts_with('%'))
            };
            if !self.is_at_end_of_line() && !is_marker(self.line()) {
                return;
            }
            match self.rest().find('\n') {
                Some(end) => self.at += end + 1,
                None => {
                    self.at = self.text.len();
                    return;
                }
            }
        }
    }

    fn span(&self, start: usize, end: usize) -> Span {
        let byte = |at: usize| u32::try_from(at.min(self.text.len())).unwrap_or(u32::MAX);
        Span { file: self.id, start: byte(start), end: byte(end.max(start)) }
    }

    fn null(&self) -> Node {
        Node { span: self.span(self.at, self.at), kind: NodeKind::Null }
    }

    fn scalar(&self, start: usize, end: usize, text: String, plain: bool) -> Node {
        let kind = if plain && matches!(text.as_str(), "" | "~" | "null") {
            NodeKind::Null
        } else {
            NodeKind::Scalar { text, plain }
        };
        Node { span: self.span(start, end), kind }
    }

    fn is_item(&self) -> bool {
        self.line().strip_prefix('-').is_some_and(|rest| rest.is_empty() || rest.starts_with([' ', '\t']))
    }

    /// How many bytes a key takes that begins here, without its colon; `None` where there is none on this line.
    fn key_length(&self) -> Option<usize> {
        let line = self.line();
        let is_end = |rest: &str| {
            rest.strip_prefix(':').is_some_and(|rest| rest.is_empty() || rest.starts_with([' ', '\t']))
        };
        if let Some(quote) = line.chars().next().filter(|c| matches!(c, '"' | '\'')) {
            let length = quoted_length(line, quote)?;
            let blanks = line[length..].len() - line[length..].trim_start().len();
            return is_end(&line[length + blanks..]).then_some(length);
        }
        if line.starts_with(['{', '[', '|', '>']) {
            return None;
        }
        for (at, c) in line.char_indices() {
            match c {
                ':' if is_end(&line[at..]) => return Some(line[..at].trim_end().len()),
                '#' if line[..at].ends_with([' ', '\t']) => return None,
                _ => {}
            }
        }
        None
    }

    /// What begins at a column; `parent` is that of the map or list around it.
    fn block(&mut self, column: i32, parent: i32) -> Node {
        self.depth += 1;
        let node = if self.depth > MAX_DEPTH {
            self.at = self.text.len();
            Node { span: self.span(self.at, self.at), kind: NodeKind::Broken }
        } else if self.is_item() {
            self.list(column)
        } else if self.begins_map(column) {
            self.map(column)
        } else {
            self.inline(parent)
        };
        self.depth -= 1;
        node
    }

    /// Whether a key is here, or a word that is to become one.
    fn begins_map(&self, column: i32) -> bool {
        if self.key_length().is_some() {
            return true;
        }
        if self.line().starts_with(['{', '[', '|', '>', '"', '\'', '&', '*']) {
            return false;
        }
        let mut next = Reader { anchors: BTreeMap::new(), ..*self };
        next.at += next.line().len();
        next.next_line();
        next.column() == Some(column) && next.key_length().is_some() && next.at > self.at
    }

    fn list(&mut self, column: i32) -> Node {
        let start = self.at;
        let mut items = Vec::new();
        while self.column() == Some(column) && self.is_item() {
            let dash = self.at;
            self.at += 1;
            self.blanks();
            let item = if self.is_at_end_of_line() {
                self.value(column, false)
            } else {
                let inner = self.column().unwrap_or(column);
                self.block(inner, column)
            };
            items.push(item);
            self.after_value(dash);
        }
        let end = items.last().map_or(start, |item| item.span.end as usize);
        Node { span: self.span(start, end), kind: NodeKind::List(items) }
    }

    fn map(&mut self, column: i32) -> Node {
        let start = self.at;
        let mut entries: Vec<(Spanned<String>, Node)> = Vec::new();
        while self.column().is_some_and(|at| at >= column)
            && !(self.column() == Some(column) && self.is_item())
        {
            let begin = self.at;
            match self.key_length() {
                Some(length) => {
                    let key = self.key(length);
                    self.blanks();
                    // The colon.
                    self.at = (self.at + 1).min(self.text.len());
                    let value = self.value(column, true);
                    entries.push((key, value));
                }
                None => {
                    let word = self.inline(column);
                    if let NodeKind::Scalar { text, .. } = word.kind {
                        entries.push((Spanned::new(text, word.span), null_behind(word.span)));
                    }
                }
            }
            self.after_value(begin);
        }
        let end = entries.last().map_or(start, |(name, node)| node.span.end.max(name.span.end) as usize);
        Node { span: self.span(start, end), kind: NodeKind::Map(entries) }
    }

    fn key(&mut self, length: usize) -> Spanned<String> {
        let written = &self.text[self.at..self.at + length];
        let span = self.span(self.at, self.at + length);
        self.at += length;
        let text = match written.chars().next() {
            Some(quote @ ('"' | '\'')) => unquoted(written, quote),
            _ => written.to_owned(),
        };
        Spanned::new(text, span)
    }

    /// Goes to the next line after a value, and at least one character on from where it began.
    fn after_value(&mut self, begin: usize) {
        self.blanks();
        if !self.is_at_end_of_line() && self.line_start(self.at) == self.line_start(begin) {
            // Something after a value that is not part of it.
            self.at += self.line().len();
        }
        self.next_line();
        if self.at <= begin {
            self.at = self.text.len();
        }
    }

    /// The value of a key whose map begins at a column, or an item of a list there.
    fn value(&mut self, parent: i32, is_of_key: bool) -> Node {
        self.blanks();
        let anchor = self.properties();
        let node = if self.is_at_end_of_line() {
            let line_end = self.at;
            self.next_line();
            match self.column() {
                Some(column) if column > parent => self.block(column, parent),
                Some(column) if column == parent && is_of_key && self.is_item() => self.block(column, parent),
                _ => {
                    self.at = line_end;
                    self.null()
                }
            }
        } else {
            self.inline(parent)
        };
        if let Some(anchor) = anchor {
            self.anchors.insert(anchor, node.clone());
        }
        node
    }

    /// Skips tags, and reads the name of an anchor.
    fn properties(&mut self) -> Option<&'a str> {
        let mut anchor = None;
        while self.line().starts_with(['&', '!']) {
            let line = self.line();
            let word = line.split([' ', '\t']).next().unwrap_or_default();
            anchor = word.strip_prefix('&').or(anchor);
            self.at += word.len();
            self.blanks();
        }
        anchor
    }

    /// A value that begins on this line, in lines that are indented more than `parent`.
    fn inline(&mut self, parent: i32) -> Node {
        let anchor = self.properties();
        let node = match self.line().chars().next() {
            Some('{' | '[') => self.flow(parent),
            Some('|' | '>') => self.block_scalar(parent),
            Some(quote @ ('"' | '\'')) => self.quoted(quote, parent),
            Some('*') => self.alias(&[]),
            _ => self.plain(parent),
        };
        if let Some(anchor) = anchor {
            self.anchors.insert(anchor, node.clone());
        }
        node
    }

    fn alias(&mut self, ends: &[char]) -> Node {
        let line = self.line();
        let end = line.find(|c: char| c.is_whitespace() || ends.contains(&c)).unwrap_or(line.len());
        let span = self.span(self.at, self.at + end);
        self.at += end;
        let target = self.anchors.get(&line[1..end]);
        self.repeated += target.map_or(0, Node::weight);
        let kind = target
            .filter(|_| self.repeated <= MOST_REPEATED)
            .map_or(NodeKind::Broken, |node| node.kind.clone());
        Node { span, kind }
    }
}

/// Nothing, directly after a key.
const fn null_behind(key: Span) -> Node {
    Node { span: Span { start: key.end, ..key }, kind: NodeKind::Null }
}
