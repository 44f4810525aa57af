//! A device starts with heartbeat or with node guarding.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0895",
    severity: Severity::Warning,
    foreign: Severity::Note,
    title: "heartbeat and node guarding at once",
    explanation: "A device uses one of the two: with a time in 1017h it sends its heartbeat and does not answer node guarding. Here 100Ch and 100Dh have values, too, so that a life time seems \
        to be watched that is not. Write 0 into 1017h, or into 100Ch and 100Dh.",
    clause: Some("CiA 301, 9.2.6 (error control) and objects 100Ch, 100Dh and 1017h"),
    example: Some(Example::new(
        "objects:\n  0x100C: {from: cia301, default: 100}\n  0x100D: {from: cia301, default: 3}\n  0x1017: {from: cia301, default: 1000}",
        "objects:\n  0x100C: {from: cia301, default: 0}\n  0x100D: {from: cia301, default: 0}\n  0x1017: {from: cia301, default: 1000}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let [Some(heartbeat), Some(guard), Some(factor)] =
        [0x1017, 0x100C, 0x100D].map(|index| subject.parameter(index, 0).filter(|one| one.raw() != 0))
    else {
        return;
    };
    let message =
        format!("{} sends a heartbeat, so that {} and {} watch nothing", heartbeat.id, guard.id, factor.id);
    let blamed = [&guard, &factor].into_iter().find(|one| one.entry.is_set()).unwrap_or(&heartbeat);
    let help = "write 0 into 100Ch and 100Dh, or into 1017h";
    findings.push(blamed.finding(CODE, message).help(help));
}
