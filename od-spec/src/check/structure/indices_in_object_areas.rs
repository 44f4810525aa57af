//! Objects lie in the areas that CiA 301 gives them.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Objects(check) };

/// The code of the rule.
const CODE: &Code = &Code {
    id: "OD0316",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "an index outside the areas for objects",
    explanation: "Objects are at 1000h to BFFFh. 0001h to 0FFFh are data types, C000h and above are reserved. \
        Configuration tools refuse a file with such an object. Give the object an index of the manufacturer's area, \
        2000h to 5FFFh, or the one that its profile has.",
    clause: Some("CiA 301, table 1 (areas of the object dictionary)"),
    example: Some(Example::new(
        "objects:\n  0xC000: {name: level, type: unsigned8, access: ro}",
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for object in subject.device.objects.values() {
        let area = match object.index.0 {
            0x0000..=0x0FFF => "the area of data types",
            0xC000.. => "a reserved area",
            0x1000..=0xBFFF => continue,
        };
        findings.push(
            subject.object_finding(CODE, object, format!("{} lies in {area}", object.index))
                .help("1000h to 1FFFh: communication; 2000h to 5FFFh: manufacturer; 6000h to 9FFFh: device profiles; A000h to BFFFh: network variables"),
        );
    }
}
