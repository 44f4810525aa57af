//! A DCF says which node it is for.

use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity};
use crate::eds::is_dcf;
use crate::eds::names::Topic;
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS701",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "a DCF without a node",
    explanation: "A DCF is the configuration of one node: `[DeviceComissioning]` says its node-ID, name and bit rate. \
        Without it, the file is an EDS with another name: `$NODEID` in its formulas has no value, and tools ask or \
        take any number.",
    clause: Some("CiA 306 5.3"),
    example: Some(Example::dcf(
        "; without [DeviceComissioning]",
        "[DeviceComissioning]\nNodeID=1\nBaudrate=125",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    if is_dcf(view.facts.name) && view.section(Topic::Commissioning).is_none() {
        diagnostics.push(
            Diagnostic::new(CODE, view.start(), "there is no section `[DeviceComissioning]`")
                .help("add it with `NodeID` and `Baudrate`; a file without a node and its values is an EDS"),
        );
    }
}
