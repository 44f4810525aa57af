//! A comment begins with a semicolon in the first column.

use super::super::edits;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Edit, Example, Repeated, Severity};
use crate::eds::line::LineKind;
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS114",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a comment with another sign",
    explanation: "A comment is a line whose first character is `;`. `#` is a comment for a few readers only; others take the line as a key or cannot read it, and stop.",
    clause: Some("CiA 306 4.2"),
    example: Some(Example::eds(
        "# nothing to say\n[Comments]\nLines=0",
        "; nothing to say\n[Comments]\nLines=0",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for line in view.document.lines().iter().filter(|line| line.kind() == LineKind::Comment) {
        let text = line.text();
        let Some(at) = text.find([';', '#']) else { continue };
        let is_hash = text[at..].starts_with('#');
        if (at == 0 && !is_hash) || text.starts_with('\u{FEFF}') {
            continue;
        }
        let place = edits::place(view, line);
        found.add(place, [Edit { span: place.part(0, at + 1), text: ";".to_owned() }], || {
            let message = if is_hash {
                "the comment begins with `#`, expected `;`"
            } else {
                "there are spaces before the comment"
            };
            Diagnostic::new(CODE, place.part(at, text.len()), message)
                .help("begin the line with `;`; `odgen fix` does")
        });
    }
    found.finish("comments", diagnostics);
}
