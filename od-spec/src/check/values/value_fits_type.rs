//! A value is one of the entry's data type, for every node-ID, and no longer than the string may be.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{DataType, Entry, EntryId, Fact, Value};
use crate::wording::format_value;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Objects(check) };

/// The code of the rule.
pub const CODE: &Code = &Code {
    id: "OD0404",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "a value that does not fit the type",
    explanation: "The value is outside what the data type can hold, for the formula `$NODEID + n` also for the largest \
        node-ID 127, or a string is longer than its `capacity`. The device would hold another value than the one \
        written here. Signed values are written in decimal, not as bit patterns. Correct the value, or take a wider \
        type or a larger capacity.",
    clause: Some("CiA 301, table 39 (data types)"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: label, type: visible-string, capacity: 4, access: rw, default: LABEL}",
        "objects:\n  0x2000: {name: label, type: visible-string, capacity: 5, access: rw, default: LABEL}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for (id, entry, value) in subject.values() {
        if let Some(finding) = number(subject, id, entry, value).or_else(|| length(subject, id, entry, value))
        {
            findings.push(finding);
        }
    }
}

/// Whether a type has values of this kind.
pub(in crate::check) const fn is_of_type(value: &Value, data_type: DataType) -> bool {
    match value {
        Value::Integer(_) | Value::NodeId(_) => {
            data_type.is_integer() || matches!(data_type, DataType::Boolean)
        }
        Value::Real(_) => matches!(data_type, DataType::Real32 | DataType::Real64),
        Value::Text(_) => matches!(data_type, DataType::VisibleString | DataType::UnicodeString),
        Value::Bytes(_) => matches!(data_type, DataType::OctetString),
    }
}

fn number(subject: &Subject<'_>, id: EntryId, entry: &Entry, value: &Value) -> Option<Diagnostic> {
    let place = subject.place(entry, Fact::Default);
    if !is_of_type(value, entry.data_type) {
        let shown = format_value(entry, value);
        let message = format!("{id} ({}): `{shown}` is not a value of type {}", entry.name, entry.data_type);
        // A value that follows from the device is right; the type is not.
        let help = "correct the type, or the fact that the value follows from";
        return Some(
            subject.finding(CODE, id, entry, Fact::Type, message).with(place, "the value").help(help),
        );
    }
    let (low, high) = entry.data_type.range()?;
    let misfit = |raw: &i128| !(low..=high).contains(raw);
    let (node, raw) = subject
        .nodes_of(value)
        .filter_map(|node| Some((node, value.integer_for(node)?)))
        .find(|(_, raw)| misfit(raw))?;
    let on_node = subject.on_node(value, node);
    let message = format!("{id} ({}): {raw} does not fit {}{on_node}", entry.name, entry.data_type);
    Some(
        subject
            .finding(CODE, id, entry, Fact::Default, message)
            .label(format!("allowed: {low} to {high}"))
            .help("correct the value or the type"),
    )
}

fn length(subject: &Subject<'_>, id: EntryId, entry: &Entry, value: &Value) -> Option<Diagnostic> {
    // A capacity that follows from a constant is that of the constant.
    let capacity = entry.capacity.filter(|_| entry.facts.get(Fact::Capacity).is_some())?;
    let length = value.bytes_for(entry.data_type, 0)?.len();
    if length <= usize::from(capacity) {
        return None;
    }
    let message = format!("{id} ({}): the value has {length} bytes, the capacity is {capacity}", entry.name);
    Some(
        subject
            .finding(CODE, id, entry, Fact::Default, message)
            .with(subject.place(entry, Fact::Capacity), "the capacity")
            .help(subject.help(Help {
                specification: "raise the capacity, or shorten the value",
                eds: "shorten the value",
                setting: "shorten the value",
            })),
    )
}
