//! Sub-indices are described, or they are alike and only counted.

use super::super::object_form::number;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Repeated, Severity};
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS422",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "sub-indices that are counted in two ways",
    explanation: "`SubNumber` counts the sub-indices that have sections, `CompactSubObj` the elements of an array that have none \
        because they are alike. An object has one or the other. With both, some readers take the sections, others make \
        up the elements.",
    clause: Some("CiA 306 4.6.3.4.2"),
    example: Some(Example::eds(
        "[2000]\nParameterName=levels\nObjectType=0x8\nSubNumber=2\nDataType=0x0005\nAccessType=ro\nCompactSubObj=1\n\n[2000sub0]\nParameterName=highest\nDataType=0x0005\nAccessType=const\nDefaultValue=1\n\n[2000sub1]\nParameterName=level\nDataType=0x0005\nAccessType=ro",
        "[2000]\nParameterName=levels\nObjectType=0x8\nSubNumber=2\n\n[2000sub0]\nParameterName=highest\nDataType=0x0005\nAccessType=const\nDefaultValue=1\n\n[2000sub1]\nParameterName=level\nDataType=0x0005\nAccessType=ro",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for (index, object) in &view.objects {
        let Some(part) = &object.object else { continue };
        let is_set = |key: &str| number(part, key).is_some_and(|number| number != 0);
        if !is_set("SubNumber") || !is_set("CompactSubObj") {
            continue;
        }
        let place = part.key("CompactSubObj").map_or(part.place(), |entry| entry.value.span);
        found.add(place, [], || {
            Diagnostic::new(CODE, place, format!("{index} has both `SubNumber` and `CompactSubObj`"))
                .help("remove `CompactSubObj` if the sub-indices have sections, otherwise `SubNumber`")
        });
    }
    found.finish("objects", diagnostics);
}
