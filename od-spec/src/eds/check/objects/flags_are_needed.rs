//! `ObjFlags` is written only where it says something.

use super::super::keys;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Repeated, Severity};
use crate::eds::number::lenient_integer;
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS426",
    severity: Severity::Note,
    foreign: Severity::Note,
    title: "a flag that says nothing",
    explanation: "`ObjFlags` is written only where it is not 0; without it nothing is different. Some old readers do not know the \
        key, so the standard asks to leave it out.",
    clause: Some("CiA 306 4.6.3.3"),
    example: Some(Example::eds(
        "[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=ro\nObjFlags=0",
        "[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=ro",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for (_, part) in view.topics().filter(|(topic, _)| keys::is_of_object(*topic)) {
        let Some(entry) = part.key("ObjFlags") else { continue };
        if lenient_integer(entry.value.value) != Some(0) {
            continue;
        }
        found.add(entry.value.span, [], || {
            Diagnostic::new(CODE, entry.value.span, "`ObjFlags` is 0, which it is without the key, too")
                .help("nothing to do; the author of the file could leave the key out")
        });
    }
    found.finish("entries", diagnostics);
}
