//! What is a number about device and node is one, and no larger than it may be.

use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity, shorten};
use crate::eds::names::Topic;
use crate::eds::number::{help, integer};
use crate::eds::view::{Entry, View};

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS206",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "a number about the device that cannot be read",
    explanation: "Vendor number, product number and revision number have 32 bits, bit rates and services are 0 or 1, \
        the granularity is 0 to 64, and CANopen has room for 512 PDOs in each direction. Text or a larger number \
        cannot be used by a reader: python-canopen stops, lely's dcfchk refuses the file.",
    clause: Some("CiA 306 4.5"),
    example: Some(Example::eds(
        "[DeviceInfo]\nProductNumber=e-RIO 8\n; ...",
        "[DeviceInfo]\nProductNumber=8\n; ...",
    )),
};

/// A key and the largest number that it may have.
pub(super) const NUMBERS: [(Topic, &str, i128); 27] = {
    const DEVICE: Topic = Topic::DeviceInfo;
    const NODE: Topic = Topic::Commissioning;
    const LONG: i128 = 0xFFFF_FFFF;
    [
        (DEVICE, "VendorNumber", LONG),
        (DEVICE, "ProductNumber", LONG),
        (DEVICE, "RevisionNumber", LONG),
        (DEVICE, "BaudRate_10", 1),
        (DEVICE, "BaudRate_20", 1),
        (DEVICE, "BaudRate_50", 1),
        (DEVICE, "BaudRate_125", 1),
        (DEVICE, "BaudRate_250", 1),
        (DEVICE, "BaudRate_500", 1),
        (DEVICE, "BaudRate_800", 1),
        (DEVICE, "BaudRate_1000", 1),
        (DEVICE, "SimpleBootUpMaster", 1),
        (DEVICE, "SimpleBootUpSlave", 1),
        (DEVICE, "Granularity", 64),
        (DEVICE, "DynamicChannelsSupported", LONG),
        (DEVICE, "GroupMessaging", 1),
        (DEVICE, "NrOfRXPDO", 512),
        (DEVICE, "NrOfTXPDO", 512),
        (DEVICE, "LSS_Supported", 1),
        (DEVICE, "CompactPDO", 0xFF),
        (DEVICE, "CANopenSafetySupported", 1),
        (DEVICE, "NG_Slave", 1),
        (DEVICE, "NG_Master", 1),
        (DEVICE, "NrOfNG_MonitoredNodes", 0xFFFF),
        (NODE, "NetNumber", LONG),
        (NODE, "CANopenManager", 1),
        (NODE, "LSS_SerialNumber", LONG),
    ]
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    for (topic, key, largest) in NUMBERS {
        let entry = view.section(topic).and_then(|part| part.key(key));
        if let Some(entry) = entry.filter(|entry| !entry.value.value.is_empty()) {
            look(&entry, key, largest, diagnostics);
        }
    }
}

fn look(entry: &Entry<'_>, key: &str, largest: i128, diagnostics: &mut Diagnostics) {
    let text = shorten(entry.value.value);
    let message = match integer(entry.value.value) {
        Some(number) if (0..=largest).contains(&number.value) => return,
        Some(_) if largest == 1 => format!("found `{text}`, expected 0 or 1 as `{key}`"),
        Some(_) => format!("found `{text}`, expected 0 to {largest} as `{key}`"),
        None => format!("found `{text}`, expected a number as `{key}`"),
    };
    diagnostics.push(
        Diagnostic::new(CODE, entry.value.span, message)
            .help(help(entry.value.value, "write the number that the device has")),
    );
}
