//! A PDO carries an entry once.

use crate::check::findings::Findings;
use crate::check::pdo::parameters::{target, title};
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::{Direction, PdoTarget};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0819",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "an entry twice in one PDO",
    explanation: "One PDO maps the same entry at two places. A TPDO would send it twice and waste the room; in an RPDO the second value overwrites the first, also where it is written through a view of the entry. Probably another entry \
        was meant. Several PDOs may map one entry: a controlword travels in many. Map the entry that was meant.",
    clause: Some("CiA 301, objects 1600h and 1A00h (PDO mapping parameters)"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\n  0x2001: {name: limit, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {map: [level, level]}}}",
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\n  0x2001: {name: limit, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {map: [level, limit]}}}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for pdo in &subject.device.pdos {
        let mut before = std::collections::BTreeMap::new();
        for parameter in subject.mapped(pdo) {
            let Some(mapped) = target(parameter.raw()) else { continue };
            // Placeholders fill gaps, of which there may be several.
            let PdoTarget::Entry(mapped_id) = mapped.target else { continue };
            // What is written through a view is the value of its target.
            let view = subject.device.entry(mapped_id).and_then(|entry| entry.alias.as_ref());
            let id = match (view, pdo.direction) {
                (Some(alias), Direction::Receive) => alias.target,
                (Some(_), Direction::Transmit) | (None, _) => mapped_id,
            };
            let (at, place) = (parameter.id, parameter.place);
            let Some((first, first_place)) = before.insert(id, (at, place)) else { continue };
            let message = format!("{} maps {id} twice, at {first} and {at}", title(pdo));
            let diagnostic = parameter.finding(CODE, message).label("again here");
            let help = "map the entry that was meant, or leave one of the two out";
            findings.push(diagnostic.with(first_place, "first here").help(help));
        }
    }
}
