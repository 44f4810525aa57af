//! LSS needs the serial number, 1018h.4.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::{Index, SubIndex};
use crate::wording::Key;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0804",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "LSS without a serial number",
    explanation: "An LSS address consists of vendor, product, revision and serial number: without 1018h.4 no LSS master can distinguish two such devices. Add \
        sub-index 4 to 1018h, or remove `lss: yes`.",
    clause: Some("CiA 301, object 1018h; CiA 305 (LSS address)"),
    example: Some(Example::new(
        "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer], lss: yes}\nobjects:\n  0x1018: {from: cia301, omit: [4]}",
        "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer], lss: yes}\nobjects:\n  0x1018: {from: cia301}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let device = subject.device;
    let Some(identity) = device.objects.get(&Index(0x1018)).filter(|_| device.info.lss) else { return };
    if identity.entry(SubIndex(4)).is_none() {
        let message = format!("`{}` supports LSS, but 1018h has no serial number", device.key);
        findings.push(subject.object_finding(CODE, identity, message).help(subject.help(Help {
            specification: "add sub-index 4 to 1018h, or remove `lss: yes`",
            eds: &format!("add sub-index 4 to 1018h, or write {}", subject.format.set(Key::Lss, "0")),
            setting: "the device has to have sub-index 4 of 1018h",
        })));
    }
}
