//! The shape of an EDS or DCF text, without loss: every character of the text is in one of its lines.

use std::fmt::{self, Display};

use super::line::{Line, LineKind};
use super::scan;
use crate::source::{FileId, Span};

/// An EDS or DCF as a text of sections, keys and comments (CiA 306 4.2).
///
/// Nothing is merged, sorted or dropped: lines are in the order of the text, and a section or key that is written twice
/// is there twice. Printing a document gives its text back, character by character, with each line's own break.
///
/// ```
/// use od_spec::eds::{Document, Section};
/// use od_spec::source::SourceMap;
///
/// let mut document = Document::default();
/// let mut section = Section::new("FileInfo");
/// section.push("FileName", "lamp.eds");
/// document.push(section);
/// document.push(Section::new("Comments").with_comments(["Who wrote this?"]));
/// let text = "[FileInfo]\r\nFileName=lamp.eds\r\n\r\n; Who wrote this?\r\n[Comments]\r\n";
/// assert_eq!(document.to_string(), text);
///
/// let mut sources = SourceMap::new();
/// let file = sources.add("lamp.eds", text);
/// let document = Document::scan(file, sources.file(file).text());
/// let comments = document.sections().nth(1).expect("there are two");
/// assert_eq!(comments.name(), "Comments");
/// assert_eq!(comments.comments().collect::<Vec<_>>(), ["Who wrote this?"]);
/// ```
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Document<'t> {
    /// Where the text was read; `None` for a document that a program writes.
    file: Option<FileId>,
    lines: Vec<Line<'t>>,
    /// Of a text that says in another notation what an EDS says: where its headers and keys are from. A line's start is its
    /// number in this list.
    origins: Vec<Span>,
}

impl<'t> Document<'t> {
    /// The lines of a text. Whatever the text is, it becomes a document.
    pub fn scan(file: FileId, text: &'t str) -> Self {
        Self { file: Some(file), lines: scan::lines(text), origins: Vec::new() }
    }

    /// A translation of what a file says in another notation, still without sections.
    pub(crate) const fn translated(file: FileId) -> Self {
        Self { file: Some(file), lines: Vec::new(), origins: Vec::new() }
    }

    /// Adds the header of a section to a translation, with comments above it.
    pub(crate) fn push_header(&mut self, name: &str, place: Span, comments: &[String]) {
        self.lines.extend(comments.iter().map(|text| Line::new_comment(text)));
        self.push_from(Line::new_header(name), place);
    }

    /// Adds a key and its value to the last section of a translation.
    pub(crate) fn push_key(&mut self, key: &str, value: &str, place: Span) {
        self.push_from(Line::new_key_value(key, value), place);
    }

    fn push_from(&mut self, line: Line<'t>, origin: Span) {
        let number = u32::try_from(self.origins.len()).unwrap_or(u32::MAX);
        self.lines.push(line.numbered(number));
        self.origins.push(origin);
    }

    /// Where a line of a translation is from.
    fn origin(&self, line: &Line<'_>) -> Option<Span> {
        self.origins.get(usize::try_from(line.start()).ok()?).copied()
    }

    /// Where the name in a header is.
    pub(crate) fn name_place(&self, header: &Line<'_>, file: FileId) -> Span {
        let part =
            || header.name_part().map_or(Span { file, start: 0, end: 0 }, |name| header.part(file, name));
        self.origin(header).unwrap_or_else(part)
    }

    /// Where the key and the value of a line are.
    pub(crate) fn key_places(&self, line: &Line<'_>, file: FileId) -> Option<(Span, Span)> {
        match self.origin(line) {
            Some(origin) => Some((origin, origin)),
            None => Some((line.part(file, line.key_part()?), line.part(file, line.value_part()?))),
        }
    }

    /// Adds a section after the others. A section that a program wrote is set off by one blank line.
    pub fn push(&mut self, section: Section) {
        if !self.lines.is_empty() {
            self.lines.push(Line::new_blank());
        }
        self.lines.extend(section.comments);
        self.lines.extend(section.lines);
    }

    /// All lines.
    pub fn lines(&self) -> &[Line<'t>] {
        &self.lines
    }

    /// Where a line is, without its break.
    pub fn place(&self, line: &Line<'_>) -> Option<Span> {
        let file = self.file?;
        if self.origins.is_empty() {
            return Some(line.place(file));
        }
        // A comment of a translation is from nowhere in particular.
        let is_numbered = matches!(line.kind(), LineKind::Header | LineKind::KeyValue);
        self.origin(line).filter(|_| is_numbered)
    }

