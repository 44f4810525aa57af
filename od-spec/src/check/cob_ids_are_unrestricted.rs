//! The COB-ID of a PDO is an 11-bit identifier that no other service has for itself, on every node.

use super::findings::Findings;
use super::pdo::{NO_REMOTE_FRAMES, NOT_VALID, Parameter};
use super::rule::{Check, Needs, Rule};
use super::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Device(check) };

pub(crate) const CODE: &Code = &Code {
    id: "OD0503",
    severity: Severity::Error,
    title: "an unusable COB-ID",
    explanation: "The identifier has more than 11 bits or is kept for NMT, SDO, heartbeat or LSS. A PDO on such an identifier would disturb a service that \
        every device relies on: a PDO with the identifier 0 stops nodes. `cob-id:` is the identifier alone; the flag bits follow from `valid:` and \
        `no-rtr:`. Write a free identifier.",
    clause: Some("CiA 301, table 35 (restricted CAN identifiers)"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {cob-id: $NODEID + 0x600, map: [level]}}}",
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {cob-id: $NODEID + 0x180, map: [level]}}}",
    )),
};

/// CAN identifiers that CiA 301 table 35 keeps from configurable services; 002h to 07Fh since version 4.2.
const RESTRICTED: [std::ops::RangeInclusive<i128>; 8] = [
    0x000..=0x000,
    0x001..=0x07F,
    0x101..=0x180,
    0x581..=0x5FF,
    0x601..=0x67F,
    0x6E0..=0x6E0,
    0x701..=0x77F,
    0x780..=0x7FF,
];

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for pdo in &subject.device.pdos {
        let Some(parameter) = subject.communication(pdo, 1) else { continue };
        if let Some(problem) = subject.nodes().find_map(|node| problem(subject, &parameter, node)) {
            let message = format!("{}: {problem}", parameter.id);
            findings.push(
                Diagnostic::new(CODE, parameter.place, message)
                    .help("write a free identifier; bits 31 (no PDO, `valid: no`) and 30 (no remote frames, `no-rtr: yes`) are flags")
                    .note("CiA 301 table 35: restricted CAN identifiers"),
            );
        }
    }
}

fn problem(subject: &Subject<'_>, parameter: &Parameter<'_>, node: u8) -> Option<String> {
    let raw = parameter.value.integer_for(node)?;
    let id = raw & !(NOT_VALID | NO_REMOTE_FRAMES);
    // A PDO that does not exist needs no identifier.
    if raw & NOT_VALID != 0 && id == 0 {
        return None;
    }
    let on_node = subject.on_node(parameter.value, node);
    if id > 0x7FF {
        return Some(format!("{id:X}h{on_node} is no 11-bit identifier"));
    }
    RESTRICTED
        .iter()
        .any(|restricted| restricted.contains(&id))
        .then(|| format!("{id:03X}h{on_node} is kept for another service"))
}
