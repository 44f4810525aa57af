//! Each message of a bus has one sender, and what receives PDOs gets PDOs.

use std::collections::BTreeMap;

use super::{Check, Rule};
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity};
use crate::model::Dictionary;
use crate::plant::{Bus, Message, Traffic};
use crate::traffic::{messages, shown};

pub(super) const RULE: Rule = Rule { codes: &[CODE], check: Check::Bus(check) };

const CODE: &Code = &Code {
    id: "OD0741",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "a COB-ID that two nodes of a bus send, or that is another service's",
    explanation: "Two nodes of one machine send messages with the same identifier, or a PDO has the one of another \
        node's SDO, EMCY or heartbeat. Sent at the same time such messages disturb each other on the bus until a node \
        goes off, and a node that receives one takes it for the other: a heartbeat may become a set-point. The \
        identifiers are those that the nodes have once they are configured. Give one of the messages another COB-ID, \
        or switch it off (bit 31).",
    clause: Some("CiA 301, 7.3.3 (pre-defined connection set)"),
    example: Some(Example::plant(
        "types:\n  P1:\n    bit-rate: 125\n    positions: {left: {supply: 1, drive: 11}, right: {drive: 12}}\n    parameters: {drive: {1800.1: 0x181}}",
        "types:\n  P1:\n    bit-rate: 125\n    positions: {left: {supply: 1, drive: 11}, right: {drive: 12}}\n    parameters: {drive: {1800.1: $NODEID + 0x180}}",
    )),
};

fn check(bus: &Bus<'_>, diagnostics: &mut Diagnostics) {
    let mut by_id: BTreeMap<u32, Vec<&Message>> = BTreeMap::new();
    for message in &bus.messages {
        by_id.entry(message.id).or_default().push(message);
    }
    for (id, messages) in by_id {
        for (at, second) in messages.iter().enumerate() {
            let clash = messages[..at].iter().find(|first| clash(bus, first, second));
            if let Some(first) = clash {
                if let Some(finding) = finding(bus, id, first, second) {
                    diagnostics.push(finding);
                }
                break;
            }
        }
    }
}

/// Whether two messages cannot have one identifier. That two nodes have one node-ID is said by itself, and so is a clash within
/// a node.
fn clash(bus: &Bus<'_>, first: &Message, second: &Message) -> bool {
    let id = |message: &Message| bus.plant.nodes.get(message.node).map(|node| node.node.value);
    if first.node == second.node || id(first) == id(second) {
        return false;
    }
    let is_pdo = |message: &Message| matches!(message.traffic, Traffic::Pdo(..));
    match (first.is_sent, second.is_sent) {
        (true, true) => true,
        // Any number of nodes may listen; requests to a server are no PDOs of another node.
        (false, false) => {
            is_pdo(first) != is_pdo(second)
                && [first, second].iter().any(|message| message.traffic == Traffic::Request)
        }
        // A PDO is for PDOs; the two ends of an SDO channel have one identifier.
        (true, false) | (false, true) => is_pdo(first) != is_pdo(second),
    }
}

fn finding(bus: &Bus<'_>, id: u32, first: &Message, second: &Message) -> Option<Diagnostic> {
    let plant = bus.plant;
    // What is set can be set otherwise.
    let (blamed, other) =
        if first.set_at.is_some() && second.set_at.is_none() { (first, second) } else { (second, first) };
    let message = format!("{} and {} have the COB-ID {}", first.short(plant), second.short(plant), shown(id));
    let diagnostic = Diagnostic::new(CODE, blamed.place(plant)?, message)
        .label(blamed.short(plant))
        .help("give one of them another COB-ID, or switch it off (bit 31)");
    let elsewhere = other.place(plant).filter(|place| Some(*place) != blamed.place(plant));
    Some(match elsewhere {
        Some(place) => diagnostic.with(place, other.short(plant)),
        None => diagnostic,
    })
}

/// Returns what is wrong where two nodes of a bus, each with its node-ID and its values, send messages with one COB-ID. Any
/// number of nodes may be able to send SYNC or TIME.
pub fn shared_cob_id(first: (u8, &Dictionary), second: (u8, &Dictionary)) -> Option<Diagnostic> {
    let sent = |(id, device): (u8, &Dictionary)| {
        let mut sent = messages(device, id);
        sent.retain(|one| one.is_sent && !matches!(one.traffic, Traffic::Sync | Traffic::Time));
        sent
    };
    let of_second = sent(second);
    let (one, other) = sent(first).into_iter().find_map(|one| {
        let other = of_second.iter().find(|other| other.id == one.id)?;
        Some((one, other))
    })?;
    let words = |message: &Message, (id, device): (u8, &Dictionary)| {
        format!("{} of {} (node {id})", message.traffic.words(), device.key)
    };
    let message =
        format!("{} and {} have the COB-ID {}", words(&one, first), words(other, second), shown(one.id));
    Some(
        Diagnostic::without_place(CODE, message)
            .help("give one of them another COB-ID, or switch it off (bit 31)"),
    )
}
