//! A PDO whose mapping can be changed can be switched off for that.

use crate::check::findings::Findings;
use crate::check::pdo::parameters::title;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::{Subject, entry_id};
use crate::diag::{Code, Example, Severity};
use crate::model::Fact;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0820",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a mapping that can be changed in a PDO that cannot",
    explanation: "A mapping is changed while its PDO does not exist (bit 31 of the COB-ID), so that no node sees half \
        of it; but this COB-ID is read-only. Most devices refuse the change with abort code 0601 0000h or 0609 0030h, \
        so the mapping is in fact fixed. Make the COB-ID `rw`, or the mapping `ro`.",
    clause: Some("CiA 301, objects 1600h and 1A00h (procedure for changing a mapping)"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\n  0x1800:\n    name: TPDO 1\n    record:\n      1: {name: COB-ID, type: unsigned32, access: ro, default: $NODEID + 0x180}\n      2: {name: transmission type, type: unsigned8, access: rw, default: 255}\n  0x1A00:\n    name: TPDO 1 mapping\n    sub0: {access: rw, default: 1}\n    record:\n      1: {name: mapped entry 1, type: unsigned32, access: rw, default: 0x2000_0008}",
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\n  0x1800:\n    name: TPDO 1\n    record:\n      1: {name: COB-ID, type: unsigned32, access: rw, default: $NODEID + 0x180}\n      2: {name: transmission type, type: unsigned8, access: rw, default: 255}\n  0x1A00:\n    name: TPDO 1 mapping\n    sub0: {access: rw, default: 1}\n    record:\n      1: {name: mapped entry 1, type: unsigned32, access: rw, default: 0x2000_0008}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for pdo in subject.device.pdos.iter().filter(|pdo| pdo.variable_mapping) {
        let cob_id = entry_id(pdo.communication_index(), 1);
        let Some(entry) = subject.device.entry(cob_id).filter(|entry| !entry.access.is_writable()) else {
            continue;
        };
        let message = format!(
            "{cob_id} is `{}`: {} cannot be switched off while its mapping is changed",
            entry.access.word(),
            title(pdo)
        );
        findings.push(
            subject
                .finding(CODE, cob_id, entry, Fact::Access, message)
                .help("make the COB-ID `rw`, or number and entries of the mapping `ro`"),
        );
    }
}
