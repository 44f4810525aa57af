//! The objects of a profile, and those of CiA 302, have the shape, the data types and the access that the standard gives them.

use crate::check::device::device_type_is_kept::{DRIVES, IO_MODULES, axes};
use crate::check::findings::{Findings, others};
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::standard::continued;
use crate::check::standard_objects::from_library::{CIA302, CIA401, CIA402, says_itself};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::{Access, Entry, EntryId, Fact, Index, Object, SystemSource};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0831",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "an object that is not as its profile has it",
    explanation: "The device type names profile 401 or 402, or the object is one of CiA 302, and it is an ARRAY or \
        RECORD where the standard has a VAR or the other way round, has another data type, or can be written where it \
        is read-only there, or not where a master writes it to every device: the outputs of an I/O module, the \
        controlword of a drive. Masters do not look into the EDS for these objects: they map a controlword of two \
        bytes, and a drive that has four refuses the mapping. Where versions of a profile or the devices on the market \
        disagree about an object, nothing is said. Take the object from the library with `from: cia402`, or correct \
        it.",
    clause: Some("CiA 302, CiA 401 and CiA 402, object dictionaries"),
    example: Some(Example::new(
        "uses: [cia301, cia402]\ndevices:\n  io: {name: Example, bit-rates: [125], device-type: 0x00020192, features: [heartbeat producer, drive]}\npdos:\n  io: {receive: {1: {map: [0x6040]}}, transmit: {1: {map: [0x6041]}}}\nobjects:\n  0x6502: {from: cia402, default: 0x0001_0000}\n  0x607A: {name: target position, type: unsigned32, access: rw}",
        "uses: [cia301, cia402]\ndevices:\n  io: {name: Example, bit-rates: [125], device-type: 0x00020192, features: [heartbeat producer, drive]}\npdos:\n  io: {receive: {1: {map: [0x6040]}}, transmit: {1: {map: [0x6041]}}}\nobjects:\n  0x6502: {from: cia402, default: 0x0001_0000}\n  0x607A: {name: target position, type: integer32, access: rw}",
    )),
};

/// What the rule looks at.
const FACTS: [Fact; 3] = [Fact::ObjectType, Fact::Type, Fact::Access];

/// A standard whose objects the rule looks at.
#[derive(Clone, Copy)]
enum Profile {
    Managers,
    IoModules,
    Drives,
}

impl Profile {
    const fn library(self) -> &'static str {
        match self {
            Self::Managers => CIA302,
            Self::IoModules => CIA401,
            Self::Drives => CIA402,
        }
    }

    const fn name(self) -> &'static str {
        match self {
            Self::Managers => "CiA 302",
            Self::IoModules => "CiA 401",
            Self::Drives => "CiA 402",
        }
    }

    /// Objects about whose type or access versions and vendors disagree, those that few of either have, and those whose members are the maker's.
    const fn is_open(self, index: Index, source: SystemSource) -> bool {
        match (self, source) {
            (Self::Drives, _) => matches!(
                index.0,
                0x607E | 0x60C1 | 0x60D0 | 0x60E0..=0x60EE | 0x60F6
                    ..=0x60F9 | 0x60FB | 0x6406 | 0x6410 | 0x6510
            ),
            (Self::IoModules, SystemSource::Specification) => false,
            // The others are the maker's own in devices of profile 401, or have another type in many.
            (Self::IoModules, SystemSource::Eds) => !matches!(
                index.0,
                0x6000 | 0x6002 | 0x6200 | 0x6202 | 0x6206 | 0x6207 | 0x6411 | 0x6423
                    ..=0x6426 | 0x6443 | 0x6444
            ),
            (Self::Managers, SystemSource::Specification) => index.0 == 0x1F25,
            // An EDS does not say which standards other than CiA 301 it follows.
            (Self::Managers, SystemSource::Eds) => true,
        }
    }

    /// What a master writes to every device.
    const fn is_written(self, index: Index) -> bool {
        match self {
            Self::Drives => matches!(index.0, 0x6040 | 0x6060),
            Self::IoModules => matches!(index.0, 0x6200 | 0x6220 | 0x6300 | 0x6320 | 0x6410..=0x6414),
            Self::Managers => false,
        }
    }
}

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let on_axes = |number: i128, profile: Profile| {
        axes(subject, number).into_iter().map(move |first| (first, Index(first.0 + 0x7FF), 0x6000, profile))
    };
    let areas = on_axes(DRIVES, Profile::Drives).chain(on_axes(IO_MODULES, Profile::IoModules)).chain([(
        Index(0x1F00),
        Index(0x1F9F),
        0x1F00,
        Profile::Managers,
    )]);
    for (first, last, known_first, profile) in areas {
        let objects = subject.device.objects.range(first..=last).map(|(_, object)| object);
        for object in objects.filter(|object| says_itself(object, profile.library(), &FACTS)) {
            let on_first = Index(object.index.0 - first.0 + known_first);
            let known = (subject.standard.in_library)(profile.library(), on_first);
            let Some(known) = known.filter(|known| !profile.is_open(known.index, subject.system.source))
            else {
                continue;
            };
            judge(subject, object, known, profile, findings);
        }
    }
}

