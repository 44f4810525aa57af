//! The node-ID is one: 1 to 127.

use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity, shorten};
use crate::eds::names::Topic;
use crate::eds::number::{help, lenient_integer};
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS703",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "not a valid node-ID",
    explanation: "Node-IDs are 1 to 127. Every formula with `$NODEID` depends on it, and so does the identifier of every message \
        of the node. 255 means a node that waits to get one.",
    clause: Some("CiA 306 5.3"),
    example: Some(Example::dcf(
        "[DeviceComissioning]\nNodeID=128\nBaudrate=125",
        "[DeviceComissioning]\nNodeID=1\nBaudrate=125",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let Some(value) = view.section(Topic::Commissioning).and_then(|part| part.value("NodeID")) else {
        return;
    };
    if !matches!(lenient_integer(value.value), Some(1..=127 | 255)) {
        let message = format!("found `{}`, expected a node-ID", shorten(value.value));
        diagnostics.push(
            Diagnostic::new(CODE, value.span, message).help(help(value.value, "node-IDs are 1 to 127")),
        );
    }
}
