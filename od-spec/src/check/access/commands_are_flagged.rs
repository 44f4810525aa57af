//! A command that has a default is marked as one that tools do not write.

use crate::check::findings::{Findings, others};
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{Entry, EntryId, Fact, Index};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0816",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a command that tools would write",
    explanation: "1010h and 1011h take commands, to store and to restore, and 1F51h starts and stops programs; the entry has a default, but no flag that keeps tools from writing \
        it. A tool that writes the defaults of a file into a device would give the command, or stop at the abort of a wrong signature. Write \
        `eds: {flags: [no-write]}`, or remove the default.",
    clause: Some("CiA 306, 4.6.3.3 (ObjFlags); CiA 301, objects 1010h and 1011h"),
    example: Some(Example::new(
        "objects:\n  0x1010: {name: Store parameters, array: {count: 1, name: \"store {n}\", type: unsigned32, access: rw, default: 1}}",
        "objects:\n  0x1010: {name: Store parameters, eds: {flags: [no-write]}, array: {count: 1, name: \"store {n}\", type: unsigned32, access: rw, default: 1}}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let commands = [0x1010, 0x1011, 0x1F51].map(Index);
    for object in commands.iter().filter_map(|index| subject.device.objects.get(index)) {
        // What no EDS shows, no tool writes.
        let is_written =
            |entry: &&Entry| entry.access.is_writable() && !entry.eds.no_write && entry.eds.default;
        let entries = object.entries.iter().filter(|entry| entry.sub.0 > 0 && entry.default.is_some());
        let mut written = entries.filter(is_written);
        let Some(entry) = written.next() else { continue };
        let id = EntryId { index: object.index, sub: entry.sub };
        let message =
            format!("{id} ({}) is a command, and its default invites tools to write it", entry.name);
        let diagnostic =
            Diagnostic::new(CODE, subject.place(entry, Fact::Default), message).help(subject.help(Help {
                specification: "add `eds: {flags: [no-write]}`, or remove the default",
                eds: "write `ObjFlags=1`, which keeps tools from writing it, or remove `DefaultValue`",
                setting: "leave the entry out; writing it triggers the command",
            }));
        findings.push(match written.count() {
            0 => diagnostic,
            more => diagnostic.note(format!("the same holds for {}", others(more))),
        });
    }
}
