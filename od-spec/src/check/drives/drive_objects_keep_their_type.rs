//! The objects of a drive have the shape, the data types and the access that CiA 402 gives them.

use crate::check::device::device_type_is_kept::axes_of_drives;
use crate::check::findings::{Findings, others};
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::standard::continued;
use crate::check::standard_objects::from_library::{CIA402, says_itself};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{Access, Entry, EntryId, Fact, Index, Object};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0831",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "an object of a drive that is not as CiA 402 has it",
    explanation: "The device type names profile 402, and an object of the axis is an ARRAY or RECORD where CiA 402 has a VAR or the other way round, has another data type, or can be \
        written where it is read-only there, or not where a master writes it to every drive. Motion controllers know these objects by heart: they map a controlword of two bytes, and a drive \
        that has four refuses the mapping. Where versions of the profile or the drives on the market disagree about an object, nothing is said. Take the object from the library with \
        `from: cia402`, or correct it.",
    clause: Some("CiA 402, object dictionary"),
    example: Some(Example::new(
        "uses: [cia301, cia402]\ndevices:\n  io: {name: Example, bit-rates: [125], device-type: 0x00020192, features: [heartbeat producer, drive]}\npdos:\n  io: {receive: {1: {map: [0x6040]}}, transmit: {1: {map: [0x6041]}}}\nobjects:\n  0x6502: {from: cia402, default: 0}\n  0x607A: {name: target position, type: unsigned32, access: rw}",
        "uses: [cia301, cia402]\ndevices:\n  io: {name: Example, bit-rates: [125], device-type: 0x00020192, features: [heartbeat producer, drive]}\npdos:\n  io: {receive: {1: {map: [0x6040]}}, transmit: {1: {map: [0x6041]}}}\nobjects:\n  0x6502: {from: cia402, default: 0}\n  0x607A: {name: target position, type: integer32, access: rw}",
    )),
};

/// What the rule looks at.
const FACTS: [Fact; 3] = [Fact::ObjectType, Fact::Type, Fact::Access];

/// Objects about whose type or access versions and vendors disagree, those that few of either have, and those whose members are the maker's.
const fn is_open(index: Index) -> bool {
    matches!(
        index.0,
        0x607E | 0x60C1 | 0x60D0 | 0x60E0..=0x60EE | 0x60F6
            ..=0x60F9 | 0x60FB | 0x6406 | 0x6410 | 0x6510
    )
}

/// What a master writes to every drive.
const fn is_written(index: Index) -> bool {
    matches!(index.0, 0x6040 | 0x6060)
}

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for first in axes_of_drives(subject) {
        let axis = subject.device.objects.range(first..=Index(first.0 + 0x7FF));
        for object in axis.map(|(_, object)| object).filter(|object| says_itself(object, CIA402, &FACTS)) {
            let on_first = Index(object.index.0 - first.0 + 0x6000);
            let Some(known) = (subject.standard.of_drives)(on_first).filter(|known| !is_open(known.index))
            else {
                continue;
            };
            judge(subject, object, known, findings);
        }
    }
}

fn judge(subject: &Subject<'_>, object: &Object, known: &Object, findings: &mut Findings) {
    let help = help(subject, object);
    // The profile turned several RECORDs of one type into ARRAYs.
    if object.is_structured() != known.is_structured() {
        let word = |object: &Object| if object.is_structured() { "an ARRAY or RECORD" } else { "a VAR" };
        let message = format!(
            "{} ({}) is {}, CiA 402 makes it {}",
            object.index,
            object.name,
            word(object),
            word(known)
        );
        findings.push(Diagnostic::new(CODE, subject.object_place(object), message).help(help));
        return;
    }
    let entries = object.entries.iter().filter(|entry| !object.is_structured() || entry.sub.0 > 0);
    let mut wrong = entries.filter_map(|entry| {
        let (problem, fact) = problem(entry, continued(known, entry.sub)?, known.index)?;
        Some((entry, problem, fact))
    });
    let Some((entry, problem, fact)) = wrong.next() else { return };
    let id = EntryId { index: object.index, sub: entry.sub };
    let message = format!("{id} ({}) {problem}", entry.name);
    let diagnostic = Diagnostic::new(CODE, subject.place(entry, fact), message).help(help);
    findings.push(match wrong.count() {
        0 => diagnostic,
        more => diagnostic.note(format!("something of the kind holds for {}", others(more))),
    });
}

fn problem(entry: &Entry, known: &Entry, index: Index) -> Option<(String, Fact)> {
    let word = entry.access.word();
    if entry.data_type != known.data_type {
        let problem = format!("is {}, CiA 402 makes it {}", entry.data_type, known.data_type);
        Some((problem, Fact::Type))
    } else if matches!(known.access, Access::Ro | Access::Const) && entry.access.is_writable() {
        Some((format!("is `{word}`, CiA 402 has it read-only"), Fact::Access))
    } else if is_written(index) && !entry.access.is_writable() {
        Some((format!("is `{word}`, CiA 402 has it writable"), Fact::Access))
    } else {
        None
    }
}

fn help(subject: &Subject<'_>, object: &Object) -> String {
    let as_described = "correct it; masters know the object as CiA 402 describes it";
    let from_library = match object.profile.as_deref() {
        Some(CIA402) => {
            "leave out what differs from the library; masters know the object as CiA 402 describes it"
                .to_owned()
        }
        Some(_) | None => {
            format!(
                "correct it, or take the object from the library: `0x{:04X}: {{from: cia402}}`",
                object.index.0
            )
        }
    };
    subject.help(Help { specification: &from_library, eds: as_described, setting: as_described }).to_owned()
}
