//! Pieces of text that know what is a link and which language they are in.

use od_spec::model::{EntryId, Index, Text};

use crate::language::Language;
use crate::view::{Cell, Part, PartKind};

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

    fn push(mut self, part: Part) -> Self {
        if part.text.is_empty() && part.kind != PartKind::Break {
            return self;
        }
        self.text.push_str(if part.kind == PartKind::Break { "\n" } else { &part.text });
        self.parts.push(part);
        self
    }

    /// With a plain text behind it.
    pub(crate) fn text(self, text: impl Into<String>) -> Self {
        self.push(Part::of(PartKind::Text, text))
    }

    /// With a text that stands out.
    pub(crate) fn strong(self, text: impl Into<String>) -> Self {
        self.push(Part::of(PartKind::Strong, text))
    }

    /// With something to be typed or read as it stands.
    pub(crate) fn code(self, text: impl Into<String>) -> Self {
        self.push(Part::of(PartKind::Code, text))
    }

    /// With a link.
    pub(crate) fn link(
        self,
        text: impl Into<String>,
        anchor: impl Into<String>,
        page: impl Into<String>,
    ) -> Self {
        self.push(Part { anchor: anchor.into(), page: page.into(), ..Part::of(PartKind::Link, text) })
    }

    /// With a new line, unless this is the first.
    pub(crate) fn line(self) -> Self {
        if self.is_empty() { self } else { self.push(Part::of(PartKind::Break, "")) }
    }

    /// With another cell behind it.
    pub(crate) fn and(mut self, behind: Cell) -> Self {
        self.text.push_str(&behind.text);
        self.parts.extend(behind.parts);
        self
    }

    /// With a text of the specification behind it.
    pub(crate) fn and_words(self, text: &Text, language: Language<'_>) -> Self {
        let Some(words) = text.get(language.code) else { return self };
        let is_foreign = text.iter().all(|(code, _)| code != language.code) && has_words(words);
        let written_in = text.iter().next().map_or("", |(code, _)| code);
        let marked = if is_foreign { written_in } else { "" };
        self.push(Part { language: marked.to_owned(), ..Part::of(PartKind::Text, words) })
    }
}

impl Part {
    fn of(kind: PartKind, text: impl Into<String>) -> Self {
        Self { kind, text: text.into(), anchor: String::new(), page: String::new(), language: String::new() }
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
