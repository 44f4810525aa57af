//! XML as a tree: elements and attributes by their local names, each with its place.

use roxmltree::{Document, Error, Node, ParsingOptions};

use crate::diag::{Diagnostic, Diagnostics, codes, shorten};
use crate::limits::ENTRIES_OF_FILE;
use crate::source::{FileId, Span, Spanned};

/// Elements of a file. An entry has about a dozen, with its parameter, texts and allowed values.
#[expect(clippy::cast_possible_truncation, reason = "a few millions")]
const MOST_NODES: u32 = 64 * ENTRIES_OF_FILE as u32;

/// Attributes of an element. The formats know two dozen; the parser compares each with all before it.
const MOST_ATTRIBUTES: usize = 256;

/// A document and the file that it is from.
#[derive(Clone, Copy)]
pub(super) struct Tree<'x> {
    pub xml: &'x Document<'x>,
    pub file: FileId,
}

/// Reads the text; `None`, with a message, where it is not XML.
pub(super) fn parse<'t>(file: FileId, text: &'t str, diagnostics: &mut Diagnostics) -> Option<Document<'t>> {
    parse_up_to(MOST_NODES, file, text, diagnostics)
}

fn parse_up_to<'t>(
    most: u32,
    file: FileId,
    text: &'t str,
    diagnostics: &mut Diagnostics,
) -> Option<Document<'t>> {
    if let Some(start) = overladen(text.as_bytes()) {
        let message = format!("an element has more than {MOST_ATTRIBUTES} attributes");
        let span = Span { file, start: offset(start), end: offset(start + 1) };
        diagnostics.push(Diagnostic::new(codes::TOO_MUCH, span, message).help("is this the right file?"));
        return None;
    }
    let options = ParsingOptions { allow_dtd: false, nodes_limit: most, ..ParsingOptions::default() };
    match Document::parse_with_options(text, options) {
        Ok(xml) => Some(xml),
        Err(error) => {
            diagnostics.push(refused(most, file, text, &error));
            None
        }
    }
}

/// Where an element begins that has more attributes than any. What is no XML is left to the parser.
fn overladen(text: &[u8]) -> Option<usize> {
    const SKIPPED: [(&[u8], &[u8]); 3] = [(b"<!--", b"-->"), (b"<![CDATA[", b"]]>"), (b"<?", b"?>")];
    let behind = |start: usize, what: &[u8]| {
        memchr::memmem::find(text.get(start..)?, what).map(|found| start + found + what.len())
    };
    let mut at = 0;
    loop {
        let start = behind(at, b"<")? - 1;
        if let Some((open, close)) = SKIPPED.into_iter().find(|(open, _)| text[start..].starts_with(open)) {
            at = behind(start + open.len(), close)?;
            continue;
        }
        at = start + 1;
        // Every attribute has one value in quotes.
        for values in 0.. {
            at += memchr::memchr3(b'>', b'"', b'\'', text.get(at..)?)?;
            if text[at] == b'>' {
                break;
            }
            if values == MOST_ATTRIBUTES {
                return Some(start);
            }
            at = behind(at + 1, &text[at..=at])?;
        }
    }
}

fn refused(most: u32, file: FileId, text: &str, error: &Error) -> Diagnostic {
    let place = |start| Span { file, start: offset(start), end: offset(start) };
    match error {
        Error::DtdDetected => {
            let start = text.find("<!DOCTYPE").unwrap_or_default();
            let span = Span { end: offset(start + "<!DOCTYPE".len()), ..place(start) };
            Diagnostic::new(codes::XDD_DTD, span, "found a document type, expected an element")
                .help("remove it: an XDD needs none")
        }
        Error::NodesLimitReached => {
            let message = format!("more than {most} elements and texts");
            Diagnostic::new(codes::TOO_MUCH, place(0), message).help("is this the right file?")
        }
        error => {
            let at = error.pos();
            let said = error.to_string();
            let words = said.strip_suffix(&format!(" at {at}")).unwrap_or(&said);
            let message = format!("this is not XML: {}", shorten(words));
            Diagnostic::new(codes::XDD_SYNTAX, place(byte_of(text, at.row, at.col)), message)
                .help("correct it; nothing of the file was read")
        }
    }
}

