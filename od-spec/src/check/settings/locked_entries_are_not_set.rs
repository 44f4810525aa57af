//! A configuration leaves locked entries alone.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::Fact;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Settings(check) };

pub(crate) const CODE: &Code = &Code {
    id: "OD0704",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "a parameter that is locked",
    explanation: "The entry is writable only after the device was unlocked for service, which a PLC does not do at \
        boot: the download would stop there. The value of a locked parameter was set in the factory, for this very \
        machine. Leave the entry out. For service on an unlocked device, name the entry with `--unlock` or under \
        `unlock:` of a parameter file.",
    clause: None,
    example: Some(Example::new(
        "objects:\n  0x2000: {name: calibration, type: unsigned8, access: rw locked, default: 1}\n# --set 2000=5",
        "objects:\n  0x2000: {name: calibration, type: unsigned8, access: rw, default: 1}\n# --set 2000=5",
    )),
};

const HELP: &str = "leave the entry out, because a PLC cannot write it; for service, name it with `--unlock` or under `unlock:`";

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for (id, entry, place) in subject.set_entries().filter(|(_, entry, _)| entry.locked) {
        let message = format!("{id} ({}) is locked: factory-set, writable only in service", entry.name);
        findings.push(Diagnostic::new(CODE, place, message).about((id, Fact::Default)).help(HELP));
    }
}
