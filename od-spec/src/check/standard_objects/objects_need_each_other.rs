//! Objects of CiA 301 that mean something only together are there together.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::{Index, Object, Role};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0322",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "an object without its other half",
    explanation: "A PDO has a communication parameter (1400h, 1800h and following) and a mapping parameter (1600h, 1A00h and following); guard time and life time \
        factor (100Ch, 100Dh) make the life time together; 1022h states how 1021h is packed. With one of the two alone a master cannot configure the PDO, \
        watch the node or read the EDS. Add the other object, or remove this one.",
    clause: Some("CiA 301, 9.2.1 (PDOs) and objects 100Ch, 100Dh, 1021h and 1022h"),
    example: Some(Example::new(
        "objects:\n  0x1021: {name: Store EDS, type: domain, access: ro}",
        "objects:\n  0x1021: {name: Store EDS, type: domain, access: ro}\n  0x1022: {name: Storage format, type: unsigned16, access: ro, default: 0}",
    )),
};

/// The object without which this one means nothing, and what that one is.
fn other_half(object: &Object) -> Option<(Index, &'static str)> {
    let at = object.index.0;
    match (object.role(), at) {
        (Role::PdoCommunication, _) => Some((Index(at + 0x200), "mapping parameter")),
        (Role::PdoMapping, _) => Some((Index(at - 0x200), "communication parameter")),
        (_, 0x100C) => Some((Index(0x100D), "life time factor")),
        (_, 0x100D) => Some((Index(0x100C), "guard time")),
        (_, 0x1021) => Some((Index(0x1022), "storage format")),
        (_, 0x1022) => Some((Index(0x1021), "EDS")),
        _ => None,
    }
}

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let device = subject.device;
    for object in device.objects.values() {
        let Some((other, what)) = other_half(object).filter(|(other, _)| !device.objects.contains_key(other))
        else {
            continue;
        };
        let message = format!("{} ({}) is there without the {what} {other}", object.index, object.name);
        findings.push(
            subject
                .object_finding(CODE, object, message)
                .help(format!("add {other}, or remove {}", object.index)),
        );
    }
}
