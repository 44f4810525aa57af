//! Where a type states what its master sends and receives, each PDO has a sender and a receiver.

use std::collections::{BTreeMap, BTreeSet};

use super::{Check, Rule};
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity, codes};
use crate::plant::{Bus, Message, Traffic};
use crate::traffic::shown;

pub(super) const RULE: Rule = Rule { codes: &[RECEIVED, SENT], check: Check::Bus(check) };

const RECEIVED: &Code = &Code {
    id: "OD0851",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a PDO that no node receives",
    explanation: "A node sends a PDO that no other node receives, nor the master, as far as the type states; or the master sends one that no node receives. An actual value that is not read hides a mistake \
        in a COB-ID, and a set-point that no node receives leaves a drive where it is. Correct the COB-ID of one end, switch the PDO off, or add it to what the master receives. Types without \
        `master:` are not looked at: the master is normally the other end, and the file does not state what it does.",
    clause: None,
    example: Some(Example::plant(
        "types:\n  P1:\n    bit-rate: 125\n    positions: {left: {drive: 11}}\n    master: {sends: [0x20B]}",
        "types:\n  P1:\n    bit-rate: 125\n    positions: {left: {drive: 11}}\n    master: {sends: [0x20B], receives: [0x18B]}",
    )),
};

const SENT: &Code = &Code {
    id: "OD0852",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a PDO that no node sends",
    explanation: "A node waits for a PDO that no other node sends, nor the master, as far as the type states; or the \
        master waits for one that no node sends. The node continues with the last value that it had. Correct the \
        COB-ID of one end, switch the PDO off, or add it to what the master sends. Types without `master:` are not \
        looked at.",
    clause: None,
    example: Some(Example::plant(
        "types:\n  P1:\n    bit-rate: 125\n    positions: {left: {drive: 11}}\n    master: {receives: [0x18B]}",
        "types:\n  P1:\n    bit-rate: 125\n    positions: {left: {drive: 11}}\n    master: {sends: [0x20B], receives: [0x18B]}",
    )),
};

fn check(bus: &Bus<'_>, diagnostics: &mut Diagnostics) {
    let plant = bus.plant;
    let of_type = plant.machines.get(bus.machine).and_then(|machine| plant.types.get(machine.of_type));
    let Some(master) = of_type.and_then(|one| one.master.as_ref()) else { return };
    let pdos = || bus.messages.iter().filter(|message| matches!(message.traffic, Traffic::Pdo(..)));
    // In the notation of messages: what needs 29 bits has the bit that says so.
    let wide = |id: u32| if id > 0x7FF { id | 1 << 29 } else { id };
    let ids = |is_sent: bool| pdos().filter(move |one| one.is_sent == is_sent).map(|one| one.id);
    let (sent, received): (BTreeSet<u32>, BTreeSet<u32>) = (ids(true).collect(), ids(false).collect());
    let of_master = |list: &[crate::source::Spanned<u32>]| -> BTreeSet<u32> {
        list.iter().map(|id| wide(id.value)).collect()
    };
    let (master_sends, master_receives) = (of_master(&master.sends), of_master(&master.receives));
    for message in pdos() {
        let has_other_end = if message.is_sent {
            received.contains(&message.id) || master_receives.contains(&message.id)
        } else {
            sent.contains(&message.id) || master_sends.contains(&message.id)
        };
        if !has_other_end && let Some(finding) = without_end(bus, message) {
            diagnostics.push(finding);
        }
    }
    for (list, does) in [(&master.sends, "sends"), (&master.receives, "receives")] {
        let mut before = BTreeMap::new();
        for id in list {
            if let Some(first) = before.insert(id.value, id.span) {
                let message = format!("the master {does} {} twice", shown(id.value));
                diagnostics.push(
                    Diagnostic::new(codes::DUPLICATE_VALUE, id.span, message)
                        .with(first, "first here")
                        .help("correct one of the two, or remove it"),
                );
            }
        }
    }
    for (list, other, code, does, lacks) in [
        (&master.sends, &received, RECEIVED, "sends", "receives"),
        (&master.receives, &sent, SENT, "receives", "sends"),
    ] {
        for id in list.iter().filter(|id| !other.contains(&wide(id.value))) {
            let message = format!("the master {does} {}, and no node {lacks} it", shown(id.value));
            diagnostics.push(
                Diagnostic::new(code, id.span, message)
                    .help("correct the COB-ID, or remove it from what the master does"),
            );
        }
    }
}

fn without_end(bus: &Bus<'_>, message: &Message) -> Option<Diagnostic> {
    let plant = bus.plant;
    let (code, lacks, list) =
        if message.is_sent { (RECEIVED, "receives", "receives") } else { (SENT, "sends", "sends") };
    let text = format!("no node {lacks} {} ({})", message.short(plant), shown(message.id));
    Some(Diagnostic::new(code, message.place(plant)?, text).help(format!(
        "correct its COB-ID, switch it off (bit 31), or add {} to what the master `{list}:`",
        format_args!("0x{:X}", message.id & 0x1FFF_FFFF)
    )))
}
