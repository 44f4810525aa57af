//! The status of a machine can be read, its commands can be written, and the two start as the machine does.

use super::paths::{Reach, starts};
use super::words::list;
use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::diag::{Code, Diagnostic, Example, Severity, shorten};
use crate::model::{
    Access, Author, BitPattern, ByDevice, Dictionary, Entry, Fact, StateMachine, System, Value,
};
use crate::source::Span;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::System(check) };

const CODE: &Code = &Code {
    id: "OD0873",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "an entry that cannot do its part in a state machine",
    explanation: "The status entry shows the state, and the command entry takes what a master asks for: the first must \
        be readable and not constant, the second writable, and they are two entries, or each command would overwrite \
        the state. Both begin as the machine does: a default of the command entry that gives a command moves the \
        machine at power-on, before a master has asked for anything; a default of the status entry that belongs to \
        another state shows a wrong state. Correct the access or the default, or name another entry.",
    clause: None,
    example: Some(Example::new(
        "objects:\n  0x2000: {name: command, type: unsigned8, access: rw}\n  0x2001: {name: status, type: unsigned8, access: wo}\nstate-machines:\n  motor:\n    status: status\n    command: command\n    states: {stopped: {pattern: xxxx xxx0}, running: {pattern: xxxx xxx1}}",
        "objects:\n  0x2000: {name: command, type: unsigned8, access: rw}\n  0x2001: {name: status, type: unsigned8, access: ro}\nstate-machines:\n  motor:\n    status: status\n    command: command\n    states: {stopped: {pattern: xxxx xxx0}, running: {pattern: xxxx xxx1}}",
    )),
};

fn check(system: &System, findings: &mut Findings) {
    for machine in system.machines.values() {
        let (_, command_place) = machine.entry_places;
        if machine.status == machine.command {
            let message = format!("{} shows the state and takes the commands", machine.status);
            findings.push(
                Diagnostic::new(CODE, machine.place(command_place), message)
                    .help("name another entry; each command would overwrite the state"),
            );
            continue;
        }
        for device in system.devices.iter().filter(|device| machine.devices.includes(&device.key)) {
            let (Some(status), Some(command)) = (device.entry(machine.status), device.entry(machine.command))
            else {
                continue;
            };
            check_access(machine, status, command, findings);
            check_defaults(machine, device, status, command, findings);
        }
    }
}

fn check_access(machine: &StateMachine, status: &Entry, command: &Entry, findings: &mut Findings) {
    let (status_place, command_place) = machine.entry_places;
    let problem = match status.access {
        Access::Wo => Some("the state cannot be read"),
        // A machine of one state shows nothing else.
        Access::Const if machine.states.len() > 1 => Some("the state it shows never changes"),
        Access::Const | Access::Ro | Access::Rw | Access::Rwr | Access::Rww => None,
    };
    if let Some(problem) = problem {
        let message = format!("{} is `{}`: {problem}", machine.status, status.access.word());
        findings.push(
            Diagnostic::new(CODE, machine.place(status_place), message)
                .help("make the entry `ro`, or name another one as `status:`"),
        );
    }
    if !command.access.is_writable() && !machine.commands.is_empty() {
        let message =
            format!("{} is `{}`: a command cannot be written", machine.command, command.access.word());
        findings.push(
            Diagnostic::new(CODE, machine.place(command_place), message)
                .help("make the entry `rw`, or name another one as `command:`"),
        );
    }
}

/// The raw value that an entry starts with, where that is not a formula.
fn start_value(entry: &Entry) -> Option<u64> {
    let raw = match entry.default.as_ref()? {
        Value::Integer(raw) => *raw,
        Value::NodeId(_) | Value::Real(_) | Value::Text(_) | Value::Bytes(_) => return None,
    };
    let bits = entry.data_type.bits()?;
    u64::try_from(raw & ((1_i128 << bits) - 1)).ok()
}

fn shows(pattern: &BitPattern, raw: u64) -> bool {
    let (mask, value) = pattern.mask_and_value();
    raw & mask == value
}

/// Where the default of an entry is; the machine, where a library says it.
fn place(machine: &StateMachine, device: &Dictionary, entry: &Entry) -> Span {
    match entry.facts.get(Fact::Default) {
        Some(statement) if statement.author == Author::Maker => statement.span,
        Some(_) | None if entry.span.file.is_one_with(device.span.file) => entry.span,
        Some(_) | None => machine.span,
    }
}

fn check_defaults(
    machine: &StateMachine,
    device: &Dictionary,
    status: &Entry,
    command: &Entry,
    findings: &mut Findings,
) {
    // The state after power-on, and what the device goes through by itself after it.
    let first = starts(machine).map(|start| start.to.as_str());
    let begun = Reach::over(machine, first, |one| one.by_device == ByDevice::Automatic);
    if begun.states().next().is_none() {
        return;
    }
    if let Some(raw) = start_value(status) {
        let shown = machine.states.iter().find(|state| shows(&state.pattern, raw));
        if shown.is_none_or(|state| !begun.has(&state.name)) {
            let what = shown.map_or("no state".to_owned(), |state| format!("`{}`", shorten(&state.name)));
            let message = format!("the default {raw:02X}h of {} shows {what}", machine.status);
            findings.push(
                Diagnostic::new(CODE, place(machine, device, status), message)
                    .about((machine.status, Fact::Default))
                    .note(format!("the start leads to {}", list(begun.states())))
                    .help("leave the default out, or write a value of the state after power-on"),
            );
        }
    }
    let Some(raw) = start_value(command) else { return };
    for given in
        machine.commands.iter().filter(|one| one.pattern.edges() == (0, 0) && shows(&one.pattern, raw))
    {
        let moves = machine.transitions.iter().find(|transition| {
            let leaves = transition.from.iter().any(|from| begun.has(from));
            leaves && given.transitions.contains(&transition.number) && !begun.has(&transition.to)
        });
        let Some(transition) = moves else { continue };
        let message = format!(
            "the default {raw:02X}h of {} is the command `{}`",
            machine.command,
            shorten(&given.name)
        );
        findings.push(
            Diagnostic::new(CODE, place(machine, device, command), message)
                .about((machine.command, Fact::Default))
                .note(format!(
                    "at power-on, transition {} leads to `{}`",
                    transition.number,
                    shorten(&transition.to)
                ))
                .help("write a default that gives no command in the state after power-on"),
        );
        return;
    }
}