    /// The lines before the first section; keys among them belong to no section.
    pub fn preamble(&self) -> &[Line<'t>] {
        let headers = self.lines.iter().position(|line| line.kind() == LineKind::Header);
        &self.lines[..headers.unwrap_or(self.lines.len())]
    }

    /// The sections, in the order of the text.
    pub fn sections(&self) -> impl Iterator<Item = SectionRef<'_, 't>> {
        let mut at = self.preamble().len();
        std::iter::from_fn(move || {
            let header = at;
            self.lines.get(header)?;
            let rest = &self.lines[header + 1..];
            let body = rest.iter().position(|line| line.kind() == LineKind::Header).unwrap_or(rest.len());
            at = header + 1 + body;
            Some(SectionRef { document: self, header, end: at })
        })
    }

    /// The header of the section that a byte of the file belongs to. The lines of a text that was read ascend.
    pub(super) fn header_before(&self, start: u32) -> Option<&Line<'t>> {
        self.file?;
        let end = self.lines.partition_point(|line| line.start() <= start);
        self.lines[..end].iter().rfind(|line| line.kind() == LineKind::Header)
    }

    /// The text in UTF-8. A text that was read in another encoding is encoded again by who decoded it.
    pub fn to_bytes(&self) -> Vec<u8> {
        let lines = self.lines.iter();
        let length = lines.clone().map(|line| line.text().len() + line.end().text().len()).sum();
        let mut bytes = Vec::with_capacity(length);
        for line in lines {
            bytes.extend_from_slice(line.text().as_bytes());
            bytes.extend_from_slice(line.end().text().as_bytes());
        }
        bytes
    }
}

/// The text.
impl Display for Document<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.lines.iter().try_for_each(|line| {
            f.write_str(line.text())?;
            f.write_str(line.end().text())
        })
    }
}

/// A section of a document: its header and the lines up to the next one.
#[derive(Debug, Clone, Copy)]
pub struct SectionRef<'d, 't> {
    document: &'d Document<'t>,
    header: usize,
    end: usize,
}

impl<'d, 't> SectionRef<'d, 't> {
    /// The document that it is a section of.
    pub(crate) const fn document(&self) -> &'d Document<'t> {
        self.document
    }

    /// The name, as it is spelled.
    pub fn name(&self) -> &'d str {
        self.header().name().unwrap_or_default()
    }

    /// The line with the name.
    pub fn header(&self) -> &'d Line<'t> {
        &self.document.lines[self.header]
    }

    /// The lines after the header.
    pub fn body(&self) -> &'d [Line<'t>] {
        &self.document.lines[self.header + 1..self.end]
    }

    /// The lines with a key, in order, also those whose key is written twice.
    pub fn keys(&self) -> impl Iterator<Item = &'d Line<'t>> + use<'d, 't> {
        self.body().iter().filter(|line| line.kind() == LineKind::KeyValue)
    }

    /// The comments directly above the header, as they are after their `;`, and what follows the name on its line.
    pub(crate) fn comments_at_header(&self) -> impl Iterator<Item = &'d str> + use<'d, 't> {
        let before = &self.document.lines[..self.header];
        let above = before.iter().rev().take_while(|line| line.kind() == LineKind::Comment).count();
        before[before.len() - above..].iter().filter_map(Line::comment).chain(self.comment_after_name())
    }

    /// The comment that follows the name on its line.
    pub(super) fn comment_after_name(&self) -> Option<&'d str> {
        self.header().after_name().map(|(_, text)| text).filter(|text| !text.is_empty())
    }

    /// The comments above the header, after the last key of the section before; without their `;` and the space after
    /// it.
    pub fn comments(&self) -> impl Iterator<Item = &'d str> + use<'d, 't> {
        let before = &self.document.lines[..self.header];
        let is_trivia = |line: &&Line<'_>| matches!(line.kind(), LineKind::Blank | LineKind::Comment);
        let above = before.iter().rev().take_while(is_trivia).count();
        before[before.len() - above..].iter().filter_map(Line::comment)
    }
}

/// A section that a program writes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Section {
    comments: Vec<Line<'static>>,
    /// The header and the keys.
    lines: Vec<Line<'static>>,
}

