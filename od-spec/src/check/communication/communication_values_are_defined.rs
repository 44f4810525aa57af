//! Communication objects have values that CiA 301 defines, beyond what type and limits can say.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::{Subject, entry_id};
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{Entry, EntryId, Fact, Value};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Device(check) };

/// Largest node-ID.
const LAST_NODE: i128 = 127;
/// What is written to 1010h to store parameters: `save`.
const SAVE: i128 = 0x6576_6173;
/// What is written to 1011h to restore defaults: `load`.
const LOAD: i128 = 0x6461_6F6C;

/// What is wrong with a signature that a device would answer, and what to do.
const SIGNATURE: (&str, &str) = (
    "the signature is written and never read",
    "write what the device answers: 1 where it takes the command, otherwise 0",
);

const CODE: &Code = &Code {
    id: "OD0510",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "a value that a communication object does not have",
    explanation: "1003h.0, the number of errors, starts with 0 and can only be set to 0; what is read from 1010h and 1011h shows what the device can do, and is never the signature that is \
        written to them; 1016h watches the nodes 1 to 127, each of them once; the SYNC counter of 1019h runs to 2 to 240, or is not sent (0); the formats 1 to 127 of 1022h and the \
        reactions 3 to 127 of 1029h are reserved; sub-index 3 of an SDO channel is a node-ID. A device refuses any other value, and a download at boot stops there. Write a value that \
        CiA 301 defines.",
    clause: Some("CiA 301, objects 1003h, 1010h, 1011h, 1016h, 1019h, 1022h, 1029h and 1200h to 12FFh"),
    example: Some(Example::new(
        "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer, sync counter]}\nobjects:\n  0x1019: {from: cia301, default: 1}",
        "devices:\n  io: {name: Example, bit-rates: [125], features: [heartbeat producer, sync counter]}\nobjects:\n  0x1019: {from: cia301, default: 2}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for (id, entry, value) in subject.values().filter(|(id, ..)| id.index.is_communication_profile()) {
        let mut nodes = subject.nodes_of(value).filter_map(|node| Some((node, value.integer_for(node)?)));
        if let Some(finding) = nodes.find_map(|(node, raw)| problem(subject, id, entry, raw, node)) {
            findings.push(finding);
        }
    }
}

fn problem(subject: &Subject<'_>, id: EntryId, entry: &Entry, raw: i128, node: u8) -> Option<Diagnostic> {
    let reported = |what: &str, help: &str| Some(undefined(subject, id, entry, what, help));
    match (id.index.0, id.sub.0) {
        (0x1003, 0) if raw != 0 => reported("a device starts with an empty error history", "write 0"),
        // That no setting writes a command is said by itself.
        (0x1010, 1..) if raw == SAVE && !entry.is_set() => reported(SIGNATURE.0, SIGNATURE.1),
        (0x1011, 1..) if raw == LOAD && !entry.is_set() => reported(SIGNATURE.0, SIGNATURE.1),
        (0x1016, 1..) if raw >> 16 > LAST_NODE => {
            let help = "write the node-ID, 1 to 127, in bits 23..16 and the time in ms in bits 15..0";
            reported(&format!("{} is not a node-ID", raw >> 16), help)
        }
        (0x1016, 1..) => watched_twice(subject, id, entry, raw, node),
        // A value outside its limits is said by itself.
        (0x1019, 0) if matches!(raw, 1 | 241..) && entry.allows(raw) => {
            let what = format!("a SYNC counter that runs to {raw} is reserved");
            reported(&what, "write 2 to 240, or 0 for a SYNC without counter")
        }
        (0x1022, 0) if matches!(raw, 1..=127) => {
            reported(&format!("storage format {raw} is reserved"), "write 0 for an EDS as it is")
        }
        (0x1029, 1..) if matches!(raw, 3..=127) => {
            let help = "write 0 (pre-operational), 1 (no change), 2 (stopped), or a reaction of the maker's own, 128 to 255";
            reported(&format!("reaction {raw} is reserved"), help)
        }
        (0x1201..=0x12FF, 3) if raw > LAST_NODE => {
            reported(&format!("{raw} is not a node-ID"), "write the node-ID of the other side, 1 to 127")
        }
        _ => None,
    }
}

fn undefined(subject: &Subject<'_>, id: EntryId, entry: &Entry, what: &str, help: &str) -> Diagnostic {
    let message = format!("{id} ({}): {what}", entry.name);
    subject.finding(CODE, id, entry, Fact::Default, message).help(help)
}

/// The node that a value of 1016h watches: bits 23 to 16 are the node, 15 to 0 the time in ms; without either, none.
const fn watched(raw: i128) -> Option<i128> {
    let (node, time) = (raw >> 16, raw & 0xFFFF);
    if node == 0 || time == 0 { None } else { Some(node) }
}

/// A node that an entry before watches already; a setting is blamed before a default.
fn watched_twice(
    subject: &Subject<'_>,
    id: EntryId,
    entry: &Entry,
    raw: i128,
    own: u8,
) -> Option<Diagnostic> {
    let node = watched(raw)?;
    let of_own = |value: &Value| value.integer_for(own);
    let (first_id, first) = (1..id.sub.0).find_map(|sub| {
        let first_id = entry_id(id.index.0, sub);
        let first = subject.device.entry(first_id)?;
        let watches = first.default.as_ref().and_then(of_own).and_then(watched) == Some(node);
        watches.then_some((first_id, first))
    })?;
    let ((id, entry), (namesake_id, namesake)) = if first.is_set() && !entry.is_set() {
        ((first_id, first), (id, entry))
    } else {
        ((id, entry), (first_id, first))
    };
    let what = format!("{namesake_id} watches node {node}, too");
    let help = "watch each node once; a time of 0 switches an entry off";
    let finding = undefined(subject, id, entry, &what, help);
    let place = subject.place(namesake, Fact::Default);
    // What a library says has no place in the specification.
    Some(if place == subject.device.span { finding } else { finding.with(place, namesake_id.to_string()) })
}
