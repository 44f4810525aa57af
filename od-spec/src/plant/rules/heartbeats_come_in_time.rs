//! Nodes whose heartbeat is watched are on the bus, and send it often enough.

use super::{Check, Rule};
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity};
use crate::plant::Bus;

pub(super) const RULE: Rule = Rule { codes: &[NO_NODE, TOO_RARE], check: Check::Bus(check) };

const NO_NODE: &Code = &Code {
    id: "OD0853",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a heartbeat of a node that is not there",
    explanation: "A node watches the heartbeat (1016h) of a node-ID that no node of the machine has, nor the master, \
        as far as the type states. It will report that the node is gone, and do what it does then: a drive may stop. \
        Correct the node-ID; if it is the master's, state it at the type: `master: {node: 127}`.",
    clause: Some("CiA 301, 7.5.2.19 (object 1016h)"),
    example: Some(Example::plant(
        "types:\n  P1:\n    bit-rate: 125\n    positions: {left: {supply: 1, drive: 11}}\n    parameters: {drive: {1016: {1: {node: 2, time: 1 s}}}, supply: {1017: 500}}",
        "types:\n  P1:\n    bit-rate: 125\n    positions: {left: {supply: 1, drive: 11}}\n    parameters: {drive: {1016: {1: {node: 1, time: 1 s}}}, supply: {1017: 500}}",
    )),
};

const TOO_RARE: &Code = &Code {
    id: "OD0854",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a heartbeat that comes too rarely",
    explanation: "A node watches the heartbeat of another one (1016h) that sends none (1017h is 0), or sends it less \
        often than it is expected. It will report that the node is gone although it works. Set a time in 1017h of the \
        other node that is clearly shorter than the time in 1016h.",
    clause: Some("CiA 301, 7.5.2.19 and 7.5.2.20 (objects 1016h and 1017h)"),
    example: Some(Example::plant(
        "types:\n  P1:\n    bit-rate: 125\n    positions: {left: {supply: 1, drive: 11}}\n    parameters: {drive: {1016: {1: {node: 1, time: 1 s}}}, supply: {1017: 2000}}",
        "types:\n  P1:\n    bit-rate: 125\n    positions: {left: {supply: 1, drive: 11}}\n    parameters: {drive: {1016: {1: {node: 1, time: 1 s}}}, supply: {1017: 500}}",
    )),
};

fn check(bus: &Bus<'_>, diagnostics: &mut Diagnostics) {
    let plant = bus.plant;
    let machine = plant.machines.get(bus.machine);
    let master = machine.and_then(|machine| plant.types.get(machine.of_type)?.master.as_ref()?.node);
    for (at, settled) in &bus.nodes {
        let Some(node) = plant.nodes.get(*at) else { continue };
        for consumer in &settled.on_the_bus.watched {
            let (watched, wait) = (consumer.raw >> 16 & 0xFF, consumer.raw & 0xFFFF);
            let place = consumer.set_at.unwrap_or(node.node.span);
            if watched == 0 || wait == 0 || master.is_some_and(|master| i128::from(master.value) == watched) {
                continue;
            }
            let other = bus.nodes.iter().find_map(|(at, settled)| {
                let other = plant.nodes.get(*at)?;
                (i128::from(other.node.value) == watched).then_some((other, settled))
            });
            let Some((other, of_other)) = other else {
                let message =
                    format!("the heartbeat of node {watched} is watched, and the machine has no such node");
                diagnostics.push(
                    Diagnostic::new(NO_NODE, place, message)
                        .help(format!("correct the node-ID; if it is the master's, add `master: {{node: {watched}}}` to the type")),
                );
                continue;
            };
            let producer = of_other.on_the_bus.heartbeat.as_ref();
            let period = producer.map_or(0, |producer| producer.raw);
            if period == 0 || period >= wait {
                let key = plant.devices.get(other.device).map_or("", |device| &device.key);
                let sends = if period == 0 {
                    "sends no heartbeat".to_owned()
                } else {
                    format!("sends a heartbeat every {period} ms")
                };
                let message = format!("node {watched} {sends}, and one is expected every {wait} ms");
                let diagnostic = Diagnostic::new(TOO_RARE, place, message).help(format!(
                    "set 1017h of {key} at position {} to less than {wait} ms",
                    other.position
                ));
                let set_at = producer.and_then(|producer| producer.set_at).filter(|at| *at != place);
                diagnostics.push(match set_at {
                    Some(at) => diagnostic.with(at, "how often it comes"),
                    None => diagnostic,
                });
            }
        }
    }
}
