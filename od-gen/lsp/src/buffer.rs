//! A text that is open in an editor.

use lsp_types::{TextDocumentContentChangeEvent, Uri};
use od_spec::encoding::decode;

use super::position::{Encoding, Lines};

/// A text that is open in an editor: what is in its file does not count.
#[derive(Debug, Clone)]
pub(super) struct Buffer {
    /// How the client calls it.
    pub uri: Uri,
    /// The version that the client gave to this text.
    pub version: i32,
    /// The text as the editor shows it.
    pub text: String,
    /// How the file is stored, if the editor has read it in another way.
    stored: Option<Stored>,
}

/// The file of a text that an editor has read in another encoding.
#[derive(Debug, Clone)]
struct Stored {
    encoding: &'static str,
    /// Its characters beyond ASCII.
    characters: String,
}

/// The characters beyond ASCII.
fn beyond_ascii(text: &str) -> String {
    text.chars().filter(|c| !c.is_ascii()).collect()
}

/// The characters of ASCII, without line breaks, which an editor may have its own for.
fn within_ascii(text: &str) -> impl Iterator<Item = char> {
    text.chars().filter(|c| c.is_ascii() && !matches!(c, '\r' | '\n'))
}

impl Buffer {
    /// A text that was opened.
    pub(super) const fn new(uri: Uri, version: i32, text: String) -> Self {
        Self { uri, version, text, stored: None }
    }

    /// The text of an EDS, DCF, XDD or XDC, whose file holds these bytes: notes whether the editor has read them in another encoding.
    pub(super) fn compare(&mut self, bytes: Vec<u8>) {
        let Ok((text, encoding)) = decode(bytes) else { return };
        let characters = beyond_ascii(&text);
        let is_other =
            characters != beyond_ascii(&self.text) && within_ascii(&text).eq(within_ascii(&self.text));
        self.stored = is_other.then(|| Stored { encoding: encoding.name(), characters });
    }

    /// The encoding of the file and the first character that the editor may show wrong, if it has read the file in another one.
    pub(super) fn misread(&self) -> Option<(&'static str, usize)> {
        let stored = self.stored.as_ref().filter(|stored| stored.characters != beyond_ascii(&self.text))?;
        Some((stored.encoding, self.text.find(|c: char| !c.is_ascii())?))
    }

    /// Makes changes in their order, each in the text that the one before it left. A change without a range is a new text.
    pub(super) fn change(&mut self, changes: Vec<TextDocumentContentChangeEvent>, encoding: Encoding) {
        for change in changes {
            let Some(range) = change.range else {
                self.text = change.text;
                continue;
            };
            let lines = Lines::of(&self.text);
            let start = lines.offset(&self.text, range.start, encoding);
            let end = lines.offset(&self.text, range.end, encoding);
            self.text.replace_range(start.min(end)..end.max(start), &change.text);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::str::FromStr as _;

    use lsp_types::{Position, Range};

    use super::*;

    type Place = (u32, u32);

    fn changed(text: &str, changes: &[(Place, Place, &str)]) -> String {
        let uri = Uri::from_str("untitled:a").unwrap();
        let mut buffer = Buffer::new(uri, 1, text.to_owned());
        let at = |(line, character)| Position { line, character };
        let event = |(start, end, text): &(Place, Place, &str)| TextDocumentContentChangeEvent {
            range: Some(Range { start: at(*start), end: at(*end) }),
            range_length: None,
            text: (*text).to_owned(),
        };
        buffer.change(changes.iter().map(event).collect(), Encoding::Utf16);
        buffer.text
    }

    #[test]
    fn changes_are_made_one_after_the_other() {
        assert_eq!(changed("°C\r\nb", &[((0, 1), (0, 2), "F"), ((0, 2), (1, 0), " ")]), "°F b");
        assert_eq!(changed("ab", &[((0, 1), (0, 1), "🌀"), ((0, 3), (0, 4), "")]), "a🌀");
    }

    #[test]
    fn ranges_that_do_not_fit_change_what_is_nearest() {
        assert_eq!(changed("ab\ncd", &[((0, 9), (7, 7), "!")]), "ab!");
        // The end before the start.
        assert_eq!(changed("abc", &[((0, 2), (0, 1), "-")]), "a-c");
        assert_eq!(changed("", &[((3, 3), (3, 3), "x")]), "x");
    }
}
