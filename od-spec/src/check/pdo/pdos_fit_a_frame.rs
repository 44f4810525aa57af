//! A PDO maps no more than 64 bits.

use crate::check::findings::Findings;
use crate::check::pdo::parameters::{target, title};
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{Dictionary, Mapped, PdoTarget};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0507",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "a PDO over 64 bits",
    explanation: "A PDO is one CAN frame and holds 64 bits; a device answers a longer mapping with abort code 0604 0042h. Map fewer entries, or 16-bit \
        aliases of 32-bit entries.",
    clause: Some("CiA 301, objects 1600h and 1A00h (PDO mapping parameters)"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: counter, type: unsigned64, access: ro, pdo: transmit}\n  0x2001: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {map: [counter, level]}}}",
        "objects:\n  0x2000: {name: counter, type: unsigned64, access: ro, pdo: transmit}\n  0x2001: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {map: [counter]}, 2: {map: [level]}}}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for pdo in &subject.device.pdos {
        let mapped: Vec<Mapped> =
            subject.mapped(pdo).filter_map(|parameter| target(parameter.raw())).collect();
        let bits: u32 = mapped.iter().map(|mapped| u32::from(mapped.bits)).sum();
        if bits > 64 {
            let parts: Vec<String> = mapped.iter().map(|mapped| mapped.bits.to_string()).collect();
            findings.push(
                Diagnostic::new(
                    CODE,
                    subject.mapping_place(pdo),
                    format!("{} carries {bits} bits", title(pdo)),
                )
                .label(format!("{} bits; a PDO holds 64", parts.join(" + ")))
                .help(
                    narrower(subject.device, &mapped)
                        .unwrap_or_else(|| "move entries to another PDO".to_owned()),
                ),
            );
        }
    }
}

/// Proposes the narrower view that would make a mapping fit best.
fn narrower(device: &Dictionary, map: &[Mapped]) -> Option<String> {
    let total: u32 = map.iter().map(|mapped| u32::from(mapped.bits)).sum();
    map.iter().find_map(|mapped| {
        let PdoTarget::Entry(id) = mapped.target else { return None };
        let (view_id, _, view) = device
            .entries()
            .find(|(_, _, entry)| entry.alias.as_ref().is_some_and(|alias| alias.target == id))?;
        let bits = total - u32::from(mapped.bits) + u32::from(view.data_type.bits()?);
        let data_type = view.data_type.name();
        Some(format!("{view_id} is {id} as {data_type}: mapping it instead makes {bits}"))
    })
}
