//! From a text to its lines: one pass, which accepts everything.

use super::line::{Content, Line, LineEnd, is_blank};
use super::names::{Topic, topic};

/// The lines of a text; their texts and breaks, one after the other, are the text.
pub(super) fn lines(text: &str) -> Vec<Line<'_>> {
    let bytes = text.as_bytes();
    // Sources are smaller than 4 GiB.
    let offset = |at: usize| u32::try_from(at).unwrap_or(u32::MAX);
    // Real files have 15 bytes a line.
    let mut lines = Vec::with_capacity(bytes.len() / 14 + 1);
    let mut start = 0;
    while start < bytes.len() {
        if let Some(length) = empty(&bytes[start..]) {
            let line_end = if bytes[start] == b'\n' { LineEnd::Lf } else { LineEnd::CrLf };
            let text = &text[start..start + length - line_end.text().len()];
            lines.push(Line::read(text, offset(start), Content::Blank, line_end));
            start += length;
            continue;
        }
        let end = memchr::memchr2(b'\r', b'\n', &bytes[start..]).map_or(bytes.len(), |length| start + length);
        let line_end = match (bytes.get(end), bytes.get(end + 1)) {
            (Some(b'\r'), Some(b'\n')) => LineEnd::CrLf,
            (Some(b'\r'), _) => LineEnd::Cr,
            (Some(_), _) => LineEnd::Lf,
            (None, _) => LineEnd::EndOfText,
        };
        let line = &text[start..end];
        lines.push(Line::read(line, offset(start), content(line), line_end));
        start = end + line_end.text().len();
    }
    lines
}

/// The length of empty lines that follow each other, all with one break. They are one line of the document: a text of nothing
/// else would take many times its size.
fn empty(bytes: &[u8]) -> Option<usize> {
    let end: &[u8] = if bytes.starts_with(b"\r\n") { b"\r\n" } else { b"\n" };
    let number = bytes.chunks(end.len()).take_while(|chunk| *chunk == end).count();
    (number > 0).then_some(number * end.len())
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
        Some(_) | None => without_bracket(line, first).unwrap_or(Content::Unreadable),
    }
}

/// The name of a section whose first bracket is missing: the keys that follow belong to no other section, either.
fn without_bracket(line: &str, first: usize) -> Option<Content> {
    let name = line.trim_end_matches(is_blank).strip_suffix(']')?;
    let is_name = topic(name.get(first..)?.trim_end_matches(is_blank)) != Topic::Unknown;
    is_name.then(|| Content::Header { end: u32::try_from(name.len()).unwrap_or(u32::MAX) })
}

/// A line that begins with a bracket. One that is not closed is a header as well: the keys that follow belong to no other
/// section.
fn header(line: &str, start: usize) -> Option<Content> {
    let end = match line[start..].find(']') {
        Some(end) => start + end,
        None if line.contains('=') => return None,
        None => start + line[start..].trim_end_matches([')', '}', '>', ' ', '\t']).len(),
    };
    Some(Content::Header { end: u32::try_from(end).unwrap_or(u32::MAX) })
}

/// The first byte that is not a space.
fn position(line: &str) -> Option<usize> {
    match line.as_bytes().first()? {
        // By far the most lines begin without a space.
        byte if *byte > b' ' && *byte < 0x80 => Some(0),
        _ => line.find(|c| !is_blank(c)),
    }
}
