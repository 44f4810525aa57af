//! What can be mapped has a PDO to be mapped into.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{Direction, Fact, Index};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0802",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "mappable, but no PDO",
    explanation: "Entries of the device can be mapped in a direction in which it has no PDO; a strict checker calls the EDS faulty, and a PLC offers the user \
        something that cannot be done. Describe the PDOs under `pdos:`. The communication profile's own objects (1000h to 1FFFh) are mappable on \
        every device and do not count.",
    clause: Some("CiA 306, 4.6.3.2 (PDOMapping)"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}",
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {map: [level]}}}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let device = subject.device;
    for direction in [Direction::Receive, Direction::Transmit] {
        if device.pdos_of(direction).next().is_some() {
            continue;
        }
        let mut mappable = device
            .entries()
            .filter(|(id, _, entry)| !id.index.is_communication_profile() && entry.pdo.allows(direction));
        if let Some((id, _, entry)) = mappable.next() {
            let message =
                format!("{id} can be mapped into {}s, but `{}` has none", direction.pdo(), device.key);
            let (communication, mapping) = match direction {
                Direction::Receive => (Index(0x1400), Index(0x1600)),
                Direction::Transmit => (Index(0x1800), Index(0x1A00)),
            };
            findings.push_each(Diagnostic::new(CODE, subject.place(entry, Fact::Mapping), message).help(
                subject.help(Help {
                    specification: &format!("describe the device's {}s under `pdos:`", direction.pdo()),
                    eds: &format!("add the device's {}s, from {communication} and {mapping} on, or write `PDOMapping=0`", direction.pdo()),
                    setting: &format!("the device has to have {}s", direction.pdo()),
                }),
            ));
        }
    }
}
