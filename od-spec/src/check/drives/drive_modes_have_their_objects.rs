//! A drive has the objects of the modes that it says it has.

use crate::check::drives::modes::{MODES, Mode, axes};
use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

/// The code of the rule.
pub const CODE: &Code = &Code {
    id: "OD0839",
    severity: Severity::Warning,
    foreign: Severity::Note,
    title: "a mode of a drive without its objects",
    explanation: "6502h shows masters which modes of operation a drive has, and CiA 402 has objects for each without which it cannot be used: a target position for positioning, a homing method for \
        homing. Some of these are missing. Add them, with the feature of the mode, or clear the bit in 6502h. A drive without a value of 6502h says nothing about its modes.",
    clause: Some("CiA 402, objects of the modes of operation"),
    example: Some(Example::new(
        "uses: [cia301, cia402]\ndevices:\n  io: {name: Example, bit-rates: [125], device-type: 0x00020192, features: [heartbeat producer, drive]}\npdos:\n  io: {receive: {1: {map: [0x6040]}}, transmit: {1: {map: [0x6041]}}}\nobjects:\n  0x6502: {from: cia402, default: 0x20}",
        "uses: [cia301, cia402]\ndevices:\n  io: {name: Example, bit-rates: [125], device-type: 0x00020192, features: [heartbeat producer, drive, homing mode]}\npdos:\n  io: {receive: {1: {map: [0x6040]}}, transmit: {1: {map: [0x6041]}}}\nobjects:\n  0x6502: {from: cia402, default: 0x20}\n  0x6098: {from: cia402, pdo: none}\n  0x6099: {from: cia402, array: {pdo: none}}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let device = subject.device;
    for axis in axes(subject) {
        let missing = |mode: &'static Mode| {
            let indices = mode.objects.iter().map(|index| axis.index(*index));
            let lacking: Vec<String> = indices
                .filter(|index| !device.objects.contains_key(index))
                .map(|index| index.to_string())
                .collect();
            (!lacking.is_empty()).then_some((mode, lacking.join(", ")))
        };
        let missing: Vec<_> = MODES.iter().filter(|mode| axis.has(mode)).filter_map(missing).collect();
        if missing.is_empty() {
            continue;
        }
        let lists: Vec<String> =
            missing.iter().map(|(mode, lacking)| format!("{} without {lacking}", mode.name)).collect();
        let message = format!("{} of `{}` lists {}", axis.supported.id, device.key, lists.join("; "));
        let features: Vec<String> = missing.iter().map(|(mode, _)| axis.feature(mode)).collect();
        let word = if features.len() == 1 { "the feature" } else { "the features" };
        let specification = format!(
            "add {word} {} of `cia402`, or clear the bits of what the drive cannot do",
            features.join(", ")
        );
        let help = subject.help(Help {
            specification: &specification,
            eds: "add these objects, or clear the bits of what the drive cannot do",
            setting: "clear the bits of what the drive cannot do",
        });
        findings.push(axis.supported.finding(CODE, message).help(help));
    }
}
