//! A dummy is allowed or not.

use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Repeated, Severity, shorten};
use crate::eds::names::Topic;
use crate::eds::number::{help, lenient_integer};
use crate::eds::view::{Part, View};

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS217",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "a dummy that is neither allowed nor not",
    explanation: "A dummy fills a gap in a receive PDO; `[DummyUsage]` says for a data type whether the device allows it: \
        `Dummy0005=1`. The value is 1 or 0.",
    clause: Some("CiA 306 4.6.2"),
    example: Some(Example::eds(
        "[DummyUsage]\nDummy0001=0\nDummy0002=0\nDummy0003=0\nDummy0004=0\nDummy0005=yes\nDummy0006=0\nDummy0007=0",
        "[DummyUsage]\nDummy0001=0\nDummy0002=0\nDummy0003=0\nDummy0004=0\nDummy0005=0\nDummy0006=0\nDummy0007=0",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for entry in view.section(Topic::DummyUsage).into_iter().flat_map(Part::entries) {
        let value = entry.value;
        if value.value.is_empty() || matches!(lenient_integer(value.value), Some(0 | 1)) {
            continue;
        }
        found.add(value.span, [], || {
            let message = format!("found `{}`, expected 0 or 1", shorten(value.value));
            Diagnostic::new(CODE, value.span, message)
                .help(help(value.value, "write 1 if the device allows this dummy, otherwise 0"))
        });
    }
    found.finish("dummies", diagnostics);
}
