//! A list counts its entries.

use super::super::numbered;
use super::super::numbered::NumberedList;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity, shorten};
use crate::eds::number::lenient_integer;
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS302",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "a list with another number of entries",
    explanation: "A list begins with the number of its entries: `SupportedObjects`, `NrOfEntries`, `Lines` or \
        `ObjectLinks`. Readers that go up to that number miss the entries after it, or stop at the first that is not \
        there; lely's tools refuse the file.",
    clause: Some("CiA 306 4.6.3.1"),
    example: Some(Example::eds(
        "[Comments]\nLines=2\nLine1=The only one",
        "[Comments]\nLines=1\nLine1=The only one",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    for (_, list) in numbered::all(view) {
        if let Some(diagnostic) = finding(view, &list) {
            diagnostics.push(diagnostic);
        }
    }
}

fn finding(view: &View<'_>, list: &NumberedList<'_, '_>) -> Option<Diagnostic> {
    let (key, entries) = (list.form.count, list.entries.len());
    let there_are = match entries {
        0 => "there are no entries".to_owned(),
        1 => "there is 1 entry".to_owned(),
        _ => format!("there are {entries} entries"),
    };
    let (place, message) = match list.part.value(key) {
        None => {
            let place = list.part.key(key).map_or(list.part.place(), |entry| entry.key.span);
            (place, format!("`{key}` is missing, and {there_are}"))
        }
        Some(value) => match lenient_integer(value.value) {
            Some(number) if i128::try_from(entries) == Ok(number) => return None,
            Some(number) => (value.span, format!("`{key}` is {number}, but {there_are}")),
            None => (
                value.span,
                format!("found `{}`, expected the number of entries: {entries}", shorten(value.value)),
            ),
        },
    };
    let mut diagnostic = Diagnostic::new(CODE, place, message);
    // Where an entry has no number of its own, the numbers come first.
    if list.form.numbers == numbered::Numbers::Place || list.is_in_sequence() {
        diagnostic.edits.extend(list.count_as(view, entries));
        return Some(diagnostic.help(format!("write `{key}={entries}`; `odgen fix` does")));
    }
    Some(diagnostic.help("number the entries 1, 2, 3 and so on, and count them"))
}
