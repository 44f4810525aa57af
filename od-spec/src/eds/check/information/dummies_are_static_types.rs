//! Dummies are the static data types 0001h to 0007h.

use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Repeated, Severity};
use crate::eds::names::Topic;
use crate::eds::number::lenient_integer;
use crate::eds::view::{Entry, Part, View};

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS219",
    severity: Severity::Warning,
    foreign: Severity::Note,
    title: "a dummy of another type",
    explanation: "CiA 301 lets a receive PDO be filled with the data types 0001h to 0007h: BOOLEAN and the integers of 8, 16 and \
        32 bits. lely's tools, as masters, allow themselves longer ones. A device that says so must be able to skip \
        them.",
    clause: Some("CiA 306 4.6.2"),
    example: Some(Example::eds(
        "[DummyUsage]\nDummy0001=0\nDummy0002=0\nDummy0003=0\nDummy0004=0\nDummy0005=0\nDummy0006=0\nDummy0007=0\nDummy0008=1",
        "[DummyUsage]\nDummy0001=0\nDummy0002=0\nDummy0003=0\nDummy0004=0\nDummy0005=0\nDummy0006=0\nDummy0007=0",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for entry in view.section(Topic::DummyUsage).into_iter().flat_map(Part::entries) {
        let Some(data_type) = data_type(&entry).filter(|data_type| !(1..=7).contains(data_type)) else {
            continue;
        };
        if lenient_integer(entry.value.value) == Some(1) {
            found.add(entry.key.span, [], || {
                let message = format!("data type {data_type:04X}h is allowed as a dummy");
                Diagnostic::new(CODE, entry.key.span, message)
                    .help("only the types 0001h to 0007h can be; set it to 0")
            });
        }
    }
    found.finish("types", diagnostics);
}

/// The type that a key names; one of another form is an unknown key.
fn data_type(entry: &Entry<'_>) -> Option<u16> {
    let (front, digits) = entry.key.value.split_at_checked(5)?;
    let is_dummy = front.eq_ignore_ascii_case("Dummy") && digits.len() == 4;
    u16::from_str_radix(digits, 16).ok().filter(|_| is_dummy)
}
