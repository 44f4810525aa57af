//! A REAL32 holds the number that is written.

use super::findings::Findings;
use super::help::Help;
use super::rule::{Check, Needs, Rule};
use super::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{DataType, Fact, Value};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Objects(check) };

const CODE: &Code = &Code {
    id: "OD0830",
    severity: Severity::Warning,
    foreign: Severity::Note,
    title: "a number with more digits than its type keeps",
    explanation: "A REAL32 keeps about seven decimal digits. Of the number that is written it takes the nearest that it has, and whoever reads the value back gets another one than the file shows: \
        16777217 becomes 16777216. A number is as written if it is the shortest text that reads back as the same value, or the value in full. Write what the type keeps, or take `real64`.",
    clause: Some("CiA 301, 7.1.4.5 (REAL32)"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: gain, type: real32, access: rw, default: 0.123456789, eds: {default: withheld}}",
        "objects:\n  0x2000: {name: gain, type: real32, access: rw, default: 0.12345679, eds: {default: withheld}}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for (id, entry, value) in subject.values().filter(|(_, entry, _)| entry.data_type == DataType::Real32) {
        let Value::Real(number) = value else { continue };
        let Some(kept) = other(*number) else { continue };
        let message = format!("{id} ({}): of {number:?}, a REAL32 keeps {kept:?}", entry.name);
        let write = format!("write {kept:?}");
        let findings_help = subject
            .help(Help { specification: &format!("{write}, or take `real64`"), eds: &write, setting: &write })
            .to_owned();
        findings
            .push(Diagnostic::new(CODE, subject.place(entry, Fact::Default), message).help(findings_help));
    }
}

/// The number that a REAL32 keeps instead of this one; `None` if it keeps this one.
fn other(number: f64) -> Option<f32> {
    #[expect(clippy::cast_possible_truncation, reason = "whether the value survives is the question")]
    let kept = number as f32;
    // Both are decided by bits: 0.1 is the shortest text of its REAL32, 0.10000000149011612 its value.
    let is_value = f64::from(kept).to_bits() == number.to_bits();
    let is_shortest =
        kept.to_string().parse::<f64>().is_ok_and(|shortest| shortest.to_bits() == number.to_bits());
    (!is_value && !is_shortest).then_some(kept)
}
