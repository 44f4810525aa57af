//! Gaps of a starter that are still open: `odgen new` marks what is the author's to say by `# <--`.

use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::source::{FileId, Span};

/// The comment after a value that the author is to replace.
const MARK: &str = "# <--";
/// Its first sign, which is quickly found.
const SIGN: char = '#';

/// Says which gaps there are.
pub(crate) fn check(file: FileId, text: &str, diagnostics: &mut Diagnostics) {
    let marks = text.match_indices(SIGN).map(|(at, _)| at).filter(|at| text[*at..].starts_with(MARK));
    for at in marks.filter(|at| is_comment(&text[..*at])) {
        let place = |at: usize| u32::try_from(at).unwrap_or(u32::MAX);
        let span = Span { file, start: place(at), end: place(at + MARK.len()) };
        diagnostics.push(
            Diagnostic::new(codes::OPEN_GAP, span, "this is an example; write your own value")
                .help("write your own value, and remove the comment"),
        );
    }
}

/// Whether a sign after this text begins a comment, and not the word of a text.
fn is_comment(before: &str) -> bool {
    let line = before.rsplit('\n').next().unwrap_or(before);
    let is_open = |quote| line.matches(quote).count() % 2 == 1;
    line.is_empty() || line.ends_with([' ', '\t']) && !is_open('"') && !is_open('\'')
}
