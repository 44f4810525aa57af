//! The name of a section begins its line.

use super::super::edits;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Edit, Example, Repeated, Severity};
use crate::eds::line::LineKind;
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS106",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "spaces before a section name",
    explanation: "The bracket that opens a section's name is the first character of its line. Python's configparser, \
        which python-canopen and lely's tools use, can take an indented line as the continuation of the value above.",
    clause: Some("CiA 306 4.2"),
    example: Some(Example::eds("  [Comments]\nLines=0", "[Comments]\nLines=0")),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for line in view.document.lines().iter().filter(|line| line.kind() == LineKind::Header) {
        // A mark in front of the text is another rule's.
        let text = line.text();
        let Some(bracket) = text.find('[').filter(|at| *at > 0 && !text.starts_with('\u{FEFF}')) else {
            continue;
        };
        let place = edits::place(view, line);
        found.add(place, [Edit { span: place.part(0, bracket), text: String::new() }], || {
            Diagnostic::new(
                CODE,
                place.part(bracket, text.len()),
                "there are spaces before the section's name",
            )
            .help("begin the line with the bracket; `odgen fix` does")
        });
    }
    found.finish("sections", diagnostics);
}
