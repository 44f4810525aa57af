//! Prints XML: elements, attributes and texts. What has no character in XML 1.0 is left out, as it cannot be written at all.

use std::fmt::{Display, Write as _};

/// An element with its attributes, not yet printed.
pub(super) struct Element {
    name: &'static str,
    attributes: String,
}

impl Element {
    pub(super) const fn new(name: &'static str) -> Self {
        Self { name, attributes: String::new() }
    }

    /// The element with an attribute.
    pub(super) fn with(mut self, name: &str, value: impl Display) -> Self {
        let _ = write!(self.attributes, " {name}=\"");
        escape(&mut self.attributes, &value.to_string(), Place::Attribute);
        self.attributes.push('"');
        self
    }

    /// The element with an attribute, if there is a value for it.
    pub(super) fn with_any(self, name: &str, value: Option<impl Display>) -> Self {
        match value {
            Some(value) => self.with(name, value),
            None => self,
        }
    }
}

/// A document that is being printed, two spaces for each level.
pub(super) struct Xml {
    text: String,
    depth: usize,
}

impl Xml {
    /// The declaration, and comments after it.
    pub(super) fn new(comments: &[&str]) -> Self {
        let mut xml = Self { text: "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n".to_owned(), depth: 0 };
        for comment in comments {
            // Two dashes would end it; of three, two are left after the first time.
            let comment: String = comment.chars().filter(|c| is_character(*c)).collect();
            let _ = writeln!(xml.text, "<!-- {} -->", comment.replace("--", "- -").replace("--", "- -"));
        }
        xml
    }

    /// An element with what `content` puts into it.
    pub(super) fn open(&mut self, element: Element, content: impl FnOnce(&mut Self)) {
        let name = self.tag(element, ">\n");
        self.depth += 1;
        content(self);
        self.depth -= 1;
        self.indent();
        let _ = writeln!(self.text, "</{name}>");
    }

    /// An element without content.
    pub(super) fn empty(&mut self, element: Element) {
        self.tag(element, "/>\n");
    }

    /// An element with a text.
    pub(super) fn text(&mut self, element: Element, text: &str) {
        let name = self.tag(element, ">");
        escape(&mut self.text, text, Place::Text);
        let _ = writeln!(self.text, "</{name}>");
    }

    pub(super) fn into_bytes(self) -> Vec<u8> {
        self.text.into_bytes()
    }

    /// The opening tag; gives the name for the closing one.
    fn tag(&mut self, Element { name, attributes }: Element, end: &str) -> &'static str {
        self.indent();
        let _ = write!(self.text, "<{name}{attributes}{end}");
        name
    }

    fn indent(&mut self) {
        for _ in 0..self.depth {
            self.text.push_str("  ");
        }
    }
}

/// Where a text is written.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Place {
    Attribute,
    Text,
}

/// Whether XML 1.0 can write a text letter by letter.
pub(super) fn can_write(text: &str) -> bool {
    text.chars().all(is_character)
}

/// The characters of XML 1.0.
const fn is_character(c: char) -> bool {
    matches!(c, '\t' | '\n' | '\r' | ' '..='\u{D7FF}' | '\u{E000}'..='\u{FFFD}' | '\u{10000}'..='\u{10FFFF}')
}

fn escape(out: &mut String, text: &str, place: Place) {
    for c in text.chars().filter(|c| is_character(*c)) {
        match (c, place) {
            ('&', _) => out.push_str("&amp;"),
            ('<', _) => out.push_str("&lt;"),
            ('>', _) => out.push_str("&gt;"),
            ('"', Place::Attribute) => out.push_str("&quot;"),
            // Readers make spaces or line feeds of these.
            ('\r', _) | ('\n' | '\t', Place::Attribute) => {
                let _ = write!(out, "&#{};", u32::from(c));
            }
            (c, _) => out.push(c),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_xml_takes_for_its_own_is_escaped() {
        let mut xml = Xml::new(&["a -- b ----- \u{1}c"]);
        xml.open(Element::new("a").with("b", "\"<&\n\t>\u{1}ä'"), |xml| {
            xml.text(Element::new("c"), "<x> & \"y\"\nz\r\u{FFFF}");
            xml.empty(Element::new("d").with_any("e", None::<&str>).with_any("f", Some(1)));
        });
        assert_eq!(
            String::from_utf8(xml.into_bytes()).unwrap(),
            "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<!-- a - - b - - - - - c -->\n\
             <a b=\"&quot;&lt;&amp;&#10;&#9;&gt;ä'\">\n  <c>&lt;x&gt; &amp; \"y\"\nz&#13;</c>\n  <d f=\"1\"/>\n</a>\n"
        );
        assert!(can_write("a\tä😀") && !can_write("\0"));
    }
}
