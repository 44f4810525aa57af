//! Characters of a YAML text that are not what they look like.

use std::ops::Range;

use crate::diag::{Diagnostic, Diagnostics, codes, shorten};
use crate::source::{FileId, Span};
use crate::text::look_alike::{Disguise, disguised};
use crate::visible::turning;

/// Reports characters that hide what a text says, wherever they are, in comments, too.
pub(super) fn check(id: FileId, text: &str, diagnostics: &mut Diagnostics) {
    refuse_turned_text(id, text, diagnostics);
    report_disguised_words(id, text, diagnostics);
}

/// Refuses characters that make the text around them look like another, wherever they are, also in comments.
fn refuse_turned_text(id: FileId, text: &str, diagnostics: &mut Diagnostics) {
    for (at, c) in turning(text) {
        let span = span_in(id, at..at + c.len_utf8());
        diagnostics.push(turned(span, c).edit(span, ""));
    }
}

/// Reports words in which characters look like others, or like nothing.
fn report_disguised_words(id: FileId, text: &str, diagnostics: &mut Diagnostics) {
    for found in disguised(text) {
        let (code, word) = (u32::from(found.character), shorten(found.word));
        let (message, help) = match found.disguise {
            Disguise::Latin(letter) => (
                format!("`{word}` has U+{code:04X}, which looks like `{letter}`"),
                "write the Latin letter; a name with another one is another name",
            ),
            Disguise::Invisible => (
                format!("`{word}` has U+{code:04X}, which cannot be seen"),
                "remove the character; a name with it is another name",
            ),
        };
        let (start, end) = (found.start, found.start + found.word.len());
        diagnostics.push(
            Diagnostic::new(codes::DISGUISED, span_in(id, start..end), message)
                .help(help)
                .edit(span_in(id, start..end), found.plain()),
        );
    }
}

fn span_in(file: FileId, range: Range<usize>) -> Span {
    let place = |at: usize| u32::try_from(at).unwrap_or(u32::MAX);
    Span { file, start: place(range.start), end: place(range.end) }
}

pub(super) fn turned(span: Span, c: char) -> Diagnostic {
    let message = format!("found U+{:04X}, which turns the text around it", u32::from(c));
    Diagnostic::new(codes::TURNED_TEXT, span, message)
        .label("what is seen here is not what is written")
        .help("remove the character; letters of every script have a direction of their own")
}
