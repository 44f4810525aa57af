//! A TPDO that is sent on remote frames takes remote frames.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::pdo::parameters::{NO_REMOTE_FRAMES, title};
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{Direction, Fact, Pdo};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0516",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "a PDO that waits for what it forbids",
    explanation: "The transmission types 252 and 253 send a TPDO when a remote frame asks for it, but bit 30 of its \
        COB-ID (`no-rtr:`) says that it does not answer remote frames. Such a PDO is never sent, and a master that \
        asks never gets an answer. Remove `no-rtr:`, or write another transmission type.",
    clause: Some("CiA 301, object 1800h (COB-ID, transmission type)"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {transmission: 253, no-rtr: yes, map: [level]}}}",
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {transmission: 253, map: [level]}}}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for pdo in subject.device.pdos_of(Direction::Transmit) {
        if let Some(finding) = never_sent(subject, pdo) {
            findings.push(finding);
        }
    }
}

fn never_sent(subject: &Subject<'_>, pdo: &Pdo) -> Option<Diagnostic> {
    let transmission =
        subject.communication(pdo, 2).filter(|transmission| matches!(transmission.raw(), 252 | 253))?;
    let cob_id = subject.communication(pdo, 1)?;
    let forbids = |node| cob_id.value.integer_for(node).is_some_and(|raw| raw & NO_REMOTE_FRAMES != 0);
    if !subject.nodes_of(cob_id.value).any(forbids) {
        return None;
    }
    // What was set is blamed before what the device has.
    let flag = match cob_id.entry.facts.get(Fact::RemoteFrames) {
        Some(flag) if !cob_id.entry.is_set() => flag.span,
        Some(_) | None => cob_id.place,
    };
    let is_set = cob_id.entry.is_set() && !transmission.entry.is_set();
    let (place, other, what) = if is_set {
        (flag, transmission.place, "the transmission type")
    } else {
        (transmission.place, flag, "no remote frames")
    };
    let message = format!(
        "{}: {} is sent on remote frames (transmission type {}), which bit 30 of {} forbids",
        transmission.id,
        title(pdo),
        transmission.raw(),
        cob_id.id
    );
    let diagnostic = Diagnostic::new(CODE, place, message).about((transmission.id, Fact::Default));
    let diagnostic = if other == place { diagnostic } else { diagnostic.with(other, what) };
    Some(diagnostic.help(subject.help(Help {
        specification: "remove `no-rtr:`, or write another `transmission:`",
        eds: "clear bit 30 of the COB-ID, or write another transmission type",
        setting: "clear bit 30 of the COB-ID, or write another transmission type",
    })))
}
