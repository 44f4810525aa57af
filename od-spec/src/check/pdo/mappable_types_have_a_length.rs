//! What can be mapped into a PDO has a fixed length.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::{Fact, PdoMapping};
use crate::wording::Key;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Objects(check) };

/// The code of the rule.
const CODE: &Code = &Code {
    id: "OD0416",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "a type that cannot travel in a PDO",
    explanation: "Strings and DOMAINs have no fixed length and cannot be mapped: a mapping parameter names the length in bits. Remove `pdo:`; \
        what is longer than a PDO travels by SDO.",
    clause: Some("CiA 301, table 39 (data types)"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: label, type: visible-string, access: ro, pdo: transmit}",
        "objects:\n  0x2000: {name: label, type: visible-string, access: ro}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for (id, _, entry) in subject.device.entries() {
        if entry.pdo != PdoMapping::None && !entry.data_type.is_mappable() {
            let message = format!("{id} ({}): {} cannot travel in a PDO", entry.name, entry.data_type);
            findings.push(subject.finding(CODE, id, entry, Fact::Mapping, message).help(subject.help(
                Help {
                    specification: "remove `pdo:`; only types of fixed length can be mapped",
                    eds: &format!(
                        "write {}; only types of fixed length can be mapped",
                        subject.format.set(Key::Mapping, "0")
                    ),
                    setting: "only types of fixed length can be mapped",
                },
            )));
        }
    }
}
