//! An array or record has an entry other than sub-index 0.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::Role;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Objects(check) };

const CODE: &Code = &Code {
    id: "OD0314",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "an array or record without entries",
    explanation: "An ARRAY or RECORD has at least one element or member other than sub-index 0: otherwise there is nothing that the number of entries could count, and tools refuse the \
        object. Add an entry, or make the object a VAR.",
    clause: Some("CiA 301, table 37 (object codes)"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: schedule, record: {}}",
        "objects:\n  0x2000: {name: schedule, record: {1: {name: start, type: unsigned8, access: rw}}}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for object in subject.device.objects.values().filter(|object| object.is_structured()) {
        // That a fixed mapping maps nothing is said of the PDO.
        let is_fixed_mapping = object.role() == Role::PdoMapping
            && object.entries.iter().all(|entry| !entry.access.is_writable());
        // Modules bring the elements of a bus coupler.
        let is_of_modules = subject.device.is_of_modules(object.index);
        if object.counted().next().is_none() && !is_fixed_mapping && !is_of_modules {
            let message = format!("{} has no entry other than sub-index 0", object.index);
            findings.push(
                subject
                    .object_finding(CODE, object, message)
                    .help("an array or record has at least one element or member"),
            );
        }
    }
}
