//! What a PDO maps is there, can be mapped in its direction, and has the length that the mapping says.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::pdo::parameters::{Parameter, target, title};
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{Direction, Entry, EntryId, Object, Pdo, PdoMapping, PdoTarget};
use crate::wording::Key;
use crate::wording::{Notation, Wording};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Device(check) };

/// The code of the rule.
pub const CODE: &Code = &Code {
    id: "OD0502",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "an entry that cannot be mapped into this PDO",
    explanation: "The entry's `pdo:` does not allow this direction, or none at all, or the mapping parameter names an entry that is not there, or says another length than the entry has. \
        A device answers such a mapping with abort code 0604 0041h, or 0602 0000h where it has no such object; one that does not would send or take other bits than the master expects. \
        Give the entry `pdo: receive` or `pdo: transmit`, or map another one.",
    clause: Some("CiA 301, objects 1600h and 1A00h (PDO mapping parameters)"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro}\npdos:\n  io: {transmit: {1: {map: [level]}}}",
        "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {map: [level]}}}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for pdo in &subject.device.pdos {
        for parameter in subject.mapping(pdo) {
            let Some(mapped) = target(parameter.raw()) else { continue };
            let PdoTarget::Entry(id) = mapped.target else { continue };
            if let Some(finding) = finding(subject, pdo, &parameter, id, mapped.bits) {
                findings.push(finding);
            }
        }
    }
}

fn finding(
    subject: &Subject<'_>,
    pdo: &Pdo,
    parameter: &Parameter<'_>,
    id: EntryId,
    length: u8,
) -> Option<Diagnostic> {
    let at = parameter.id;
    let object = subject.device.objects.get(&id.index);
    let Some((object, entry)) = object.and_then(|object| Some((object, object.entry(id.sub)?))) else {
        // A bus coupler may map what comes with modules (CiA 306 6.5): it maps as much as is there.
        if subject.device.further.as_ref().is_some_and(|further| !further.modules.is_empty()) {
            return None;
        }
        let message = format!("{at}: there is no entry {id}");
        let help = "map an entry of the device; bits 31..16: index, 15..8: sub-index, 7..0: length in bits";
        return Some(parameter.finding(CODE, message).help(help));
    };
    if !entry.pdo.allows(pdo.direction) {
        let direction = match entry.pdo {
            PdoMapping::None => "PDOs".to_owned(),
            PdoMapping::Receive | PdoMapping::Transmit | PdoMapping::Both => {
                format!("{}s", pdo.direction.pdo())
            }
        };
        let message = format!("{at}: {id} ({}) cannot be mapped into {direction}", entry.name);
        let diagnostic = parameter.finding(CODE, message).help(help(subject, object, id, pdo.direction));
        return Some(if entry.span.file.is_one_with(subject.device.span.file) {
            diagnostic.with(entry.span, what_it_is(entry))
        } else {
            diagnostic
        });
    }
    // That a type without a length says it can be mapped is said at the entry.
    let bits = entry.data_type.bits()?;
    (u16::from(length) != bits).then(|| {
        parameter
            .finding(CODE, format!("{at}: {id} has {bits} bits, not {length}"))
            .help(format!("write the entry's length in bits 7..0 of the mapping of {}", title(pdo)))
    })
}

/// What to do: perhaps the number of entries was mapped instead of an entry.
fn help(subject: &Subject<'_>, object: &Object, id: EntryId, direction: Direction) -> String {
    let is_count = object.is_structured() && id.sub.0 == 0;
    let member = object.entries.iter().find(|entry| entry.pdo.allows(direction));
    match member.filter(|_| is_count) {
        None if is_count => {
            format!(
                "that is the number of its entries, none of which can be mapped into {}s",
                direction.pdo()
            )
        }
        Some(member) => format!(
            "that is the number of its entries; map one of them, such as `0x{:04X}.{}`",
            id.index.0, member.sub
        ),
        None => {
            let access = match direction {
                Direction::Receive => "`rw`, `rww` or `wo`",
                Direction::Transmit => "`ro`, `rw`, `rwr` or `const`",
            };
            let keys = subject.format;
            let help = Help {
                specification: &format!("give the entry `pdo: {}`, or map another one", direction.word()),
                eds: &format!(
                    "write {} with {} {access}, or map another entry",
                    keys.set(Key::Mapping, "1"),
                    keys.key(Key::Access)
                ),
                setting: "map another entry",
            };
            subject.help(help)
        }
    }
}

/// What keeps an entry out of a PDO: `for TPDOs, `ro``.
fn what_it_is(entry: &Entry) -> String {
    let into = match entry.pdo {
        PdoMapping::None => "not mappable".to_owned(),
        PdoMapping::Receive | PdoMapping::Transmit | PdoMapping::Both => {
            format!("for {}s", Wording::english(Notation::Diagnostic).mapping(entry.pdo))
        }
    };
    format!("{into}, `{}`", entry.access.word())
}
