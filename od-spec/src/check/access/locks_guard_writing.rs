//! A lock guards an entry that can be written.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::Fact;
use crate::wording::Key;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Objects(check) };

/// The code of the rule.
const CODE: &Code = &Code {
    id: "OD0414",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "a lock on something that cannot be written",
    explanation: "`locked` means that the entry can be written only after the device was unlocked for service. An entry that is never \
        writable needs no lock: either the access is wrong, and the entry could not be corrected in service, or the lock is a leftover. \
        Write `rw locked`, or drop `locked`.",
    clause: None,
    example: Some(Example::new(
        "objects:\n  0x2000: {name: offset, type: unsigned16, access: ro locked}",
        "objects:\n  0x2000: {name: offset, type: unsigned16, access: rw locked}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for (id, _, entry) in subject.device.entries() {
        if entry.locked && !entry.access.is_writable() {
            let message = format!("{id} ({}) is `{}`: it cannot be locked", entry.name, entry.access.word());
            let help = subject.help(Help {
                specification: "`locked` means \"writable only when unlocked\": write `rw locked`, or drop `locked`",
                eds: &format!("correct {}, or remove the comment that it is writable when unlocked", subject.format.key(Key::Access)),
                setting: "leave the entry out; it cannot be written",
            });
            findings.push(subject.finding(CODE, id, entry, Fact::Access, message).help(help));
        }
    }
}
