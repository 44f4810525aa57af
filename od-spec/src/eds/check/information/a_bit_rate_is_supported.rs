//! The device has a bit rate.

use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity};
use crate::eds::names::Topic;
use crate::eds::number::lenient_integer;
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS213",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a device without a bit rate",
    explanation: "None of the keys `BaudRate_10` to `BaudRate_1000` is 1, so the device can be on no bus. PLC tools that offer \
        only what the device has offer nothing. Set those that the device has to 1.",
    clause: Some("CiA 306 4.5"),
    example: Some(Example::eds("[DeviceInfo]\nBaudRate_125=0\n; ...", "[DeviceInfo]\nBaudRate_125=1\n; ...")),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let Some(part) = view.section(Topic::DeviceInfo) else { return };
    // A rate that cannot be read is said already; one of another speed is a rate all the same.
    let has_rate = part.entries().any(|entry| {
        let is_rate = entry.key.value.get(..9).is_some_and(|front| front.eq_ignore_ascii_case("BaudRate_"));
        is_rate && lenient_integer(entry.value.value) != Some(0) && !entry.value.value.is_empty()
    });
    if !has_rate {
        let message = "the device supports no bit rate";
        diagnostics.push(
            Diagnostic::new(CODE, part.place(), message)
                .help("set the bit rates that it has to 1: `BaudRate_125=1`"),
        );
    }
}
