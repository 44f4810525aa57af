//! The file says that it follows version 4 of the standard.

use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity, shorten};
use crate::eds::names::Topic;
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS209",
    severity: Severity::Error,
    foreign: Severity::Note,
    title: "an unknown or old version of the format",
    explanation: "`EDSVersion` says which version of the format the file follows: `4.0`, three characters. Without the \
        key it counts as 3.0, which had other keys. Makers write `4`, `404` or `4.04` and mean 4.0; readers that act \
        on the version understand those as another version.",
    clause: Some("CiA 306 4.4"),
    example: Some(Example::eds("[FileInfo]\nEDSVersion=404\n; ...", "[FileInfo]\nEDSVersion=4.0\n; ...")),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let Some(part) = view.section(Topic::FileInfo) else { return };
    let Some(value) = part.value("EDSVersion") else {
        let place = part.key("EDSVersion").map_or(part.place(), |entry| entry.key.span);
        let message = "`EDSVersion` is missing, which counts as 3.0";
        diagnostics.push(Diagnostic::new(CODE, place, message).help(HELP));
        return;
    };
    let text = shorten(value.value);
    let message = match value.value.as_bytes() {
        [b'4'..=b'9', b'.', b'0'..=b'9'] => return,
        [b'0'..=b'3', b'.', b'0'..=b'9'] => format!("`EDSVersion` is {text}, an old version of the format"),
        _ => format!("found `{text}`, expected a version such as 4.0 as `EDSVersion`"),
    };
    diagnostics.push(Diagnostic::new(CODE, value.span, message).help(HELP));
}

const HELP: &str = "write `EDSVersion=4.0` if the file follows CiA 306 of 2005 or later";
