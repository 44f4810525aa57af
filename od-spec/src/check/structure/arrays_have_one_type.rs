//! All elements of an ARRAY have one data type.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::{EntryId, Fact, ObjectKind};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Objects(check) };

/// The code of the rule.
const CODE: &Code = &Code {
    id: "OD0315",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "an array of several types",
    explanation: "All elements of an ARRAY have one data type; a tool that reads the first takes the others for the same. Make the object a RECORD, \
        or correct the type.",
    clause: Some("CiA 301, table 37 (object codes)"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: inputs, array: {count: 2, name: \"input {n}\", type: unsigned8, access: ro, elements: {2: {type: unsigned16}}}}",
        "objects:\n  0x2000: {name: inputs, array: {count: 2, name: \"input {n}\", type: unsigned8, access: ro}}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for object in subject.device.objects.values().filter(|object| object.kind == ObjectKind::Array) {
        let mut elements = object.counted();
        let Some(first) = elements.next().map(|element| element.data_type) else { continue };
        if let Some(element) = elements.find(|element| element.data_type != first) {
            let (index, sub, data_type) = (object.index, element.sub, element.data_type);
            findings.push(
                subject
                    .finding(
                        CODE,
                        EntryId { index, sub },
                        element,
                        Fact::Type,
                        format!("{index}.{sub} ({}) is {data_type}, the first element {first}", element.name),
                    )
                    .help("all elements of an array have one data type; make the object a record")
                    .note("CiA 301 table 37: ARRAY"),
            );
        }
    }
}
