//! Every line is empty, a comment, a section name, or a key with a value.

use super::super::edits;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Repeated, Severity, shorten};
use crate::eds::line::LineKind;
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS108",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "a line that cannot be read",
    explanation: "A line is empty, a comment that begins with `;`, the name of a section in brackets, or a key, `=` \
        and a value. Everything else makes Python's configparser refuse the file, and is dropped silently by others. \
        Often it is the second line of a text that was broken: a value is one line.",
    clause: Some("CiA 306 4.2"),
    example: Some(Example::eds(
        "[Comments]\nLines=1\nLine1=A text that\ngoes on",
        "[Comments]\nLines=2\nLine1=A text that\nLine2=goes on",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for line in view.document.lines().iter().filter(|line| line.kind() == LineKind::Unreadable) {
        let place = edits::place(view, line);
        found.add(place, [], || {
            let text = shorten(line.text().trim());
            Diagnostic::new(
                CODE,
                place,
                format!("found `{text}`, expected a key with a value, a section or a comment"),
            )
            .help("complete the line, or make it a comment with `;` in front")
        });
    }
    found.finish("lines", diagnostics);
}
