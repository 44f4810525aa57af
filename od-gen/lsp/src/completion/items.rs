//! What is written already, and what is put in its place.

use lsp_types::{
    CompletionItem, CompletionItemKind, CompletionItemLabelDetails, CompletionTextEdit, Documentation,
    InsertTextFormat, MarkupContent, MarkupKind, Position, Range, TextEdit,
};
use od_import::yaml::spelled;
use od_spec::model::Access;
use od_spec::source::Span;

use super::{Insertion, MARK};

/// The word that is being completed.
#[derive(Debug)]
pub(super) struct Written {
    /// Where it begins and ends in the text, without the mark.
    pub start: usize,
    pub end: usize,
    /// Its text up to the cursor.
    pub before: String,
    /// Its text after the cursor.
    pub after: String,
    /// The quote around it.
    pub quote: Option<char>,
    /// What follows it on its line.
    pub follows: char,
}

impl Written {
    /// The word that a scalar of a marked text is; only the line of the cursor counts.
    pub(super) fn of(marked: &str, word: &str, span: Span, cursor: usize) -> Self {
        let quote = marked[span.start as usize..].chars().next().filter(|c| matches!(c, '"' | '\''));
        let line_start = marked[..cursor].rfind(['\n', '\r']).map_or(0, |at| at + 1);
        let line_end = marked[cursor..].find(['\n', '\r']).map_or(marked.len(), |at| cursor + at);
        let start = (span.start as usize).max(line_start);
        let end = (span.end as usize).min(line_end);
        let follows = marked[end..].chars().find(|c| *c != ' ').unwrap_or('\n');
        let (before, after) = word.split_once(MARK).unwrap_or((word, ""));
        let (before, after) = if (span.start as usize) < line_start || (span.end as usize) > line_end {
            let line = marked.get(start..end).unwrap_or_default();
            line.split_once(MARK).unwrap_or((line, ""))
        } else {
            (before, after)
        };
        Self {
            start,
            end: end.saturating_sub(MARK.len_utf8()).max(start),
            before: before.to_owned(),
            after: after.to_owned(),
            quote,
            follows,
        }
    }
}

/// Something that can be written there.
#[derive(Debug)]
pub(super) struct Offer {
    /// What is shown.
    pub label: String,
    pub kind: CompletionItemKind,
    /// Shown next to it.
    pub detail: Option<String>,
    /// Markdown about it.
    pub about: Option<String>,
    /// What is put in.
    pub insert: Insert,
    /// Its place in the list: the lowest first.
    pub rank: u8,
    /// Its place among those of the same rank; by label if that is equal.
    pub order: usize,
    /// The text before the part of the word that it completes.
    pub kept: String,
    /// Another text that finds it: the symbol of a unit, the name of a number.
    pub also: Option<String>,
    /// Whether a value follows, which can be completed next.
    pub goes_on: bool,
}

/// What is put in.
#[derive(Debug)]
pub(super) enum Insert {
    /// A text as a scalar, in quotes where it needs them.
    Scalar(String),
    /// A text as it is.
    Raw(String),
    /// A snippet.
    Snippet(String),
}

impl Offer {
    /// A name.
    pub(super) fn name(text: &str, kind: CompletionItemKind) -> Self {
        let insert = Insert::Scalar(text.to_owned());
        Self {
            label: text.to_owned(),
            kind,
            detail: None,
            about: None,
            insert,
            rank: 5,
            order: 0,
            kept: String::new(),
            also: None,
            goes_on: false,
        }
    }

    /// A word that needs no quotes.
    pub(super) fn word(text: &str, kind: CompletionItemKind) -> Self {
        Self { insert: Insert::Raw(text.to_owned()), ..Self::name(text, kind) }
    }

    pub(super) fn detail(mut self, detail: impl Into<String>) -> Self {
        self.detail = Some(detail.into()).filter(|detail| !detail.is_empty());
        self
    }

    pub(super) fn about(mut self, about: Option<String>) -> Self {
        self.about = about;
        self
    }

    pub(super) const fn rank(mut self, rank: u8) -> Self {
        self.rank = rank;
        self
    }

    pub(super) fn also(mut self, text: impl Into<String>) -> Self {
        self.also = Some(text.into());
        self
    }

    /// The text by which editors find it: they compare it with what is written, quote included.
    fn filter_text(&self, written: &Written) -> String {
        let quote = written.quote.map(String::from).unwrap_or_default();
        let part = written.before.strip_prefix(self.kept.as_str()).unwrap_or(&written.before).to_lowercase();
        let begins = |text: &String| !part.is_empty() && text.to_lowercase().starts_with(&part);
        let text = self.also.as_ref().filter(|also| !begins(&self.label) && begins(also));
        format!("{quote}{}{}", self.kept, text.unwrap_or(&self.label))
    }

    /// The item as the protocol has it, in the place of what is written.
    pub(super) fn into_item(
        self,
        written: &Written,
        client: &Insertion,
        position: impl Fn(usize) -> Position,
    ) -> CompletionItem {
        let filter_text = self.filter_text(written);
        let filter_text = (filter_text != self.label).then_some(filter_text);
        let (text, format) = match self.insert {
            Insert::Scalar(text) => (quoted(&text, written.quote), InsertTextFormat::PLAIN_TEXT),
            Insert::Raw(text) => (text, InsertTextFormat::PLAIN_TEXT),
            Insert::Snippet(text) => (text, InsertTextFormat::SNIPPET),
        };
        // Some editors cut a plain text at its first space.
        let is_cut = client.snippets && format == InsertTextFormat::PLAIN_TEXT && text.contains(' ');
        let (new_text, format) =
            if is_cut { (as_snippet(&text), InsertTextFormat::SNIPPET) } else { (text, format) };
        let range = Range { start: position(written.start), end: position(written.end) };
        let documentation = self
            .about
            .map(|value| Documentation::MarkupContent(MarkupContent { kind: MarkupKind::Markdown, value }));
        CompletionItem {
            sort_text: Some(format!("{}{:03}{}", self.rank, self.order, self.label.to_lowercase())),
            command: client.next.clone().filter(|_| self.goes_on),
            label: self.label,
            kind: Some(self.kind),
            // Editors show the one in each line of the list, or the other about the chosen line.
            label_details: self.detail.clone().map(|detail| CompletionItemLabelDetails {
                description: Some(detail),
                ..CompletionItemLabelDetails::default()
            }),
            detail: self.detail,
            documentation,
            filter_text,
            text_edit: Some(CompletionTextEdit::Edit(TextEdit { range, new_text })),
            insert_text_format: Some(format),
            ..CompletionItem::default()
        }
    }
}

/// The access types, the one of constants last.
pub(super) fn access_types() -> Vec<Offer> {
    let words = Access::WORDS.iter().enumerate().map(|(order, word)| Offer {
        order: if *word == Access::Const.word() { Access::WORDS.len() } else { order },
        ..Offer::word(word, CompletionItemKind::KEYWORD)
    });
    words.collect()
}

/// A text as a snippet without places for the cursor.
fn as_snippet(text: &str) -> String {
    text.replace('\\', r"\\").replace('$', r"\$").replace('}', r"\}")
}

/// A text as a scalar, in the quotes that are written already.
fn quoted(text: &str, quote: Option<char>) -> String {
    match quote {
        Some('\'') => format!("'{}'", text.replace('\'', "''")),
        Some(_) => {
            let spelled = spelled(text);
            if spelled.starts_with('"') {
                spelled
            } else {
                format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
            }
        }
        None => spelled(text),
    }
}