impl Section {
    /// A section without keys. The name may hold neither brackets nor line breaks.
    pub fn new(name: &str) -> Self {
        // As many as an entry's section usually has.
        let mut lines = Vec::with_capacity(8);
        lines.push(Line::new_header(name));
        Self { comments: Vec::new(), lines }
    }

    /// The section with comments directly above its header, a line each, without their `;`.
    #[must_use]
    pub fn with_comments<C: AsRef<str>>(mut self, comments: impl IntoIterator<Item = C>) -> Self {
        self.comments.extend(comments.into_iter().map(|text| Line::new_comment(text.as_ref())));
        self
    }

    /// The name in the header.
    pub fn name(&self) -> &str {
        self.lines.first().and_then(Line::name).unwrap_or_default()
    }

    /// Adds a key and its value after the others. Neither may hold a line break, and the key no `=`.
    pub fn push(&mut self, key: &str, value: &str) {
        self.lines.push(Line::new_key_value(key, value));
    }

    /// Adds what only programs read that know it: a comment of a key and its value, `;StorageLocation=PERSIST_COMM`.
    pub fn push_remark(&mut self, key: &str, value: &str) {
        self.lines.push(Line::new_remark(key, value));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::eds::line::LineEnd;
    use crate::source::SourceMap;

    #[test]
    fn what_a_program_writes_has_the_form_that_every_reader_takes() {
        let mut document = Document::default();
        let mut first = Section::new("1000").with_comments(["device type", "profile and more"]);
        first.push("ParameterName", "Device type");
        first.push("DataType", "0x0007");
        document.push(first);
        document.push(Section::new("1001"));
        document.push(Section::new("1018sub1").with_comments(["vendor"]));
        assert_eq!(
            String::from_utf8(document.to_bytes()).unwrap(),
            "; device type\r\n; profile and more\r\n[1000]\r\nParameterName=Device type\r\nDataType=0x0007\r\n\
             \r\n[1001]\r\n\r\n; vendor\r\n[1018sub1]\r\n"
        );
        let names: Vec<&str> = document.sections().map(|section| section.name()).collect();
        assert_eq!(names, ["1000", "1001", "1018sub1"]);
    }

    /// A foreign file with everything that a reader will meet: every break, duplicates, spaces, what cannot be read,
    /// and a last line without a break.
    #[test]
    fn every_character_of_a_foreign_text_is_in_a_line() {
        let text = "\u{FEFF}; licence\nStray=1\n\t\n  ; above\r [FileInfo] trailing\r\n\tFileName = a b.eds \r\
                    FILENAME=c\r\n;between\n#and this\n[FileInfo\r\nno equals sign\r\n=nothing\n[ 1018 ]\nA==b=c\r\n\r\n;end\u{1A}";
        let mut sources = SourceMap::new();
        let file = sources.add("foreign.eds", text);
        let document = Document::scan(file, text);
        assert_eq!(document.to_string(), text);
        for line in document.lines() {
            assert_eq!(sources.text(document.place(line).unwrap()), line.text());
        }
        assert_eq!(document.preamble().iter().filter_map(Line::key).collect::<Vec<_>>(), ["Stray"]);
        let sections: Vec<SectionRef<'_, '_>> = document.sections().collect();
        let names: Vec<&str> = sections.iter().map(SectionRef::name).collect();
        assert_eq!(names, ["FileInfo", "FileInfo", "1018"]);
        let above: Vec<Vec<&str>> = sections.iter().map(|section| section.comments().collect()).collect();
        assert_eq!(above, [vec!["above"], vec!["between", "and this"], vec![]]);
        let values = |at: usize| {
            sections[at].keys().map(|line| (line.key().unwrap(), line.value().unwrap())).collect::<Vec<_>>()
        };
        assert_eq!(values(0), [("FileName", "a b.eds"), ("FILENAME", "c")]);
        assert_eq!(values(2), [("A", "=b=c")]);
        let kinds: Vec<LineKind> = sections[1].body().iter().map(Line::kind).collect();
        assert_eq!(kinds, [LineKind::Unreadable, LineKind::Unreadable]);
        let ends: Vec<LineEnd> = document.lines().iter().map(Line::end).collect();
        assert_eq!(ends.last(), Some(&LineEnd::EndOfText));
        assert_eq!(ends.iter().filter(|end| **end == LineEnd::Cr).count(), 2);
    }
}
