//! A line of an EDS or DCF text: what it is, and the parts of it.

use std::borrow::Cow;
use std::ops::Range;

use crate::source::{FileId, Span};

/// A line and what ends it. Empty lines that follow each other are one, with the breaks between them in its text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Line<'t> {
    text: Cow<'t, str>,
    /// First byte in its file.
    start: u32,
    content: Content,
    end: LineEnd,
}

/// What a line says: positions in its text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Content {
    Blank,
    Comment,
    /// Where the name ends, which begins after the first bracket if there is one.
    Header {
        end: u32,
    },
    /// Where the equals sign is.
    KeyValue {
        equals: u32,
    },
    Unreadable,
}

/// A part of a line's text, in bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Part {
    pub start: u32,
    pub end: u32,
}

impl Part {
    fn range(self) -> Range<usize> {
        self.start as usize..self.end as usize
    }
}

/// How a line ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LineEnd {
    /// Carriage return and line feed, as most files have it.
    CrLf,
    /// Line feed alone.
    Lf,
    /// Carriage return alone, which CiA 306 does not know.
    Cr,
    /// With the text itself: the last line of a file without a break.
    EndOfText,
}

/// What a line is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LineKind {
    /// Only spaces.
    Blank,
    /// A comment: `;`, or what many take for one, `#`.
    Comment,
    /// The line that begins a section: `[1018sub1]`.
    Header,
    /// A key and its value: `DataType=0x0007`.
    KeyValue,
    /// None of these, such as a key without `=`.
    Unreadable,
}

impl<'t> Line<'t> {
    /// A line that a program writes.
    const fn written(text: String, content: Content) -> Self {
        Self { text: Cow::Owned(text), start: 0, content, end: LineEnd::CrLf }
    }

    /// An empty line.
    pub(super) const fn new_blank() -> Self {
        Self::written(String::new(), Content::Blank)
    }

    /// A comment.
    pub(super) fn new_comment(text: &str) -> Self {
        Self::written(joined(["; ", text, ""]), Content::Comment)
    }

    /// A comment that programs read which know its key: without a space after the sign.
    pub(super) fn new_remark(key: &str, value: &str) -> Self {
        Self::written(format!(";{key}={value}"), Content::Comment)
    }

    /// The line that begins a section.
    pub(super) fn new_header(name: &str) -> Self {
        let text = joined(["[", name, "]"]);
        let end = length(&text) - 1;
        Self::written(text, Content::Header { end })
    }

    /// A key and its value.
    pub(super) fn new_key_value(key: &str, value: &str) -> Self {
        Self::written(joined([key, "=", value]), Content::KeyValue { equals: length(key) })
    }

    /// The line under a number, by which its document knows where it is from.
    pub(super) fn numbered(self, number: u32) -> Self {
        Self { start: number, ..self }
    }

    /// Its first byte in its file.
    pub(super) const fn start(&self) -> u32 {
        self.start
    }

    /// Where it is in a file, without its break.
    pub(super) fn place(&self, file: FileId) -> Span {
        Span { file, start: self.start, end: self.start.saturating_add(length(&self.text)) }
    }

    /// A line of a text that begins at the byte `start` of its file.
    pub(super) const fn read(text: &'t str, start: u32, content: Content, end: LineEnd) -> Self {
        Self { text: Cow::Borrowed(text), start, content, end }
    }

    /// The text of the line, without its break.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// What ends the line.
    pub const fn end(&self) -> LineEnd {
        self.end
    }

    /// How many lines of the text it represents.
    pub(in crate::eds) fn number(&self) -> usize {
        match self.content {
            Content::Blank if !self.end.text().is_empty() => 1 + self.text.matches(self.end.text()).count(),
            _ => 1,
        }
    }

