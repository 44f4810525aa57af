//! Dates and times are such, month first and with AM or PM.

use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Edit, Example, Severity, shorten};
use crate::eds::dates::{date, date_text, time, time_text};
use crate::eds::names::Topic;
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS210",
    severity: Severity::Error,
    foreign: Severity::Note,
    title: "a date or time in another notation",
    explanation: "Dates are `mm-dd-yyyy`, times `hh:mmAM` or `hh:mmPM`, with two digits each. In another order, 02-03 cannot be distinguished from 03-02. What cannot be misunderstood, such as a year in front, the name of a month or a day above 12, is fixed by `odgen fix`.",
    clause: Some("CiA 306 4.4"),
    example: Some(Example::eds(
        "[FileInfo]\nCreationDate=2020-01-31\n; ...",
        "[FileInfo]\nCreationDate=01-31-2020\n; ...",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let Some(part) = view.section(Topic::FileInfo) else { return };
    for key in ["CreationDate", "ModificationDate"] {
        let Some(value) = part.value(key) else { continue };
        let plain = date(value.value).map(date_text);
        if plain.as_deref() == Some(value.value) {
            continue;
        }
        let message =
            format!("found `{}`, expected a date such as 01-31-2020 as `{key}`", shorten(value.value));
        diagnostics.push(mended(Diagnostic::new(CODE, value.span, message), plain));
    }
    for key in ["CreationTime", "ModificationTime"] {
        let Some(value) = part.value(key) else { continue };
        let plain = time(value.value).map(time_text);
        if plain.as_deref() == Some(value.value) {
            continue;
        }
        let message = format!("found `{}`, expected a time such as 09:45AM as `{key}`", shorten(value.value));
        diagnostics.push(mended(Diagnostic::new(CODE, value.span, message), plain));
    }
}

fn mended(mut diagnostic: Diagnostic, text: Option<String>) -> Diagnostic {
    let Some(text) = text else {
        return diagnostic.help("write it as in the standard: two digits each, month first");
    };
    let span = diagnostic.labels.first().map(|label| label.span);
    let help = format!("write `{text}`; `odgen fix` does");
    diagnostic.edits.extend(span.map(|span| Edit { span, text }));
    diagnostic.help(help)
}
