//! The COB-IDs of PDOs, SYNC, TIME, EMCY and SDO channels are 11-bit identifiers that no other service has for itself, on every node.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::pdo::parameters::{NO_REMOTE_FRAMES, NOT_VALID, Parameter};
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Device(check) };

pub(crate) const CODE: &Code = &Code {
    id: "OD0503",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "an unusable COB-ID",
    explanation: "The identifier of a PDO, of SYNC, TIME, EMCY or of an SDO channel other than the first has more than 11 bits or is kept for NMT, SDO, heartbeat \
        or LSS. A message on such an identifier would disturb a service that every device relies on: a PDO with the identifier 0 stops nodes. A device \
        refuses it with abort code 0609 0030h. `cob-id:` is the identifier alone; the flag bits follow from `valid:` and `no-rtr:`. Write a free \
        identifier.",
    clause: Some("CiA 301, table 35 (restricted CAN identifiers)"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {cob-id: $NODEID + 0x600, map: [level]}}}",
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {cob-id: $NODEID + 0x180, map: [level]}}}",
    )),
};

/// CAN identifiers that CiA 301 table 35 keeps from configurable services; 002h to 07Fh since version 4.2.
const RESTRICTED: [std::ops::RangeInclusive<i128>; 8] = [
    0x000..=0x000,
    0x001..=0x07F,
    0x101..=0x180,
    0x581..=0x5FF,
    0x601..=0x67F,
    0x6E0..=0x6E0,
    0x701..=0x77F,
    0x780..=0x7FF,
];

/// CAN identifiers of the first SDO channel of a node: requests and answers, as sub-index 1 and 2 have them (CiA 301 table 34).
const FIRST_CHANNEL: [std::ops::RangeInclusive<i128>; 2] = [0x601..=0x67F, 0x581..=0x5FF];

/// What bit 31 of a COB-ID says.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Bit31 {
    /// That the message does not exist.
    NotValid,
    /// Nothing about the identifier: SYNC and TIME.
    Other,
}

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let pdos = subject.device.pdos.iter().filter_map(|pdo| subject.communication(pdo, 1));
    let pdos = pdos.map(|parameter| (parameter, Bit31::NotValid));
    for (parameter, bit_31) in pdos.chain(services(subject)) {
        if let Some(problem) = subject.nodes().find_map(|node| problem(subject, &parameter, bit_31, node)) {
            let message = format!("{}: {problem}", parameter.id);
            let of_pdo = "write a free identifier; bits 31 (no PDO) and 30 (no remote frames) are flags";
            let help = if is_of_pdo(&parameter) {
                subject.help(Help {
                    specification: "write a free identifier; bits 31 (no PDO, `valid: no`) and 30 (no remote frames, `no-rtr: yes`) are flags",
                    eds: of_pdo,
                    setting: of_pdo,
                })
            } else {
                "write a free identifier; bits 31 and 30 are flags".to_owned()
            };
            findings.push(
                parameter
                    .finding(CODE, message)
                    .help(help)
                    .note("CiA 301 table 35: restricted CAN identifiers"),
            );
        }
    }
}

const fn is_of_pdo(parameter: &Parameter<'_>) -> bool {
    matches!(parameter.id.index.0, 0x1400..=0x15FF | 0x1800..=0x19FF)
}

/// The COB-IDs of services that can be configured; the first SDO channel (1200h) has restricted ones by right.
fn services<'a>(subject: &Subject<'a>) -> impl Iterator<Item = (Parameter<'a>, Bit31)> {
    let subject = *subject;
    subject.device.entries().filter_map(move |(id, ..)| {
        let bit_31 = match (id.index.0, id.sub.0) {
            (0x1005 | 0x1012, 0) => Bit31::Other,
            (0x1014, 0) | (0x1028, 1..) | (0x1201..=0x12FF, 1 | 2) => Bit31::NotValid,
            _ => return None,
        };
        Some((subject.parameter(id.index.0, id.sub.0)?, bit_31))
    })
}

fn problem(subject: &Subject<'_>, parameter: &Parameter<'_>, bit_31: Bit31, node: u8) -> Option<String> {
    let raw = parameter.value.integer_for(node)?;
    let id = raw & !(NOT_VALID | NO_REMOTE_FRAMES);
    let on_node = || subject.on_node(parameter.value, node);
    if id > 0x7FF {
        return Some(format!("{id:X}h{} is no 11-bit identifier", on_node()));
    }
    // A message that does not exist disturbs no service, whatever its identifier.
    if bit_31 == Bit31::NotValid && raw & NOT_VALID != 0 {
        return None;
    }
    // A client talks to the first channel of another node on the identifiers that are kept for that.
    let is_client = matches!(parameter.id.index.0, 0x1280..=0x12FF);
    let kept = FIRST_CHANNEL.iter().position(|range| is_client && range.contains(&id));
    match (kept, parameter.id.sub.0) {
        (Some(0), 1) | (Some(1), 2) => None,
        (Some(0), _) => {
            Some(format!("{id:03X}h{} is kept for requests to a server, not for its answers", on_node()))
        }
        (Some(_), _) => {
            Some(format!("{id:03X}h{} is kept for answers of a server, not for requests to it", on_node()))
        }
        (None, _) => is_restricted(id).then(|| format!("{id:03X}h{} is kept for another service", on_node())),
    }
}

/// Whether an identifier is kept for a service that cannot be moved.
pub(in crate::check) fn is_restricted(id: i128) -> bool {
    RESTRICTED.iter().any(|restricted| restricted.contains(&id))
}
