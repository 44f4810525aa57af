//! From a text to its lines: one pass, which accepts everything.

use super::document::{Content, Line, LineEnd, Part};

/// White space and control characters, such as the DOS end-of-file sign.
pub(super) const fn is_blank(c: char) -> bool {
    c <= ' ' || c == '\u{FEFF}'
}

/// The lines of a text; their texts and breaks, one behind the other, are the text.
pub(super) fn lines(text: &str) -> Vec<Line<'_>> {
    // Real files have 18 bytes a line.
    let mut lines = Vec::with_capacity(text.len() / 16 + 1);
    let bytes = text.as_bytes();
    let mut start = 0;
    while start < bytes.len() {
        let rest = &bytes[start..];
        let length = memchr::memchr2(b'\n', b'\r', rest).unwrap_or(rest.len());
        let end = match rest.get(length..) {
            Some([b'\r', b'\n', ..]) => LineEnd::CrLf,
            Some([b'\r', ..]) => LineEnd::Cr,
            Some([b'\n', ..]) => LineEnd::Lf,
            Some([..]) | None => LineEnd::EndOfText,
        };
        let line = &text[start..start + length];
        // Sources are smaller than 4 GiB.
        let at = u32::try_from(start).unwrap_or(u32::MAX);
        lines.push(Line::read(line, at, content(line), end));
        start += length + end.text().len();
    }
    lines
}

fn content(line: &str) -> Content {
    let bytes = line.as_bytes();
    let Some(first) = position(line, 0) else { return Content::Blank };
    match bytes[first] {
        b';' | b'#' => return Content::Comment,
        b'[' => {
            if let Some(content) = header(line, first + 1) {
                return content;
            }
        }
        _ => {}
    }
    match memchr::memchr(b'=', bytes) {
        Some(equals) if equals > first => Content::KeyValue {
            key: trimmed(line, first, equals),
            value: trimmed(line, equals + 1, line.len()),
        },
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
    Some(Content::Header { name: trimmed(line, start, end) })
}

/// The first byte from `start` on that is not blank.
fn position(line: &str, start: usize) -> Option<usize> {
    let bytes = line.as_bytes();
    match bytes.get(start)? {
        // By far the most lines begin without a blank.
        byte if *byte > b' ' && *byte < 0x80 => Some(start),
        _ => line[start..].find(|c| !is_blank(c)).map(|at| start + at),
    }
}

/// What is left of `start..end` without the blanks around it.
fn trimmed(line: &str, start: usize, end: usize) -> Part {
    let text = &line[start..end];
    let front = text.len() - text.trim_start_matches(is_blank).len();
    let length = text.trim_matches(is_blank).len();
    let at = |position: usize| u32::try_from(position).unwrap_or(u32::MAX);
    Part { start: at(start + front), end: at(start + front + length) }
}
