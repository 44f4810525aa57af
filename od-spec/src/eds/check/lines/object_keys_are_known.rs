//! Every key of an object or entry is one of the standard.

use super::super::keys;
use super::super::rule::FormatRule;
use super::unknown_keys;
use crate::diag::{Code, Diagnostics, Example, Severity};
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS118",
    severity: Severity::Warning,
    foreign: Severity::Note,
    title: "an unknown key of an object",
    explanation: "The standard has no key of this name for an object or entry. It is allowed to add some, so most \
        readers ignore it; lely's dcfchk refuses the file. Where the name is a misspelling, what the standard's key \
        would say is missing: an access type, a limit.",
    clause: Some("CiA 306 4.2"),
    example: Some(Example::eds(
        "[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=ro\nUnit=mV",
        "; unit: mV\n[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=ro",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let sections = view.topics().filter(|(topic, _)| keys::is_of_object(*topic));
    unknown_keys::report(CODE, sections, "for an object", diagnostics);
}
