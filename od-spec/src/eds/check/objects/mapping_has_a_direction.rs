//! What can be mapped says into which PDOs.

use super::super::keys;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Repeated, Severity};
use crate::eds::coded;
use crate::eds::number::lenient_integer;
use crate::eds::view::View;
use crate::model::Access;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS428",
    severity: Severity::Note,
    foreign: Severity::Note,
    title: "a mapping of either direction",
    explanation: "`PDOMapping=1` does not state a direction; the access type does. With `rw` the entry can be mapped into RPDOs and \
        TPDOs. Where the device takes it in one of them only, `rww` (RPDO) or `rwr` (TPDO) says so, and a PLC offers no \
        mapping that the device refuses.",
    clause: Some("CiA 306 4.6.3.2 (AccessType, PDOMapping)"),
    example: Some(Example::eds(
        "[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=rw\nPDOMapping=1",
        "[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=rww\nPDOMapping=1",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let mut found = Repeated::new();
    for (_, part) in view.topics().filter(|(topic, _)| keys::is_of_object(*topic)) {
        let is_mapped = part.value("PDOMapping").and_then(|value| lenient_integer(value.value)) == Some(1);
        let access =
            part.value("AccessType").filter(|access| coded::access(access.value) == Some(Access::Rw));
        let Some(access) = access.filter(|_| is_mapped) else { continue };
        found.add(access.span, [], || {
            Diagnostic::new(
                CODE,
                access.span,
                "the entry is `rw`, so that it can be mapped into RPDOs and TPDOs",
            )
            .help("write `rww` or `rwr` if it can be mapped into RPDOs or TPDOs alone")
        });
    }
    found.finish("entries", diagnostics);
}
