//! A value of an enum is one of those that the enum lists and the device supports, or a special one.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{Fact, TypeKind, Value};
use crate::source::Span;
use crate::wording::format_value;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

/// The code of the rule.
pub(crate) const CODE: &Code = &Code {
    id: "OD0403",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "not a value of the enum",
    explanation: "The entry's type lists its values; this one is not among them, or is one that the device does not \
        support (`supported: no`). A device refuses a mode or command that it does not know, with abort code 0609 \
        0030h, and it starts with a value that it has. Write the name of a value, add the value to the type, or make \
        it `special` at the entry.",
    clause: None,
    example: Some(Example::new(
        "types:\n  mode: {base: unsigned16, values: {0: off, 1: on}}\nobjects:\n  0x2000: {name: mode, type: mode, access: rw}\n  0x2001: {name: short mode, alias: mode, type: unsigned8}\n# --set 2001=2",
        "types:\n  mode: {base: unsigned16, values: {0: off, 1: on}}\nobjects:\n  0x2000: {name: mode, type: mode, access: rw}\n  0x2001: {name: short mode, alias: mode, type: unsigned8}\n# --set 2001=1",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for (id, entry, value) in subject.values() {
        let Some(TypeKind::Enum(values)) = entry.named_type.as_ref().map(|named| &named.kind) else {
            continue;
        };
        // What a view shows of another entry's value is not a value of its own.
        if entry.alias.is_some() && !entry.is_set() {
            continue;
        }
        let is_special = |raw: i128| entry.special.iter().any(|special| special.value == raw);
        let is_supported = |raw: i128| values.of(raw).is_some_and(|listed| listed.supported);
        let mut raw = subject.nodes_of(value).filter_map(|node| value.integer_for(node));
        let Some(stranger) = raw.find(|raw| !is_special(*raw) && !is_supported(*raw)) else { continue };
        let is_listed = values.of(stranger).is_some();
        let (message, specification) = if is_listed {
            let shown = format_value(entry, &Value::Integer(stranger));
            (
                format!("{id} ({}): {shown} is a value that the device does not support", entry.name),
                "write a supported value, or remove `supported: no`",
            )
        } else {
            (
                format!("{id} ({}): {stranger} is not a value of its enum", entry.name),
                "write the name of a value, or add the value to the type",
            )
        };
        let help = subject.help(Help {
            specification,
            eds: "write one of its values, or correct the comment",
            setting: "write one of its values; the device refuses any other",
        });
        // Where a library says the value, it is the maker's type that does not fit.
        let places = [Fact::Default, Fact::Type].map(|fact| subject.place(entry, fact));
        let is_makers = |place: &&Span| **place != subject.device.span && **place != entry.span;
        let place = places.iter().find(is_makers).unwrap_or(&places[0]);
        findings.push(
            subject.seen_through(
                id,
                Diagnostic::new(CODE, *place, message).about((id, Fact::Default)).help(help),
            ),
        );
    }
}
