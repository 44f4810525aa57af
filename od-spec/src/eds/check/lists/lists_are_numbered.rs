//! The entries of a list are numbered 1, 2, 3 and so on.

use super::super::numbered;
use super::super::numbered::Numbers;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity, shorten};
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS303",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "a list with gaps",
    explanation: "The entries of a list have the numbers 1, 2, 3 and so on, in decimal and without gaps. Readers count up to the \
        number of entries: what follows a gap is lost, and of two entries with one number one is. In which order \
        the entries are does not matter.",
    clause: Some("CiA 306 4.6.3.1"),
    example: Some(Example::eds(
        "[Comments]\nLines=2\nLine1=First\nLine3=Last",
        "[Comments]\nLines=2\nLine1=First\nLine2=Last",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    for (_, list) in numbered::all(view) {
        if list.form.numbers != Numbers::Order || list.is_in_sequence() {
            continue;
        }
        let Some((at, (_, entry))) = (1..).zip(&list.entries).find(|(at, (number, _))| number != at) else {
            continue;
        };
        let prefix = list.form.prefix;
        let message = format!("found `{}`, expected `{prefix}{at}`", shorten(entry.key.value));
        let mut diagnostic = Diagnostic::new(CODE, entry.key.span, message)
            .help("number the entries 1, 2, 3 and so on; `odgen fix` does");
        diagnostic.edits = list.rewritten(view, &list.repeated(), &[]);
        diagnostics.push(diagnostic);
    }
}
