//! Every unit and type that the maker defines is used by an entry or a table.

use super::findings::Findings;
use super::rule::{Check, Needs, Rule};
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{Author, Statement, System, TableContent};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::System(check) };

/// The code of the rule.
pub(super) const CODE: &Code = &Code {
    id: "OD0806",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a definition that nothing uses",
    explanation: "A unit or type is defined but no entry refers to it. A leftover, or an entry lost its `unit:` or `type:`, and with it its scale or its \
        meaning? Remove the definition, or use it.",
    clause: None,
    example: Some(Example::new(
        "units:\n  volt: {symbol: V}\nobjects:\n  0x2000: {name: voltage, type: unsigned8, access: ro}",
        "units:\n  volt: {symbol: V}\nobjects:\n  0x2000: {name: voltage, type: unsigned8, unit: volt, access: ro}",
    )),
};

fn check(system: &System, findings: &mut Findings) {
    // What has no devices defines for others.
    if system.devices.is_empty() {
        return;
    }
    let entries = || system.devices.iter().flat_map(|device| device.entries().map(|(.., entry)| entry));
    let tables = || system.document.tables().map(|(.., table)| &table.content);
    let mut unused = |what: &str, name: &str, stated: Statement| {
        if stated.author == Author::Maker {
            findings.push(
                Diagnostic::new(CODE, stated.span, format!("nothing uses {what} `{name}`"))
                    .help("remove it, or did an entry lose its key?"),
            );
        }
    };
    for unit in system.units.values() {
        if !entries().any(|entry| entry.unit.as_ref().is_some_and(|used| used.name == unit.name)) {
            unused("unit", &unit.name, unit.stated);
        }
    }
    for named in system.types.values() {
        let by_entry =
            entries().any(|entry| entry.named_type.as_ref().is_some_and(|used| used.name == named.name));
        let by_table = tables().any(
            |content| matches!(content, TableContent::Bits(name) | TableContent::Values(name) if *name == named.name),
        );
        if !by_entry && !by_table {
            unused("type", &named.name, named.stated);
        }
    }
}
