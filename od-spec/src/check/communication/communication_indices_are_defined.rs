//! An object from 1000h to 1FFFh is one that a standard defines.

use std::ops::RangeInclusive;

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::standard_objects::from_library::CIA302;
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::{Index, SystemSource};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Objects(check) };

const CODE: &Code = &Code {
    id: "OD0813",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "an index that is reserved",
    explanation: "1000h to 1FFFh belong to the standards; the object has an index among them that CiA 301 and CiA 302 do not use, or that only old devices had: 1004h, \
        100Bh, 100Eh and 100Fh held the number of PDOs, the node-ID and the identifier of node guarding. A later version of a standard may give the \
        index to something else. Move the object to 2000h to 5FFFh, or remove it. Where another standard defines it, such as CiA 304, say so under `allow:`.",
    clause: Some("CiA 301, table 47 (objects of the communication profile)"),
    example: Some(Example::new(
        "objects:\n  0x100B: {name: node-ID, type: unsigned8, access: ro}",
        "objects:\n  0x2000: {name: node-ID, type: unsigned8, access: ro}",
    )),
};

/// Objects of CiA 302 that its library does not have: the inhibit time of NMT messages, and programs for the nodes of a manager.
const OF_MANAGERS: [u16; 2] = [0x102A, 0x1F58];
/// Objects of CANopen Safety: its parameters, its messages and their mappings, and their checksums.
const SAFETY: [RangeInclusive<u16>; 3] = [0x1300..=0x1340, 0x1381..=0x13C0, 0x13FE..=0x13FF];

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    // From 1300h on, several standards have objects, and which of them an EDS follows it does not say.
    let end = match subject.system.source {
        SystemSource::Specification => Index(0x2000),
        SystemSource::Eds => Index(0x1200),
    };
    for object in subject.device.objects.range(Index(0x1000)..end).map(|(_, object)| object) {
        let index = object.index;
        let is_defined = || {
            (subject.standard.object)(index).is_some()
                || OF_MANAGERS.contains(&index.0)
                || (subject.standard.in_library)(CIA302, index).is_some()
        };
        if object.profile.is_some() || SAFETY.iter().any(|run| run.contains(&index.0)) || is_defined() {
            continue;
        }
        let message = match index.0 {
            0x1004 | 0x100B | 0x100E | 0x100F => {
                format!("{index} ({}) is reserved; only older devices have it", object.name)
            }
            0x1000..0x1200 => {
                format!("{index} ({}) is among the objects of CiA 301, which defines none there", object.name)
            }
            _ => {
                format!("{index} ({}) is in the area of the standards, 1000h to 1FFFh", object.name)
            }
        };
        findings.push(
            subject
                .object_finding(CODE, object, message)
                .help("move the object to 2000h to 5FFFh, or remove it"),
        );
    }
}
