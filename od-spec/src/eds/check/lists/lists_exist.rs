//! There are three lists of objects.

use super::super::edits;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity};
use crate::eds::names::{List, Topic};
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS301",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "a list of objects that is missing",
    explanation: "Every object is in one of three lists: `[MandatoryObjects]`, `[OptionalObjects]` or `[ManufacturerObjects]`. \
        A list without objects has `SupportedObjects=0`. lely's tools stop where a list is missing, others find no \
        objects.",
    clause: Some("CiA 306 4.6.1"),
    example: Some(Example::eds("; without [OptionalObjects]", "[OptionalObjects]\nSupportedObjects=0")),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    for list in List::ALL.into_iter().filter(|list| view.list(*list).is_none()) {
        let header = format!("[{}]", list.section());
        let message = format!("there is no list `{header}`");
        let mut diagnostic = Diagnostic::new(CODE, view.start(), message)
            .help("add it, with `SupportedObjects=0` where it is empty; `odgen fix` does");
        let lines = ["", header.as_str(), "SupportedObjects=0"];
        diagnostic.edits.extend(edits::new_section(view, Topic::Objects(list), lines));
        diagnostics.push(diagnostic);
    }
}
