//! Values hold no control characters.

use super::super::edits;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Repeated, Severity};
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS123",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "a control character",
    explanation: "A control character inside a line cannot be seen, and readers do different things with it: a NUL ends the text \
        for those written in C. It usually comes from a text that was copied out of a program's memory.",
    clause: Some("CiA 306 4.2"),
    example: Some(Example::eds("[Comments]\nLines=1\nLine1=Beep", "[Comments]\nLines=1\nLine1=Beep")),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for line in view.document.lines() {
        let Some(at) = line.text().bytes().position(is_control) else { continue };
        // The breaks between empty lines; and the DOS end-of-file sign after the text does no harm.
        if line.number() > 1 || line.text().trim_start_matches('\u{1A}').is_empty() {
            continue;
        }
        let place = edits::place(view, line).part(at, at + 1);
        let byte = line.text().as_bytes()[at];
        found.add(place, [], || {
            Diagnostic::new(CODE, place, format!("the line holds the control character {byte:#04X}"))
                .help("remove the character")
        });
    }
    found.finish("lines", diagnostics);
}

const fn is_control(byte: u8) -> bool {
    byte.is_ascii_control() && byte != b'\t'
}
