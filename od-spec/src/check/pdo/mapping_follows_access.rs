//! A TPDO carries what can be read, an RPDO what can be written; and the EDS promises nothing else.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{Access, Author, Direction, Entry, EntryId, Fact, PdoMapping};
use crate::wording::Key;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Objects(check) };

/// The code of the rule.
pub(crate) const CODE: &Code = &Code {
    id: "OD0417",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "mapping against the access",
    explanation: "What is mapped into a TPDO is read from the device, what is mapped into an RPDO is written to it. `ro`, `const` and `rwr` go \
        with `transmit`, `wo` and `rww` with `receive`; only `rw` leaves the choice. The same holds for what the EDS shows, which may be less \
        than the device gives, and never more: a PLC believes the EDS. Correct the mapping or the access.",
    clause: Some("CiA 306, 4.6.3.2 (AccessType, PDOMapping)"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: hours, type: unsigned32, access: ro, pdo: receive}\npdos:\n  io: {receive: {1: {valid: no, map: []}}, transmit: {1: {valid: no, map: []}}}",
        "objects:\n  0x2000: {name: hours, type: unsigned32, access: ro, pdo: transmit}\npdos:\n  io: {receive: {1: {valid: no, map: []}}, transmit: {1: {valid: no, map: []}}}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for (id, _, entry) in subject.device.entries() {
        // What follows from the target of a view is reported there.
        let derived = |fact| entry.facts.is_said_by(fact, Author::Derived);
        if entry.alias.is_some() && derived(Fact::Mapping) && derived(Fact::Access) {
            continue;
        }
        // What has no length cannot be mapped at all.
        if entry.pdo != PdoMapping::None && !entry.data_type.is_mappable() {
            continue;
        }
        let found = against_access(subject, id, entry).or_else(|| against_eds(subject, id, entry));
        if let Some(finding) = found {
            findings.push(finding);
        }
    }
}

/// The mappings, other than none, that an access allows.
const fn allowed(access: Access) -> &'static [PdoMapping] {
    match access {
        Access::Const | Access::Ro | Access::Rwr => &[PdoMapping::Transmit],
        Access::Wo | Access::Rww => &[PdoMapping::Receive],
        Access::Rw => &[PdoMapping::Receive, PdoMapping::Transmit, PdoMapping::Both],
    }
}

fn against_access(subject: &Subject<'_>, id: EntryId, entry: &Entry) -> Option<Diagnostic> {
    let allowed = allowed(entry.access);
    if entry.pdo == PdoMapping::None || allowed.contains(&entry.pdo) {
        return None;
    }
    let keys = subject.format;
    let words: Vec<String> = allowed.iter().map(|pdo| format!("`pdo: {}`", pdo.word())).collect();
    let (name, access, pdo) = (&entry.name, entry.access.word(), entry.pdo.word());
    let message = format!("{id} ({name}) is `{access}` and cannot be mapped as `{pdo}`");
    Some(
        subject
            .finding(CODE, id, entry, Fact::Mapping, message)
            .with(subject.place(entry, Fact::Access), "the access")
            .help(subject.help(Help {
                specification: &format!("write {}, or correct the access", words.join(" or ")),
                eds: &format!("write {}, or correct {}", keys.set(Key::Mapping, "0"), keys.key(Key::Access)),
                setting: "the mapping or the access has to be corrected",
            }))
            .note("CiA 306 4.6.3.2: a TPDO carries what can be read, an RPDO what can be written"),
    )
}

/// The EDS promises no access that the device refuses, and none that contradicts the mapping.
fn against_eds(subject: &Subject<'_>, id: EntryId, entry: &Entry) -> Option<Diagnostic> {
    let (access, shown) = (entry.access, entry.eds.access);
    let promises_more =
        (shown.is_writable() && !access.is_writable()) || (shown.is_readable() && !access.is_readable());
    if promises_more {
        let message = format!(
            "{id} ({}): the EDS would show `{}`, the entry is `{}`",
            entry.name,
            shown.word(),
            access.word()
        );
        let help = "an EDS may show less access than the device gives, not more";
        return Some(subject.finding(CODE, id, entry, Fact::Eds, message).help(help));
    }
    let permits = |direction: Direction| {
        let mapping = match direction {
            Direction::Receive => PdoMapping::Receive,
            Direction::Transmit => PdoMapping::Transmit,
        };
        allowed(shown).contains(&mapping)
    };
    let contradicted = [Direction::Receive, Direction::Transmit]
        .into_iter()
        .find(|direction| entry.pdo.allows(*direction) && !permits(*direction))?;
    // Only a specification says what its EDS shows: an EDS that is read shows the access it states.
    let message = format!(
        "{id} ({}): mappable into {}s, but the EDS shows `{}`",
        entry.name,
        contradicted.pdo(),
        shown.word()
    );
    let help = "remove `pdo:`, or let the EDS show the access; a locked entry is `ro` in the EDS";
    Some(subject.finding(CODE, id, entry, Fact::Eds, message).help(help))
}
