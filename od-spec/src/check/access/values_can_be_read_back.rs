//! A default value is of an entry that can be read.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Repeated, Severity};
use crate::model::{Entry, Fact};
use crate::wording::Key;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0825",
    severity: Severity::Note,
    foreign: Severity::Note,
    title: "a default value that cannot be read back",
    explanation: "The entry is `wo`: it cannot be read, so its value cannot be compared with the default, and a tool that reads the device back after a download stops at it. \
        That may be meant: a command has such a default where writing it does nothing. Otherwise leave the default out, or make the entry `rw`.",
    clause: Some("CiA 306, 4.6.3.2 (AccessType, DefaultValue)"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: command, type: unsigned8, access: wo, default: 0}",
        "objects:\n  0x2000: {name: command, type: unsigned8, access: wo}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let (mut found, keys) = (Repeated::new(), subject.format);
    let hidden = |entry: &Entry| !entry.access.is_readable() && !entry.is_set();
    for (id, entry, _) in subject.values().filter(|(_, entry, _)| hidden(entry)) {
        // What a standard says so is meant so.
        if entry.is_only_standard(Fact::Default) {
            continue;
        }
        let place = subject.place(entry, Fact::Default);
        found.add(place, [], || {
            let message = format!("{id} ({}) is `wo`, its default value cannot be read back", entry.name);
            subject.finding(CODE, id, entry, Fact::Default, message).help(subject.help(Help {
                specification: "leave `default:` out, or make the entry `rw`",
                eds: &format!(
                    "leave {} out, or write {}",
                    keys.key(Key::Default),
                    keys.set(Key::Access, "rw")
                ),
                setting: "leave the default value out, or make the entry `rw`",
            }))
        });
    }
    if let Some(finding) = found.into_diagnostic("entries") {
        findings.push(finding);
    }
}
