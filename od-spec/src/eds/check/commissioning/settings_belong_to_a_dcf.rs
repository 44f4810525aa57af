//! An EDS holds no settings of a node.

use super::super::keys;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Repeated, Severity};
use crate::eds::is_dcf;
use crate::eds::names::{ElementList, Topic};
use crate::eds::view::View;
use crate::source::Span;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

/// The code of the rule.
pub const CODE: &Code = &Code {
    id: "EDS709",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "settings of a node in an EDS",
    explanation: "`ParameterValue`, `Denotation`, `[DeviceComissioning]` and `[ConnectedModules]` are settings of one node and belong to a DCF. In an \
        EDS they hide the defaults: python-canopen takes a COB-ID of one node for all of them. An EDS with \
        `[DeviceComissioning]` is read as a DCF; without the section, the settings are left out of everything that is made \
        from the file. Call the file `.dcf`, or remove the settings.",
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
    let end = if view.is_dcf { "" } else { ", and is left out" };
    let mut add = |what: &str, place: Span| {
        let message = format!("`{what}` belongs to a DCF{end}");
        found.add(place, [], || Diagnostic::new(CODE, place, message).help(HELP));
    };
    for (topic, part) in view.topics() {
        match topic {
            _ if keys::is_of_object(topic) => {
                for key in ["ParameterValue", "Denotation"] {
                    part.value(key).iter().for_each(|value| add(key, value.span));
                }
            }
            Topic::Elements(_, ElementList::Value | ElementList::Denotation) | Topic::ConnectedModules => {
                add(&format!("[{}]", part.name().value), part.place());
            }
            _ => {}
        }
    }
    found.finish("settings", diagnostics);
}
