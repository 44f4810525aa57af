//! The device says whose it is and which one.

use super::super::enumeration::enumeration;
use super::super::keys::IDENTITY;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity};
use crate::eds::names::Topic;
use crate::eds::view::View;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS204",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "a device without maker, product or number",
    explanation: "Vendor number, product number and revision number are what a PLC compares with object 1018h of the \
        device on the bus; names and order code are what users choose it by. Without the numbers every device is taken \
        as this one, or none. An empty key counts as missing, and python-canopen stops at an empty number.",
    clause: Some("CiA 306 4.5"),
    example: Some(Example::eds("[DeviceInfo]\nVendorNumber=\n; ...", "[DeviceInfo]\nVendorNumber=1\n; ...")),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let Some(part) = view.section(Topic::DeviceInfo) else { return };
    let missing: Vec<&str> = IDENTITY.iter().copied().filter(|key| part.value(key).is_none()).collect();
    let Some(first) = missing.first() else { return };
    let place = part.key(first).map_or(part.place(), |entry| entry.key.span);
    let message = format!("`[DeviceInfo]` does not say {}", enumeration(&missing));
    diagnostics.push(Diagnostic::new(CODE, place, message).help("fill in what is missing"));
}
