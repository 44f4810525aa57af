//! `ObjFlags` has no bits without a meaning.

use super::super::keys;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Repeated, Severity};
use crate::eds::number::lenient_integer;
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS425",
    severity: Severity::Warning,
    foreign: Severity::Note,
    title: "a flag without a meaning",
    explanation: "`ObjFlags` has two bits: bit 0 keeps tools from writing the entry when they download a \
        configuration, bit 1 from reading it when they scan the device. The others are reserved and 0. What another \
        tool means by them is unknown to all others.",
    clause: Some("CiA 306 4.6.3.3"),
    example: Some(Example::eds(
        "[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=ro\nObjFlags=0x4",
        "[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=ro",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for (_, part) in view.topics().filter(|(topic, _)| keys::is_of_object(*topic)) {
        let Some(entry) = part.key("ObjFlags") else { continue };
        let Some(number) = lenient_integer(entry.value.value).filter(|number| *number & !0x3 != 0) else {
            continue;
        };
        found.add(entry.value.span, None, || {
            Diagnostic::new(
                CODE,
                entry.value.span,
                format!("`ObjFlags` is {number:#X}, with bits that have no meaning"),
            )
            .help("use bits 0 and 1 only")
        });
    }
    found.finish("entries", diagnostics);
}
