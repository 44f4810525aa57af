//! What a device has can be switched on.

use crate::check::device::device_type_is_kept::{IO_MODULES, axes};
use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::{Index, PdoMapping};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0889",
    severity: Severity::Warning,
    foreign: Severity::Note,
    title: "a function that is off and cannot be switched on",
    explanation: "The entry switches a function of the device on and off; it says \"off\", and it cannot be written. The device has the function, its PDO or its message, and never does anything with \
        it. Make the entry `rw`, give it another value, or leave the function out.",
    clause: Some("CiA 301, objects 1006h and 1014h; CiA 401, objects 6005h and 6423h"),
    example: Some(Example::new(
        "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer, emergency]}\nobjects:\n  0x1014: {from: cia301, access: const, default: $NODEID + 0x8000_0080}",
        "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer, emergency]}\nobjects:\n  0x1014: {from: cia301, access: const, default: $NODEID + 0x80}",
    )),
};

/// Bit of a COB-ID: the message does not exist.
const NOT_VALID: i128 = 1 << 31;
/// Bit of 1005h: the device produces SYNC.
const PRODUCER: i128 = 1 << 30;

/// A switch: index, whether a value is "off", and what is off then.
type Switch = (u16, fn(i128) -> bool, &'static str);

const SWITCHES: [Switch; 4] = [
    (0x1006, |period| period == 0, "SYNC is never sent"),
    (0x1014, |cob_id| cob_id & NOT_VALID != 0, "no emergency message is ever sent"),
    (0x6005, |enable| enable == 0, "no change of a digital input sends a PDO"),
    (0x6423, |enable| enable == 0, "no analogue input ever sends a PDO"),
];

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let is_io_module = axes(subject, IO_MODULES).contains(&Index(0x6000));
    let produces = subject.parameter(0x1005, 0).is_some_and(|sync| sync.raw() & PRODUCER != 0);
    for (index, is_off, what) in SWITCHES {
        let counts = match index {
            0x1006 => produces,
            0x6000.. => is_io_module,
            _ => true,
        };
        let Some(switch) = subject.parameter(index, 0).filter(|_| counts) else { continue };
        let can_change = switch.entry.access.is_writable()
            || matches!(switch.entry.pdo, PdoMapping::Receive | PdoMapping::Both);
        let nodes = subject.nodes_of(switch.value);
        let mut values = nodes.filter_map(|node| switch.value.integer_for(node));
        if !can_change && values.any(is_off) {
            let message = format!("{} ({}) cannot be written: {what}", switch.id, switch.entry.name);
            findings.push(switch.finding(CODE, message).help(subject.help(Help {
                specification: "make the entry `rw`, or leave the function out",
                eds: "let the entry be writable, or leave the function out",
                setting: "the device has to have another value there",
            })));
        }
    }
}
