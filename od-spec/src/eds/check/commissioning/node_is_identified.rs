//! The section about the node says its node-ID and bit rate.

use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity};
use crate::eds::names::Topic;
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS704",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a node without a node-ID or bit rate",
    explanation: "A node without a node-ID cannot be on the bus, and every message identifier that depends on it is open. Tools \
        ask for one or take any; the configuration is then not the one that was tried.",
    clause: Some("CiA 306 5.3"),
    example: Some(Example::dcf(
        "[DeviceComissioning]\nNodeID=\nBaudrate=125",
        "[DeviceComissioning]\nNodeID=1\nBaudrate=125",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let Some(part) = view.section(Topic::Commissioning) else { return };
    for (key, what) in [("NodeID", "node-ID"), ("Baudrate", "bit rate")] {
        if part.value(key).is_none() {
            let place = part.key(key).map_or(part.place(), |entry| entry.key.span);
            let message = format!("the node has no {what}");
            diagnostics.push(Diagnostic::new(CODE, place, message).help(format!("write it as `{key}`")));
        }
    }
}
