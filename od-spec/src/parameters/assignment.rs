//! Settings in one text each, as on a command line.

use super::Assignment;
use crate::ast::{DefaultDecl, Reference, SettingDecl};
use crate::diag::{Diagnostic, codes};
use crate::source::{Span, Spanned};
use crate::visible::{is_hidden, turns_text};

/// A text `ENTRY=VALUE`.
///
/// # Errors
/// There is no `=` in it, or an invisible character.
pub(super) fn setting(assignment: &Assignment) -> Result<SettingDecl, Diagnostic> {
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
    Ok(SettingDecl {
        reference: Reference::Whole(Spanned::new(name.trim().to_owned(), name_span)),
        value: Spanned::new(DefaultDecl::One(value.to_owned()), value_span),
        span: *span,
    })
}

/// As in a specification, which cannot hold a control character without an escape.
fn hidden(span: Span, c: char) -> Diagnostic {
    let what = if turns_text(c) { "turns the text around it" } else { "is invisible" };
    Diagnostic::new(codes::TURNED_TEXT, span, format!("found U+{:04X}, which {what}", u32::from(c)))
        .help("remove the character")
}
