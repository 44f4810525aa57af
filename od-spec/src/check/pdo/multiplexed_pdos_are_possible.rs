//! A device that says it has multiplexed PDOs has something to make one of.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::pdo::parameters::{DESTINATION_ADDRESS, SOURCE_ADDRESS};
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::{Subject, entry_id};
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{Fact, Index, Pdo, Value};
use crate::wording::Key;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0827",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "multiplexed PDOs that the device does not have",
    explanation: "The device says that it supports multiplexed PDOs, but has neither a PDO with 254 or 255 mapped entries, nor one whose number of mapped entries could be set to that, nor the \
        lists of 1FA0h to 1FFFh that belong to such PDOs. A tool offers its user what cannot be done. Describe what there is, or say that the device has no multiplexed PDOs.",
    clause: Some("CiA 301, 11.4 (multiplexed PDOs); CiA 306, 4.5 (GroupMessaging)"),
    example: Some(Example::new(
        "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer], group-messaging: yes}",
        "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer]}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let device = subject.device;
    let has_lists = device.objects.range(Index(0x1FA0)..Index(0x2000)).next().is_some();
    if !device.info.group_messaging
        || has_lists
        || device.pdos.iter().any(|pdo| can_be_multiplexed(subject, pdo))
    {
        return;
    }
    let message = format!("`{}` says that it has multiplexed PDOs, but has no objects for them", device.key);
    let no = subject.format.set(Key::GroupMessaging, "0");
    findings.push(Diagnostic::new(CODE, device.place(Fact::GroupMessaging), message).help(subject.help(
        Help {
            specification: "remove `group-messaging:`, or describe the objects 1FA0h to 1FFFh",
            eds: &format!("write {no}, or describe the objects 1FA0h to 1FFFh"),
            setting: "the device has to have such PDOs",
        },
    )));
}

/// Whether the number of mapped entries is that of a multiplexed PDO, or can be set to it.
fn can_be_multiplexed(subject: &Subject<'_>, pdo: &Pdo) -> bool {
    let Some(count) = subject.device.entry(entry_id(pdo.mapping_index(), 0)) else { return false };
    let is = |number| count.default.as_ref().and_then(Value::integer) == Some(number);
    let can_be = |number| count.access.is_writable() && count.allows(number);
    [SOURCE_ADDRESS, DESTINATION_ADDRESS].into_iter().any(|number| is(number) || can_be(number))
}
