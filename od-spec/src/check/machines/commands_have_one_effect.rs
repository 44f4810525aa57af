//! A command causes something, and no value of the command entry asks for two things at once.

use super::patterns_can_occur::some_value;
use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::diag::{Code, Diagnostic, Example, Severity, shorten};
use crate::model::{Command, Dictionary, StateMachine, System, Transition};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::System(check) };

const CODE: &Code = &Code {
    id: "OD0871",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a command without one effect",
    explanation: "In each state, a value of the command entry leads to one other state at most. A command with two transitions from one state to different states leaves open which of them is made, and so \
        do two commands that one value gives, because their patterns have no bit that differs; the message names the value. A command without `transitions:` changes no state: if it does something \
        within one, `about:` says so. Correct the pattern, or the numbers of the transitions.",
    clause: None,
    example: Some(Example::new(
        "objects:\n  0x2000: {name: command, type: unsigned8, access: rw}\n  0x2001: {name: status, type: unsigned8, access: ro}\nstate-machines:\n  motor:\n    status: status\n    command: command\n    states: {stopped: {pattern: xxxx xx00}, forward: {pattern: xxxx xx01}, backward: {pattern: xxxx xx10}}\n    transitions:\n      0: {from: start, to: stopped, event: power-on}\n      1: {from: stopped, to: forward, event: command forward}\n      2: {from: stopped, to: backward, event: command backward}\n      3: {from: [forward, backward], to: stopped, event: command stop}\n    commands:\n      forward: {pattern: xxxx xxx1, transitions: [1]}\n      backward: {pattern: xxxx xx1x, transitions: [2]}\n      stop: {pattern: xxxx xx00, transitions: [3]}",
        "objects:\n  0x2000: {name: command, type: unsigned8, access: rw}\n  0x2001: {name: status, type: unsigned8, access: ro}\nstate-machines:\n  motor:\n    status: status\n    command: command\n    states: {stopped: {pattern: xxxx xx00}, forward: {pattern: xxxx xx01}, backward: {pattern: xxxx xx10}}\n    transitions:\n      0: {from: start, to: stopped, event: power-on}\n      1: {from: stopped, to: forward, event: command forward}\n      2: {from: stopped, to: backward, event: command backward}\n      3: {from: [forward, backward], to: stopped, event: command stop}\n    commands:\n      forward: {pattern: xxxx xx01, transitions: [1]}\n      backward: {pattern: xxxx xx10, transitions: [2]}\n      stop: {pattern: xxxx xx00, transitions: [3]}",
    )),
};

fn check(system: &System, findings: &mut Findings) {
    for machine in system.machines.values().filter(|machine| !machine.transitions.is_empty()) {
        let mut devices = system.devices.iter().filter(|device| machine.devices.includes(&device.key));
        let Some(device) = devices.next() else { continue };
        for (at, command) in machine.commands.iter().enumerate() {
            if let Some(finding) = idle(machine, command).or_else(|| with_two_targets(machine, command)) {
                findings.push_each(finding);
            }
            let mut others = machine.commands[..at].iter();
            if let Some(finding) = others.find_map(|other| both_given(machine, device, other, command)) {
                findings.push_each(finding);
            }
        }
    }
}

fn idle(machine: &StateMachine, command: &Command) -> Option<Diagnostic> {
    let is_idle = command.transitions.is_empty() && command.about.is_empty();
    is_idle.then(|| {
        let message = format!("command `{}` causes no transition", shorten(&command.name));
        Diagnostic::new(CODE, machine.place(command.span), message)
            .help("list what it causes in `transitions:`, or say in `about:` what it does within a state")
    })
}

fn caused<'a>(machine: &'a StateMachine, command: &Command) -> impl Iterator<Item = &'a Transition> {
    machine.transitions.iter().filter(|transition| command.transitions.contains(&transition.number))
}

/// A state that two transitions leave, and where they lead.
struct Fork<'a> {
    state: &'a str,
    first: &'a Transition,
    second: &'a Transition,
}

impl Fork<'_> {
    fn words(&self) -> String {
        let [state, first, second] = [self.state, &self.first.to, &self.second.to].map(shorten);
        format!(
            "from `{state}`, transition {} leads to `{first}` and {} to `{second}`",
            self.first.number, self.second.number
        )
    }
}

/// The first state from which two commands lead to different states.
fn fork<'a>(machine: &'a StateMachine, one: &Command, other: &Command) -> Option<Fork<'a>> {
    caused(machine, one).find_map(|first| {
        let mut others = caused(machine, other).filter(|second| second.to != first.to);
        others.find_map(|second| {
            let state = first.from.iter().find(|state| second.from.contains(state))?;
            Some(Fork { state, first, second })
        })
    })
}

fn with_two_targets(machine: &StateMachine, command: &Command) -> Option<Diagnostic> {
    let fork = fork(machine, command, command)?;
    let message = format!("command `{}` leads from one state to two", shorten(&command.name));
    Some(
        Diagnostic::new(CODE, machine.place(command.span), message)
            .note(fork.words())
            .help("leave one of the two out of `transitions:`, or give it a command of its own"),
    )
}

fn both_given(
    machine: &StateMachine,
    device: &Dictionary,
    other: &Command,
    command: &Command,
) -> Option<Diagnostic> {
    let both = other.pattern.joined(&command.pattern)?;
    let fork = fork(machine, other, command)?;
    let value = some_value(device.entry(machine.command)?, &both)?;
    let message = format!(
        "{value:02X}h is `{}` and `{}`, which lead to different states",
        shorten(&other.name),
        shorten(&command.name)
    );
    Some(
        Diagnostic::new(CODE, machine.place(command.span), message)
            .with(machine.place(other.span), "the other command")
            .note(fork.words())
            .help("give the patterns a bit that is 0 in one command and 1 in the other"),
    )
}