    /// What the line is.
    pub const fn kind(&self) -> LineKind {
        match self.content {
            Content::Blank => LineKind::Blank,
            Content::Comment => LineKind::Comment,
            Content::Header { .. } => LineKind::Header,
            Content::KeyValue { .. } => LineKind::KeyValue,
            Content::Unreadable => LineKind::Unreadable,
        }
    }

    /// The name in a header, as it is spelled, without spaces around it.
    pub fn name(&self) -> Option<&str> {
        self.text.get(self.name_part()?.range())
    }

    /// The key, as it is spelled.
    pub fn key(&self) -> Option<&str> {
        self.text.get(self.key_part()?.range())
    }

    /// The text of a key's value, without spaces around it; what it means depends on the key.
    pub fn value(&self) -> Option<&str> {
        self.text.get(self.value_part()?.range())
    }

    /// The text of a comment, without its sign and the space after it.
    pub fn comment(&self) -> Option<&str> {
        if self.kind() != LineKind::Comment {
            return None;
        }
        let text = self.text.trim_start_matches(is_blank).get(1..)?;
        Some(text.strip_prefix(' ').unwrap_or(text).trim_end_matches(is_blank))
    }

    /// Where the text after a section's name begins, which is not part of it, and what it says: a comment that has no
    /// line of its own.
    pub(super) fn after_name(&self) -> Option<(usize, &str)> {
        let Content::Header { .. } = self.content else { return None };
        let end = self.text.find(']')? + 1;
        let text = self.text[end..].trim();
        (!text.is_empty()).then(|| (end, text.trim_start_matches([';', '#']).trim()))
    }

    /// Where a part of the line is in its file, in bytes of the line's text.
    pub(super) const fn part(&self, file: FileId, part: Part) -> Span {
        Span { file, start: self.start + part.start, end: self.start + part.end }
    }

    /// The name in a header.
    pub(super) fn name_part(&self) -> Option<Part> {
        match self.content {
            Content::Header { end } => {
                let start = self.text.find('[').map_or(0, |bracket| bracket + 1);
                let start = u32::try_from(start).unwrap_or(end).min(end);
                Some(trimmed(&self.text, Part { start, end }))
            }
            Content::Blank | Content::Comment | Content::KeyValue { .. } | Content::Unreadable => None,
        }
    }

    /// The key in front of the equals sign.
    pub(super) fn key_part(&self) -> Option<Part> {
        let equals = self.equals()?;
        Some(trimmed(&self.text, Part { start: 0, end: equals }))
    }

    /// The value after the equals sign.
    pub(super) fn value_part(&self) -> Option<Part> {
        let equals = self.equals()?;
        Some(trimmed(&self.text, Part { start: equals + 1, end: length(&self.text) }))
    }

    const fn equals(&self) -> Option<u32> {
        match self.content {
            Content::KeyValue { equals } => Some(equals),
            Content::Blank | Content::Comment | Content::Header { .. } | Content::Unreadable => None,
        }
    }
}

impl LineEnd {
    /// The characters of the break.
    pub const fn text(self) -> &'static str {
        match self {
            LineEnd::CrLf => "\r\n",
            LineEnd::Lf => "\n",
            LineEnd::Cr => "\r",
            LineEnd::EndOfText => "",
        }
    }
}

/// One text of three; `concat` takes twice as long, and an EDS is many lines.
fn joined(parts: [&str; 3]) -> String {
    let mut text = String::with_capacity(parts.iter().map(|part| part.len()).sum());
    for part in parts {
        text.push_str(part);
    }
    text
}

/// The length of a text that is part of a file, or of a line that a program writes.
fn length(text: &str) -> u32 {
    u32::try_from(text.len()).unwrap_or(u32::MAX)
}

/// White space, also that of Unicode, and control characters such as the DOS end-of-file sign.
pub(super) const fn is_blank(c: char) -> bool {
    c <= ' ' || c == '\u{FEFF}' || c.is_whitespace()
}

/// What is left of `start..end` without the spaces around it.
fn trimmed(line: &str, Part { start, end }: Part) -> Part {
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
