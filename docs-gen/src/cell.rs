//! Pieces of text that know what is a link and which language they are in.

use od_spec::model::{EntryId, Index, Text};

use crate::language::Language;
use crate::view::{Cell, Part};

impl Cell {
    /// A plain text.
    pub(crate) fn plain(text: impl Into<String>) -> Self {
        Self::default().text(text)
    }

    /// A text of the specification; where it is in another language, that is marked.
    pub(crate) fn words(text: &Text, language: Language<'_>) -> Self {
        Self::default().and_words(text, language)
    }

    /// The same as the word of a standard that the maker does not repeat.
    pub(crate) fn standard(self, standard: bool) -> Self {
        Self { standard, ..self }
    }

    /// Nothing to show.
    pub(crate) fn is_empty(&self) -> bool {
        self.parts.is_empty()
    }

    fn push(
        mut self,
        kind: &'static str,
        text: String,
        anchor: String,
        page: String,
        language: String,
    ) -> Self {
        if text.is_empty() && kind != "break" {
            return self;
        }
        self.text.push_str(if kind == "break" { "\n" } else { &text });
        self.parts.push(Part { kind, text, anchor, page, language });
        self
    }

    /// With a plain text behind it.
    pub(crate) fn text(self, text: impl Into<String>) -> Self {
        self.push("text", text.into(), String::new(), String::new(), String::new())
    }

    /// With something to be typed or read as it stands.
    pub(crate) fn code(self, text: impl Into<String>) -> Self {
        self.push("code", text.into(), String::new(), String::new(), String::new())
    }

    /// With a link.
    pub(crate) fn link(
        self,
        text: impl Into<String>,
        anchor: impl Into<String>,
        page: impl Into<String>,
    ) -> Self {
        self.push("link", text.into(), anchor.into(), page.into(), String::new())
    }

    /// With a new line, unless this is the first.
    pub(crate) fn line(self) -> Self {
        if self.is_empty() {
            self
        } else {
            self.push("break", String::new(), String::new(), String::new(), String::new())
        }
    }

    /// With another cell behind it.
    pub(crate) fn and(mut self, other: Cell) -> Self {
        self.text.push_str(&other.text);
        self.parts.extend(other.parts);
        self
    }

    /// With a text of the specification behind it.
    pub(crate) fn and_words(self, text: &Text, language: Language<'_>) -> Self {
        let Some(words) = text.get(language.code) else { return self };
        let other = text.iter().all(|(code, _)| code != language.code);
        let code =
            if other && has_words(words) { text.iter().next().map_or("", |(code, _)| code) } else { "" };
        self.push("text", words.to_owned(), String::new(), String::new(), code.to_owned())
    }
}

/// Whether a text has words: three letters in a row, of which one is small. `0..3`, `6040h` and `PDO` are the same in every
/// language.
fn has_words(text: &str) -> bool {
    text.split(|sign: char| !sign.is_alphabetic())
        .any(|word| word.chars().count() >= 3 && word.chars().any(char::is_lowercase))
}

/// Where links to an object lead: `6040`.
pub(crate) fn object_anchor(index: Index) -> String {
    format!("{:04X}", index.0)
}

/// Where links to an entry lead: `3020.5`, or `6040` for sub-index 0.
pub(crate) fn entry_anchor(id: EntryId) -> String {
    if id.sub.0 == 0 { object_anchor(id.index) } else { format!("{:04X}.{}", id.index.0, id.sub) }
}

/// A name as part of an anchor or file name: lower case, `-` between words.
pub(crate) fn slug(name: &str) -> String {
    let ascii = od_spec::ascii::transliterate(name).to_lowercase();
    let words: Vec<&str> =
        ascii.split(|sign: char| !sign.is_ascii_alphanumeric()).filter(|word| !word.is_empty()).collect();
    words.join("-")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_in_another_language_is_marked() {
        let text = Text::new([("en", "lamp")]);
        assert_eq!(Cell::words(&text, Language { code: "en" }).parts[0].language, "");
        assert_eq!(Cell::words(&text, Language { code: "de" }).parts[0].language, "en");
    }

    #[test]
    fn anchors_are_plain() {
        assert_eq!(slug("Übersicht (4.1): 24V supply"), "uebersicht-4-1-24v-supply");
        let id = EntryId { index: Index(0x30FA), sub: od_spec::model::SubIndex(3) };
        assert_eq!(entry_anchor(id), "30FA.3");
    }
}