/// The byte of a line and a column, both counted from 1; the column counts characters.
fn byte_of(text: &str, row: u32, column: u32) -> usize {
    let before = row.saturating_sub(1) as usize;
    let line: usize = text.split_inclusive('\n').take(before).map(str::len).sum();
    let rest = text.get(line..).unwrap_or_default();
    let in_line = rest.char_indices().nth(column.saturating_sub(1) as usize);
    line + in_line.map_or(rest.len(), |(at, _)| at)
}

/// Says that a text is XML and no XDD.
pub(super) fn say_that_it_is_none(tree: Tree<'_>, diagnostics: &mut Diagnostics) {
    let root = tree.xml.root_element();
    let message = format!("found `{}`, which has no `CANopenObjectList`", shorten(root.tag_name().name()));
    diagnostics.push(
        Diagnostic::new(codes::XDD_NONE, tree.place(root), message)
            .help("is this the right file? an XDD or XDC describes the objects of a CANopen device"),
    );
}

/// Whether an element has a name, in whatever namespace.
pub(super) fn is_named(node: Node<'_, '_>, name: &str) -> bool {
    node.tag_name().name() == name
}

/// The child elements of a name.
pub(super) fn children<'a, 'x>(node: Node<'a, 'x>, name: &'a str) -> impl Iterator<Item = Node<'a, 'x>> {
    node.children().filter(move |child| child.is_element() && is_named(*child, name))
}

/// The first child element of a name.
pub(super) fn child<'a, 'x>(node: Node<'a, 'x>, name: &str) -> Option<Node<'a, 'x>> {
    node.children().find(|child| child.is_element() && is_named(*child, name))
}

impl<'x> Tree<'x> {
    /// The first element of a name.
    pub(super) fn first(self, name: &str) -> Option<Node<'x, 'x>> {
        self.xml.descendants().find(|node| node.is_element() && is_named(*node, name))
    }

    /// Where the name of an element is.
    pub(super) fn place(self, node: Node<'_, '_>) -> Span {
        let start = node.range().start;
        // The name as it is written has its prefix; it ends where a name cannot go on.
        let text = self.xml.input_text().get(start + 1..).unwrap_or_default();
        let length = text.find(|c: char| c.is_whitespace() || matches!(c, '/' | '>')).unwrap_or(text.len());
        Span { file: self.file, start: offset(start + 1), end: offset(start + 1 + length) }
    }

    /// An attribute in upper or lower case, without spaces around it; with the place of its value. An empty one says
    /// nothing.
    pub(super) fn attribute(self, node: Node<'x, 'x>, name: &str) -> Option<Spanned<&'x str>> {
        let found = node.attributes().find(|attribute| attribute.name().eq_ignore_ascii_case(name))?;
        let value = found.value().trim();
        let range = found.range_value();
        let span = Span { file: self.file, start: offset(range.start), end: offset(range.end) };
        (!value.is_empty()).then_some(Spanned::new(value, span))
    }

    /// The text of an element, without spaces around it; with the place of the text. An empty one says nothing.
    pub(super) fn text(self, node: Node<'x, 'x>) -> Option<Spanned<&'x str>> {
        let text = node.text().map(str::trim).filter(|text| !text.is_empty())?;
        let range = node.first_child()?.range();
        let span = Span { file: self.file, start: offset(range.start), end: offset(range.end) };
        Some(Spanned::new(text, span))
    }
}

/// Sources are smaller than 4 GiB.
fn offset(at: usize) -> u32 {
    u32::try_from(at).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::SourceMap;

    #[test]
    fn elements_have_a_limit() {
        let text = "<a><b/><b/></a>";
        let file = SourceMap::new().add("a.xdd", text);
        let mut said = Diagnostics::new();
        assert!(parse_up_to(5, file, text, &mut said).is_some() && said.iter().next().is_none());
        assert!(parse_up_to(3, file, text, &mut said).is_none());
        let one = said.iter().next().unwrap();
        assert_eq!((one.code.id, one.message.as_str()), ("OD0116", "more than 3 elements and texts"));
    }
}
