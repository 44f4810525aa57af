//! Sub-index 0 holds the highest sub-index, where its value is fixed.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{DataType, Entry, EntryId, Fact, Index, Object, Role, SubIndex, Value};
use crate::wording::Key;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Objects(check) };

/// The code of the rule.
pub(crate) const CODE: &Code = &Code {
    id: "OD0313",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "two counts disagree",
    explanation: "An array has an element beyond its `count`, sub-index 0 says another number than the entries, a table row has more or fewer \
        cells than the table has columns, or a list of defaults more or fewer values than the array has elements. A client reads sub-index 0 to know how far to go, and would miss entries or ask for some that are not \
        there. Correct one of the two counts.",
    clause: Some("CiA 306, 4.6.3.2 (SubNumber and sub-index 0)"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: inputs, type: unsigned8, access: ro, sub0: {default: 3}, array: {count: 2, name: \"input {n}\"}}",
        "objects:\n  0x2000: {name: inputs, type: unsigned8, access: ro, array: {count: 2, name: \"input {n}\"}}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for object in subject.device.objects.values().filter(|object| object.is_structured()) {
        let count = object.entry(SubIndex(0)).and_then(|entry| count(subject, object, entry));
        if let Some(finding) = count {
            findings.push(finding);
        }
    }
}

fn count(subject: &Subject<'_>, object: &Object, entry: &Entry) -> Option<Diagnostic> {
    let index = object.index;
    let id = EntryId { index, sub: SubIndex(0) };
    if !entry.access.is_readable() || entry.data_type != DataType::Unsigned8 {
        let message = format!("{index}: sub-index 0 is not a readable UNSIGNED8");
        let help = "correct its type and access; CiA 301 fixes the type, and every client reads it";
        let code = crate::check::pdo::mapping_follows_access::CODE;
        return Some(subject.finding(code, id, entry, Fact::Type, message).help(help));
    }
    let highest = i128::from(object.highest().0);
    // A count without a value is said by itself.
    let shown = entry.default.as_ref().and_then(Value::integer)?;
    // How much a mapping parameter maps and how many errors 1003h lists changes at run time.
    let varies = entry.access.is_writable() || index == Index(0x1003) || object.role() == Role::PdoMapping;
    if varies || shown == highest {
        return None;
    }
    let message = format!("{index}: sub-index 0 is {shown}, the highest sub-index {highest}");
    Some(subject.finding(CODE, id, entry, Fact::Default, message).help(subject.help(Help {
        specification: "remove `default:` from `sub0:`; the value follows from the entries",
        eds: &format!(
            "correct {} of sub-index 0, or describe the missing sub-indices",
            subject.format.key(Key::Default)
        ),
        setting: "leave the entry out; the value follows from the entries",
    })))
}
