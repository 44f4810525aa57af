//! What a configuration sets can be written over the bus, and the EDS says so.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::Fact;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Settings(check) };

/// The code of the rule.
pub const CODE: &Code = &Code {
    id: "OD0703",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "a parameter that cannot be written",
    explanation: "A DCF sets parameters by SDO download; this entry is read-only over the bus, or shown as such in the EDS. The download would stop with \
        abort code 0601 0002h, and with it, for most masters, the boot-up of the node. Leave the entry out.",
    clause: None,
    example: Some(Example::new(
        "objects:\n  0x2000: {name: measured, type: unsigned8, access: ro}\n# --set 2000=5",
        "objects:\n  0x2000: {name: wanted, type: unsigned8, access: rw}\n# --set 2000=5",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for (id, entry, place) in subject.set_entries() {
        let (shown, help) = if !entry.access.is_writable() {
            (format!("`{}`", entry.access.word()), "only entries that can be written over the bus can be set")
        } else if !entry.locked && !entry.eds.access.is_writable() {
            (
                format!("`{}` in the EDS", entry.eds.access.word()),
                "leave the entry out; programs that read the DCF treat the entry as read-only",
            )
        } else {
            continue;
        };
        findings.push(
            Diagnostic::new(CODE, place, format!("{id} ({}) is {shown}", entry.name))
                .about((id, Fact::Default))
                .help(help),
        );
    }
}
