//! A file is changed after it was made.

use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity};
use crate::eds::dates::{date, date_text};
use crate::eds::names::Topic;
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS211",
    severity: Severity::Warning,
    foreign: Severity::Note,
    title: "a file that was changed before it was made",
    explanation: "`ModificationDate` is earlier than `CreationDate`. One of the two is a mistake, often day and month the wrong \
        way round: the month comes first.",
    clause: Some("CiA 306 4.4"),
    example: Some(Example::eds(
        "[FileInfo]\nCreationDate=01-31-2020\nModificationDate=01-30-2020\n; ...",
        "[FileInfo]\nCreationDate=01-31-2020\nModificationDate=01-31-2020\n; ...",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let Some(part) = view.section(Topic::FileInfo) else { return };
    let (Some(created), Some(modified)) = (part.value("CreationDate"), part.value("ModificationDate")) else {
        return;
    };
    if let (Some(first), Some(last)) = (date(created.value), date(modified.value))
        && last < first
    {
        let message = format!(
            "the file was changed on {}, before it was made on {}",
            date_text(last),
            date_text(first)
        );
        diagnostics.push(
            Diagnostic::new(CODE, modified.span, message)
                .label("changed")
                .with(created.span, "made")
                .help("correct one of the two; the month comes first"),
        );
    }
}
