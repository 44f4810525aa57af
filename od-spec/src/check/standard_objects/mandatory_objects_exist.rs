//! Every device has 1000h, 1001h and 1018h.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::Index;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0801",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a mandatory object is missing",
    explanation: "Every CANopen device has 1000h, 1001h and 1018h; a master reads them at boot to identify the device. `uses: [cia301]` brings them.",
    clause: Some("CiA 301, objects 1000h, 1001h and 1018h"),
    example: Some(Example::new(
        "uses: []\nobjects:\n  0x1017: {name: Producer heartbeat time, type: unsigned16, access: rw, default: 0}\ndevices:\n  io: {name: Example, bit-rates: [125]}",
        "uses: [cia301]\ndevices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer]}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let device = subject.device;
    let missing: Vec<String> = [0x1000, 0x1001, 0x1018]
        .map(Index)
        .into_iter()
        .filter(|index| !device.objects.contains_key(index))
        .map(|index| index.to_string())
        .collect();
    if !missing.is_empty() {
        let message = format!("`{}` lacks {}", device.key, missing.join(", "));
        findings.push(Diagnostic::new(CODE, device.span, message).help(subject.help(Help {
            specification: "add `uses: [cia301]` at the top of the specification",
            eds: "add what is missing; a master reads it at boot",
            setting: "the device has to have what is missing; a master reads it at boot",
        })));
    }
}
