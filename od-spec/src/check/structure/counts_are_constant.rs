//! Sub-index 0 of an array or record holds a number that nothing changes.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Example, Severity};
use crate::model::{EntryId, Fact, Object, PdoMapping, Role, SubIndex};
use crate::wording::Key;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Objects(check) };

const CODE: &Code = &Code {
    id: "OD0818",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a count that is not constant",
    explanation: "Sub-index 0 holds the highest sub-index of an array or record and is read-only; only the error history (1003h) and PDO mappings get their number from a master. \
        Here it can be written, can be mapped, or has no value: a tool would offer it as a parameter, or not know how far to read. Remove `access:` and `pdo:` from `sub0:`; \
        a number of elements in use is an entry of its own.",
    clause: Some("CiA 301, 9.5.3.1 (sub-index 0)"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: steps, sub0: {access: rw}, array: {count: 8, name: \"step {n}\", type: unsigned8, access: rw}}",
        "objects:\n  0x2000: {name: steps, array: {count: 8, name: \"step {n}\", type: unsigned8, access: rw}}\n  0x2001: {name: steps in use, type: unsigned8, access: rw, max: 8}",
    )),
};

/// Whether a master writes the number of entries.
fn is_told(object: &Object) -> bool {
    matches!(object.role(), Role::ErrorHistory | Role::PdoMapping)
}

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let keys = subject.format;
    for object in subject.device.objects.values().filter(|object| object.is_structured()) {
        let Some(count) = object.entry(SubIndex(0)) else { continue };
        let id = format_args!("{}: sub-index 0", object.index);
        let reported = is_told(object);
        let problem = if count.access.is_writable() && !reported {
            let what =
                format!("{id} is `{}`, although it only holds the highest sub-index", count.access.word());
            Some((what, Fact::Access, format!("write {}", keys.set(Key::Access, "ro"))))
        } else if count.pdo != PdoMapping::None {
            let what = format!("{id} is mappable, although it only holds the highest sub-index");
            Some((what, Fact::Mapping, format!("write {}", keys.set(Key::Mapping, "0"))))
        } else if count.default.is_none() && !reported {
            let what = format!("{id} does not say which the highest sub-index is");
            Some((what, Fact::Default, format!("write the highest sub-index as {}", keys.key(Key::Default))))
        } else {
            None
        };
        if let Some((message, fact, eds)) = problem {
            let help = subject.help(Help {
                specification: "remove what `sub0:` says about it; type, access and value follow",
                eds: &eds,
                setting: "leave the entry out; it holds the highest sub-index",
            });
            findings.push(
                subject
                    .finding(CODE, EntryId { index: object.index, sub: count.sub }, count, fact, message)
                    .help(help),
            );
        }
    }
}
