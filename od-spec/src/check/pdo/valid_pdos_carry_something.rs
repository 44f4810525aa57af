//! A PDO that exists after start-up maps something.

use crate::check::findings::Findings;
use crate::check::pdo::parameters::title;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{Fact, Index, Origin};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0879",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a PDO that is valid and maps nothing",
    explanation: "After start-up the PDO exists, but no entry is mapped into it: some devices then send empty \
        messages, others none, and a master that waits for it never receives it. Map something, or write `valid: no` \
        where a master is to map the entries; it switches the PDO off for that and on again anyway.",
    clause: Some("CiA 301, objects 1600h and 1A00h (number of mapped objects)"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {map: []}}}",
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {valid: no, map: []}}}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    // Setting the number of a node's mapped entries to 0 switches the PDO off.
    if subject.node.is_some() {
        return;
    }
    for pdo in subject.device.pdos.iter().filter(|pdo| pdo.valid && pdo.variable_mapping) {
        // One that is described in full, as the files of many devices have it, is for a master to fill.
        let mapping = subject.device.objects.get(&Index(pdo.mapping_index()));
        if mapping.is_none_or(|mapping| mapping.origin != Origin::Pdo) {
            continue;
        }
        let Some(count) = subject.mapping_count(pdo).filter(|count| count.raw() == 0) else { continue };
        let message = format!("{} exists after start-up and maps nothing", title(pdo));
        findings.push(
            Diagnostic::new(CODE, count.place, message)
                .about((Index(pdo.mapping_index()), Fact::Map))
                .help("map something, or write `valid: no`"),
        );
    }
}
