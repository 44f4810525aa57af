//! Positions of the protocol and bytes of a text.
//!
//! The protocol counts lines from 0 and, in a line, code units of UTF-16, unless client and server agree on UTF-8. Lines end
//! with a line feed, a carriage return, or both.

use lsp_types::{Position, PositionEncodingKind, Range};
use od_spec::source::Span;

/// What the characters of a line are counted in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Encoding {
    /// Bytes.
    Utf8,
    /// Code units of UTF-16: what every client knows.
    #[default]
    Utf16,
}

impl Encoding {
    /// The encoding to speak with a client that names these, the ones it prefers first: bytes, if it knows them.
    pub(super) fn agreed(offered: &[PositionEncodingKind]) -> Self {
        if offered.contains(&PositionEncodingKind::UTF8) { Encoding::Utf8 } else { Encoding::Utf16 }
    }

    /// Its name in the protocol.
    pub(super) const fn kind(self) -> PositionEncodingKind {
        match self {
            Encoding::Utf8 => PositionEncodingKind::UTF8,
            Encoding::Utf16 => PositionEncodingKind::UTF16,
        }
    }

    /// The units of a text.
    fn units(self, text: &str) -> usize {
        match self {
            Encoding::Utf8 => text.len(),
            Encoding::Utf16 if text.is_ascii() => text.len(),
            Encoding::Utf16 => text.chars().map(char::len_utf16).sum(),
        }
    }

    /// The byte of a line before which there are so many units; inside a character, its beginning; after the line, its end.
    fn byte(self, line: &str, units: usize) -> usize {
        let mut before = 0;
        for (at, c) in line.char_indices() {
            let width = match self {
                Encoding::Utf8 => c.len_utf8(),
                Encoding::Utf16 => c.len_utf16(),
            };
            if before + width > units {
                return at;
            }
            before += width;
        }
        line.len()
    }
}

/// Where the lines of a text begin.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Lines {
    starts: Vec<usize>,
}

impl Lines {
    /// The lines of a text.
    pub(super) fn of(text: &str) -> Self {
        let bytes = text.as_bytes();
        let ends_line = |(at, byte): (usize, &u8)| match byte {
            b'\n' => Some(at + 1),
            b'\r' if bytes.get(at + 1) != Some(&b'\n') => Some(at + 1),
            _ => None,
        };
        Self { starts: std::iter::once(0).chain(bytes.iter().enumerate().filter_map(ends_line)).collect() }
    }

    /// How many lines there are; after a last line break there is one more, which is empty.
    pub(super) const fn count(&self) -> usize {
        self.starts.len()
    }

    /// The bytes of a line of the text, without its line break.
    pub(super) fn line<'a>(&self, text: &'a str, line: usize) -> (usize, &'a str) {
        let Some(start) = self.starts.get(line).copied() else { return (text.len(), "") };
        let end = self.starts.get(line + 1).map_or(text.len(), |next| *next);
        (start, text.get(start..end).unwrap_or_default().trim_end_matches(['\n', '\r']))
    }

    /// The line that holds a byte.
    pub(super) fn line_of(&self, offset: usize) -> usize {
        self.starts.partition_point(|start| *start <= offset).saturating_sub(1)
    }

    /// The position of a byte; one in a line break is at the line's end.
    pub(super) fn position(&self, text: &str, offset: usize, encoding: Encoding) -> Position {
        let line = self.line_of(offset);
        let (start, content) = self.line(text, line);
        let mut end = offset.saturating_sub(start).min(content.len());
        while !content.is_char_boundary(end) {
            end -= 1;
        }
        Position { line: number(line), character: number(encoding.units(&content[..end])) }
    }

    /// The byte at a position. A position after the end of its line is at that end, as the protocol has it; one after the
    /// last line at the end of the text.
    pub(super) fn offset(&self, text: &str, position: Position, encoding: Encoding) -> usize {
        let (start, content) = self.line(text, position.line as usize);
        start + encoding.byte(content, position.character as usize)
    }

    /// The range of a span.
    pub(super) fn range(&self, text: &str, span: Span, encoding: Encoding) -> Range {
        Range {
            start: self.position(text, span.start as usize, encoding),
            end: self.position(text, span.end as usize, encoding),
        }
    }
}

