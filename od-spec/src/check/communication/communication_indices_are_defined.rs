//! An object from 1000h to 11FFh is one that CiA 301 or CiA 302 defines.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::standard_objects::from_library::is_from_library;
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::Index;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Objects(check) };

const CODE: &Code = &Code {
    id: "OD0813",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "an index that is reserved",
    explanation: "1000h to 11FFh belong to CiA 301 and 102Ah to CiA 302; the object has an index among them that no standard uses, or that only old devices had: 1004h, \
        100Bh, 100Eh and 100Fh told the number of PDOs, the node-ID and the identifier of node guarding. A later version of the standard may give the \
        index to something else. Move the object to 2000h to 5FFFh, or remove it.",
    clause: Some("CiA 301, table 47 (objects of the communication profile)"),
    example: Some(Example::new(
        "objects:\n  0x100B: {name: node-ID, type: unsigned8, access: ro}",
        "objects:\n  0x2000: {name: node-ID, type: unsigned8, access: ro}",
    )),
};

/// The inhibit time of NMT messages, of CiA 302.
const NMT_INHIBIT_TIME: u16 = 0x102A;

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    // From 1300h on, several standards have objects.
    for object in subject.device.objects.range(Index(0x1000)..Index(0x1200)).map(|(_, object)| object) {
        let index = object.index;
        if is_from_library(object)
            || (subject.standard.object)(index).is_some()
            || index.0 == NMT_INHIBIT_TIME
        {
            continue;
        }
        let message = match index.0 {
            0x1004 | 0x100B | 0x100E | 0x100F => {
                format!("{index} ({}) is reserved; only older devices have it", object.name)
            }
            _ => format!("{index} ({}) lies among the objects of CiA 301, which has none there", object.name),
        };
        findings.push(
            Diagnostic::new(CODE, subject.object_place(object), message)
                .help("move the object to 2000h to 5FFFh, or remove it"),
        );
    }
}
