//! There are sections for dummy mapping and for comments, even if they say nothing.

use super::super::edits;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity};
use crate::eds::names::{Topic, canonical};
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS202",
    severity: Severity::Warning,
    foreign: Severity::Note,
    title: "a section that the standard wants",
    explanation: "Everything that the standard does not call optional is mandatory: so are `[DummyUsage]` and `[Comments]`. \
        Without them nothing is lost: no dummy can be mapped, and there is no comment. Some editors of EDS files still \
        expect them.",
    clause: Some("CiA 306 4.6.2 and 4.6.5"),
    example: Some(Example::eds("; without [Comments]", "[Comments]\nLines=0")),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    const DUMMIES: [&str; 9] = [
        "",
        "[DummyUsage]",
        "Dummy0001=0",
        "Dummy0002=0",
        "Dummy0003=0",
        "Dummy0004=0",
        "Dummy0005=0",
        "Dummy0006=0",
        "Dummy0007=0",
    ];
    const COMMENTS: [&str; 3] = ["", "[Comments]", "Lines=0"];
    for (topic, lines) in [(Topic::DummyUsage, &DUMMIES[..]), (Topic::Comments, &COMMENTS[..])] {
        if view.section(topic).is_some() {
            continue;
        }
        let name = canonical(topic).unwrap_or_default();
        let message = format!("there is no section `[{name}]`");
        let mut diagnostic =
            Diagnostic::new(CODE, view.start(), message).help("add it; `odgen fix` does, with nothing in it");
        diagnostic.edits.extend(edits::new_section(view, topic, lines.iter().copied()));
        diagnostics.push(diagnostic);
    }
}
