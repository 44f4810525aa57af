//! An object comes before its sub-indices.

use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Repeated, Severity};
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS124",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a sub-index before its object",
    explanation: "The standard allows any order. python-canopen reads a file from top to bottom and stops at a \
        sub-index whose object it does not know yet. Move the section of the object before them.",
    clause: None,
    example: Some(Example::eds(
        "[2000sub0]\nParameterName=highest\nDataType=0x0005\nAccessType=const\nDefaultValue=0\n\n[2000]\nParameterName=levels\nObjectType=0x8\nSubNumber=1",
        "[2000]\nParameterName=levels\nObjectType=0x8\nSubNumber=1\n\n[2000sub0]\nParameterName=highest\nDataType=0x0005\nAccessType=const\nDefaultValue=0",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for (index, object) in &view.objects {
        let Some(place) = object.object.as_ref().map(crate::eds::view::Part::place) else { continue };
        let Some(early) = object.subs.values().map(crate::eds::view::Part::place).find(|sub| *sub < place)
        else {
            continue;
        };
        found.add(early, [], || {
            Diagnostic::new(CODE, early, format!("a sub-index of {index} comes before the object"))
                .with(place, "the object")
                .help(format!("move `[{:X}]` in front of its sub-indices", index.0))
        });
    }
    found.finish("objects", diagnostics);
}
