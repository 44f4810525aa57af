//! The objects of CiA 301 can be read, written and mapped as it says, also where a device writes them in full or takes them
//! from the library and says otherwise.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::standard_objects::from_library::{CIA301, help, says_itself};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::{Access, Entry, EntryId, Fact, Object, PdoMapping, SubIndex};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Objects(check) };

const CODE: &Code = &Code {
    id: "OD0812",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a standard object with another access",
    explanation: "An entry of the communication profile can be written where CiA 301 has it read-only, cannot be read or written where it must, or is mappable where \
        it is not. A device may make most of what is `rw` read-only; the other way round a tool finds parameters where there are none, and writes the identity or the \
        device type of the device. Correct the access, or take the object from the library with `from: cia301`.",
    clause: Some("CiA 301, 9.5.1 and the descriptions of the objects 1000h to 1FFFh"),
    example: Some(Example::new(
        "objects:\n  0x1002: {name: Manufacturer status register, type: unsigned32, access: rw}",
        "objects:\n  0x1002: {name: Manufacturer status register, type: unsigned32, access: ro}",
    )),
};

/// What the rule looks at.
const FACTS: [Fact; 2] = [Fact::Access, Fact::Mapping];

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for object in subject.device.objects.values().filter(|object| says_itself(object, CIA301, &FACTS)) {
        for entry in &object.entries {
            let Some(known) = subject.standard.entry(object.index, entry.sub) else { continue };
            for (problem, fact) in
                [access(object, entry, known), mapping(object, entry, known)].into_iter().flatten()
            {
                let id = EntryId { index: object.index, sub: entry.sub };
                let message = format!("{id} ({}) {problem}", entry.name);
                findings.push(subject.finding(CODE, id, entry, fact, message).help(help(subject, object)));
            }
        }
    }
}

/// Entries that have to be writable: the error history is cleared through its number of errors.
const fn must_be_writable(id: EntryId) -> bool {
    matches!((id.index.0, id.sub.0), (0x1003 | 0x1015, 0))
}

fn access(object: &Object, entry: &Entry, known: &Entry) -> Option<(String, Fact)> {
    let id = EntryId { index: object.index, sub: entry.sub };
    // That a count is constant is said for all objects alike.
    if object.is_structured() && id.sub == SubIndex(0) && !must_be_writable(id) {
        return None;
    }
    // The EDS in a device, and how it is packed, were `rw` before CiA 301 v4.2.
    let may_be_writable = known.access.is_writable() || matches!(id.index.0, 0x1021 | 0x1022);
    let must_be_writable = must_be_writable(id) || known.access == Access::Wo;
    let word = entry.access.word();
    let problem = if entry.access.is_writable() && !may_be_writable {
        format!("is `{word}`, CiA 301 has it read-only")
    } else if !entry.access.is_writable() && must_be_writable {
        format!("is `{word}`, CiA 301 has it writable")
    } else if !entry.access.is_readable() && known.access.is_readable() {
        format!("is `{word}`, CiA 301 has it readable")
    } else {
        return None;
    };
    Some((problem, Fact::Access))
}

/// What an entry is mapped as although CiA 301 does not have it so, whichever file describes it: no departure from the
/// standard makes process data of a parameter.
fn mapping(object: &Object, entry: &Entry, known: &Entry) -> Option<(String, Fact)> {
    // CiA 301 leaves it to the device whether these are mappable.
    let is_free = matches!(object.index.0, 0x1001 | 0x1002 | 0x1013 | 0x1026);
    let is_count = object.is_structured() && entry.sub == SubIndex(0);
    let is_against = entry.pdo != PdoMapping::None && known.pdo == PdoMapping::None && !is_free && !is_count;
    is_against.then(|| ("is mappable, in CiA 301 it is not".to_owned(), Fact::Mapping))
}
