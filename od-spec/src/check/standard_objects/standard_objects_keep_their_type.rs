//! The objects of CiA 301 have the shape and the data types that it gives them, also where a device writes them in full or
//! takes them from the library and says otherwise.

use crate::check::findings::{Findings, others};
use crate::check::rule::{Check, Needs, Rule};
use crate::check::standard::continued;
use crate::check::standard_objects::from_library::{CIA301, help, says_itself};
use crate::check::subject::Subject;
use crate::check::values::value_fits_type::is_of_type;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{Author, DataType, Entry, EntryId, Fact, Index, Object, ObjectKind, Role};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Objects(check) };

const CODE: &Code = &Code {
    id: "OD0320",
    severity: Severity::Error,
    foreign: Severity::Warning,
    title: "a standard object of another type",
    explanation: "An object of the communication profile has another object type (VAR, ARRAY or RECORD) than CiA 301 \
        says, or an entry of it has another data type. Masters do not look into the EDS for these objects: a write of \
        two bytes into an entry of four is refused with abort code 0607 0010h, and the boot-up of the node ends there. \
        Take the object from the library with `from: cia301`, or correct it.",
    clause: Some("CiA 301, table 47 and the descriptions of the objects 1000h to 1FFFh"),
    example: Some(Example::new(
        "objects:\n  0x1002: {name: Manufacturer status register, type: unsigned16, access: ro}",
        "objects:\n  0x1002: {name: Manufacturer status register, type: unsigned32, access: ro}",
    )),
};

/// What the rule looks at.
const FACTS: [Fact; 2] = [Fact::ObjectType, Fact::Type];

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for object in subject.device.objects.values().filter(|object| says_itself(object, CIA301, &FACTS)) {
        let Some(defined) = (subject.standard.object)(object.index) else { continue };
        if let Some(finding) = shape(subject, object, defined) {
            findings.push(finding);
            continue;
        }
        // The type of a count is fixed by CiA 301 for all objects.
        let entries = object.entries.iter().filter(|entry| !object.is_structured() || entry.sub.0 > 0);
        let wrong = entries.filter_map(|entry| {
            let known = continued(defined, entry.sub)?.data_type;
            has_other_type(object.index, entry, known).then_some((entry, known))
        });
        // One finding for all entries with one mistake: a PDO mapping has up to 64 of them.
        let mut mistakes: Vec<(&Entry, DataType, usize)> = Vec::new();
        for (entry, known) in wrong {
            let same = |(first, as_known, _): &&mut (&Entry, DataType, usize)| {
                first.data_type == entry.data_type && *as_known == known
            };
            match mistakes.iter_mut().find(same) {
                Some((.., more)) => *more += 1,
                None => mistakes.push((entry, known, 0)),
            }
        }
        for (entry, known, more) in mistakes {
            findings.push(data_type(subject, object, entry, known, more));
        }
    }
}

/// The shape that CiA 301 gives an object.
fn kind(defined: &Object, object: &Object) -> ObjectKind {
    match object.role() {
        Role::PdoMapping => ObjectKind::Record,
        _ => defined.kind,
    }
}

fn shape(subject: &Subject<'_>, object: &Object, defined: &Object) -> Option<Diagnostic> {
    let single = |kind| matches!(kind, ObjectKind::Var | ObjectKind::Domain);
    let kind = kind(defined, object);
    // CiA 301 calls 1021h a VAR and describes a DOMAIN.
    if object.kind == kind || single(object.kind) && single(kind) {
        return None;
    }
    let message = format!(
        "{} ({}) is {}, CiA 301 makes it {}",
        object.index,
        object.name,
        article(object.kind),
        article(kind)
    );
    Some(subject.object_finding(CODE, object, message).help(help(subject, object)))
}

const fn article(kind: ObjectKind) -> &'static str {
    match kind {
        ObjectKind::Var => "a VAR",
        ObjectKind::Array => "an ARRAY",
        ObjectKind::Record => "a RECORD",
        ObjectKind::Domain => "a DOMAIN",
    }
}

fn has_other_type(index: Index, entry: &Entry, known: DataType) -> bool {
    // CiA 301 names two types for 1022h.
    let is_either = index.0 == 0x1022 && entry.data_type == DataType::Unsigned8;
    // A value that follows from the device and cannot be of the type is said by itself.
    let misfit = entry.default.as_ref().is_some_and(|value| !is_of_type(value, entry.data_type));
    let is_said = misfit && entry.facts.is_said_by(Fact::Default, Author::Derived);
    entry.data_type != known && !is_either && !is_said
}

fn data_type(
    subject: &Subject<'_>,
    object: &Object,
    entry: &Entry,
    known: DataType,
    more: usize,
) -> Diagnostic {
    let id = EntryId { index: object.index, sub: entry.sub };
    let message = format!("{id} ({}) is {}, CiA 301 makes it {known}", entry.name, entry.data_type);
    let diagnostic = subject.finding(CODE, id, entry, Fact::Type, message).help(help(subject, object));
    match more {
        0 => diagnostic,
        _ => diagnostic.note(format!("the same holds for {}", others(more))),
    }
}
