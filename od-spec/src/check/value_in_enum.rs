//! A value of an enum is one of those that the enum lists.

use super::findings::Findings;
use super::help::Help;
use super::rule::{Check, Needs, Rule};
use super::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{Fact, TypeKind};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

/// The code of the rule.
pub const CODE: &Code = &Code {
    id: "OD0403",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "not a value of the enum",
    explanation: "The entry's type lists its values; this one is not among them. A device refuses a mode or command that it does not know, \
        with abort code 0609 0030h. Write the name of a value, or add the value to the type.",
    clause: None,
    example: Some(Example::new(
        "types:\n  mode: {base: unsigned16, values: {0: off, 1: on}}\nobjects:\n  0x2000: {name: mode, type: mode, access: rw}\n  0x2001: {name: short mode, alias: mode, type: unsigned8}\n# --set 2001=2",
        "types:\n  mode: {base: unsigned16, values: {0: off, 1: on}}\nobjects:\n  0x2000: {name: mode, type: mode, access: rw}\n  0x2001: {name: short mode, alias: mode, type: unsigned8}\n# --set 2001=1",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for (id, entry, value) in subject.values() {
        let Some(TypeKind::Enum(values)) = entry.named_type.as_ref().map(|named| &named.kind) else {
            continue;
        };
        // What a view shows of another entry's value is no value of its own.
        if entry.alias.is_some() && !entry.is_set() {
            continue;
        }
        let is_listed = |raw: i128| values.iter().any(|listed| listed.value == raw);
        let mut raw = subject.nodes_of(value).filter_map(|node| value.integer_for(node));
        if let Some(stranger) = raw.find(|raw| !is_listed(*raw)) {
            let message = format!("{id} ({}): {stranger} is not a value of its enum", entry.name);
            let help = subject.help(Help {
                specification: "write the name of a value, or add the value to the type",
                eds: "write one of its values, or add the value to the comment",
                setting: "write one of its values; the device refuses any other",
            });
            let diagnostic = Diagnostic::new(CODE, subject.place(entry, Fact::Default), message).help(help);
            findings.push(subject.seen_through(id, diagnostic));
        }
    }
}
