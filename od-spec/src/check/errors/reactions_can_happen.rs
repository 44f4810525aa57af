//! Who treats an error reports it, and its reaction can be chosen where an entry chooses it.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{ErrorCode, System};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::System(check) };

const CODE: &Code = &Code {
    id: "OD0877",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a reaction to an error that cannot be",
    explanation: "`treated-by:` names devices among those that report the error; one that does not report it has nothing to treat, and the documents would show a reaction that never happens. `option-code:` \
        names the entry by which a master chooses the reaction; where that can only be read, no master can choose. Correct the devices, or name the entry that is meant.",
    clause: None,
    example: Some(Example::new(
        "errors:\n  0x4310: {name: too hot, option-code: 0x2000}\nobjects:\n  0x2000: {name: reaction, type: unsigned8, access: ro}",
        "errors:\n  0x4310: {name: too hot, option-code: 0x2000}\nobjects:\n  0x2000: {name: reaction, type: unsigned8, access: rw}",
    )),
};

fn check(system: &System, findings: &mut Findings) {
    for error in &system.errors {
        if let Some(finding) = idle(system, error).or_else(|| fixed(system, error)) {
            findings.push(finding);
        }
    }
}

fn idle(system: &System, error: &ErrorCode) -> Option<Diagnostic> {
    let mut devices = system.devices.iter().map(|device| device.key.as_str());
    let idle = devices.find(|key| error.treated_by.includes(key) && !error.devices.includes(key))?;
    let message = format!("`{idle}` treats the error {:04X}h, but does not report it", error.code);
    let help = "add it to `devices:`, or leave it out of `treated-by:`";
    Some(Diagnostic::new(CODE, error.span, message).help(help))
}

fn fixed(system: &System, error: &ErrorCode) -> Option<Diagnostic> {
    let id = error.option_code?;
    let reporting = system.devices.iter().filter(|device| error.devices.includes(&device.key));
    let mut entries = reporting.filter_map(|device| device.entry(id)).peekable();
    let access = entries.peek()?.access;
    if entries.any(|entry| entry.access.is_writable()) {
        return None;
    }
    let message =
        format!("{id} is `{}`: the reaction to {:04X}h cannot be chosen with it", access.word(), error.code);
    Some(
        Diagnostic::new(CODE, error.span, message)
            .help("name an entry that can be written, or make this one `rw`"),
    )
}
