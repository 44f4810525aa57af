//! From a text to its lines: one pass, which accepts everything.

use super::document::{Content, Line, LineEnd, Part};

/// White space and control characters, such as the DOS end-of-file sign.
pub(super) const fn is_blank(c: char) -> bool {
    c <= ' ' || c == '\u{FEFF}'
}

/// The lines of a text; their texts and breaks, one behind the other, are the text.
pub(super) fn lines(text: &str) -> Vec<Line<'_>> {
    let bytes = text.as_bytes();
    // Real files have 15 bytes a line.
    let mut lines = Vec::with_capacity(bytes.len() / 14 + 1);
    let mut start = 0;
    for at in memchr::memchr_iter(b'\n', bytes) {
        let (end, line_end) = match bytes[start..at].last() {
            Some(b'\r') => (at - 1, LineEnd::CrLf),
            Some(_) | None => (at, LineEnd::Lf),
        };
        pieces(&text[start..end], start, line_end, &mut lines);
        start = at + 1;
    }
    if start < bytes.len() {
        pieces(&text[start..], start, LineEnd::EndOfText, &mut lines);
    }
    lines
}

/// Adds what lies between two line feeds: a line, or several with carriage returns between them.
fn pieces<'t>(mut text: &'t str, mut start: usize, end: LineEnd, lines: &mut Vec<Line<'t>>) {
    // Sources are smaller than 4 GiB.
    let offset = |at: usize| u32::try_from(at).unwrap_or(u32::MAX);
    while let Some(at) = memchr::memchr(b'\r', text.as_bytes()) {
        lines.push(Line::read(&text[..at], offset(start), content(&text[..at]), LineEnd::Cr));
        start += at + 1;
        text = &text[at + 1..];
    }
    if !text.is_empty() || end != LineEnd::EndOfText {
        lines.push(Line::read(text, offset(start), content(text), end));
    }
}

fn content(line: &str) -> Content {
    let bytes = line.as_bytes();
    let Some(first) = position(line) else { return Content::Blank };
    match bytes[first] {
        b';' | b'#' => return Content::Comment,
        b'[' => {
            if let Some(content) = header(line, first + 1) {
                return content;
            }
        }
        _ => {}
    }
    // Keys are short.
    match bytes.iter().position(|byte| *byte == b'=') {
        Some(equals) if equals > first => {
            Content::KeyValue { equals: u32::try_from(equals).unwrap_or(u32::MAX) }
        }
        Some(_) | None => Content::Unreadable,
    }
}

/// A line that begins with a bracket. One that is not closed is a header as well: the keys that follow belong to no other
/// section.
fn header(line: &str, start: usize) -> Option<Content> {
    let end = match line[start..].find(']') {
        Some(end) => start + end,
        None if line.contains('=') => return None,
        None => start + line[start..].trim_end_matches([')', '}', '>', ' ', '\t']).len(),
    };
    let at = |position: usize| u32::try_from(position).unwrap_or(u32::MAX);
    Some(Content::Header { name: Part { start: at(start), end: at(end) } })
}

/// The first byte that is not blank.
fn position(line: &str) -> Option<usize> {
    match line.as_bytes().first()? {
        // By far the most lines begin without a blank.
        byte if *byte > b' ' && *byte < 0x80 => Some(0),
        _ => line.find(|c| !is_blank(c)),
    }
}

/// What is left of `start..end` without the blanks around it.
pub(super) fn trimmed(line: &str, Part { start, end }: Part) -> Part {
    let (start, end) = (start as usize, end as usize);
    let at = |position: usize| u32::try_from(position).unwrap_or(u32::MAX);
    let bytes = &line.as_bytes()[start..end];
    let is_plain = |byte: Option<&u8>| byte.is_some_and(|byte| *byte > b' ' && *byte < 0x80);
    if is_plain(bytes.first()) && is_plain(bytes.last()) {
        return Part { start: at(start), end: at(end) };
    }
    let text = &line[start..end];
    let front = text.len() - text.trim_start_matches(is_blank).len();
    let length = text.trim_matches(is_blank).len();
    Part { start: at(start + front), end: at(start + front + length) }
}
