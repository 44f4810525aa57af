//! Tools disagree about how a REAL value is written in an EDS.

use super::findings::Findings;
use super::help::Help;
use super::rule::{Check, Needs, Rule};
use super::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{Fact, Value};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0807",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a default of a REAL type",
    explanation: "Tools read `DefaultValue` of REAL32 and REAL64 differently: some as decimal text, some as the bit pattern of IEEE 754. It is written as \
        decimal text. Withhold it from the EDS, or scale the value to an integer.",
    clause: None,
    example: Some(Example::new(
        "objects:\n  0x2000: {name: gain, type: real32, access: rw, default: 0.5}",
        "objects:\n  0x2000: {name: gain, type: real32, access: rw, default: 0.5, eds: {default: withheld}}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for (id, entry, value) in subject.values() {
        // What is set was wished for, in this notation.
        if matches!(value, Value::Real(_)) && entry.eds.default && !entry.is_set() {
            findings.push(
                Diagnostic::new(CODE, subject.place(entry, Fact::Default), format!("PLC tools may misread the default of {id}"))
                    .help(subject.help(Help {
                        specification: "withhold it from the EDS with `eds: {default: withheld}`, or scale the value to an integer",
                        eds: "leave `DefaultValue` out, or scale the value to an integer",
                        setting: "the device has to scale the value to an integer",
                    })),
            );
        }
    }
}
