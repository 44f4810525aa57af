//! The shape of an EDS or DCF text, without loss: every character of the text has a place in it.

use std::fmt::{self, Display};

use crate::source::Span;

/// An EDS or DCF as a text of sections, keys and comments (CiA 306 4.2).
///
/// Nothing is merged, sorted or dropped: sections and keys stand in the order of the text, and one that stands twice is
/// there twice. Printing a document gives its text back, character by character, with each line's own break.
///
/// ```
/// use od_spec::eds::{Document, Section};
///
/// let mut document = Document::default();
/// let mut section = Section::new("FileInfo");
/// section.push("FileName", "lamp.eds");
/// document.push(section);
/// document.push(Section::new("Comments").with_comments(["Who wrote this?"]));
/// assert_eq!(document.to_string(), "[FileInfo]\r\nFileName=lamp.eds\r\n\r\n; Who wrote this?\r\n[Comments]\r\n");
/// ```
#[derive(Debug, Clone, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Document {
    /// What stands before the first section and does not belong to it: keys without a section, and what is above them.
    pub preamble: Vec<Line<Item>>,
    /// Sections in the order of the text.
    pub sections: Vec<Section>,
    /// Comments and blank lines behind the last key of the text.
    pub tail: Vec<Line<Trivia>>,
}

/// A section: its header, the comments above it and its keys.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Section {
    /// Blank lines and comments between the last key of the section before and this header.
    pub above: Vec<Line<Trivia>>,
    /// The line with the name.
    pub header: Line<Header>,
    /// Keys, and what stands between them.
    pub body: Vec<Line<Item>>,
}

/// A line and what ends it.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Line<T> {
    /// What the line says.
    pub content: T,
    /// How it ends.
    pub end: LineEnd,
    /// Where it was read, without its break; `None` for a line that a program wrote.
    pub place: Option<Span>,
}

/// How a line ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LineEnd {
    /// Carriage return and line feed, as CiA 306 has it.
    CrLf,
    /// Line feed alone.
    Lf,
    /// Carriage return alone.
    Cr,
    /// With the text itself: the last line of a file without a break.
    EndOfText,
}

/// What no reader gives a meaning.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Trivia {
    /// Nothing but blanks, which are kept.
    Blank(String),
    /// A comment, from the first character of its line on, with its `;`.
    Comment(String),
}

/// The line that begins a section: `[1018sub1]`.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Header {
    /// Blanks in front of the bracket.
    pub indent: String,
    /// What stands between the brackets, as it is spelled.
    pub name: String,
    /// What stands behind the closing bracket.
    pub rest: String,
}

/// A line in a section.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Item {
    /// A key and its value.
    KeyValue(KeyValue),
    /// A blank line or a comment.
    Trivia(Trivia),
    /// A line that is none of these, such as a key without `=`.
    Unreadable(String),
}

/// A key and its value: `DataType=0x0007`.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct KeyValue {
    /// Blanks in front of the key.
    pub indent: String,
    /// The key, as it is spelled.
    pub key: String,
    /// The sign between key and value, with the blanks around it.
    pub equals: String,
    /// The text of the value, as it is written; what it stands for depends on the key.
    pub value: String,
    /// Blanks behind the value.
    pub rest: String,
}

impl Document {
    /// Adds a section behind the others. A section that a program wrote is set off by one blank line.
    pub fn push(&mut self, mut section: Section) {
        if !self.sections.is_empty() {
            section.above.insert(0, Line::written(Trivia::Blank(String::new())));
        }
        self.sections.push(section);
    }

    /// The text in UTF-8. A text that was read in another encoding is encoded again by who decoded it.
    pub fn to_bytes(&self) -> Vec<u8> {
        self.to_string().into_bytes()
    }
}

/// The text.
impl Display for Document {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        print(f, &self.preamble)?;
        for section in &self.sections {
            print(f, &section.above)?;
            section.header.fmt(f)?;
            print(f, &section.body)?;
        }
        print(f, &self.tail)
    }
}

fn print(f: &mut fmt::Formatter<'_>, lines: &[Line<impl Display>]) -> fmt::Result {
    lines.iter().try_for_each(|line| line.fmt(f))
}

impl Section {
    /// A section without keys. The name may hold neither brackets nor line breaks.
    pub fn new(name: impl Into<String>) -> Self {
        let header = Header { indent: String::new(), name: name.into(), rest: String::new() };
        Self { above: Vec::new(), header: Line::written(header), body: Vec::new() }
    }

    /// The section with comments directly above its header, a line each, without their `;`.
    #[must_use]
    pub fn with_comments<C: Display>(mut self, comments: impl IntoIterator<Item = C>) -> Self {
        let lines = comments.into_iter().map(|text| Line::written(Trivia::Comment(format!("; {text}"))));
        self.above.extend(lines);
        self
    }

