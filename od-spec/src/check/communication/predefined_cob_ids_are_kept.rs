//! EMCY and the first SDO channel of a type have the identifiers of the pre-defined connection set.

use crate::check::findings::Findings;
use crate::check::pdo::parameters::{NO_REMOTE_FRAMES, NOT_VALID};
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::{Subject, entry_id};
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{Fact, Index, SubIndex};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0815",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "EMCY or SDO on an unexpected identifier",
    explanation: "A master listens for emergency messages on 80h + node-ID and talks to a device on 600h and 580h + node-ID without asking which identifiers it has. The default of \
        1014h or 1200h says another one, often because `$NODEID` was forgotten, so that all nodes of the type would share it; or 1200h has a sub-index 3, which \
        only further channels have. Remove the default: the library has the right one.",
    clause: Some("CiA 301, table 34 (pre-defined connection set), objects 1014h and 1200h"),
    example: Some(Example::new(
        "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer, emergency]}\nobjects:\n  0x1014: {from: cia301, default: 0x81}",
        "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer, emergency]}\nobjects:\n  0x1014: {from: cia301}",
    )),
};

/// A service whose identifier follows from the node-ID.
struct Service {
    index: u16,
    sub: u8,
    name: &'static str,
    base: u16,
}

const SERVICES: [Service; 3] = [
    Service { index: 0x1014, sub: 0, name: "EMCY", base: 0x80 },
    Service { index: 0x1200, sub: 1, name: "requests of the first SDO channel", base: 0x600 },
    Service { index: 0x1200, sub: 2, name: "answers of the first SDO channel", base: 0x580 },
];

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    // What is set for a node was wished for, and the master that sets it knows.
    if subject.node.is_some() {
        return;
    }
    for service in SERVICES {
        let Some(parameter) = subject.parameter(service.index, service.sub) else { continue };
        let other = |node: &u8| {
            // Bit 30 is reserved; that it is set is said by itself.
            let raw = parameter.value.integer_for(*node)? & !NO_REMOTE_FRAMES;
            let is_off = service.index == 0x1014 && raw & NOT_VALID != 0;
            (!is_off && raw != i128::from(service.base) + i128::from(*node)).then_some(raw)
        };
        let Some(node) = subject.nodes().find(|node| other(node).is_some()) else { continue };
        let (raw, on_node) = (other(&node).unwrap_or_default(), format!(" on node {node}"));
        let (id, expected) = (parameter.id, i128::from(service.base) + i128::from(node));
        let message = format!("{id}: {} {raw:X}h{on_node}, masters expect {expected:X}h", uses(service.name));
        let help = format!("write `$NODEID+0x{:X}`, or remove the default", service.base);
        findings.push(Diagnostic::new(CODE, parameter.place, message).help(help));
    }
    let client = entry_id(0x1200, 3);
    if let Some(entry) =
        subject.device.objects.get(&Index(0x1200)).and_then(|object| object.entry(SubIndex(3)))
    {
        let message = format!("{client} ({}): the first SDO channel is open to every client", entry.name);
        let help = "remove sub-index 3; only 1201h and following have it";
        findings.push(Diagnostic::new(CODE, subject.place(entry, Fact::Name), message).help(help));
    }
}

/// `EMCY has`, `requests … have`.
fn uses(name: &str) -> String {
    if name == "EMCY" { format!("{name} has") } else { format!("{name} have") }
}
