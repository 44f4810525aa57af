//! The parameters of a drive have values with which it can reckon.

use crate::check::device::device_type_is_kept::{DRIVES, axes};
use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::Index;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0892",
    severity: Severity::Warning,
    foreign: Severity::Note,
    title: "a value with which no drive can work",
    explanation: "Encoder resolution, gear ratio, feed constant and the factors between units are quotients; with a 0 in one of them, the drive divides by 0 or takes every position for 0. The \
        interpolation period is 60C2h.1 × 10^60C2h.2 seconds, and an exponent above 0 makes it 10 s and more, where the sign was forgotten. A drive without a bit in 6502h has no \
        mode, and masters do not start it. Correct the value.",
    clause: Some("CiA 402, objects 604Bh, 604Ch, 608Fh to 6097h, 60C2h and 6502h"),
    example: Some(Example::new(
        "uses: [cia301, cia402]\ndevices:\n  io: {name: Example, bit-rates: [125], device-type: 0x00020192, features: [heartbeat producer, drive]}\npdos:\n  io: {receive: {1: {map: [0x6040]}}, transmit: {1: {map: [0x6041]}}}\nobjects:\n  0x608F: {from: cia402, array: {elements: {1: {default: 4096}, 2: {default: 0}}}}",
        "uses: [cia301, cia402]\ndevices:\n  io: {name: Example, bit-rates: [125], device-type: 0x00020192, features: [heartbeat producer, drive]}\npdos:\n  io: {receive: {1: {map: [0x6040]}}, transmit: {1: {map: [0x6041]}}}\nobjects:\n  0x608F: {from: cia402, array: {elements: {1: {default: 4096}, 2: {default: 1}}}}",
    )),
};

/// Objects whose sub-indices 1 and 2 are a quotient.
const QUOTIENTS: [u16; 12] =
    [0x604B, 0x604C, 0x608F, 0x6090, 0x6091, 0x6092, 0x6093, 0x6094, 0x6095, 0x6096, 0x6097, 0x60A2];
const INTERPOLATION_PERIOD: u16 = 0x60C2;
const SUPPORTED_MODES: u16 = 0x6502;
/// The bits of 6502h that represent a mode of CiA 402 or of the maker.
const MODES: i128 = 0xFFFF_07EF;

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for first in axes(subject, DRIVES) {
        let parameter = |index: u16, sub: u8| subject.parameter(index - 0x6000 + first.0, sub);
        for (index, sub) in QUOTIENTS.iter().flat_map(|index| [(*index, 1), (*index, 2)]) {
            let Some(factor) = parameter(index, sub).filter(|factor| factor.raw() == 0) else { continue };
            let message = format!("{} ({}) is 0, but part of a quotient", factor.id, factor.entry.name);
            findings.push(factor.finding(CODE, message).help("write another number; 1 changes nothing"));
        }
        if let Some(exponent) = parameter(INTERPOLATION_PERIOD, 2).filter(|exponent| exponent.raw() > 0) {
            let period = Index(INTERPOLATION_PERIOD - 0x6000 + first.0);
            let message = format!(
                "{} is {}: the period is {period}.1 × 10^{} s",
                exponent.id,
                exponent.raw(),
                exponent.raw()
            );
            findings
                .push(exponent.finding(CODE, message).help("write the exponent with its sign: -3 for ms"));
        }
        if let Some(modes) = parameter(SUPPORTED_MODES, 0).filter(|modes| modes.raw() & MODES == 0) {
            let message = format!("{} ({}) lists no mode at all", modes.id, modes.entry.name);
            findings.push(modes.finding(CODE, message).help("set the bits of the modes that the drive has"));
        }
    }
}
