//! A VAR or DOMAIN counts no sub-indices.

use super::super::edits;
use super::super::object_form::{Form, form};
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Repeated, Severity};
use crate::eds::number::lenient_integer;
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS421",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "an object without sub-indices that counts them",
    explanation: "A VAR or DOMAIN is one value and has no sub-indices to count, with `SubNumber` or `CompactSubObj`. Readers look \
        for as many sections as it says. If the object is an ARRAY or RECORD, `ObjectType` has to say so.",
    clause: Some("CiA 306 4.6.3.2"),
    example: Some(Example::eds(
        "[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=ro\nSubNumber=1",
        "[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=ro",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for (index, object) in &view.objects {
        let Some(part) = object.object.as_ref().filter(|_| form(object) == Some(Form::Single)) else {
            continue;
        };
        for key in ["SubNumber", "CompactSubObj"] {
            let entry = part.key(key).filter(|entry| !entry.value.value.is_empty());
            let Some(entry) = entry.filter(|entry| lenient_integer(entry.value.value) != Some(0)) else {
                continue;
            };
            // With a type it is a value without doubt, and one sub-index is what some count for it.
            let is_value = part.value("DataType").is_some() && part.value("ObjectType").is_some();
            let is_certain = is_value && key == "SubNumber" && object.subs.is_empty();
            let removal = is_certain.then(|| edits::remove(view, entry.line));
            found.add(entry.value.span, removal, || {
                Diagnostic::new(
                    CODE,
                    entry.value.span,
                    format!("{index} has no sub-indices and says `{key}` all the same"),
                )
                .help("remove the key, or correct `ObjectType`")
            });
        }
    }
    found.finish("objects", diagnostics);
}
