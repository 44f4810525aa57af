//! PDOs and further SDO channels that exist after start-up, and the services SYNC, TIME and EMCY, have COB-IDs of their own.

use super::findings::Findings;
use super::pdo::{NOT_VALID, Parameter, title};
use super::rule::{Check, Needs, Rule};
use super::subject::Subject;
use super::subject::entry_id;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{Fact, Index, Value};
use crate::source::Span;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0504",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "two services with one COB-ID",
    explanation: "Two PDOs that are valid after start-up, a PDO or an SDO channel and SYNC, TIME or EMCY, or two of these use one identifier; the device would disturb its own traffic, \
        and a receiver would take one for the other. Give one of them another identifier, or make the PDO `valid: no`.",
    clause: Some("CiA 301, tables 33 and 34 (pre-defined connection set)"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {map: [level]}, 2: {cob-id: $NODEID + 0x180, map: [level]}}}",
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {map: [level]}, 2: {map: [level]}}}",
    )),
};

/// Services that a device has once.
const SERVICES: [(u16, &str); 3] = [(0x1005, "SYNC"), (0x1012, "TIME"), (0x1014, "EMCY")];

/// Something that has a COB-ID.
struct User<'a> {
    name: String,
    value: &'a Value,
    place: Span,
    is_set: bool,
}

impl User<'_> {
    /// The identifier on a node, whatever the flag bits. That 0 cannot be one is said by itself.
    fn identifier(&self, node: u8) -> Option<i128> {
        self.value.integer_for(node).map(|raw| raw & 0x1FFF_FFFF).filter(|id| *id != 0)
    }
}

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let users = users(subject);
    for (at, second) in users.iter().enumerate() {
        for first in &users[..at] {
            let clash =
                |node: &u8| first.identifier(*node).is_some_and(|id| second.identifier(*node) == Some(id));
            if let Some(node) = subject.nodes().find(clash) {
                findings.push_each(finding(subject, first, second, node));
            }
        }
    }
}

/// The services, the SDO channels that exist, and then the PDOs that exist.
fn users<'a>(subject: &Subject<'a>) -> Vec<User<'a>> {
    let services = SERVICES.iter().filter_map(|(index, service)| {
        let id = entry_id(*index, 0);
        let entry = subject.device.entry(id)?;
        // Bit 31 of 1014h says that there is no EMCY; in 1005h and 1012h it says nothing about the identifier.
        let is_off = |node| {
            let raw = entry.default.as_ref().and_then(|value| value.integer_for(node));
            *index == 0x1014 && raw.is_some_and(|raw| raw & NOT_VALID != 0)
        };
        if subject.nodes().all(is_off) {
            return None;
        }
        Some(User {
            name: format!("{service} ({id})"),
            value: entry.default.as_ref()?,
            place: subject.place(entry, Fact::Default),
            is_set: entry.is_set(),
        })
    });
    let pdos = subject.device.pdos.iter().filter_map(|pdo| {
        let parameter = subject.communication(pdo, 1)?;
        let exists = |node| parameter.value.integer_for(node).is_some_and(|raw| raw & NOT_VALID == 0);
        subject.nodes().any(exists).then(|| User {
            name: title(pdo),
            value: parameter.value,
            place: parameter.place,
            is_set: parameter.entry.is_set(),
        })
    });
    services.chain(channels(subject)).chain(pdos).collect()
}

/// The two directions of each SDO channel beside the first; it exists while both are valid.
fn channels<'a>(subject: &Subject<'a>) -> impl Iterator<Item = User<'a>> {
    let subject = *subject;
    let exists = move |parameter: &Parameter<'_>| {
        let valid = |node| parameter.value.integer_for(node).is_some_and(|raw| raw & NOT_VALID == 0);
        subject.nodes().any(valid)
    };
    let channels = subject.device.objects.range(Index(0x1201)..Index(0x1300)).map(|(index, _)| *index);
    let both = channels.filter_map(move |index| {
        let (first, second) = (subject.parameter(index.0, 1)?, subject.parameter(index.0, 2)?);
        (exists(&first) && exists(&second)).then_some([first, second])
    });
    both.flatten().map(|parameter| User {
        name: format!("the SDO channel ({})", parameter.id),
        value: parameter.value,
        place: parameter.place,
        is_set: parameter.entry.is_set(),
    })
}

fn finding(subject: &Subject<'_>, first: &User<'_>, second: &User<'_>, node: u8) -> Diagnostic {
    let differ = matches!(
        (first.value, second.value),
        (Value::Integer(_), Value::NodeId(_)) | (Value::NodeId(_), Value::Integer(_))
    );
    let on_node = if differ && subject.node.is_none() { format!(" on node {node}") } else { String::new() };
    let (blamed, namesake) = if first.is_set && !second.is_set { (first, second) } else { (second, first) };
    let message =
        format!("{} and {} of `{}` have one COB-ID{on_node}", first.name, second.name, subject.device.key);
    let diagnostic = Diagnostic::new(CODE, blamed.place, message)
        .label(blamed.name.clone())
        .help("give one of them another COB-ID, or switch one off: for a PDO `valid: no` (bit 31)");
    // What a library says has no place in the specification.
    if namesake.place == subject.device.span {
        return diagnostic;
    }
    diagnostic.with(namesake.place, namesake.name.clone())
}
