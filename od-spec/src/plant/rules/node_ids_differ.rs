//! Each node-ID of a bus is that of one node.

use std::collections::BTreeMap;

use super::{Check, Rule};
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity};
use crate::plant::Bus;
use crate::source::Span;

pub(super) const RULE: Rule = Rule { codes: &[CODE], check: Check::Bus(check) };

const CODE: &Code = &Code {
    id: "OD0740",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "a node-ID that two nodes of a bus have",
    explanation: "Two nodes of one machine, or a node and the master, have the same node-ID. Both would answer each request, and neither could be configured; \
        a drive might take the set-points of the other. Give one of them another node-ID. Of what a run or a type says, the message names the first machine.",
    clause: Some("CiA 301, 7.2.3 (NMT) and 7.3.3 (pre-defined connection set)"),
    example: Some(Example::plant(
        "types:\n  P1:\n    bit-rate: 125\n    positions: {left: {supply: 1, drive: 11}, right: {drive: 11}}",
        "types:\n  P1:\n    bit-rate: 125\n    positions: {left: {supply: 1, drive: 11}, right: {drive: 12}}",
    )),
};

fn check(bus: &Bus<'_>, diagnostics: &mut Diagnostics) {
    let plant = bus.plant;
    let machine = plant.machines.get(bus.machine);
    let master = machine.and_then(|machine| plant.types.get(machine.of_type)?.master.as_ref()?.node);
    let mut first: BTreeMap<u8, (Span, String)> = BTreeMap::new();
    if let Some(node) = master {
        first.insert(node.value, (node.span, "the master".to_owned()));
    }
    for (at, _) in &bus.nodes {
        let Some(node) = plant.nodes.get(*at) else { continue };
        let key = plant.devices.get(node.device).map_or("", |device| &device.key);
        let name = format!("{key} at position {}", node.position);
        match first.get(&node.node.value) {
            Some((span, other)) => {
                let message = format!("{other} and {name} have the node-ID {}", node.node.value);
                diagnostics.push(
                    Diagnostic::new(CODE, node.node.span, message)
                        .label(name)
                        .with(*span, other.clone())
                        .help("give one of them another node-ID"),
                );
            }
            None => {
                first.insert(node.node.value, (node.node.span, name));
            }
        }
    }
}
