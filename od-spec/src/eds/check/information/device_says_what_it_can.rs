//! The device says which bit rates and services it has.

use super::super::enumeration::enumeration;
use super::super::keys::ABILITIES;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity};
use crate::eds::names::Topic;
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS205",
    severity: Severity::Warning,
    foreign: Severity::Note,
    title: "a device that does not say what it can",
    explanation: "`[DeviceInfo]` has a key for each bit rate and service that says whether the device has it, and for \
        the number of PDOs. What is missing counts as no, or as 0; readers agree about that, so it is only a matter of \
        form. A device that has what is missing has to say so.",
    clause: Some("CiA 306 4.5"),
    example: Some(Example::eds(
        "[DeviceInfo]\nVendorName=Example\nVendorNumber=1\nProductName=Example\nProductNumber=1\nRevisionNumber=1\nOrderCode=A1\nBaudRate_125=1",
        "[DeviceInfo]\nVendorName=Example\nVendorNumber=1\nProductName=Example\nProductNumber=1\nRevisionNumber=1\nOrderCode=A1\nBaudRate_125=1\n; ...",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let Some(part) = view.section(Topic::DeviceInfo) else { return };
    let missing: Vec<&str> = ABILITIES.iter().copied().filter(|key| part.value(key).is_none()).collect();
    if !missing.is_empty() {
        let counts = if missing.len() == 1 { "counts" } else { "count" };
        let message = format!("`[DeviceInfo]` does not say {}, which {counts} as 0", enumeration(&missing));
        diagnostics.push(Diagnostic::new(CODE, part.place(), message).help("add the keys"));
    }
}
