//! Scalars: plain, in quotes, and in blocks of lines.

use std::collections::BTreeMap;
use std::str::Chars;

use super::Reader;
use crate::yaml::Node;

impl Reader<'_> {
    /// The bytes of a line up to its comment.
    pub(super) fn without_comment(line: &str) -> &str {
        let comment = line.match_indices('#').find(|(at, _)| line[..*at].ends_with([' ', '\t']));
        comment.map_or(line, |(at, _)| &line[..at]).trim_end()
    }

    pub(super) fn plain(&mut self, parent: i32) -> Node {
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
            while let Some(length) = ahead.rest().find('\n') {
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

    pub(super) fn quoted(&mut self, quote: char, parent: i32) -> Node {
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

    pub(super) fn block_scalar(&mut self, parent: i32) -> Node {
        let mut start = self.at;
        let header = self.line();
        let is_folded = header.starts_with('>');
        self.at += header.len();
        let (mut lines, mut end) = (Vec::new(), self.at);
        let mut block_indent = None;
        while let Some(length) = self.rest().find('\n') {
            let next = Reader { at: self.at + length + 1, anchors: BTreeMap::new(), ..*self };
            let line = next.line();
            let blank = line.trim().is_empty();
            if !blank && indent(line) <= parent || next.at >= self.text.len() {
                break;
            }
            if blank {
                lines.push("");
            } else {
                let width = usize::try_from(indent(line)).unwrap_or(0);
                if block_indent.is_none() {
                    start = next.at + width;
                }
                let width = *block_indent.get_or_insert(width);
                let blanks = line.len() - line.trim_start().len();
                lines.push(line.get(width.min(blanks)..).unwrap_or_default());
                end = next.at + line.trim_end().len();
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
}

/// How a line break in a text that goes on is read.
pub(super) fn fold(lines: &[&str]) -> String {
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

/// The spaces before a line.
pub(super) fn indent(line: &str) -> i32 {
    i32::try_from(line.len() - line.trim_start_matches([' ', '\t']).len()).unwrap_or(i32::MAX)
}

/// The lines of a folded block scalar.
pub(super) fn folded(lines: &[&str]) -> String {
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
pub(super) fn quoted_length(text: &str, quote: char) -> Option<usize> {
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
pub(super) fn unquoted(written: &str, quote: char) -> String {
    let inner = written.get(1..written.len().saturating_sub(1)).unwrap_or_default();
    let lines: Vec<&str> = inner.split('\n').collect();
    let inner = if lines.len() > 1 {
        // Spaces inside of quotes count, but not those around line breaks.
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

/// A text in which escapes are replaced by what they mean.
pub(super) fn unescaped(text: &str) -> String {
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