/// As the protocol counts; no text has so many lines or characters.
fn number(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A degree sign is one unit of UTF-16 and two bytes, an emoji two and four; lines end in each of the three ways.
    const TEXT: &str = "a°b\r\n🌀x\rplain\n";

    fn at(line: u32, character: u32) -> Position {
        Position { line, character }
    }

    #[test]
    fn wide_characters_and_line_breaks_of_every_kind() {
        let lines = Lines::of(TEXT);
        assert_eq!(lines.count(), 4);
        let bytes =
            |encoding| move |line, character| Lines::of(TEXT).offset(TEXT, at(line, character), encoding);
        let (wide, narrow) = (bytes(Encoding::Utf16), bytes(Encoding::Utf8));
        assert_eq!([wide(0, 0), wide(0, 1), wide(0, 2), wide(0, 3)], [0, 1, 3, 4]);
        assert_eq!([narrow(0, 0), narrow(0, 1), narrow(0, 3), narrow(0, 4)], [0, 1, 3, 4]);
        assert_eq!([wide(1, 0), wide(1, 2), wide(1, 3)], [6, 10, 11]);
        assert_eq!([narrow(1, 0), narrow(1, 4), narrow(1, 5)], [6, 10, 11]);
        assert_eq!([wide(2, 0), wide(3, 0)], [12, 18]);
    }

    #[test]
    fn positions_inside_of_characters_and_out_of_range_are_at_the_nearest_place() {
        let lines = Lines::of(TEXT);
        let offset = |line, character, encoding| lines.offset(TEXT, at(line, character), encoding);
        // Between the two halves of the emoji, and between the bytes of the degree sign.
        assert_eq!(offset(1, 1, Encoding::Utf16), 6);
        assert_eq!(offset(0, 2, Encoding::Utf8), 1);
        // After the end of the line: before its line break.
        assert_eq!(offset(0, 99, Encoding::Utf16), 4);
        assert_eq!(offset(2, u32::MAX, Encoding::Utf8), 17);
        assert_eq!(offset(4, 0, Encoding::Utf16), TEXT.len());
        assert_eq!(offset(u32::MAX, u32::MAX, Encoding::Utf16), TEXT.len());
        // A byte of a line break, one inside a character, and one after the text.
        assert_eq!(lines.position(TEXT, 5, Encoding::Utf16), at(0, 3));
        assert_eq!(lines.position(TEXT, 8, Encoding::Utf16), at(1, 0));
        assert_eq!(lines.position(TEXT, usize::MAX, Encoding::Utf16), at(3, 0));
        assert_eq!(Lines::of("").position("", 7, Encoding::Utf8), at(0, 0));
    }

    #[test]
    fn every_byte_that_begins_a_character_comes_back() {
        for text in [TEXT, "", "\r\r\n\n", "°", "x: 𝄞 # €\r\n\r\ny"] {
            let lines = Lines::of(text);
            for encoding in [Encoding::Utf8, Encoding::Utf16] {
                for (offset, c) in text.char_indices().chain([(text.len(), ' ')]) {
                    if matches!(c, '\n' | '\r') {
                        continue;
                    }
                    let position = lines.position(text, offset, encoding);
                    assert_eq!(lines.offset(text, position, encoding), offset, "{text:?} {encoding:?}");
                }
            }
        }
    }

    #[test]
    fn bytes_are_agreed_on_where_a_client_knows_them() {
        assert_eq!(Encoding::agreed(&[]), Encoding::Utf16);
        assert_eq!(Encoding::agreed(&[PositionEncodingKind::UTF16]), Encoding::Utf16);
        let both = [PositionEncodingKind::UTF16, PositionEncodingKind::UTF8];
        assert_eq!(Encoding::agreed(&both), Encoding::Utf8);
        assert_eq!(Encoding::agreed(&[PositionEncodingKind::UTF32]), Encoding::Utf16);
    }
}
