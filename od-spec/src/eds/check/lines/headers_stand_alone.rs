//! Nothing follows the name of a section.

use super::super::edits;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Edit, Example, Repeated, Severity, shorten};
use crate::eds::line::LineKind;
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS107",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "text after a section name",
    explanation: "Nothing follows the bracket that closes a section's name; a comment is a line of its own. Some readers then do not see the section and take its keys as keys of the one above.",
    clause: Some("CiA 306 4.2"),
    example: Some(Example::eds(
        "[Comments] nothing to say\nLines=0",
        "; nothing to say\n[Comments]\nLines=0",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for line in view.document.lines().iter().filter(|line| line.kind() == LineKind::Header) {
        let Some((end, words)) = line.after_name() else { continue };
        let text = line.text();
        let place = edits::place(view, line).part(end, text.len());
        let comment = (!words.is_empty()).then(|| edits::above(view, line, &format!("; {words}")));
        let cut = Edit { span: place, text: String::new() };
        found.add(place, comment.into_iter().chain([cut]), || {
            Diagnostic::new(
                CODE,
                place,
                format!(
                    "found `{}` after the section's name, expected the end of the line",
                    shorten(text[end..].trim())
                ),
            )
            .help("make it a comment on a line of its own; `odgen fix` does")
        });
    }
    found.finish("sections", diagnostics);
}
