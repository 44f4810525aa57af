//! A device supports at least one bit rate.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::wording::Key;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

/// The code of the rule.
const CODE: &Code = &Code {
    id: "OD0602",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "no bit rate",
    explanation: "An EDS without a supported bit rate is refused by configuration tools: the device could not be put on any bus. Add `bit-rates:` \
        to the device.",
    clause: Some("CiA 306, 4.5 ([DeviceInfo])"),
    example: Some(Example::new(
        "devices:\n  io: {name: Example, features: [heartbeat producer]}",
        "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer]}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let device = subject.device;
    if device.info.bit_rates.is_empty() {
        findings.push(
            Diagnostic::new(CODE, device.span, format!("device `{}` supports no bit rate", device.key))
                .help(subject.help(Help {
                    specification: "add `bit-rates:`, such as `[125, 250, 500, 1000]`; a PLC refuses a device without them",
                    eds: &format!("write 1 for each bit rate of the device, such as {}; a PLC refuses a device without them", subject.format.set(Key::BitRate(125), "1")),
                    setting: "the device has to report its bit rates; a PLC refuses one without them",
                })),
        );
    }
}
