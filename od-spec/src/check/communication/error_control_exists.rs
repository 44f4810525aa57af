//! A device has heartbeat or node guarding.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{Fact, Index};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0803",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "neither heartbeat nor node guarding",
    explanation: "CiA 301 demands one of the two: without them no master notices that the device has gone. The same holds where the time of the only one is 0 and cannot be written. Add the feature \
        `heartbeat producer`, or let its time be written.",
    clause: Some("CiA 301, objects 100Ch, 100Dh and 1017h"),
    example: Some(Example::new(
        "devices:\n  io: {name: Example, bit-rates: [125]}",
        "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer]}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let device = subject.device;
    let has = |index: u16| device.objects.contains_key(&Index(index));
    let guarding = has(0x100C) && has(0x100D);
    if !guarding && !has(0x1017) {
        let message =
            format!("`{}` has neither heartbeat (1017h) nor node guarding (100Ch, 100Dh)", device.key);
        findings.push(Diagnostic::new(CODE, device.span, message).help(subject.help(Help {
            specification: "add the feature `heartbeat producer` of `cia301`",
            eds: "add 1017h, the producer heartbeat time",
            setting: "the device has to have one of the two",
        })));
        return;
    }
    let off = |index: u16| {
        subject.parameter(index, 0).filter(|time| time.raw() == 0 && !time.entry.access.is_writable())
    };
    let can_watch = guarding && off(0x100C).is_none() && off(0x100D).is_none();
    if can_watch || has(0x1017) && off(0x1017).is_none() {
        return;
    }
    if let Some(time) = [0x1017, 0x100C, 0x100D].into_iter().find_map(off) {
        let message = format!(
            "{} ({}) is 0 and cannot be written: nothing watches the device",
            time.id, time.entry.name
        );
        findings.push(subject.finding(CODE, time.id, time.entry, Fact::Access, message).help(subject.help(
            Help {
                specification: "make the entry `rw`, or write another time",
                eds: "let the entry be writable, or write another time",
                setting: "the device has to have another time there",
            },
        )));
    }
}
