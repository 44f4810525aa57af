//! Error codes that bits refer to are in `errors:`, where a specification has such a list.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{Author, System, TypeKind};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::System(check) };

const CODE: &Code = &Code {
    id: "OD0808",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "an error code that is not listed",
    explanation: "A bit refers to an error code that `errors:` does not have, so that the documents cannot say what it means and generated code has no name \
        for it. Add the code to `errors:`, or correct it.",
    clause: None,
    example: Some(Example::new(
        "types:\n  faults: {base: unsigned8, bits: {0: {name: overload, error: 0x2310}}, rest: reserved}\nobjects:\n  0x2000: {name: faults, type: faults, access: ro}\nerrors:\n  0x8110: {name: CAN overrun}",
        "types:\n  faults: {base: unsigned8, bits: {0: {name: overload, error: 0x2310}}, rest: reserved}\nobjects:\n  0x2000: {name: faults, type: faults, access: ro}\nerrors:\n  0x2310: {name: overload}",
    )),
};

fn check(system: &System, findings: &mut Findings) {
    if system.errors.is_empty() {
        return;
    }
    let by_maker = system.types.values().filter(|named| named.stated.author == Author::Maker);
    let fields = by_maker.flat_map(|named| match &named.kind {
        TypeKind::Bits(fields) => fields.as_slice(),
        TypeKind::Enum(_) => &[],
    });
    let of_types = fields.flat_map(|field| &field.errors);
    let of_entries = system.devices.iter().flat_map(|device| {
        let entries = device.entries().map(|(.., entry)| entry);
        let lists = entries.flat_map(|entry| &entry.bit_errors).flat_map(|bit| &bit.codes);
        lists.filter(|code| code.span.file.is_one_with(device.span.file))
    });
    for code in of_types.chain(of_entries) {
        if system.errors.binary_search_by_key(&code.value, |error| error.code).is_err() {
            findings.push(
                Diagnostic::new(CODE, code.span, format!("`errors:` does not list {:04X}h", code.value))
                    .help("add the code to `errors:`, or correct it"),
            );
        }
    }
}
