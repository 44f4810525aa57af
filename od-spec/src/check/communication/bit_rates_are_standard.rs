//! A device supports bit rates of CiA 301.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{BIT_RATES, Fact};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Device(check) };

/// The code of the rule.
const CODE: &Code = &Code {
    id: "OD0601",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "not a CANopen bit rate",
    explanation: "CiA 301 defines 10, 20, 50, 125, 250, 500, 800 and 1000 kbit/s; an EDS has keys for these only, so that a master could never \
        be given another one. Write one of these.",
    clause: Some("CiA 306, 4.5 ([DeviceInfo])"),
    example: Some(Example::new(
        "devices:\n  io: {name: Example, bit-rates: [100, 125], features: [heartbeat producer]}",
        "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer]}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let device = subject.device;
    let place = device.place(Fact::BitRates);
    for rate in device.info.bit_rates.iter().filter(|rate| !BIT_RATES.contains(rate)) {
        findings.push_each(
            Diagnostic::new(CODE, place, format!("{rate} kbit/s is not a CANopen bit rate"))
                .help("write one of 10, 20, 50, 125, 250, 500, 800 and 1000"),
        );
    }
}
