//! The lists of objects ascend.

use super::super::numbered;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity};
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS311",
    severity: Severity::Note,
    foreign: Severity::Note,
    title: "a list of objects in another order",
    explanation: "Lists of objects usually ascend, and readers look for an index in that order. Nothing else depends on it.",
    clause: None,
    example: Some(Example::eds(
        "[ManufacturerObjects]\nSupportedObjects=2\n1=0x2001\n2=0x2000\n\n[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=ro\n\n[2001]\nParameterName=limit\nObjectType=0x7\nDataType=0x0005\nAccessType=ro",
        "[ManufacturerObjects]\nSupportedObjects=2\n1=0x2000\n2=0x2001\n\n[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=ro\n\n[2001]\nParameterName=limit\nObjectType=0x7\nDataType=0x0005\nAccessType=ro",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    for (_, list) in numbered::of_objects(view) {
        let indices: Vec<_> = list
            .entries
            .iter()
            .filter_map(|(_, entry)| Some((numbered::index(entry)?, entry.value.span)))
            .collect();
        let step = indices.windows(2).find_map(|pair| match pair {
            [(before, _), (index, place)] if index < before => Some((*before, *index, *place)),
            _ => None,
        });
        if let Some((before, index, place)) = step {
            let message = format!("{index} is listed after {before}");
            diagnostics
                .push(Diagnostic::new(CODE, place, message).help("list the objects in ascending order"));
        }
    }
}
