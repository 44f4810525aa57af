//! A drive starts at rest: nothing that it has after power-on sets it moving.

use crate::check::device::device_type_is_kept::{DRIVES, axes};
use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::{EntryId, Fact, Index, Storage, SubIndex};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0893",
    severity: Severity::Warning,
    foreign: Severity::Note,
    title: "a drive that starts by itself",
    explanation: "The default of the controlword (6040h) is the command \"enable operation\", that of the statusword (6041h) is the state \"operation enabled\", or the controlword is kept over \
        power-off. After power-on the motor would move, or the drive says that it does, without a command of the master. Start with a controlword of 0, leave the default of the \
        statusword to the firmware, and do not store the controlword.",
    clause: Some("CiA 402, objects 6040h and 6041h"),
    example: Some(Example::new(
        "uses: [cia301, cia402]\ndevices:\n  io: {name: Example, bit-rates: [125], device-type: 0x00020192, features: [heartbeat producer, drive]}\npdos:\n  io: {receive: {1: {map: [0x6040]}}, transmit: {1: {map: [0x6041]}}}\nobjects:\n  0x6040: {from: cia402, default: 0x000F}",
        "uses: [cia301, cia402]\ndevices:\n  io: {name: Example, bit-rates: [125], device-type: 0x00020192, features: [heartbeat producer, drive]}\npdos:\n  io: {receive: {1: {map: [0x6040]}}, transmit: {1: {map: [0x6041]}}}\nobjects:\n  0x6040: {from: cia402, default: 0}",
    )),
};

const CONTROLWORD: u16 = 0x6040;
const STATUSWORD: u16 = 0x6041;

/// An entry, whether a value of it lets a drive run, and what that value does.
type Moving = (u16, fn(i128) -> bool, &'static str);

const MOVING: [Moving; 2] =
    [(CONTROLWORD, enables, "enables operation"), (STATUSWORD, is_enabled, "says \"operation enabled\"")];

/// Whether a controlword is the command "enable operation": bits 0 to 3, without the fault reset of bit 7.
const fn enables(raw: i128) -> bool {
    raw & 0x8F == 0x0F
}

/// Whether a statusword is the state "operation enabled".
const fn is_enabled(raw: i128) -> bool {
    raw & 0x6F == 0x27
}

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for first in axes(subject, DRIVES) {
        let on_axis = |index: u16| Index(index - 0x6000 + first.0);
        for (index, moves, what) in MOVING {
            let parameter = subject.parameter(on_axis(index).0, 0);
            let Some(word) = parameter.filter(|word| moves(word.raw())) else { continue };
            let message = format!("{} ({}) {what} after power-on", word.id, word.entry.name);
            findings.push(word.finding(CODE, message).help(subject.help(Help {
                specification: "remove the default, or write 0",
                eds: "remove the default, or write 0",
                setting: "leave the entry out; masters write it when they want to move",
            })));
        }
        let id = EntryId { index: on_axis(CONTROLWORD), sub: SubIndex(0) };
        if let Some(entry) = subject.device.entry(id).filter(|entry| entry.stored != Storage::No) {
            let message = format!("{id} ({}) is a command that power-off does not end", entry.name);
            findings.push(subject.finding(CODE, id, entry, Fact::Storage, message).help(subject.help(
                Help {
                    specification: "remove `stored:`",
                    eds: "remove the comment that it is stored",
                    setting: "leave the entry out; masters write it when they want to move",
                },
            )));
        }
    }
}
