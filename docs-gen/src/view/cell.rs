//! Pieces of text that know what is a link and which language they are in.

use od_spec::model::{EntryId, Index, Text};
use serde::Serialize;
use serde::ser::{SerializeStruct, Serializer};

use crate::language::Language;
/// Lists of up to so many parts take no more memory than they need; longer ones grow in larger steps.
const FEW: usize = 8;

/// The contents of a cell, or another piece of text. A document has very many, most of them one plain text.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Cell {
    /// The text alone; lines are separated by line breaks.
    pub text: String,
    /// What its parts are; nothing where it is one plain text, or empty.
    pub(crate) spans: Vec<Span>,
    /// Who says it.
    pub stated: Stated,
}

/// Who says what is in a [`Cell`].
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Stated {
    /// The maker: the printed manual, or what follows from it.
    #[default]
    Manual,
    /// A standard, and the maker does not.
    Standard,
    /// Neither: it is assumed.
    Assumed,
}

/// What a part of a [`Cell`] is, and where it ends in the text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Span {
    pub end: usize,
    pub kind: PartKind,
    pub anchor: Box<str>,
    pub page: Box<str>,
    pub language: Box<str>,
}

/// A part of a [`Cell`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Part<'a> {
    /// What it is.
    pub kind: PartKind,
    /// The text; empty for a break.
    pub text: &'a str,
    /// Anchor that a link leads to.
    pub anchor: &'a str,
    /// Page that has the anchor, where pages are small.
    pub page: &'a str,
    /// Language of the text, where it is not that of the document.
    pub language: &'a str,
}

/// What a [`Part`] is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum PartKind {
    /// Running text.
    Text,
    /// Emphasized text.
    Strong,
    /// To be typed or read as it is.
    Code,
    /// A link.
    Link,
    /// A new line.
    Break,
}

impl Cell {
    /// A plain text.
    pub(crate) fn plain(text: impl Into<String>) -> Self {
        Self { text: text.into(), ..Self::default() }
    }

    /// A text of the specification, with arrows for `->`; where it is in another language, that is marked.
    pub(crate) fn words(text: &Text, language: Language<'_>) -> Self {
        Self::in_own_language(text, language, |words| words.replace("->", "→"))
    }

    /// The same character by character.
    pub(crate) fn quoted(text: &Text, language: Language<'_>) -> Self {
        Self::in_own_language(text, language, str::to_owned)
    }

    fn in_own_language(text: &Text, language: Language<'_>, print: fn(&str) -> String) -> Self {
        let Some(words) = text.get(language.code) else { return Self::default() };
        let is_foreign = text.iter().all(|(code, _)| code != language.code) && has_words(words);
        let written_in = text.iter().next().map_or("", |(code, _)| code);
        Self::default().in_language(&print(words), if is_foreign { written_in } else { "" })
    }

    /// The same as the word of this author, if it has words.
    pub(crate) fn stated(self, stated: Stated) -> Self {
        if self.is_empty() { self } else { Self { stated, ..self } }
    }

    /// Nothing to show.
    pub(crate) const fn is_empty(&self) -> bool {
        self.text.is_empty()
    }

