//! A PDO mapping can be changed as a whole, number and entries, or not at all.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{EntryId, Fact, Role, SubIndex};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Objects(check) };

const CODE: &Code = &Code {
    id: "OD0512",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "a mapping that is half fixed",
    explanation: "Sub-index 0 of a PDO mapping can be written and its entries cannot, or the other way round. A master changes a mapping by setting the number to 0, writing the entries, and \
        setting the number again; with half of them read-only it stops in the middle and leaves a PDO that carries nothing. Make all of them `rw`, or all `ro` or `const`.",
    clause: Some("CiA 301, objects 1600h and 1A00h (procedure for changing a mapping)"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\n  0x1800:\n    name: TPDO 1\n    record:\n      1: {name: COB-ID, type: unsigned32, access: rw, default: $NODEID + 0x180}\n      2: {name: transmission type, type: unsigned8, access: rw, default: 255}\n  0x1A00:\n    name: TPDO 1 mapping\n    sub0: {access: rw, default: 1}\n    record:\n      1: {name: mapped entry 1, type: unsigned32, access: ro, default: 0x2000_0008}",
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\n  0x1800:\n    name: TPDO 1\n    record:\n      1: {name: COB-ID, type: unsigned32, access: rw, default: $NODEID + 0x180}\n      2: {name: transmission type, type: unsigned8, access: rw, default: 255}\n  0x1A00:\n    name: TPDO 1 mapping\n    sub0: {access: rw, default: 1}\n    record:\n      1: {name: mapped entry 1, type: unsigned32, access: rw, default: 0x2000_0008}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for object in subject.device.objects.values().filter(|object| object.role() == Role::PdoMapping) {
        let Some(count) = object.entry(SubIndex(0)) else { continue };
        let is_writable = count.access.is_writable();
        let Some(other) = object.counted().find(|entry| entry.access.is_writable() != is_writable) else {
            continue;
        };
        let id = |sub| EntryId { index: object.index, sub };
        let (count_id, other_id) = (id(count.sub), id(other.sub));
        let (count_word, other_word) = (count.access.word(), other.access.word());
        let message = format!(
            "{count_id}, the number of mapped entries, is `{count_word}`, but {other_id} is `{other_word}`"
        );
        findings.push(
            Diagnostic::new(CODE, subject.place(other, Fact::Access), message)
                .help("make number and entries of the mapping writable, or neither"),
        );
    }
}
