//! Objects that act on another one exist together with it.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::Index;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0887",
    severity: Severity::Warning,
    foreign: Severity::Note,
    title: "an object that acts on one that is not there",
    explanation: "1006h, 1007h and 1019h say how SYNC comes, which needs 1005h; 1015h holds back emergency messages, which need 1014h; 1F51h, 1F56h and 1F57h are about the programs of 1F50h, 1F21h about the files of 1F20h, and dates have times; an NMT master \
        (bit 0 of 1F80h) finds its slaves in 1F81h. Without the other object this one does nothing, and setting it has no effect. Add the other one, or remove this one.",
    clause: Some("CiA 301, objects 1005h to 1007h, 1014h, 1015h and 1019h; CiA 302, objects 1F20h to 1F81h"),
    example: Some(Example::new(
        "objects:\n  0x1015: {from: cia301}",
        "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer, emergency]}\nobjects:\n  0x1015: {from: cia301}",
    )),
};

/// Objects, the ones that they act on, and what these are.
const PARTNERS: [(u16, u16, &str); 13] = [
    (0x1006, 0x1005, "COB-ID of SYNC"),
    (0x1007, 0x1005, "COB-ID of SYNC"),
    (0x1019, 0x1005, "COB-ID of SYNC"),
    (0x1015, 0x1014, "COB-ID of emergency messages"),
    (0x1F21, 0x1F20, "DCF files"),
    (0x1F26, 0x1F27, "time of the configuration"),
    (0x1F27, 0x1F26, "date of the configuration"),
    (0x1F51, 0x1F50, "programs"),
    (0x1F53, 0x1F54, "time of the software"),
    (0x1F54, 0x1F53, "date of the software"),
    (0x1F56, 0x1F50, "programs"),
    (0x1F57, 0x1F50, "programs"),
    (0x1F80, 0x1F81, "list of slaves"),
];
/// Shows whether the device is an NMT master, in bit 0.
const NMT_STARTUP: u16 = 0x1F80;

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let objects = &subject.device.objects;
    for (index, partner, what) in PARTNERS {
        let Some(object) = objects.get(&Index(index)).filter(|_| !objects.contains_key(&Index(partner)))
        else {
            continue;
        };
        if index == NMT_STARTUP && subject.parameter(index, 0).is_none_or(|startup| startup.raw() & 1 == 0) {
            continue;
        }
        let message =
            format!("{} ({}) is there without the {what}, {}", object.index, object.name, Index(partner));
        let help = format!("add {}, or remove {}", Index(partner), object.index);
        findings.push(subject.object_finding(CODE, object, message).help(help));
    }
}
