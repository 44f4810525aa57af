//! `SubNumber` is the number of sub-indices that have a section.

use super::super::edits;
use super::super::object_form::{Form, described, form};
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Edit, Example, Repeated, Severity, shorten};
use crate::eds::number::lenient_integer;
use crate::eds::view::{ObjectPart, View};

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS424",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "a wrong number of sub-indices",
    explanation: "`SubNumber` counts the sub-indices that have a section, sub-index 0 included and FFh not. It is not the highest \
        sub-index: where some are left out, it is smaller. Zencan and lely's dcfchk refuse a file where it is wrong; \
        others look for sub-indices that are not there.",
    clause: Some("CiA 306 4.6.3.2"),
    example: Some(Example::eds(
        "[2000]\nParameterName=levels\nObjectType=0x8\nSubNumber=1\n\n[2000sub0]\nParameterName=highest\nDataType=0x0005\nAccessType=const\nDefaultValue=1\n\n[2000sub1]\nParameterName=level\nDataType=0x0005\nAccessType=ro",
        "[2000]\nParameterName=levels\nObjectType=0x8\nSubNumber=2\n\n[2000sub0]\nParameterName=highest\nDataType=0x0005\nAccessType=const\nDefaultValue=1\n\n[2000sub1]\nParameterName=level\nDataType=0x0005\nAccessType=ro",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for (index, object) in &view.objects {
        let Some(part) = object.object.as_ref().filter(|_| form(object) == Some(Form::Structured)) else {
            continue;
        };
        let Some(value) = part.value("SubNumber") else { continue };
        let (declared, count) = (lenient_integer(value.value), described(object));
        if declared == Some(count) || declared == Some(0) {
            continue;
        }
        let text = || edits::number_like(value.value, count);
        let edit = (count > 0).then(|| Edit { span: value.span, text: text() });
        found.add(value.span, edit, || {
            let message = match declared {
                Some(declared) if count == 1 => {
                    format!("`SubNumber` of {index} is {declared}, but 1 sub-index has a section")
                }
                Some(declared) => {
                    format!("`SubNumber` of {index} is {declared}, but {count} sub-indices have sections")
                }
                None => format!(
                    "found `{}`, expected the number of sub-indices of {index}: {count}",
                    shorten(value.value)
                ),
            };
            Diagnostic::new(CODE, value.span, message).help(help(declared, count, object))
        });
    }
    found.finish("objects", diagnostics);
}

fn help(declared: Option<i128>, count: i128, object: &ObjectPart<'_>) -> String {
    let highest = object.subs.keys().filter(|sub| **sub < 0xFF).max().map(|sub| i128::from(*sub));
    if count == 0 {
        "describe the sub-indices".to_owned()
    } else if declared == highest {
        format!("write {count}: `SubNumber` is the number of sub-indices, not the highest; `odgen fix` does")
    } else {
        format!("write {count}, or add the sections that are missing; `odgen fix` writes the number")
    }
}
