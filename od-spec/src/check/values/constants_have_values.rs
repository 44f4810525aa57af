//! A constant states its value.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{Access, DataType, Fact};
use crate::wording::Key;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0805",
    severity: Severity::Warning,
    foreign: Severity::Note,
    title: "a constant without a value",
    explanation: "A `const` entry has one value for ever; without it, an EDS does not give its value, and generated \
        code has nothing to answer. State it as `default`, or make the entry `ro`.",
    clause: Some("CiA 306, 4.6.3.2 (AccessType, DefaultValue)"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: scale, type: unsigned8, access: const}",
        "objects:\n  0x2000: {name: scale, type: unsigned8, access: const, default: 1}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for (id, object, entry) in subject.device.entries() {
        if entry.access != Access::Const || entry.default.is_some() || entry.data_type == DataType::Domain {
            continue;
        }
        // The library says that it is constant, and the file describes the object.
        let is_described = object.span.file.is_one_with(subject.device.span.file);
        let is_taken = entry.is_only_standard(Fact::Access);
        let keys = subject.format;
        let help = match object.profile.as_ref().filter(|_| is_taken && !is_described) {
            Some(library) => {
                format!("write it among the objects: `0x{:04X}: {{from: {library}, default: …}}`", id.index.0)
            }
            None => subject.help(Help {
                specification: "add `default:`, or make it `ro`",
                eds: &format!("add {}, or write {}", keys.key(Key::Default), keys.set(Key::Access, "ro")),
                setting: "the device has to state its value; a constant cannot be set",
            }),
        };
        let message =
            format!("{id} ({}) of `{}` is constant, but has no value", object.name, subject.device.key);
        let place = if is_taken { subject.object_place(object) } else { subject.place(entry, Fact::Access) };
        findings.push(Diagnostic::new(CODE, place, message).about((id, Fact::Default)).help(help));
    }
}
