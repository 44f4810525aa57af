//! Values leave reserved bits at 0.

use super::findings::Findings;
use super::rule::{Check, Needs, Rule};
use super::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{BitUsage, Fact, TypeKind};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0810",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a value sets reserved bits",
    explanation: "Reserved bits are written as 0: a later device may give them a meaning, and would then do something that nobody asked for. Correct the value, \
        or say what the bits mean.",
    clause: None,
    example: Some(Example::new(
        "types:\n  flags: {base: unsigned8, bits: {0: on}, rest: reserved}\nobjects:\n  0x2000: {name: flags, type: flags, access: rw, default: 3}",
        "types:\n  flags: {base: unsigned8, bits: {0: on}, rest: reserved}\nobjects:\n  0x2000: {name: flags, type: flags, access: rw, default: 1}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for (id, entry, value) in subject.values() {
        let Some(TypeKind::Bits(fields)) = entry.named_type.as_ref().map(|named| &named.kind) else {
            continue;
        };
        let Some(raw) = value.integer().filter(|raw| !entry.special.iter().any(|one| one.value == *raw))
        else {
            continue;
        };
        let reserved = fields.iter().filter(|field| field.usage == BitUsage::Reserved);
        let set = |bit: &u8| raw.checked_shr(u32::from(*bit)).unwrap_or(0) & 1 == 1;
        if let Some(bit) = reserved.flat_map(|field| field.first..=field.last).find(set) {
            let what = if entry.is_set() { "value" } else { "default" };
            let message = format!("the {what} of {id} sets bit {bit}, which is reserved");
            findings.push(
                Diagnostic::new(CODE, subject.place(entry, Fact::Default), message)
                    .help(format!("correct the {what}, or say what the bit means")),
            );
        }
    }
}
