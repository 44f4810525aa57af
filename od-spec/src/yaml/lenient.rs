//! A tree of a text that is not quite YAML, such as one that is being written.
//!
//! [`parse`](super::parse) stops at the first mistake, because nobody knows what is meant behind it. An editor asks all the same: what stands
//! at this place, what could stand there? So here lines and their indentation decide, which somebody who writes keeps right for the
//! most part: a bracket or quote that is never closed ends where the lines around it go on, and a word without a colon among keys
//! is a key. Of a text that is right, the tree is that of `parse`.

use std::collections::BTreeMap;
use std::str::Chars;

use super::{MAX_DEPTH, Node, NodeKind};
use crate::source::{FileId, Span, Spanned};

/// Most bytes that aliases may repeat.
const MOST_REPEATED: usize = 1 << 20;

/// Reads what can be read.
pub fn lenient(id: FileId, text: &str) -> Node {
    let mut reader = Reader { id, text, at: 0, depth: 0, anchors: BTreeMap::new(), repeated: 0 };
    reader.next_line();
    let root = match reader.column() {
        Some(column) => reader.block(column, -1),
        None => reader.null(),
    };
    // What stands further to the left than the beginning is left out.
    Node { span: root.span, ..root }
}

struct Reader<'a> {
    id: FileId,
    text: &'a str,
    at: usize,
    depth: usize,
    anchors: BTreeMap<&'a str, Node>,
    repeated: usize,
}

