//! The parameters of a PDO do not contradict each other: what is mapped is there and fits what the PDO offers, an RPDO has no
//! flag of a TPDO, and the SYNC counter can reach the start value.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::pdo::parameters::{NO_REMOTE_FRAMES, is_multiplexed, target, title};
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{Direction, Fact, Mapped, Pdo, PdoTarget};
use crate::wording::Key;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Device(check) };

/// The code of the rule.
const CODE: &Code = &Code {
    id: "OD0508",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "PDO settings that contradict each other",
    explanation: "More entries are mapped than the PDO offers, fewer than it says, entries whose length is not a \
        multiple of the device's granularity, nothing at all in a mapping that cannot be changed; an RPDO forbids \
        remote frames, which only a TPDO answers (bit 30 of an RPDO's COB-ID is reserved); or a SYNC start value that \
        the counter, which runs to 240, never reaches. A device refuses such a parameter, or the PDO stays silent. The \
        message names the one that is meant.",
    clause: Some("CiA 301, objects 1400h, 1600h, 1800h and 1A00h (PDO parameters)"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: level, type: unsigned8, access: rw, pdo: receive}\npdos:\n  io: {receive: {1: {no-rtr: yes, map: [level]}}}",
        "objects:\n  0x2000: {name: level, type: unsigned8, access: rw, pdo: receive}\npdos:\n  io: {receive: {1: {map: [level]}}}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for pdo in &subject.device.pdos {
        let problems = [
            count(subject, pdo),
            granularity(subject, pdo),
            remote_frames(subject, pdo),
            sync_start(subject, pdo),
        ];
        for finding in problems.into_iter().flatten() {
            findings.push(finding);
        }
    }
}

/// The number of mapped entries, against what is offered and what is there.
fn count(subject: &Subject<'_>, pdo: &Pdo) -> Option<Diagnostic> {
    let parameter = subject.mapping_count(pdo).filter(|count| !is_multiplexed(count.raw()))?;
    let (count, offered, title) = (parameter.raw(), subject.mapping_capacity(pdo), title(pdo));
    if count > offered {
        let message = format!("{}: {title} maps {count} entries, but offers {offered}", parameter.id);
        let help = subject.help(Help {
            specification: "map fewer entries, raise `capacity:`, or lower the device's `granularity:`",
            eds: "map fewer entries, or describe more sub-indices",
            setting: "map fewer entries",
        });
        let place = match parameter.entry.facts.get(Fact::Capacity) {
            Some(capacity) if !parameter.entry.is_set() => capacity.span,
            Some(_) | None => parameter.place,
        };
        return Some(Diagnostic::new(CODE, place, message).about((parameter.id, Fact::Default)).help(help));
    }
    if count == 0 && !pdo.variable_mapping {
        let message = format!("{title} has a fixed mapping of nothing");
        let help = subject.help(Help {
            specification: "map something, or let the mapping be `variable`",
            eds: &format!(
                "map something, or write {} if the mapping can be changed",
                subject.format.set(Key::Access, "rw")
            ),
            setting: "map something",
        });
        return Some(parameter.finding(CODE, message).help(help));
    }
    let empty = subject.mapped(pdo).find(|mapped| mapped.raw() == 0)?;
    let message =
        format!("{}: {title} maps {count} entries, but entry {} is empty", parameter.id, empty.id.sub);
    let help = "set the mapped entry, or a smaller number of them";
    Some(
        Diagnostic::new(CODE, subject.mapping_place(pdo), message)
            .about((parameter.id, Fact::Default))
            .help(help),
    )
}

/// What is mapped comes in multiples of the device's granularity.
fn granularity(subject: &Subject<'_>, pdo: &Pdo) -> Option<Diagnostic> {
    let granularity = subject.device.info.granularity.max(1);
    // A length that is not the entry's is said by itself.
    let has_its_length = |mapped: &Mapped| match mapped.target {
        PdoTarget::Entry(id) => {
            subject.device.entry(id).and_then(|entry| entry.data_type.bits()) == Some(mapped.bits.into())
        }
        PdoTarget::Dummy(data_type) => data_type.bits() == Some(mapped.bits.into()),
    };
    let odd = |raw: i128| {
        target(raw).is_some_and(|mapped| mapped.bits % granularity != 0 && has_its_length(&mapped))
    };
    let parameter = subject.mapping(pdo).find(|parameter| odd(parameter.raw()))?;
    let bits = target(parameter.raw())?.bits;
    let message = format!(
        "{}: {} maps {bits} bits, the device's granularity is {granularity}",
        parameter.id,
        title(pdo)
    );
    Some(parameter.finding(CODE, message).help(subject.help(Help {
        specification: "lower the device's `granularity:`, or map entries of its multiples",
        eds: &format!("lower {}, or map entries of its multiples", subject.format.key(Key::Granularity)),
        setting: "map entries of its multiples",
    })))
}

fn remote_frames(subject: &Subject<'_>, pdo: &Pdo) -> Option<Diagnostic> {
    let parameter = subject.communication(pdo, 1).filter(|_| pdo.direction == Direction::Receive)?;
    let forbids = |node| parameter.value.integer_for(node).is_some_and(|raw| raw & NO_REMOTE_FRAMES != 0);
    if !subject.nodes().any(forbids) {
        return None;
    }
    let place = match parameter.entry.facts.get(Fact::RemoteFrames) {
        Some(flag) if !parameter.entry.is_set() => flag.span,
        Some(_) | None => parameter.place,
    };
    let message = format!("{}: an RPDO is not asked for by remote frames", parameter.id);
    let help = subject.help(Help {
        specification: "leave out `no-rtr:`, and leave bit 30 of an RPDO's COB-ID at 0; it is reserved",
        eds: "leave bit 30 of an RPDO's COB-ID 0; it is reserved",
        setting: "leave bit 30 of an RPDO's COB-ID 0; it is reserved",
    });
    Some(Diagnostic::new(CODE, place, message).about((parameter.id, Fact::RemoteFrames)).help(help))
}

fn sync_start(subject: &Subject<'_>, pdo: &Pdo) -> Option<Diagnostic> {
    let parameter = subject.communication(pdo, 6).filter(|parameter| parameter.raw() > 240)?;
    let message = format!("{}: the SYNC counter never reaches {}", parameter.id, parameter.raw());
    Some(parameter.finding(CODE, message).help("write 0 to 240"))
}
