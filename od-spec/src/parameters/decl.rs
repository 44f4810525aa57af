//! Settings as they are written: on a command line, in a list, or as the entries of a YAML map.

use super::Assignment;
use crate::ast::{DefaultDecl, Name};
use crate::diag::{Diagnostic, codes};
use crate::source::{Span, Spanned};
use crate::visible::{is_hidden, turns_text};

/// A setting as it is written: which entry, and its value.
#[derive(Debug, Clone)]
pub struct SettingDecl {
    /// The entry.
    pub(super) reference: Reference,
    /// The value.
    pub(super) value: Spanned<DefaultDecl>,
    /// Where the setting stands.
    pub(super) span: Span,
}

/// How a setting names its entry.
#[derive(Debug, Clone)]
pub(super) enum Reference {
    /// In one text: `607D.2`, `position limits.upper`.
    Whole(Name),
    /// An object, and one of its entries below it.
    Member {
        /// The object, by index or name.
        object: Name,
        /// The entry, by sub-index or name.
        entry: Name,
    },
}

impl SettingDecl {
    /// A key of a YAML map with its value. What stands below the name of an object are values of its entries.
    pub(crate) fn of_key(key: &Name, value: &Spanned<DefaultDecl>) -> Vec<Self> {
        let one = |reference, key: &Name, value: &Spanned<DefaultDecl>| Self {
            reference,
            value: value.clone(),
            span: key.span.to(value.span),
        };
        match &value.value {
            DefaultDecl::ByDevice(members) => members
                .iter()
                .map(|(entry, value)| {
                    let reference = Reference::Member { object: key.clone(), entry: entry.clone() };
                    one(reference, entry, value)
                })
                .collect(),
            DefaultDecl::One(_) | DefaultDecl::Each(_) => {
                vec![one(Reference::Whole(key.clone()), key, value)]
            }
        }
    }

    /// A text `ENTRY=VALUE`.
    ///
    /// # Errors
    /// There is no `=` in it, or a character that nobody sees.
    pub(super) fn of_assignment(assignment: &Assignment) -> Result<Self, Diagnostic> {
        let Assignment { value: text, span } = assignment;
        if let Some((at, c)) = text.char_indices().find(|(_, c)| is_hidden(*c)) {
            return Err(hidden(span.part(at, at + c.len_utf8()), c));
        }
        let Some((name, value)) = text.split_once('=') else {
            let message = format!("found `{text}`, expected ENTRY=VALUE");
            return Err(Diagnostic::new(codes::BAD_ASSIGNMENT, *span, message)
                .help("write an index or a name, `=`, and a value: `607D.2=9000`"));
        };
        let name_span = span.part(0, name.len());
        let value_span = span.part(name.len() + 1, text.len());
        Ok(Self {
            reference: Reference::Whole(Spanned::new(name.trim().to_owned(), name_span)),
            value: Spanned::new(DefaultDecl::One(value.to_owned()), value_span),
            span: *span,
        })
    }
}

/// As in a specification, which cannot hold a control character without an escape.
fn hidden(span: Span, c: char) -> Diagnostic {
    let what = if turns_text(c) { "turns the text around it" } else { "nobody sees" };
    Diagnostic::new(codes::TURNED_TEXT, span, format!("found U+{:04X}, which {what}", u32::from(c)))
        .help("remove the character")
}
