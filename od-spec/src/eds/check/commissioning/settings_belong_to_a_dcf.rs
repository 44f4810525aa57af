//! An EDS holds no settings of a node.

use super::super::keys;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Repeated, Severity};
use crate::eds::is_dcf;
use crate::eds::names::Topic;
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS709",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "settings of a node in an EDS",
    explanation: "`ParameterValue`, `Denotation` and `[DeviceComissioning]` are settings of one node and belong to a DCF. In an \
        EDS they hide the defaults: python-canopen takes a COB-ID of one node for all of them. Call the file `.dcf`, or \
        remove the settings.",
    clause: Some("CiA 306 5.1"),
    example: Some(Example::eds(
        "[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=rw\nDefaultValue=0\nParameterValue=5",
        "[2000]\nParameterName=level\nObjectType=0x7\nDataType=0x0005\nAccessType=rw\nDefaultValue=0",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    const HELP: &str = "call the file `.dcf` if it is for one node, otherwise remove the settings";
    if is_dcf(view.facts.name) {
        return;
    }
    let mut found = Repeated::new();
    if let Some(part) = view.section(Topic::Commissioning) {
        found.add(part.place(), [], || {
            Diagnostic::new(CODE, part.place(), "`[DeviceComissioning]` belongs to a DCF").help(HELP)
        });
    }
    for (_, part) in view.topics().filter(|(topic, _)| keys::is_of_object(*topic)) {
        for key in ["ParameterValue", "Denotation"] {
            let Some(value) = part.value(key) else { continue };
            found.add(value.span, [], || {
                Diagnostic::new(CODE, value.span, format!("`{key}` belongs to a DCF")).help(HELP)
            });
        }
    }
    found.finish("settings", diagnostics);
}
