//! A configuration does not write entries that trigger commands.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Settings(check) };

/// The code of the rule.
pub const CODE: &Code = &Code {
    id: "OD0707",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "an entry that tools must not write",
    explanation: "The entry carries `flags: [no-write]` (bit 0 of ObjFlags in the EDS): it triggers a command, such as storing parameters, and must not be \
        written as part of a configuration. At each boot of the machine the command would run again. Leave the entry out.",
    clause: Some("CiA 306, 4.6.3.2 (ObjFlags)"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: reset, type: unsigned8, access: rw, eds: {flags: [no-write]}}\n# --set 2000=1",
        "objects:\n  0x2000: {name: reset, type: unsigned8, access: rw}\n# --set 2000=1",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    // A lock, which has the same flag, and an access that refuses the write are rules of their own.
    let is_command = |entry: &crate::model::Entry| {
        entry.eds.no_write && !entry.locked && entry.access.is_writable() && entry.eds.access.is_writable()
    };
    for (id, entry, place) in subject.set_entries().filter(|(_, entry, _)| is_command(entry)) {
        let message = format!("{id} ({}) must not be written by configuration tools", entry.name);
        let help = "leave the entry out; writing it triggers a command";
        findings.push(Diagnostic::new(CODE, place, message).help(help));
    }
}
