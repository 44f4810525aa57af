//! The first four PDOs of a direction start on the identifiers of the pre-defined connection set, and the others do not exist
//! at first.

use crate::check::communication::cob_ids_are_unrestricted::is_restricted;
use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::pdo::parameters::{NO_REMOTE_FRAMES, NOT_VALID, Parameter, title};
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Repeated, Severity};
use crate::model::{Direction, Pdo};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0823",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a PDO on an identifier that no node expects",
    explanation: "After start-up, the PDOs 1 to 4 of each direction have the identifiers of the pre-defined connection set (180h, 280h, 380h and 480h + node-ID of a TPDO, 200h to 500h + \
        node-ID of an RPDO), and no other PDO exists, because no standard has reserved an identifier for it: it may be that of a PDO of another node. This PDO is valid on another \
        identifier, so that it sends or receives before a master has given it one. Write the identifier of the set, or make the PDO not valid (bit 31).",
    clause: Some("CiA 301, table 34 (pre-defined connection set), objects 1400h and 1800h"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {cob-id: $NODEID + 0x280, map: [level]}}}",
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {map: [level]}}}",
    )),
};

/// How many PDOs of a direction have an identifier in the pre-defined connection set.
const PREDEFINED: u16 = 4;

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    // What is set for a node was wished for, and the master that sets it knows.
    if subject.node.is_some() {
        return;
    }
    let mut found = Repeated::new();
    for pdo in &subject.device.pdos {
        let Some(parameter) = subject.communication(pdo, 1) else { continue };
        let base = predefined(pdo);
        let expected = |node: u8| base.map(|base| base + i128::from(node));
        let Some((node, actual)) = unexpected(subject, &parameter, expected) else { continue };
        found.add(parameter.place, [], || {
            let (id, title) = (parameter.id, title(pdo));
            let (message, identifier) = match base {
                Some(base) => (
                    format!(
                        "{id}: {title} starts on {actual:X}h on node {node}, masters expect {:X}h",
                        base + i128::from(node)
                    ),
                    format!("write `$NODEID+0x{base:X}`, or "),
                ),
                None => (
                    format!(
                        "{id}: {title} exists from the start, on {actual:X}h{}, which is not reserved for it",
                        subject.on_node(parameter.value, node)
                    ),
                    String::new(),
                ),
            };
            parameter.finding(CODE, message).help(subject.help(Help {
                specification: &format!(
                    "{identifier}make the PDO `valid: no`; a master that uses it gives it an identifier"
                ),
                eds: &format!(
                    "{identifier}set bit 31, not valid; a master that uses it gives it an identifier"
                ),
                setting: "set bit 31, not valid, or an identifier that is free",
            }))
        });
    }
    if let Some(finding) = found.into_diagnostic("PDOs") {
        findings.push(finding);
    }
}

/// The identifier of the pre-defined connection set on node 0.
fn predefined(pdo: &Pdo) -> Option<i128> {
    let first: u16 = match pdo.direction {
        Direction::Transmit => 0x180,
        Direction::Receive => 0x200,
    };
    (pdo.number <= PREDEFINED).then(|| i128::from(first + (pdo.number - 1) * 0x100))
}

/// The first node on which the PDO exists with another identifier, and that identifier.
fn unexpected(
    subject: &Subject<'_>,
    parameter: &Parameter<'_>,
    expected: impl Fn(u8) -> Option<i128>,
) -> Option<(u8, i128)> {
    let valid = |node| {
        let raw = parameter.value.integer_for(node).filter(|raw| raw & NOT_VALID == 0)?;
        Some((node, raw & !NO_REMOTE_FRAMES))
    };
    let mut identifiers = subject.nodes().filter_map(valid);
    // An identifier that no PDO can have is said by itself.
    if identifiers.clone().any(|(_, id)| id > 0x7FF || is_restricted(id)) {
        return None;
    }
    identifiers.find(|(node, id)| expected(*node) != Some(*id))
}
