//! The transmission type of a PDO is one that CiA 301 defines for its direction.

use crate::check::findings::Findings;
use crate::check::pdo::parameters::title;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::Direction;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0505",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "a reserved transmission type",
    explanation: "0 to 240 are synchronous, 254 and 255 event-driven, 252 and 253 answer remote frames (TPDOs only); 241 to 251 are reserved. A device \
        refuses a reserved type with abort code 0609 0030h, or behaves unpredictably. Write one of the defined types.",
    clause: Some("CiA 301, table 56 (transmission types)"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {transmission: 245, map: [level]}}}",
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {transmission: 255, map: [level]}}}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for pdo in &subject.device.pdos {
        let Some(parameter) = subject.communication(pdo, 2) else { continue };
        let reserved = match pdo.direction {
            Direction::Receive => 241..=253,
            Direction::Transmit => 241..=251,
        };
        let transmission = parameter.raw();
        if reserved.contains(&transmission) {
            let message =
                format!("{}: transmission type {transmission} is reserved for {}", parameter.id, title(pdo));
            findings.push(
                parameter.finding(CODE, message)
                    .help("0 to 240: synchronous; 254 and 255: event-driven; 252 and 253: on remote frames, TPDOs only")
                    .note("CiA 301 table 56"),
            );
        }
    }
}
