//! An object with sub-indices counts them.

use super::super::edits;
use super::super::object_form::{Form, described, form, number};
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Repeated, Severity};
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS423",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "an object that does not count its sub-indices",
    explanation: "An ARRAY or RECORD says how many sub-indices it has: `SubNumber`, those that have a section, or \
        `CompactSubObj`, the elements of an array that are all alike. Without it, lely's tools find none, and it is \
        unknown whether sections are missing.",
    clause: Some("CiA 306 4.6.3.2"),
    example: Some(Example::eds(
        "[2000]\nParameterName=levels\nObjectType=0x8\n\n[2000sub0]\nParameterName=highest\nDataType=0x0005\nAccessType=const\nDefaultValue=1\n\n[2000sub1]\nParameterName=level\nDataType=0x0005\nAccessType=ro",
        "[2000]\nParameterName=levels\nObjectType=0x8\nSubNumber=2\n\n[2000sub0]\nParameterName=highest\nDataType=0x0005\nAccessType=const\nDefaultValue=1\n\n[2000sub1]\nParameterName=level\nDataType=0x0005\nAccessType=ro",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for (index, object) in &view.objects {
        let Some(part) = object.object.as_ref().filter(|_| form(object) == Some(Form::Structured)) else {
            continue;
        };
        let is_missing = |key: &str| part.value(key).is_none() || number(part, key) == Some(0);
        if !is_missing("SubNumber") || !is_missing("CompactSubObj") {
            continue;
        }
        let count = described(object);
        let edit = (count > 0).then(|| edits::set(view, part, "SubNumber", &count.to_string())).flatten();
        found.add(part.place(), edit, || {
            if count == 0 {
                let message = format!("{index} is an ARRAY or RECORD and has no sub-indices");
                return Diagnostic::new(CODE, part.place(), message).help("describe its sub-indices");
            }
            Diagnostic::new(
                CODE,
                part.place(),
                format!("{index} does not say how many sub-indices it has: {count}"),
            )
            .help(format!("write `SubNumber={count}`; `odgen fix` does"))
        });
    }
    found.finish("objects", diagnostics);
}
