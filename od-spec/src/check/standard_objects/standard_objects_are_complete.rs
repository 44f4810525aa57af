//! The objects of CiA 301 have the sub-indices that it demands, none that it does not know, and a mapping has no gap.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::standard_objects::from_library::is_from_library;
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::{Category, Object, ObjectKind, Role, SubIndex};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0321",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "a standard object without what it needs",
    explanation: "An object of the communication profile lacks a sub-index that CiA 301 demands, has one that it does not know, or a PDO mapping has a gap. \
        1018h has a vendor-ID; an SDO channel two identifiers; a PDO a COB-ID and a transmission type; 1010h and 1011h a first command. A master asks for \
        them without looking, and stops at the abort. Add what is missing, or leave out the whole object.",
    clause: Some("CiA 301, descriptions of the objects 1000h to 1FFFh"),
    example: Some(Example::new(
        "objects:\n  0x1280:\n    name: SDO client parameter\n    record:\n      1: {name: request, type: unsigned32, access: rw, default: 0x80000000}\n      2: {name: answer, type: unsigned32, access: rw, default: 0x80000000}",
        "objects:\n  0x1280:\n    name: SDO client parameter\n    record:\n      1: {name: request, type: unsigned32, access: rw, default: 0x80000000}\n      2: {name: answer, type: unsigned32, access: rw, default: 0x80000000}\n      3: {name: server, type: unsigned8, access: rw}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let device = subject.device;
    // What a feature brings from the library is complete.
    let is_written =
        |object: &&Object| !is_from_library(object) || object.span.file.is_one_with(device.span.file);
    for object in device.objects.values().filter(|object| object.is_structured()).filter(is_written) {
        let Some(defined) = (subject.standard.object)(object.index).filter(|defined| defined.is_structured())
        else {
            continue;
        };
        // What modules bring is there with them.
        let missing = missing(object, defined).filter(|_| !device.is_of_modules(object.index));
        let problems = [missing, unknown(object), gap(object)];
        for (message, help) in problems.into_iter().flatten() {
            findings.push_each(subject.object_finding(CODE, object, message).help(help));
        }
    }
}

/// The first sub-index that CiA 301 demands and the object does not have.
fn missing(object: &Object, defined: &'static Object) -> Option<(String, String)> {
    let demanded = |sub: SubIndex, category: Option<Category>| match defined.kind {
        // An array of equal elements has at least one; a mapping may be without.
        ObjectKind::Array if object.role() != Role::PdoMapping => {
            sub == SubIndex(1) || category == Some(Category::Mandatory)
        }
        ObjectKind::Array | ObjectKind::Record | ObjectKind::Var | ObjectKind::Domain => {
            category == Some(Category::Mandatory)
        }
    };
    let mut entries =
        defined.entries.iter().filter(|entry| entry.sub.0 > 0 && demanded(entry.sub, entry.category));
    let lacking = entries.find(|entry| object.entry(entry.sub).is_none())?;
    let index = object.index;
    let message = format!("{index} ({}) lacks {index}.{} ({})", object.name, lacking.sub, lacking.name);
    let add = format!("add sub-index {}", lacking.sub);
    let is_mandatory = defined.category == Some(Category::Mandatory);
    Some((message, if is_mandatory { add } else { format!("{add}, or leave the object out") }))
}

/// The highest sub-index that CiA 301 knows.
const fn highest(object: &Object) -> u8 {
    match object.index.0 {
        0x1018 => 4,
        0x1010 | 0x1011 | 0x1016 | 0x1028 => 127,
        0x1020 => 2,
        0x1023 | 0x1025 | 0x1026 | 0x1201..=0x12FF => 3,
        0x1400..=0x15FF | 0x1800..=0x19FF => 6,
        0x1600..=0x17FF | 0x1A00..=0x1BFF => 64,
        _ => 254,
    }
}

fn unknown(object: &Object) -> Option<(String, String)> {
    let (index, highest) = (object.index, highest(object));
    let stranger = object.counted().find(|entry| entry.sub.0 > highest)?;
    let message =
        format!("{index}.{} ({}) is not defined: {index} has {highest} at most", stranger.sub, stranger.name);
    let help = "remove the entry; the maker's own entries belong in 2000h to 5FFFh".to_owned();
    Some((message, help))
}

/// A mapping is read from its first entry on, as many as its number says.
fn gap(object: &Object) -> Option<(String, String)> {
    if object.role() != Role::PdoMapping {
        return None;
    }
    let last = object.highest();
    let hole = (1..last.0).find(|sub| object.entry(SubIndex(*sub)).is_none())?;
    let index = object.index;
    let message = format!("{index} ({}) has {index}.{last}, but not {index}.{hole}", object.name);
    Some((message, "number the mapped entries without a gap".to_owned()))
}