fn judge(subject: &Subject<'_>, object: &Object, known: &Object, profile: Profile, findings: &mut Findings) {
    let help = help(subject, object, profile);
    // The profile turned several RECORDs of one type into ARRAYs.
    if object.is_structured() != known.is_structured() {
        let word = |object: &Object| if object.is_structured() { "an ARRAY or RECORD" } else { "a VAR" };
        let message = format!(
            "{} ({}) is {}, {} makes it {}",
            object.index,
            object.name,
            word(object),
            profile.name(),
            word(known)
        );
        findings.push(subject.object_finding(CODE, object, message).help(help));
        return;
    }
    let entries = object.entries.iter().filter(|entry| !object.is_structured() || entry.sub.0 > 0);
    let mut wrong = entries.filter_map(|entry| {
        let (problem, fact) = problem(entry, continued(known, entry.sub)?, known.index, profile)?;
        Some((entry, problem, fact))
    });
    let Some((entry, problem, fact)) = wrong.next() else { return };
    let id = EntryId { index: object.index, sub: entry.sub };
    let message = format!("{id} ({}) {problem}", entry.name);
    let diagnostic = subject.finding(CODE, id, entry, fact, message).help(help);
    findings.push(match wrong.count() {
        0 => diagnostic,
        more => diagnostic.note(format!("something of the kind holds for {}", others(more))),
    });
}

fn problem(entry: &Entry, known: &Entry, index: Index, profile: Profile) -> Option<(String, Fact)> {
    let (word, name) = (entry.access.word(), profile.name());
    if entry.data_type != known.data_type {
        let problem = format!("is {}, {name} makes it {}", entry.data_type, known.data_type);
        Some((problem, Fact::Type))
    } else if matches!(known.access, Access::Ro | Access::Const) && entry.access.is_writable() {
        Some((format!("is `{word}`, {name} has it read-only"), Fact::Access))
    } else if profile.is_written(index) && !entry.access.is_writable() {
        Some((format!("is `{word}`, {name} has it writable"), Fact::Access))
    } else {
        None
    }
}

fn help(subject: &Subject<'_>, object: &Object, profile: Profile) -> String {
    let (library, name) = (profile.library(), profile.name());
    let as_described = format!("correct it; masters know the object as {name} describes it");
    let from_library = if object.profile.as_deref() == Some(library) {
        format!("leave out what differs from the library; masters know the object as {name} describes it")
    } else {
        format!(
            "correct it, or take the object from the library: `0x{:04X}: {{from: {library}}}`",
            object.index.0
        )
    };
    subject.help(Help { specification: &from_library, eds: &as_described, setting: &as_described })
}
