//! Fills a document within the limits of the format: ASCII, 255 characters a line, comments only above a section,
//! except properties of CANopenEditor, which it looks for among the keys.

use std::borrow::Cow;
use std::fmt::Display;

use od_spec::ascii::{in_ascii, is_printable, transliterate};
use od_spec::eds::{Document, Section};
use od_spec::model::{Dictionary, EditorProperty, Further, FurtherSection, Index, KeyValue, SubIndex};

use crate::hexadecimal;

/// Longest line without its line break (CiA 306 4.2).
const LONGEST_LINE: usize = 255;
/// The longest key of a file of others, so that there is room for a value.
const LONGEST_KEY: usize = LONGEST_LINE / 2;
/// Width at which comments are broken.
const COMMENT_WIDTH: usize = 110;
/// Longest word of a comment; what is longer is cut.
const LONGEST_WORD: usize = LONGEST_LINE - COMMENT_WIDTH;

/// A section that is being written.
pub(super) struct SectionWriter(Section);

impl SectionWriter {
    /// Begins a section, with comments directly above its header: the one place where every reader takes them.
    pub(super) fn new(name: &str, comments: &[String]) -> Self {
        Self(Section::new(name).with_comments(comments.iter().flat_map(|comment| broken(comment))))
    }

    /// A key and its value.
    pub(super) fn key(&mut self, key: &str, value: impl Display) {
        self.text(key, &value.to_string());
    }

    /// A key and a number in hexadecimal digits, at least so many.
    pub(super) fn hexadecimal(&mut self, key: &str, number: impl Into<u64>, digits: usize) {
        self.text(key, &hexadecimal::prefixed(number, digits));
    }

    /// A key and a text, which is transliterated and cut to the line length.
    pub(super) fn text(&mut self, key: &str, text: &str) {
        if fits(key, text) {
            self.0.push(key, text);
        } else {
            let mut ascii = transliterate(text);
            ascii.truncate(longest(key));
            self.0.push(key, ascii.trim());
        }
    }

    /// A key and a value that counts, letter by letter. What a line cannot say is left out: only a foreign EDS has such values.
    pub(super) fn value(&mut self, key: &str, value: &str) {
        if fits(key, value) {
            self.0.push(key, value);
        }
    }

    /// A property of CANopenEditor: a comment to all other readers.
    pub(super) fn property(&mut self, property: EditorProperty, value: &str) {
        self.0.push_remark(property.key(), value);
    }

    /// A key whose value is 1 or 0.
    pub(super) fn flag(&mut self, key: &str, value: bool) {
        self.text(key, if value { "1" } else { "0" });
    }

    /// Puts the section after those of the document, with further keys that the file of the device has in it.
    pub(super) fn finish(mut self, device: &Dictionary, document: &mut Document<'_>) {
        let keys = device.further.as_ref().and_then(|further| further.keys.get(self.0.name()));
        self.further(keys.into_iter().flatten());
        document.push(self.0);
    }

    /// Keys in the words of a file, in ASCII and as long as a line.
    fn further<'k>(&mut self, keys: impl IntoIterator<Item = &'k KeyValue>) {
        for KeyValue { key, value, .. } in keys {
            let key = in_ascii(key);
            if key.len() < LONGEST_KEY {
                self.text(&key, value);
            }
        }
    }
}

/// Writes the sections that the file of the device has in addition to those of the model.
pub(super) fn write_further(document: &mut Document<'_>, further: &Further) {
    for FurtherSection { name, keys, .. } in further.all_sections() {
        let name = in_ascii(name);
        if name.len() < LONGEST_KEY {
            let mut section = SectionWriter::new(&name, &[]);
            section.further(keys);
            document.push(section.0);
        }
    }
}

/// The name of an object's section.
pub(super) fn object_section(index: Index) -> String {
    let mut name = String::with_capacity(16);
    hexadecimal::push(&mut name, index.0, 1);
    name
}

/// The name of an entry's section.
pub(super) fn entry_section(index: Index, sub: SubIndex) -> String {
    let mut name = object_section(index);
    name.push_str("sub");
    hexadecimal::push(&mut name, sub.0, 1);
    name
}

/// The longest value of a key.
const fn longest(key: &str) -> usize {
    LONGEST_LINE - 1 - key.len()
}

/// Whether readers find the text as it is after a key.
fn fits(key: &str, text: &str) -> bool {
    is_printable(text) && text.len() <= longest(key) && !text.starts_with(' ') && !text.ends_with(' ')
}

/// The lines of a comment, those after the first indented.
fn broken(comment: &str) -> Vec<Cow<'_, str>> {
    // Most are short and plain: their line is the text.
    if is_line(comment) {
        return vec![Cow::Borrowed(comment)];
    }
    let text = in_ascii(comment);
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace().map(|word| word.get(..LONGEST_WORD).unwrap_or(word)) {
        match lines.last_mut() {
            // The `;` counts, and the spaces in front of both words.
            Some(line) if 2 + line.len() + 1 + word.len() <= COMMENT_WIDTH => {
                line.push(' ');
                line.push_str(word);
            }
            Some(_) => lines.push(format!("  {word}")),
            None => lines.push(word.to_owned()),
        }
    }
    lines.into_iter().map(Cow::Owned).collect()
}

/// Whether a comment fits a line as it is, with single spaces between its words.
fn is_line(comment: &str) -> bool {
    is_printable(comment)
        && (1..=COMMENT_WIDTH - 2).contains(&comment.len())
        && !comment.starts_with(' ')
        && !comment.ends_with(' ')
        && !has_two_blanks(comment.as_bytes())
}

/// Whether two spaces follow one another.
fn has_two_blanks(text: &[u8]) -> bool {
    // Without an end in between, the compiler looks at many bytes at once.
    text.iter().zip(text.iter().skip(1)).filter(|pair| *pair == (&b' ', &b' ')).count() > 0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_are_above_headers_and_lines_stay_short() {
        let mut document = Document::default();
        let mut section = SectionWriter::new("A", &[]);
        section.key("Name", "Größe");
        section.value("DefaultValue", "Größe");
        document.push(section.0);
        let mut section = SectionWriter::new("B", &["word ".repeat(60), String::new(), "x".repeat(400)]);
        section.key("Long", "y".repeat(400));
        document.push(section.0);
        let text = document.to_string();
        assert!(text.starts_with("[A]\r\nName=Groesse\r\n\r\n; word word"));
        assert!(text.is_ascii());
        assert!(text.split("\r\n").all(|line| line.len() <= 255 && !line.contains('\n')));
        assert!(text.ends_with("y\r\n"));
        let widths: Vec<usize> =
            text.lines().filter(|line| line.starts_with(';')).map(|line| line.trim_end().len()).collect();
        assert_eq!(widths, [106, 108, 93, 2 + LONGEST_WORD]);
    }
}
