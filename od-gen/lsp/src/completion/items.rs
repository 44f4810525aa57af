//! What is written already, and what is put in its place.

use lsp_types::{
    CompletionItem, CompletionItemKind, CompletionTextEdit, Documentation, InsertTextFormat, MarkupContent,
    MarkupKind, Position, Range, TextEdit,
};
use od_import::yaml::spelled;
use od_spec::source::Span;

use super::MARK;

/// The word that is being completed.
#[derive(Debug)]
pub(super) struct Written {
    /// Where it begins and ends in the text, without the mark.
    pub start: usize,
    pub end: usize,
    /// Its text up to the cursor.
    pub before: String,
    /// Its text behind the cursor.
    pub behind: String,
    /// The quote in which it stands.
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
        let (before, behind) = word.split_once(MARK).unwrap_or((word, ""));
        let (before, behind) = if (span.start as usize) < line_start || (span.end as usize) > line_end {
            let line = marked.get(start..end).unwrap_or_default();
            line.split_once(MARK).unwrap_or((line, ""))
        } else {
            (before, behind)
        };
        Self {
            start,
            end: end.saturating_sub(MARK.len_utf8()).max(start),
            before: before.to_owned(),
            behind: behind.to_owned(),
            quote,
            follows,
        }
    }
}

/// Something that could stand there.
#[derive(Debug)]
pub(super) struct Offer {
    /// What is shown.
    pub label: String,
    pub kind: CompletionItemKind,
    /// Shown beside it.
    pub detail: Option<String>,
    /// Markdown about it.
    pub about: Option<String>,
    /// What is put in.
    pub insert: Insert,
    /// How far up it stands; the lowest first.
    pub rank: u8,
    /// What stands before the part of the word that it completes.
    pub kept: String,
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
        let (detail, about, kept) = (None, None, String::new());
        Self { label: text.to_owned(), kind, detail, about, insert, rank: 5, kept }
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

    /// The item as the protocol has it, in the place of what is written.
    pub(super) fn into_item(self, written: &Written, position: impl Fn(usize) -> Position) -> CompletionItem {
        let (new_text, format) = match self.insert {
            Insert::Scalar(text) => (quoted(&text, written.quote), InsertTextFormat::PLAIN_TEXT),
            Insert::Raw(text) => (text, InsertTextFormat::PLAIN_TEXT),
            Insert::Snippet(text) => (text, InsertTextFormat::SNIPPET),
        };
        // Editors compare what is written, quote included, with the beginning of this text.
        let quote = written.quote.map(String::from).unwrap_or_default();
        let filter_text = format!("{quote}{}{}", self.kept, self.label);
        let filter_text = (filter_text != self.label).then_some(filter_text);
        let range = Range { start: position(written.start), end: position(written.end) };
        let documentation = self
            .about
            .map(|value| Documentation::MarkupContent(MarkupContent { kind: MarkupKind::Markdown, value }));
        CompletionItem {
            sort_text: Some(format!("{}{}", self.rank, self.label.to_lowercase())),
            label: self.label,
            kind: Some(self.kind),
            detail: self.detail,
            documentation,
            filter_text,
            text_edit: Some(CompletionTextEdit::Edit(TextEdit { range, new_text })),
            insert_text_format: Some(format),
            ..CompletionItem::default()
        }
    }
}

/// A text as a scalar, in the quotes that stand there already.
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
