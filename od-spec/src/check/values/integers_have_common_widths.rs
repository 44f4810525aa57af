//! Integers have a width that every tool knows.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Repeated, Severity};
use crate::model::Fact;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0826",
    severity: Severity::Note,
    foreign: Severity::Note,
    title: "an integer of an unusual width",
    explanation: "CiA 301 has integers of 24, 40, 48 and 56 bits, and few programs support them: no processor has such \
        a type, and often a PLC has none to import them into. Nothing is wrong with the device. Where the width is \
        free, 32 or 64 bits are easier for its users.",
    clause: Some("CiA 301, table 39 (data types)"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: count, type: unsigned24, access: ro}",
        "objects:\n  0x2000: {name: count, type: unsigned32, access: ro}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let mut found = Repeated::new();
    for (id, _, entry) in subject.device.entries() {
        let is_unusual = entry.data_type.bits().is_some_and(|bits| !matches!(bits, 8 | 16 | 32 | 64));
        if !is_unusual || !entry.data_type.is_integer() {
            continue;
        }
        let place = subject.place(entry, Fact::Type);
        found.add(place, [], || {
            let message = format!("{id} ({}) is {}, which few programs know", entry.name, entry.data_type);
            subject
                .finding(CODE, id, entry, Fact::Type, message)
                .help("use 32 or 64 bits where the width is free")
        });
    }
    if let Some(finding) = found.into_diagnostic("entries") {
        findings.push(finding);
    }
}
