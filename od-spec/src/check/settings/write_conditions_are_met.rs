//! The device accepts what a configuration sets in the state that the configuration makes.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::Outcome;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Settings(check) };

/// An entry is set that the device does not accept in the state that it is in then.
pub const CODE: &Code = &Code {
    id: "OD0710",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a parameter that the device accepts only in some state",
    explanation: "The entry has a `writable-when` condition that the configured values do not meet. A PLC that downloads the DCF at boot will get an \
        SDO abort for it, unless the device is brought into that state first. Set the entries of the condition, too, or leave this one out.",
    clause: None,
    example: Some(Example::new(
        "objects:\n  0x2000: {name: mode, type: unsigned8, access: rw, default: 0}\n  0x2001: {name: speed, type: unsigned8, access: rw, writable-when: \"0x2000 == 1\"}\n# --set 2001=5",
        "objects:\n  0x2000: {name: mode, type: unsigned8, access: rw, default: 0}\n  0x2001: {name: speed, type: unsigned8, access: rw, writable-when: \"0x2000 == 1\"}\n# --set 2000=1\n# --set 2001=5",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for (set, entry, place) in subject.set_entries() {
        // A value set through a view has to meet the conditions of the view and of the entry that it shows.
        let target = entry.alias.as_ref().map(|alias| alias.target);
        let unmet = [Some(set), target].into_iter().flatten().find_map(|id| {
            let condition = subject.device.entry(id)?.writable_when.as_ref()?;
            matches!(condition.evaluate(subject), Outcome::Fails { .. }).then_some((id, condition))
        });
        let Some((id, condition)) = unmet else { continue };
        let shown = if id == set { String::new() } else { format!(", which {set} shows,") };
        let message = format!("the device accepts {id}{shown} only while `{}`", condition.text);
        findings.push(
            Diagnostic::new(CODE, place, message).help(
                "a download at boot will be refused unless the device is brought into that state first",
            ),
        );
    }
}
