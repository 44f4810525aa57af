//! What is known about the texts of a specification.

use crate::diag::{Diagnostic, codes, shorten};
use crate::model::Index;
use crate::running_text::Numbered;
use crate::source::Span;

/// What a text names.
#[derive(Debug)]
pub(crate) struct TextMention {
    /// The place of the text.
    pub place: Span,
    pub named: Named,
}

/// Something that a text can name.
#[derive(Debug)]
pub(crate) enum Named {
    /// A table, figure or section, with its number.
    Numbered(Numbered, String),
    /// An object.
    Object(Index),
}

/// A text that lacks one of the languages of its specification.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Untranslated {
    /// The place of the text.
    pub place: Span,
    /// The code of the language.
    pub language: String,
}

impl Untranslated {
    /// The finding about this text alone.
    pub fn note(&self) -> Diagnostic {
        let message = format!("this text is not in `{}`", shorten(&self.language));
        Diagnostic::new(codes::ONE_LANGUAGE, self.place, message)
    }
}
