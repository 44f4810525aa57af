//! Maps and lists in brackets.

use super::scalars::fold;
use super::{Reader, null_behind};
use crate::source::{Span, Spanned};
use crate::yaml::{MAX_DEPTH, Node, NodeKind};

impl Reader<'_> {
    /// A map or list in brackets.
    pub(super) fn flow(&mut self, parent: i32) -> Node {
        self.depth += 1;
        let start = self.at;
        let is_map = self.rest().starts_with('{');
        let closing = if is_map { '}' } else { ']' };
        self.at += 1;
        let (mut entries, mut items) = (Vec::new(), Vec::new());
        if self.depth > MAX_DEPTH {
            self.at = self.text.len();
        }
        loop {
            let before = self.at;
            if !self.flow_blanks(parent) {
                break;
            }
            match self.rest().chars().next() {
                None => break,
                Some(c) if c == closing => {
                    self.at += 1;
                    break;
                }
                // A bracket that closes something else.
                Some('}' | ']') => break,
                Some(',') => self.at += 1,
                Some(_) => {
                    let (key, value) = self.flow_pair(parent);
                    match (is_map, value) {
                        (true, value) => {
                            let span = key.span;
                            if let NodeKind::Scalar { text, .. } = key.kind {
                                entries.push((
                                    Spanned::new(text, span),
                                    value.unwrap_or_else(|| null_behind(span)),
                                ));
                            }
                        }
                        (false, None) => items.push(key),
                        (false, Some(value)) => {
                            let whole = Span { end: value.span.end.max(key.span.end), ..key.span };
                            if let NodeKind::Scalar { text, .. } = key.kind {
                                let pair = vec![(Spanned::new(text, key.span), value)];
                                items.push(Node { span: whole, kind: NodeKind::Map(pair) });
                            }
                        }
                    }
                }
            }
            if self.at == before {
                break;
            }
        }
        self.depth -= 1;
        let kind = if is_map { NodeKind::Map(entries) } else { NodeKind::List(items) };
        Node { span: self.span(start, self.at), kind }
    }

    /// Skips spaces, comments and line breaks in brackets; `false` where the lines around go on.
    pub(super) fn flow_blanks(&mut self, parent: i32) -> bool {
        let line = self.line_start(self.at);
        let before = self.at;
        self.next_line();
        if self.line_start(self.at) == line {
            return true;
        }
        let closes = self.line().starts_with(['}', ']']);
        let goes_on = self.column().is_some_and(|column| column > parent || column == parent && closes);
        if !goes_on {
            self.at = before;
        }
        goes_on
    }

    pub(super) fn flow_pair(&mut self, parent: i32) -> (Node, Option<Node>) {
        let key = self.flow_value(parent);
        let behind = self.at;
        self.blanks();
        let is_pair = self.rest().strip_prefix(':').is_some_and(|rest| {
            key.text().is_none()
                || matches!(key.kind, NodeKind::Scalar { plain: false, .. })
                || rest.is_empty()
                || rest.starts_with([' ', '\t', '\n', '\r', ',', ']', '}'])
        });
        if !is_pair {
            self.at = behind;
            return (key, None);
        }
        self.at += 1;
        let colon = self.at;
        let goes_on = self.flow_blanks(parent);
        if !goes_on || self.rest().starts_with([',', ']', '}']) || self.rest().is_empty() {
            let null = Node { span: self.span(colon, colon), kind: NodeKind::Null };
            return (key, Some(null));
        }
        let value = self.flow_value(parent);
        (key, Some(value))
    }

    pub(super) fn flow_value(&mut self, parent: i32) -> Node {
        let anchor = self.properties();
        let node = match self.rest().chars().next() {
            Some('{' | '[') => self.flow(parent),
            Some(quote @ ('"' | '\'')) => self.quoted(quote, parent),
            Some('*') => self.alias(&[',', ']', '}']),
            _ => self.flow_plain(parent),
        };
        if let Some(anchor) = anchor {
            self.anchors.insert(anchor, node.clone());
        }
        node
    }

    pub(super) fn flow_plain(&mut self, parent: i32) -> Node {
        let start = self.at;
        let (mut lines, mut end) = (Vec::new(), start);
        loop {
            let line = self.line();
            let stop = line.char_indices().find(|(at, c)| match c {
                ',' | '[' | ']' | '{' | '}' => true,
                ':' => {
                    line[at + 1..].is_empty()
                        || line[at + 1..].starts_with([' ', '\t', ',', ']', '}', '[', '{'])
                }
                '#' => *at > 0 && line[..*at].ends_with([' ', '\t']),
                _ => false,
            });
            let length = stop.map_or(line.len(), |(at, _)| at);
            let part = line[..length].trim_end();
            if !part.is_empty() {
                lines.push(part);
                end = self.at + part.len();
            }
            self.at += length;
            if stop.is_some() {
                break;
            }
            // It may go on in the next line.
            let line_end = self.at;
            if !self.flow_blanks(parent)
                || self.at == line_end
                || self.rest().starts_with([',', ']', '}', ':', '#', '{', '[', '"'])
            {
                break;
            }
            if self.rest().is_empty() {
                break;
            }
        }
        self.at = self.at.max(end);
        if self.at == start && !self.rest().is_empty() {
            // A sign that begins nothing here.
            let c = self.rest().chars().next().map_or(1, char::len_utf8);
            self.at += c;
            return self.scalar(start, self.at, self.text[start..self.at].to_owned(), true);
        }
        self.scalar(start, end, fold(&lines), true)
    }
}
