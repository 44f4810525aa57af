//! Placeholders are in RPDOs, and are of types that the device accepts there.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::pdo::parameters::{placeholder, target, title};
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::Direction;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0506",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "a placeholder that the device does not take",
    explanation: "RPDOs may hold placeholders of the types that the device lists in `dummies:`, to skip bits that are meant for another device; \
        TPDOs may not. A placeholder has the length of its type. A device that does not know the placeholder refuses the whole mapping. List the \
        type in `dummies:`, or map entries only.",
    clause: Some("CiA 306, 4.6.2 ([DummyUsage])"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: level, type: unsigned8, access: rw, pdo: receive}\npdos:\n  io: {receive: {1: {map: [unsigned8, level]}}}",
        "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer], dummies: [unsigned8]}\nobjects:\n  0x2000: {name: level, type: unsigned8, access: rw, pdo: receive}\npdos:\n  io: {receive: {1: {map: [unsigned8, level]}}}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for pdo in &subject.device.pdos {
        for parameter in subject.mapping(pdo) {
            let Some(mapped) = target(parameter.raw()) else { continue };
            let Some(data_type) = placeholder(&mapped) else { continue };
            let taken = subject.device.info.dummies.contains(&data_type);
            let problem = match (pdo.direction, data_type.bits()) {
                (Direction::Transmit, _) => "a TPDO has no placeholders".to_owned(),
                (Direction::Receive, _) if !taken => {
                    format!("{} takes no {data_type} placeholder", title(pdo))
                }
                (Direction::Receive, Some(bits)) if bits != u16::from(mapped.bits) => {
                    format!("a placeholder of {data_type} has {bits} bits, not {}", mapped.bits)
                }
                (Direction::Receive, Some(_) | None) => continue,
            };
            let message = format!("{}: {problem}", parameter.id);
            findings.push(
                parameter.finding(CODE, message)
                    .help(subject.help(Help {
                        specification: "list the type in the device's `dummies:`; placeholders are in RPDOs only, in the length of their type",
                        eds: &format!(
                            "write `Dummy{:04X}=1` if the device takes the type; placeholders are in RPDOs only, in the length of their type",
                            data_type.code()
                        ),
                        setting: "map what the device takes; placeholders are in RPDOs only, in the length of their type",
                    })),
            );
        }
    }
}