    /// Adds a key and its value behind the others. Neither may hold a line break, and the key no `=`.
    pub fn push(&mut self, key: impl Into<String>, value: impl Into<String>) {
        self.body.push(Line::written(Item::KeyValue(KeyValue::new(key, value))));
    }

    /// The name, as it is spelled.
    pub fn name(&self) -> &str {
        &self.header.content.name
    }

    /// The keys with their values, in order, also those that stand twice.
    pub fn entries(&self) -> impl Iterator<Item = &KeyValue> {
        self.body.iter().filter_map(|line| match &line.content {
            Item::KeyValue(entry) => Some(entry),
            Item::Trivia(_) | Item::Unreadable(_) => None,
        })
    }
}

impl<T> Line<T> {
    /// A line that a program writes.
    pub const fn written(content: T) -> Self {
        Self { content, end: LineEnd::CrLf, place: None }
    }

    /// A line of a text: what it says, how it ends, and where it stands without its break.
    pub const fn read(content: T, end: LineEnd, place: Span) -> Self {
        Self { content, end, place: Some(place) }
    }
}

impl<T: Display> Display for Line<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.content.fmt(f)?;
        f.write_str(self.end.text())
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

impl Display for Trivia {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Trivia::Blank(text) | Trivia::Comment(text) => f.write_str(text),
        }
    }
}

impl Display for Header {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Header { indent, name, rest } = self;
        write!(f, "{indent}[{name}]{rest}")
    }
}

impl Display for Item {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Item::KeyValue(entry) => entry.fmt(f),
            Item::Trivia(trivia) => trivia.fmt(f),
            Item::Unreadable(text) => f.write_str(text),
        }
    }
}

impl KeyValue {
    /// `key=value`, without blanks.
    pub fn new(key: impl Into<String>, value: impl Into<String>) -> Self {
        let (indent, rest) = (String::new(), String::new());
        Self { indent, key: key.into(), equals: "=".to_owned(), value: value.into(), rest }
    }
}

impl Display for KeyValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let KeyValue { indent, key, equals, value, rest } = self;
        write!(f, "{indent}{key}{equals}{value}{rest}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
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
        let names: Vec<&str> = document.sections.iter().map(Section::name).collect();
        assert_eq!(names, ["1000", "1001", "1018sub1"]);
    }

    /// A foreign file with everything that a reader will meet: every break, duplicates, blanks, what nobody can read, and
    /// a last line without a break. The document holds it and gives it back.
    #[test]
    fn every_character_of_a_foreign_text_has_a_place() {
        let text = "\u{FEFF}; licence\nStray=1\n\t\n  ; above\r [FileInfo] trailing\r\n\tFileName = a b.eds \r\
                    FILENAME=c\r\n;between\n[FileInfo]\r\nno equals sign\r\n\r\n;end";
        let mut sources = SourceMap::new();
        let file = sources.add("foreign.eds", text);
        let whole = sources.whole(file);
        let trivia = |content| Line::read(content, LineEnd::Lf, whole);
        let comment = |text: &str| Trivia::Comment(text.to_owned());
        let item = |content, end| Line::read(content, end, whole);
        let header = |indent: &str, rest: &str| Header {
            indent: indent.to_owned(),
            name: "FileInfo".to_owned(),
            rest: rest.to_owned(),
        };
        let name = KeyValue {
            indent: "\t".to_owned(),
            equals: " = ".to_owned(),
            rest: " ".to_owned(),
            ..KeyValue::new("FileName", "a b.eds")
        };
        let document = Document {
            preamble: vec![
                item(Item::Trivia(comment("\u{FEFF}; licence")), LineEnd::Lf),
                item(Item::KeyValue(KeyValue::new("Stray", "1")), LineEnd::Lf),
            ],
            sections: vec![
                Section {
                    above: vec![
                        trivia(Trivia::Blank("\t".to_owned())),
                        Line::read(comment("  ; above"), LineEnd::Cr, whole),
                    ],
                    header: Line::read(header(" ", " trailing"), LineEnd::CrLf, whole),
                    body: vec![
                        item(Item::KeyValue(name), LineEnd::Cr),
                        item(Item::KeyValue(KeyValue::new("FILENAME", "c")), LineEnd::CrLf),
                    ],
                },
                Section {
                    above: vec![trivia(comment(";between"))],
                    header: Line::read(header("", ""), LineEnd::CrLf, whole),
                    body: vec![item(Item::Unreadable("no equals sign".to_owned()), LineEnd::CrLf)],
                },
            ],
            tail: vec![
                Line::read(Trivia::Blank(String::new()), LineEnd::CrLf, whole),
                Line::read(comment(";end"), LineEnd::EndOfText, whole),
            ],
        };
        assert_eq!(document.to_string(), text);
        let entries: Vec<_> = document.sections[0].entries().map(|entry| entry.value.as_str()).collect();
        assert_eq!(entries, ["a b.eds", "c"]);
    }
}
