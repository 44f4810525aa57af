//! Every unit and type that the maker defines is used by an entry or a table.

use std::collections::BTreeSet;

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{Author, Dictionary, SignalCarrier, Statement, System, TableContent};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::System(check) };

/// The code of the rule.
pub const CODE: &Code = &Code {
    id: "OD0806",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a definition that nothing uses",
    explanation: "A unit or type is defined but no entry refers to it. Is it a leftover, or has an entry lost its \
        `unit:` or `type:`, and with it its scale or its meaning? Remove the definition, or use it.",
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
    let Used { units, types } = used(system);
    let mut unused = |what: &str, name: &str, stated: Statement| {
        if stated.author == Author::Maker {
            findings.push(
                Diagnostic::new(CODE, stated.span, format!("nothing uses {what} `{name}`"))
                    .help("remove it, or did an entry lose its key?"),
            );
        }
    };
    for unit in system.units.values() {
        if !units.contains(unit.name.as_str()) {
            unused("unit", &unit.name, unit.stated);
        }
    }
    for named in system.types.values() {
        if !types.contains(named.name.as_str()) {
            unused("type", &named.name, named.stated);
        }
    }
}

/// The names of what is used.
struct Used<'a> {
    units: BTreeSet<&'a str>,
    types: BTreeSet<&'a str>,
}

fn used(system: &System) -> Used<'_> {
    let mut used = Used { units: BTreeSet::new(), types: BTreeSet::new() };
    for (.., entry) in system.devices.iter().flat_map(Dictionary::entries) {
        used.units.extend(entry.unit.as_ref().map(|unit| unit.name.as_str()));
        used.types.extend(entry.named_type.as_ref().map(|named| named.name.as_str()));
    }
    for (.., table) in system.document.tables() {
        match &table.content {
            TableContent::Bits(table) => drop(used.types.insert(&table.named_type)),
            TableContent::Values(name) => drop(used.types.insert(name)),
            TableContent::Timing(timing) => {
                used.types.extend(timing.signals.iter().filter_map(|signal| match &signal.carrier {
                    SignalCarrier::Bits(bits) => Some(bits.named_type.as_str()),
                    SignalCarrier::Entry(_) => None,
                }));
            }
            TableContent::Flow(flow) => {
                let bits = flow.blocks.iter().filter_map(|block| block.bits.as_ref());
                used.types.extend(bits.map(|bits| bits.named_type.as_str()));
            }
            TableContent::Overview(_)
            | TableContent::Objects(_)
            | TableContent::Errors(_)
            | TableContent::Reactions(_)
            | TableContent::States(_)
            | TableContent::Transitions(_)
            | TableContent::Commands(_)
            | TableContent::Ladder(_)
            | TableContent::Hysteresis(_)
            | TableContent::Axis(_)
            | TableContent::Pdos(_)
            | TableContent::Rows { .. }
            | TableContent::Glossary
            | TableContent::History => {}
        }
    }
    used
}
