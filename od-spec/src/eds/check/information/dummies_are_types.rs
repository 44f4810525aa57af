//! Dummies are static data types, and allowed or not.

use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity, shorten};
use crate::eds::names::Topic;
use crate::eds::number::lenient_integer;
use crate::eds::view::{Entry, View};

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS217",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "a dummy that is none",
    explanation: "A dummy fills a gap in a receive PDO; `[DummyUsage]` says for each of the data types 0001h to 0007h whether the \
        device allows it: `Dummy0005=1`. The key has the type in four hexadecimal digits, the value is 0 or 1. Other \
        types cannot be dummies.",
    clause: Some("CiA 306 4.6.2"),
    example: Some(Example::eds(
        "[DummyUsage]\nDummy0001=0\nDummy0002=0\nDummy0003=0\nDummy0004=0\nDummy0005=0\nDummy0006=0\nDummy0007=0\nDummy0008=1",
        "[DummyUsage]\nDummy0001=0\nDummy0002=0\nDummy0003=0\nDummy0004=0\nDummy0005=0\nDummy0006=0\nDummy0007=0",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let Some(part) = view.section(Topic::DummyUsage) else { return };
    for entry in part.entries().filter(|entry| !entry.value.value.is_empty()) {
        let Some(data_type) = data_type(&entry) else { continue };
        let is_used = lenient_integer(entry.value.value);
        let (place, message, help) = if !matches!(is_used, Some(0 | 1)) {
            let message = format!("found `{}`, expected 0 or 1", shorten(entry.value.value));
            (entry.value.span, message, "write 1 if the device allows this dummy, otherwise 0")
        } else if !(1..=7).contains(&data_type) && is_used == Some(1) {
            let message = format!("data type {data_type:04X}h cannot be a dummy");
            (entry.key.span, message, "only the types 0001h to 0007h can; set it to 0")
        } else {
            continue;
        };
        diagnostics.push(Diagnostic::new(CODE, place, message).help(help));
    }
}

/// The type that a key names; one of another form is an unknown key.
fn data_type(entry: &Entry<'_>) -> Option<u16> {
    let (front, digits) = entry.key.value.split_at_checked(5)?;
    let is_dummy = front.eq_ignore_ascii_case("Dummy") && digits.len() == 4;
    u16::from_str_radix(digits, 16).ok().filter(|_| is_dummy)
}
