//! The lines of a text, looked at once for all readers.

use super::refusal::Place;

/// A line, with the byte at which it begins and what is in it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line<'t> {
    pub text: &'t str,
    pub start: usize,
    /// The first `=`.
    equals: Option<usize>,
    signs: Signs,
}

/// Signs of which there is one in a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Signs(u8);

impl Signs {
    /// `;` or `#`, with which remarks begin.
    pub(super) const REMARK: Self = Self(1);
    /// `"`, `'` or `\`.
    pub(super) const QUOTE: Self = Self(2);
    /// `:`
    pub(super) const COLON: Self = Self(4);
    /// `=`
    const EQUALS: Self = Self(8);
    /// A second `=`.
    pub(super) const SECOND_EQUALS: Self = Self(16);
    /// A character that is not ASCII.
    pub(super) const FOREIGN: Self = Self(32);
    /// The end of the line.
    const BREAK: Self = Self(64);

    const fn and(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    const fn of(byte: u8) -> Self {
        match byte {
            b';' | b'#' => Self::REMARK,
            b'"' | b'\'' | b'\\' => Self::QUOTE,
            b':' => Self::COLON,
            b'=' => Self::EQUALS,
            b'\r' | b'\n' => Self::BREAK,
            0x80.. => Self::FOREIGN,
            _ => Self(0),
        }
    }
}

impl<'t> Line<'t> {
    /// The line at a byte, up to the next break.
    fn at(text: &'t str, start: usize) -> Self {
        let (mut signs, mut equals, mut length) = (Signs::default(), None, 0);
        for byte in &text.as_bytes()[start..] {
            let sign = Signs::of(*byte);
            if sign == Signs::BREAK {
                break;
            }
            if sign == Signs::EQUALS {
                match equals {
                    None => equals = Some(length),
                    Some(_) => signs = signs.and(Signs::SECOND_EQUALS),
                }
            }
            signs = signs.and(sign);
            length += 1;
        }
        Self { text: &text[start..start + length], start, equals, signs }
    }

    pub(super) fn place(&self) -> Place {
        Place { start: self.start, end: self.start + self.text.len() }
    }

    /// Whether one of these signs is in the line.
    pub(super) const fn has(&self, signs: Signs) -> bool {
        self.signs.0 & signs.0 != 0
    }

    /// What is before and after the first `=`.
    pub(super) fn pair(&self) -> Option<(&'t str, &'t str)> {
        let equals = self.equals?;
        Some((&self.text[..equals], &self.text[equals + 1..]))
    }
}

/// The lines of a text for readers that know the breaks of all systems.
pub(super) fn lines(text: &str) -> Vec<Line<'_>> {
    let (mut lines, mut start) = (Vec::new(), 0);
    while start < text.len() {
        let line = Line::at(text, start);
        let end = line.place().end;
        start = end + if text.as_bytes()[end..].starts_with(b"\r\n") { 2 } else { 1 };
        lines.push(line);
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_ends_at_each_kind_of_break() {
        let read = lines("[a]\r\nb=1;2\r\rc=d=\"e\"\n");
        let texts: Vec<&str> = read.iter().map(|line| line.text).collect();
        assert_eq!(texts, ["[a]", "b=1;2", "", "c=d=\"e\""]);
        assert_eq!(read[1].pair(), Some(("b", "1;2")));
        assert!(read[1].has(Signs::REMARK) && !read[1].has(Signs::SECOND_EQUALS));
        assert_eq!(read[3].pair(), Some(("c", "d=\"e\"")));
        assert!(read[3].has(Signs::SECOND_EQUALS) && read[3].has(Signs::QUOTE));
        assert_eq!(read[3].place(), Place { start: 12, end: 19 });
    }
}
