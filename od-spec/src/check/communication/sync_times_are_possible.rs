//! The period of SYNC is longer than its message and than the window after it.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0886",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a time of SYNC that cannot be kept",
    explanation: "1006h is the time between two SYNC messages and 1007h the time after each in which synchronous PDOs are sent, both in µs. A period that is shorter than the message itself is \
        kept at no bit rate of the device, and a window that outlasts the period never closes. Often a time is written in ms. Correct the time.",
    clause: Some("CiA 301, objects 1006h and 1007h"),
    example: Some(Example::new(
        "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer, sync producer, sync window]}\nobjects:\n  0x1006: {from: cia301, default: 10000}\n  0x1007: {from: cia301, default: 20000}",
        "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer, sync producer, sync window]}\nobjects:\n  0x1006: {from: cia301, default: 10000}\n  0x1007: {from: cia301, default: 5000}",
    )),
};

/// Bits of a message without data, with the gap after it and without stuff bits.
const MESSAGE: i128 = 47;

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let Some(period) = subject.parameter(0x1006, 0).filter(|period| period.raw() > 0) else { return };
    // kbit/s: so many bits in a millisecond.
    let fastest = subject.device.info.bit_rates.iter().max().copied().map_or(1000, i128::from);
    let shortest = (MESSAGE * 1000).div_euclid(fastest.max(1));
    if period.raw() < shortest {
        let message = format!(
            "{} is {} µs, but a SYNC message takes {shortest} µs at {fastest} kbit/s",
            period.id,
            period.raw()
        );
        findings.push(period.finding(CODE, message).help("write the period in µs"));
    }
    let Some(window) = subject.parameter(0x1007, 0).filter(|window| window.raw() > period.raw()) else {
        return;
    };
    let message = format!("{} is {} µs, longer than the period of SYNC", window.id, window.raw());
    // What was set is blamed before what the device has.
    let (blamed, other) =
        if period.entry.is_set() && !window.entry.is_set() { (&period, &window) } else { (&window, &period) };
    let finding = blamed.finding(CODE, message);
    let finding =
        if other.place == blamed.place { finding } else { finding.with(other.place, other.id.to_string()) };
    findings.push(finding.help("write a window that is shorter than the period; both are in µs"));
}
