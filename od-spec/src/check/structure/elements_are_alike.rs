//! The elements of an ARRAY are alike: in access, in PDO mapping, and in having a default value or none.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Repeated, Severity};
use crate::model::{Entry, EntryId, Fact, Object, ObjectKind, PdoMapping};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

/// The code of the rule.
pub const CODE: &Code = &Code {
    id: "OD0822",
    severity: Severity::Note,
    foreign: Severity::Note,
    title: "an array whose elements differ",
    explanation: "The elements of an ARRAY have one type by definition, and programs that make one array of it expect \
        the rest to be equal, too: access and PDO mapping of the first element hold for all. Where only some elements \
        that can be written have a default value, the start values of the others are unknown. Nothing is wrong if the \
        elements are meant so; a RECORD makes this plainer.",
    clause: Some("CiA 301, table 37 (object codes)"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: limits, array: {count: 2, name: \"limit {n}\", type: unsigned8, access: rw, elements: {2: {access: ro}}}}",
        "objects:\n  0x2000: {name: limits, array: {count: 2, name: \"limit {n}\", type: unsigned8, access: rw}}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let mut found = Repeated::new();
    // The standard has arrays that are not alike throughout, such as 1026h; others than these are reported.
    let arrays = subject
        .device
        .objects
        .values()
        .filter(|object| object.kind == ObjectKind::Array && !object.index.is_communication_profile());
    for object in arrays {
        let Some(Difference { element, fact, this, first }) = difference(object) else { continue };
        let place = subject.place(element, fact);
        found.add(place, [], || {
            let (index, sub, name) = (object.index, element.sub, &element.name);
            let message = format!("{index}.{sub} ({name}) {this}, the first element {first}");
            let id = EntryId { index, sub };
            subject
                .finding(CODE, id, element, fact, message)
                .help("make the elements alike, or the object a record")
        });
    }
    if let Some(finding) = found.into_diagnostic("arrays") {
        findings.push(finding);
    }
}

/// In what an element differs from the first.
struct Difference<'a> {
    element: &'a Entry,
    fact: Fact,
    this: String,
    first: String,
}

fn difference(object: &Object) -> Option<Difference<'_>> {
    let mut elements = object.counted();
    let first = elements.next()?;
    // A value that is set says nothing about the defaults.
    let is_set = object.counted().any(Entry::is_set);
    elements.find_map(|element| {
        if element.access != first.access {
            let access = |entry: &Entry| format!("is `{}`", entry.access.word());
            let (this, first) = (access(element), access(first));
            Some(Difference { element, fact: Fact::Access, this, first })
        } else if element.pdo != first.pdo {
            let (this, first) = (mapped(element.pdo).to_owned(), mapped(first.pdo).to_owned());
            Some(Difference { element, fact: Fact::Mapping, this, first })
        } else if !is_set
            && element.access.is_writable()
            && element.default.is_some() != first.default.is_some()
        {
            let (this, first) = match element.default {
                Some(_) => ("has a default value", "has none"),
                None => ("has no default value", "has one"),
            };
            Some(Difference { element, fact: Fact::Default, this: this.to_owned(), first: first.to_owned() })
        } else {
            None
        }
    })
}

const fn mapped(pdo: PdoMapping) -> &'static str {
    match pdo {
        PdoMapping::None => "cannot be mapped",
        PdoMapping::Receive => "can be mapped into RPDOs",
        PdoMapping::Transmit => "can be mapped into TPDOs",
        PdoMapping::Both => "can be mapped into PDOs of both directions",
    }
}
