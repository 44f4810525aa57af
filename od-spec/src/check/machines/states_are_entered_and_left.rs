//! A state machine has one start, from which a path leads to each state, and a path leads on from each.

use super::paths::{Reach, leaving, starts};
use super::words::{list, path};
use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::diag::{Code, Diagnostic, Example, Severity, shorten};
use crate::model::{State, StateMachine, System};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::System(check) };

const CODE: &Code = &Code {
    id: "OD0870",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a state that is never entered or never left",
    explanation: "The transitions of a state machine lead from its start to each of its states, and on from there. Without a start, or with two, its beginning is undefined, and generated code leaves \
        that to the firmware; a state that no path leads to is never shown; one that no transition leaves, such as a fault without a reset, holds the device until it is switched off. \
        Most often a transition is missing, or names another state. The message shows the path. Where switching off is meant to be the only way out, say so under `allow:`.",
    clause: None,
    example: Some(Example::new(
        "objects:\n  0x2000: {name: command, type: unsigned8, access: rw}\n  0x2001: {name: status, type: unsigned8, access: ro}\nstate-machines:\n  motor:\n    status: status\n    command: command\n    states: {stopped: {pattern: xxxx xxx0}, running: {pattern: xxxx xxx1}}\n    transitions:\n      0: {from: start, to: stopped, event: power-on}\n      1: {from: stopped, to: running, event: a key}",
        "objects:\n  0x2000: {name: command, type: unsigned8, access: rw}\n  0x2001: {name: status, type: unsigned8, access: ro}\nstate-machines:\n  motor:\n    status: status\n    command: command\n    states: {stopped: {pattern: xxxx xxx0}, running: {pattern: xxxx xxx1}}\n    transitions:\n      0: {from: start, to: stopped, event: power-on}\n      1: {from: stopped, to: running, event: a key}\n      2: {from: running, to: stopped, event: another key}",
    )),
};

fn check(system: &System, findings: &mut Findings) {
    // Without any transition, a machine says how states look and nothing more.
    for machine in system.machines.values().filter(|machine| !machine.transitions.is_empty()) {
        let from_start = Reach::of(machine, starts(machine).map(|start| start.to.as_str()));
        check_start(machine, findings);
        if starts(machine).next().is_some() {
            check_reached(machine, &from_start, findings);
        }
        check_left(machine, &from_start, findings);
        check_return(machine, &from_start, findings);
    }
}

fn check_start(machine: &StateMachine, findings: &mut Findings) {
    let name = shorten(&machine.name);
    let mut starts = starts(machine);
    match (starts.next(), starts.next()) {
        (None, _) => findings.push_each(
            Diagnostic::new(CODE, machine.span, format!("state machine `{name}` has no start"))
                .help("add a transition with `from: start` to the state after power-on"),
        ),
        (Some(first), Some(second)) => {
            let message = format!(
                "state machine `{name}` starts with transition {} and with {}",
                first.number, second.number
            );
            findings.push_each(
                Diagnostic::new(CODE, machine.place(second.span), message)
                    .label(format!("to `{}`", shorten(&second.to)))
                    .with(machine.place(first.span), format!("to `{}`", shorten(&first.to)))
                    .help("keep one; what the device does next by itself is another transition"),
            );
        }
        (Some(_), None) => {}
    }
}

fn check_reached(machine: &StateMachine, from_start: &Reach<'_>, findings: &mut Findings) {
    for state in machine.states.iter().filter(|state| !from_start.has(&state.name)) {
        let message = format!("no path leads from the start to `{}`", shorten(&state.name));
        findings.push_each(
            Diagnostic::new(CODE, machine.place(state.span), message)
                .note(format!("the start leads to {}", list(from_start.states())))
                .help("add the transition that enters it, or correct one that should"),
        );
    }
}

fn check_left(machine: &StateMachine, from_start: &Reach<'_>, findings: &mut Findings) {
    // Of a single state, nothing else is known.
    if machine.states.len() < 2 {
        return;
    }
    for state in machine.states.iter().filter(|state| is_end(machine, state)) {
        let message = format!("`{}` is entered and never left", shorten(&state.name));
        let diagnostic = Diagnostic::new(CODE, machine.place(state.span), message)
            .help("add the transition that leaves it, such as a reset");
        findings.push_each(match from_start.path(&state.name).as_slice() {
            [_] => diagnostic,
            way => diagnostic.note(format!("it is entered by {}", path(way.iter().copied()))),
        });
    }
}

fn is_end(machine: &StateMachine, state: &State) -> bool {
    let is_entered = machine.transitions.iter().any(|transition| transition.to == state.name);
    is_entered && leaving(machine, &state.name).next().is_none()
}

/// Where the first state can be entered again, it can be entered again from everywhere.
fn check_return(machine: &StateMachine, from_start: &Reach<'_>, findings: &mut Findings) {
    let Some(first) = starts(machine).next().map(|start| start.to.as_str()) else { return };
    let leads_to = |from: &str, to: &str| {
        let next = leaving(machine, from).map(|transition| transition.to.as_str());
        Reach::of(machine, next).has(to)
    };
    if !leads_to(first, first) {
        return;
    }
    let mut lost = machine
        .states
        .iter()
        .filter(|state| from_start.has(&state.name) && state.name != first && !leads_to(&state.name, first));
    let Some(state) = lost.next() else { return };
    let next = Reach::of(machine, std::iter::once(state.name.as_str()));
    // An end is reported already.
    if machine.states.iter().any(|state| next.has(&state.name) && is_end(machine, state)) {
        return;
    }
    let message = format!("no path leads back from `{}` to `{}`", shorten(&state.name), shorten(first));
    findings.push_each(
        Diagnostic::new(CODE, machine.place(state.span), message)
            .note(format!("it is entered by {}", path(from_start.path(&state.name))))
            .note(format!("it leads to {}", list(next.states().filter(|next| *next != state.name))))
            .help("add the transition that leads back, such as a reset"),
    );
}
