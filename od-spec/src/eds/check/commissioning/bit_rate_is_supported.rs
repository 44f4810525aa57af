//! The node has a bit rate that the device supports.

use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity};
use crate::eds::coded;
use crate::eds::names::Topic;
use crate::eds::number::lenient_integer;
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS706",
    severity: Severity::Warning,
    foreign: Severity::Note,
    title: "a bit rate that the device does not support",
    explanation: "`[DeviceInfo]` says which bit rates the device has, and the one of the node is not among them. Either the device has it, and its key has to be 1, or the node will not be heard.",
    clause: Some("CiA 306 5.3"),
    example: Some(Example::dcf(
        "[DeviceComissioning]\nNodeID=1\nBaudrate=500",
        "[DeviceComissioning]\nNodeID=1\nBaudrate=125",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let rate = view.section(Topic::Commissioning).and_then(|part| part.value("Baudrate"));
    let (Some(rate), Some(device)) = (rate, view.section(Topic::DeviceInfo)) else { return };
    let Some(standard) = coded::bit_rate(rate.value) else { return };
    let key = format!("BaudRate_{standard}");
    let supported = device.value(&key);
    if supported.is_none_or(|supported| lenient_integer(supported.value) == Some(0)) {
        let message = format!("the node has {standard} kbit/s, which the device does not support");
        let mut diagnostic = Diagnostic::new(CODE, rate.span, message)
            .help(format!("choose another bit rate, or set `{key}` to 1 if the device has it"));
        if let Some(supported) = supported {
            diagnostic = diagnostic.with(supported.span, "not supported");
        }
        diagnostics.push(diagnostic);
    }
}
