//! The file says of every possible dummy whether it is allowed.

use super::super::edits;
use super::super::enumeration::enumeration;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity};
use crate::eds::names::Topic;
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS218",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "dummies that are not mentioned",
    explanation: "A data type that `[DummyUsage]` does not mention is not a dummy, which is right by the standard. \
        python-canopen asks for all seven, `Dummy0001` to `Dummy0007`, and stops at the first that is missing. Add the \
        others with the value 0.",
    clause: Some("CiA 306 4.6.2"),
    example: Some(Example::eds(
        "[DummyUsage]\nDummy0005=1",
        "[DummyUsage]\nDummy0001=0\nDummy0002=0\nDummy0003=0\nDummy0004=0\nDummy0005=1\nDummy0006=0\nDummy0007=0",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let Some(part) = view.section(Topic::DummyUsage) else { return };
    let missing: Vec<String> = (1..=7)
        .map(|data_type| format!("Dummy{data_type:04X}"))
        .filter(|key| part.key(key).is_none())
        .collect();
    let Some(section) = part.sections.first().filter(|_| !missing.is_empty()) else { return };
    let lines: Vec<String> = missing.iter().map(|key| format!("{key}=0")).collect();
    let message = format!("`[DummyUsage]` does not mention {}", enumeration(&missing));
    let mut diagnostic =
        Diagnostic::new(CODE, part.place(), message).help("add them with 0; `odgen fix` does");
    diagnostic.edits.push(edits::below(view, edits::last_line(section), lines.iter().map(String::as_str)));
    diagnostics.push(diagnostic);
}