    /// The same in parts.
    pub fn parts(&self) -> impl Iterator<Item = Part<'_>> {
        let plain = (self.spans.is_empty() && !self.text.is_empty()).then_some(Part {
            kind: PartKind::Text,
            text: &self.text,
            anchor: "",
            page: "",
            language: "",
        });
        let mut start = 0;
        plain.into_iter().chain(self.spans.iter().map(move |span| {
            let text = &self.text[start..span.end];
            start = span.end;
            Part {
                kind: span.kind,
                text: if span.kind == PartKind::Break { "" } else { text },
                anchor: &span.anchor,
                page: &span.page,
                language: &span.language,
            }
        }))
    }

    /// Whether it is a list of links, with hardly any text around them.
    fn is_list_of_links(&self) -> bool {
        let count = |is_link| {
            let parts = self.parts().filter(move |part| (part.kind == PartKind::Link) == is_link);
            parts.map(|part| part.text.chars().filter(|sign| sign.is_alphanumeric()).count())
        };
        count(true).count() > 1 && count(false).sum::<usize>() < count(true).sum()
    }

    /// With a text after it; `span` says what it is, except for its end.
    fn push(mut self, text: &str, span: Span) -> Self {
        if text.is_empty() {
            return self;
        }
        let is_plain = span == Span::plain(0);
        if !(self.is_empty() && is_plain) {
            self.spell_out();
            self.make_room();
            self.spans.push(Span { end: self.text.len() + text.len(), ..span });
        }
        self.text.push_str(text);
        self
    }

    /// One plain text becomes a part, so that others can be next to it.
    fn spell_out(&mut self) {
        if self.spans.is_empty() && !self.is_empty() {
            self.make_room();
            self.spans.push(Span::plain(self.text.len()));
        }
    }

    fn make_room(&mut self) {
        if self.spans.len() < FEW {
            self.spans.reserve_exact(1);
        }
    }

    /// With a plain text after it.
    pub(crate) fn text(self, text: impl AsRef<str>) -> Self {
        self.push(text.as_ref(), Span::plain(0))
    }

    /// With a text that is emphasized.
    pub(crate) fn strong(self, text: impl AsRef<str>) -> Self {
        self.push(text.as_ref(), Span { kind: PartKind::Strong, ..Span::plain(0) })
    }

    /// With something to be typed or read as it is.
    pub(crate) fn code(self, text: impl AsRef<str>) -> Self {
        self.push(text.as_ref(), Span { kind: PartKind::Code, ..Span::plain(0) })
    }

    /// With a link.
    pub(crate) fn link(
        self,
        text: impl AsRef<str>,
        anchor: impl Into<Box<str>>,
        page: impl Into<Box<str>>,
    ) -> Self {
        let span = Span { kind: PartKind::Link, anchor: anchor.into(), page: page.into(), ..Span::plain(0) };
        self.push(text.as_ref(), span)
    }

    /// With a new line, unless this is the first.
    pub(crate) fn line(self) -> Self {
        if self.is_empty() { self } else { self.push("\n", Span { kind: PartKind::Break, ..Span::plain(0) }) }
    }

    /// With a plain text, in another language where one is named.
    pub(crate) fn in_language(self, text: &str, language: &str) -> Self {
        self.push(text, Span { language: language.into(), ..Span::plain(0) })
    }

    /// All of it in another language, where one is named.
    pub(crate) fn all_in_language(mut self, language: &str) -> Self {
        if !language.is_empty() {
            self.spell_out();
        }
        for span in &mut self.spans {
            span.language = language.into();
        }
        self
    }

    /// With another cell after it.
    pub(crate) fn and(mut self, mut behind: Cell) -> Self {
        if behind.is_empty() {
            return self;
        }
        if self.is_empty() {
            return Self { stated: self.stated, ..behind };
        }
        self.spell_out();
        behind.spell_out();
        let start = self.text.len();
        self.text.push_str(&behind.text);
        self.spans.extend(behind.spans.into_iter().map(|span| Span { end: start + span.end, ..span }));
        self
    }
}

impl Span {
    /// A plain text up to there.
    fn plain(end: usize) -> Self {
        Self {
            end,
            kind: PartKind::Text,
            anchor: Box::default(),
            page: Box::default(),
            language: Box::default(),
        }
    }
}

impl Serialize for Cell {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        /// The parts as a list.
        struct Parts<'a>(&'a Cell);
        impl Serialize for Parts<'_> {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.collect_seq(self.0.parts())
            }
        }
        let mut cell = serializer.serialize_struct("Cell", 4)?;
        cell.serialize_field("text", &self.text)?;
        cell.serialize_field("parts", &Parts(self))?;
        cell.serialize_field("links", &self.is_list_of_links())?;
        cell.serialize_field("stated", &self.stated)?;
        cell.end()
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
        let language = |code| {
            Cell::words(&text, Language { code, words: od_spec::wording::Language::of(code) })
                .parts()
                .next()
                .map(|part| part.language.to_owned())
        };
        assert_eq!(language("en").as_deref(), Some(""));
        assert_eq!(language("de").as_deref(), Some("en"));
    }

    #[test]
    fn parts_make_up_the_text() {
        let tail = Cell::plain("of ").strong("Ä").line().code("1");
        let cell = Cell::default().and(Cell::plain("bit ")).text("").link("3", "6041.b3", "pmc").and(tail);
        assert_eq!(cell.text, "bit 3of Ä\n1");
        let parts: Vec<_> = cell.parts().map(|part| (part.kind, part.text, part.anchor)).collect();
        let expected = [
            (PartKind::Text, "bit ", ""),
            (PartKind::Link, "3", "6041.b3"),
            (PartKind::Text, "of ", ""),
            (PartKind::Strong, "Ä", ""),
            (PartKind::Break, "", ""),
            (PartKind::Code, "1", ""),
        ];
        assert_eq!(parts, expected);
        assert_eq!(Cell::plain("").parts().count(), 0);
        let plain = Cell::plain("lamp");
        assert_eq!(
            plain.parts().collect::<Vec<_>>(),
            plain.clone().all_in_language("").parts().collect::<Vec<_>>()
        );
    }

    #[test]
    fn anchors_are_plain() {
        assert_eq!(slug("Übersicht (4.1): 24V supply"), "uebersicht-4-1-24v-supply");
        let id = EntryId { index: Index(0x30FA), sub: od_spec::model::SubIndex(3) };
        assert_eq!(entry_anchor(id), "30FA.3");
    }
}
