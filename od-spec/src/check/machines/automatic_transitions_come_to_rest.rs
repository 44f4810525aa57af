//! What a device does by itself ends in one state.

use std::collections::BTreeSet;

use super::paths::leaving;
use super::words::path;
use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::diag::{Code, Diagnostic, Example, Severity, shorten};
use crate::model::{ByDevice, StateMachine, System, Transition};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::System(check) };

const CODE: &Code = &Code {
    id: "OD0872",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "automatic transitions that do not come to rest",
    explanation: "A device makes an `automatic` transition as soon as what it does in the state is done. Two of them from one state to different states leave open which one it makes; several that form a circle keep the device from ever resting in a state, and a master sees it change without end. Write `event` where something has to happen first, and say in `event:` what.",
    clause: None,
    example: Some(Example::new(
        "objects:\n  0x2000: {name: command, type: unsigned8, access: rw}\n  0x2001: {name: status, type: unsigned8, access: ro}\nstate-machines:\n  pump:\n    status: status\n    command: command\n    states: {filling: {pattern: xxxx xxx0}, draining: {pattern: xxxx xxx1}}\n    transitions:\n      0: {from: start, to: filling, event: power-on}\n      1: {from: filling, to: draining, by-device: automatic, event: full}\n      2: {from: draining, to: filling, by-device: automatic, event: empty}",
        "objects:\n  0x2000: {name: command, type: unsigned8, access: rw}\n  0x2001: {name: status, type: unsigned8, access: ro}\nstate-machines:\n  pump:\n    status: status\n    command: command\n    states: {filling: {pattern: xxxx xxx0}, draining: {pattern: xxxx xxx1}}\n    transitions:\n      0: {from: start, to: filling, event: power-on}\n      1: {from: filling, to: draining, by-device: event, event: full}\n      2: {from: draining, to: filling, by-device: event, event: empty}",
    )),
};

fn check(system: &System, findings: &mut Findings) {
    for machine in system.machines.values() {
        let mut in_circles = BTreeSet::new();
        for state in &machine.states {
            let mut automatic = automatic(machine, &state.name);
            let Some(first) = automatic.next() else { continue };
            if let Some(other) = automatic.find(|other| other.to != first.to) {
                findings.push_each(two_ways(machine, &state.name, first, other));
            }
            if !in_circles.contains(state.name.as_str())
                && let Some(circle) = circle(machine, &state.name)
            {
                let message =
                    format!("what the device does by itself never ends: {}", path(circle.iter().copied()));
                findings.push_each(
                    Diagnostic::new(CODE, machine.place(first.span), message)
                        .help("write `by-device: event` where something has to happen first"),
                );
                in_circles.extend(circle);
            }
        }
    }
}

fn automatic<'a>(machine: &'a StateMachine, state: &'a str) -> impl Iterator<Item = &'a Transition> + Clone {
    leaving(machine, state).filter(|transition| transition.by_device == ByDevice::Automatic)
}

fn two_ways(machine: &StateMachine, state: &str, first: &Transition, other: &Transition) -> Diagnostic {
    let [state, one, two] = [state, &first.to, &other.to].map(shorten);
    let message = format!("`{state}` is left by itself to `{one}` and to `{two}`");
    Diagnostic::new(CODE, machine.place(other.span), message)
        .label(format!("to `{two}`"))
        .with(machine.place(first.span), format!("to `{one}`"))
        .help("write `by-device: event` where something decides, and say in `event:` what")
}

/// The states from one round to it again, by the shortest way.
fn circle<'a>(machine: &'a StateMachine, state: &'a str) -> Option<Vec<&'a str>> {
    let next = automatic(machine, state).map(|transition| transition.to.as_str());
    let reach = super::paths::Reach::over(machine, next, |one| one.by_device == ByDevice::Automatic);
    reach.has(state).then(|| std::iter::once(state).chain(reach.path(state)).collect())
}
