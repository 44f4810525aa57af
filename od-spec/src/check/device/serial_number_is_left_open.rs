//! A device type has no serial number: each device has its own.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::SystemSource;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0890",
    severity: Severity::Warning,
    foreign: Severity::Note,
    title: "one serial number for all devices",
    explanation: "1018h.4 distinguishes two devices of one type. With a default, every device reports the same number: \
        LSS cannot give them node-IDs, and a master that compares the number takes a replaced device for the old one. \
        Remove the default; firmware fills the number in.",
    clause: Some("CiA 301, object 1018h; CiA 305 (LSS address)"),
    example: Some(Example::new(
        "objects:\n  0x1018: {from: cia301, record: {4: {default: 12345}}}",
        "objects:\n  0x1018: {from: cia301}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    // An EDS may be that of one device.
    if subject.node.is_some() || subject.system.source != SystemSource::Specification {
        return;
    }
    if let Some(serial) = subject.parameter(0x1018, 4).filter(|serial| serial.raw() != 0) {
        let message = format!("{}: all devices have the serial number {}", serial.id, serial.raw());
        findings.push(
            serial.finding(CODE, message).help("remove the default; each device has a number of its own"),
        );
    }
}