/// How a line break in a text that goes on is read.
fn fold(lines: &[&str]) -> String {
    let mut folded = String::new();
    let mut blank = 0;
    for (at, line) in lines.iter().enumerate() {
        let line = line.trim_matches([' ', '\t', '\r']);
        if line.is_empty() && at > 0 {
            blank += 1;
            continue;
        }
        if at > 0 {
            if blank == 0 {
                folded.push(' ');
            } else {
                folded.extend(std::iter::repeat_n('\n', blank));
            }
        }
        blank = 0;
        folded.push_str(line);
    }
    folded
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
            line.starts_with('#') && before.is_none_or(|c| c.is_whitespace())
        };
        line.is_empty() || is_comment()
    }

    /// Goes on to the next thing that is no blank and no comment, if the line holds nothing more.
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

    /// Whether a key stands here, or a word that is to become one.
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
                        entries.push((Spanned::new(text, word.span), self.null_at(word.span)));
                    }
                }
            }
            self.after_value(begin);
        }
        let end = entries.last().map_or(start, |(name, node)| node.span.end.max(name.span.end) as usize);
        Node { span: self.span(start, end), kind: NodeKind::Map(entries) }
    }

    fn null_at(&self, behind: Span) -> Node {
        Node { span: Span { start: behind.end, ..behind }, kind: NodeKind::Null }
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

    /// Goes to the next line behind a value, and at least one character on from where it began.
    fn after_value(&mut self, begin: usize) {
        self.blanks();
        if !self.is_at_end_of_line() && self.line_start(self.at) == self.line_start(begin) {
            // Something behind a value that is none of it.
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
            let here = self.at;
            self.next_line();
            match self.column() {
                Some(column) if column > parent => self.block(column, parent),
                Some(column) if column == parent && is_of_key && self.is_item() => self.block(column, parent),
                _ => {
                    self.at = here;
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

    /// The bytes of a line up to its comment.
    fn without_comment(line: &str) -> &str {
        let comment = line.match_indices('#').find(|(at, _)| line[..*at].ends_with([' ', '\t']));
        comment.map_or(line, |(at, _)| &line[..at]).trim_end()
    }

    fn plain(&mut self, parent: i32) -> Node {
        let start = self.at;
        let line = self.line();
        let first = Self::without_comment(line);
        let mut end = start + first.len();
        let mut lines = vec![first];
        self.at += line.len();
        // A comment ends it.
        let mut goes_on = first.len() == line.trim_end().len();
        while goes_on {
            let mut ahead = Reader { anchors: BTreeMap::new(), ..*self };
            let mut blank = 0;
            loop {
                let Some(length) = ahead.rest().find('\n') else { break };
                ahead.at += length + 1;
                if !ahead.line().trim().is_empty() {
                    break;
                }
                blank += 1;
            }
            ahead.blanks();
            let deeper = ahead.column().is_some_and(|column| column > parent) && ahead.at > self.at;
            if !deeper || ahead.is_at_end_of_line() || ahead.key_length().is_some() {
                break;
            }
            let line = ahead.line();
            let more = Self::without_comment(line);
            lines.extend(std::iter::repeat_n("", blank));
            lines.push(more);
            end = ahead.at + more.len();
            self.at = ahead.at + line.len();
            goes_on = more.len() == line.trim_end().len();
        }
        self.scalar(start, end, fold(&lines), true)
    }

    fn quoted(&mut self, quote: char, parent: i32) -> Node {
        let start = self.at;
        let length = quoted_length(self.rest(), quote).filter(|length| {
            // Further lines belong to it as long as they are indented.
            let lines = self.rest()[..*length].split('\n').skip(1);
            lines.clone().all(|line| line.trim().is_empty() || indent(line) > parent)
        });
        let Some(length) = length else {
            let line = self.line().trim_end();
            self.at += line.len();
            return self.scalar(start, self.at, line[1..].to_owned(), false);
        };
        self.at += length;
        self.scalar(start, self.at, unquoted(&self.text[start..self.at], quote), false)
    }

    fn block_scalar(&mut self, parent: i32) -> Node {
        let mut start = self.at;
        let header = self.line();
        let is_folded = header.starts_with('>');
        self.at += header.len();
        let (mut lines, mut end) = (Vec::new(), self.at);
        let mut own = None;
        while let Some(length) = self.rest().find('\n') {
            let next = Reader { at: self.at + length + 1, anchors: BTreeMap::new(), ..*self };
            let line = next.line();
            let blank = line.trim().is_empty();
            if !blank && indent(line) <= parent || next.at >= self.text.len() {
                break;
            }
            if !blank {
                let width = usize::try_from(indent(line)).unwrap_or(0);
                if own.is_none() {
                    start = next.at + width;
                }
                let width = *own.get_or_insert(width);
                lines.push(line.get(width.min(line.len() - line.trim_start().len())..).unwrap_or_default());
                end = next.at + line.trim_end().len();
            } else {
                lines.push("");
            }
            self.at = next.at + line.len();
        }
        while lines.last().is_some_and(|line| line.is_empty()) {
            lines.pop();
        }
        let mut text = if is_folded { folded(&lines) } else { lines.join("\n") };
        let chomp = header.split_whitespace().next().unwrap_or_default();
        if !chomp.contains('-') && !text.is_empty() {
            text.push('\n');
        }
        self.scalar(start, end, text, false)
    }

    /// A map or list in brackets.
    fn flow(&mut self, parent: i32) -> Node {
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
                                    value.unwrap_or_else(|| self.null_at(span)),
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

    /// Skips blanks, comments and line breaks in brackets; `false` where the lines around go on.
    fn flow_blanks(&mut self, parent: i32) -> bool {
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

    fn flow_pair(&mut self, parent: i32) -> (Node, Option<Node>) {
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

    fn flow_value(&mut self, parent: i32) -> Node {
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

    fn flow_plain(&mut self, parent: i32) -> Node {
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
            let here = self.at;
            if !self.flow_blanks(parent)
                || self.at == here
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

/// The blanks before a line.
fn indent(line: &str) -> i32 {
    i32::try_from(line.len() - line.trim_start_matches([' ', '\t']).len()).unwrap_or(i32::MAX)
}

/// The lines of a folded block scalar.
fn folded(lines: &[&str]) -> String {
    let mut text = String::new();
    let mut blank = 0;
    for (at, line) in lines.iter().enumerate() {
        if line.is_empty() {
            blank += 1;
            continue;
        }
        let keeps = line.starts_with([' ', '\t'])
            || at > 0
                && lines[..at]
                    .iter()
                    .rev()
                    .find(|l| !l.is_empty())
                    .is_some_and(|l| l.starts_with([' ', '\t']));
        if at > 0 {
            if keeps {
                text.extend(std::iter::repeat_n('\n', blank + 1));
            } else if blank == 0 {
                text.push(' ');
            } else {
                text.extend(std::iter::repeat_n('\n', blank));
            }
        }
        blank = 0;
        text.push_str(line);
    }
    text
}

/// The bytes of a text in quotes that begins here, with both quotes; `None` where it is not closed.
fn quoted_length(text: &str, quote: char) -> Option<usize> {
    let mut characters = text.char_indices().skip(1).peekable();
    while let Some((at, c)) = characters.next() {
        match c {
            '\\' if quote == '"' => drop(characters.next()),
            '\'' if quote == '\'' && characters.peek().is_some_and(|(_, next)| *next == '\'') => {
                characters.next();
            }
            c if c == quote => return Some(at + 1),
            _ => {}
        }
    }
    None
}

/// The text that is written in quotes.
fn unquoted(written: &str, quote: char) -> String {
    let inner = written.get(1..written.len().saturating_sub(1)).unwrap_or_default();
    let lines: Vec<&str> = inner.split('\n').collect();
    let inner = if lines.len() > 1 {
        // Blanks inside of quotes count, but not those around line breaks.
        let last = lines.len() - 1;
        let trimmed: Vec<&str> = lines
            .iter()
            .enumerate()
            .map(|(at, line)| {
                let line = line.strip_suffix('\r').unwrap_or(line);
                let line = if at > 0 { line.trim_start_matches([' ', '\t']) } else { line };
                if at < last { line.trim_end_matches([' ', '\t']) } else { line }
            })
            .collect();
        let mut text = String::new();
        let mut blank = 0;
        for (at, line) in trimmed.iter().enumerate() {
            if at > 0 && line.is_empty() && at < last {
                blank += 1;
                continue;
            }
            if at > 0 {
                if blank == 0 {
                    if text.ends_with('\\') && quote == '"' {
                        text.pop();
                    } else {
                        text.push(' ');
                    }
                } else {
                    text.extend(std::iter::repeat_n('\n', blank));
                }
            }
            blank = 0;
            text.push_str(line);
        }
        text
    } else {
        inner.to_owned()
    };
    if quote == '\'' { inner.replace("''", "'") } else { unescaped(&inner) }
}

/// A text in which escapes stand for what they mean.
fn unescaped(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    let mut rest = text.chars();
    let code = |rest: &mut Chars<'_>, digits: usize| {
        let hexadecimal: String = rest.by_ref().take(digits).collect();
        u32::from_str_radix(&hexadecimal, 16).ok().and_then(char::from_u32)
    };
    while let Some(c) = rest.next() {
        if c != '\\' {
            plain.push(c);
            continue;
        }
        plain.extend(match rest.next() {
            Some('n') => Some('\n'),
            Some('t') => Some('\t'),
            Some('r') => Some('\r'),
            Some('0') => Some('\0'),
            Some('_') => Some('\u{A0}'),
            Some('x') => code(&mut rest, 2),
            Some('u') => code(&mut rest, 4),
            Some('U') => code(&mut rest, 8),
            other => other,
        });
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diag::Diagnostics;
    use crate::shipped::LIBRARIES;
    use crate::source::SourceMap;
    use crate::yaml::parse;

    /// What differs first between two trees.
    fn difference(strict: &Node, lenient: &Node, sources: &SourceMap) -> Option<String> {
        let place = || sources.place(strict.span);
        let differ = |what: &str| Some(format!("{}: {what}: {strict:?} or {lenient:?}", place()));
        match (&strict.kind, &lenient.kind) {
            (NodeKind::Map(one), NodeKind::Map(other)) => {
                let pairs = one.iter().zip(other);
                let found = pairs.clone().find_map(|((key, node), (other_key, other))| {
                    if (&key.value, key.span) != (&other_key.value, other_key.span) {
                        return Some(format!("{}: {key:?} or {other_key:?}", sources.place(key.span)));
                    }
                    difference(node, other, sources)
                });
                found.or_else(|| if one.len() == other.len() { None } else { differ("keys") })
            }
            (NodeKind::List(one), NodeKind::List(other)) => {
                let found = one.iter().zip(other).find_map(|(one, other)| difference(one, other, sources));
                found.or_else(|| if one.len() == other.len() { None } else { differ("items") })
            }
            (NodeKind::Null, NodeKind::Null) => None,
            (one, other) if one == other && strict.span == lenient.span => None,
            _ => differ("value"),
        }
    }

    fn same(name: &str, text: &str) {
        let mut sources = SourceMap::new();
        let file = sources.add(name, text);
        let strict =
            parse(file, sources.file(file), &mut Diagnostics::new()).unwrap_or_else(|| panic!("{name}"));
        let found = difference(&strict, &lenient(file, text), &sources);
        assert!(found.is_none(), "{}", found.unwrap_or_default());
    }

    #[test]
    fn a_text_that_is_right_has_the_tree_of_the_parser() {
        for (name, text) in LIBRARIES {
            same(name, text);
            same(name, &text.replace('\n', "\r\n"));
        }
        let devices = concat!(env!("CARGO_MANIFEST_DIR"), "/devices");
        for file in std::fs::read_dir(devices).unwrap() {
            let path = file.unwrap().path();
            same(&path.display().to_string(), &std::fs::read_to_string(&path).unwrap());
        }
        for (at, text) in [
            "a: {b: c, d: [e, f: 1, \"g, h\"], 'i': }\nj:\n- k\n-   l: 1\n    m: 2\n",
            "a: &x {b: 1}\nc: *x\nd: [*x, *x]\n",
            "a: >-\n  one\n  two\n\n  three\n   four\nb: |\n  x\n   y\n",
            "a: one\n  two\n\n  three # no more\nb: \"x\\u00b0\\n \\\"\n  y\"\nc: 'it''s'\n",
            "---\n# c\na: {\n  b: 1, # d\n  c: two\n    words,\n}\ne: # f\n  g: h#i\n",
            "a: [\n  1,\n  2\n]\nb: {x: \"y\", \"z\": w}\n",
        ]
        .iter()
        .enumerate()
        {
            same(&format!("text {at}"), text);
        }
    }

    #[test]
    fn what_is_not_closed_ends_where_the_lines_around_go_on() {
        let mut sources = SourceMap::new();
        let mut read = |text: &str| {
            let file = sources.add("a", text);
            lenient(file, text)
        };
        let tree =
            read("objects:\n  0x1: {name: a, type\n  0x2: {name: \"b\n  0x3: [c\nunits:\n  u: {symbol: V}\n");
        let keys = |node: &Node| node.entries().iter().map(|(key, _)| key.value.clone()).collect::<Vec<_>>();
        assert_eq!(keys(&tree), ["objects", "units"]);
        let objects = tree.get("objects").unwrap();
        assert_eq!(keys(objects), ["0x1", "0x2", "0x3"]);
        assert_eq!(keys(objects.get("0x1").unwrap()), ["name", "type"]);
        assert_eq!(
            tree.get("units").unwrap().get("u").unwrap().get("symbol").unwrap().text().unwrap().value,
            "V"
        );
        // A word without a colon is a key among keys.
        let tree = read("a:\n  b: 1\n  wor\n  c: 2\nd\n");
        assert_eq!(
            (keys(tree.get("a").unwrap()), keys(&tree)),
            (vec!["b".into(), "wor".into(), "c".into()], vec!["a".into(), "d".into()])
        );
    }

    #[test]
    fn every_beginning_of_a_text_is_read() {
        let text = "a: {b: [c, {d: 'e''f', g: \"h\\\"\"}], *i: &j k}\n- l\n  - >\n   m\n\n  n: |2\n     o\n: }\n]\n\t? p\n!q r # s\n°: ☃\n";
        let mut sources = SourceMap::new();
        for (end, _) in text.char_indices() {
            for start in [0, end / 2] {
                if text.is_char_boundary(start) {
                    let part = &text[start..end];
                    let file = sources.add("a", part);
                    let tree = lenient(file, part);
                    assert!(tree.span.end as usize <= part.len());
                }
            }
        }
        let file = sources.add("deep", "[".repeat(100_000));
        let _ = lenient(file, sources.file(file).text());
        let deep = (0..500).map(|at| format!("{}a:\n", " ".repeat(at))).collect::<String>();
        let _ = lenient(file, &deep);
    }
}
