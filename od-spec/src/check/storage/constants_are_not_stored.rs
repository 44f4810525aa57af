//! A constant is not stored: it never changes.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::{Access, Fact, Storage};
use crate::wording::Key;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Objects(check) };

/// The code of the rule.
const CODE: &Code = &Code {
    id: "OD0415",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "a stored constant",
    explanation: "`const` means that the value never changes, so there is nothing to store. One of the two is wrong: a value that is stored can \
        change, and masters that take it for constant will not read it again. Remove `stored:`, or correct the access.",
    clause: Some("CiA 306, 4.6.3.2 (AccessType)"),
    example: Some(Example::new(
        "objects:\n  0x1010: {from: cia301}\n  0x2000: {name: scale, type: unsigned8, access: const, default: 1, stored: application}",
        "objects:\n  0x1010: {from: cia301}\n  0x2000: {name: scale, type: unsigned8, access: rw, default: 1, stored: application}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for (id, _, entry) in subject.device.entries() {
        if entry.access == Access::Const && entry.stored != Storage::No {
            let message =
                format!("{id} ({}) is constant and stored, but a constant never changes", entry.name);
            findings.push(subject.finding(CODE, id, entry, Fact::Storage, message).help(subject.help(
                Help {
                    specification: "remove `stored:`, or correct the access",
                    eds: &format!(
                        "remove the comment that it is stored, or correct {}",
                        subject.format.key(Key::Access)
                    ),
                    setting: "leave the entry out; a constant cannot be written",
                },
            )));
        }
    }
}
