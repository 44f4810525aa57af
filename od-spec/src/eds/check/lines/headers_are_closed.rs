//! The name of a section is between two brackets.

use super::super::edits;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Edit, Example, Severity, shorten};
use crate::eds::line::LineKind;
use crate::eds::names::{Topic, topic};
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS105",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "a section name without its bracket",
    explanation: "The line that begins a section has a bracket on both sides of the name. Where one is missing, \
        readers stop, or they ignore the line and take the keys below it as keys of the section above. It is read as \
        the section that its name means.",
    clause: Some("CiA 306 4.2"),
    example: Some(Example::eds("[Comments\nLines=0", "[Comments]\nLines=0")),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    for line in view.document.lines().iter().filter(|line| line.kind() == LineKind::Header) {
        let text = line.text();
        let place = edits::place(view, line);
        let Some(part) = line.name_part() else { continue };
        let edit = match (text.contains('['), text.contains(']')) {
            (true, true) => continue,
            (true, false) => Edit { span: place.part(part.end as usize, text.len()), text: "]".to_owned() },
            (false, _) => Edit { span: place.part(0, part.start as usize), text: "[".to_owned() },
        };
        let name = line.name().unwrap_or_default();
        let message = format!("`{}` lacks a bracket, expected `[{}]`", shorten(text.trim()), shorten(name));
        let mut diagnostic = Diagnostic::new(CODE, place, message).help("put the name between brackets");
        if topic(name) != Topic::Unknown {
            diagnostic.edits.push(edit);
        }
        diagnostics.push(diagnostic);
    }
}
