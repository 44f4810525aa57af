//! Version and revision of the file are small numbers.

use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity, shorten};
use crate::eds::names::Topic;
use crate::eds::number::{Deviation, help, integer};
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS208",
    severity: Severity::Error,
    foreign: Severity::Note,
    title: "a file version that is not a number",
    explanation: "`FileVersion` and `FileRevision` are two numbers of 0 to 255. Texts such as `1.0`, `v1` or `-` are shown by most \
        tools and understood by none; CANopenNode's editor has refused such files. Write version 1.2 as `FileVersion=1` \
        and `FileRevision=2`.",
    clause: Some("CiA 306 4.4"),
    example: Some(Example::eds("[FileInfo]\nFileVersion=v1\n; ...", "[FileInfo]\nFileVersion=1\n; ...")),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let Some(part) = view.section(Topic::FileInfo) else { return };
    for key in ["FileVersion", "FileRevision"] {
        let Some(value) = part.value(key) else { continue };
        let number = integer(value.value);
        let is_small = number.is_some_and(|number| {
            (0..=0xFF).contains(&number.value) && !number.deviations.contains(&Deviation::Fraction)
        });
        if !is_small {
            let message =
                format!("found `{}`, expected a number of 0 to 255 as `{key}`", shorten(value.value));
            diagnostics.push(
                Diagnostic::new(CODE, value.span, message).help(help(value.value, "write a whole number")),
            );
        }
    }
}
