//! A value lies inside the limits of its entry, for every node-ID, or is a special one.

use crate::check::findings::Findings;
use crate::check::help::Help;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{Entry, EntryId, Fact, Value};
use crate::source::Span;
use crate::wording::{allowed, format_value};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Objects(check) };

pub(crate) const CODE: &Code = &Code {
    id: "OD0406",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "a value outside the limits",
    explanation: "The value is outside `min` and `max` of its entry and is not one of its `special` values; for a node-ID formula this holds \
        for every node-ID. A device refuses such a value with abort code 0609 0031h or 0609 0032h, and one that does not may do harm. \
        Correct the value or the limits, or make the value `special`. What an alias sets counts for the entry that holds the value, too.",
    clause: Some("CiA 306, 4.6.3.2 (LowLimit, HighLimit)"),
    example: Some(Example::new(
        "objects:\n  0x2000: {name: brightness, type: unsigned8, access: rw, default: 120, max: 100}",
        "objects:\n  0x2000: {name: brightness, type: unsigned8, access: rw, default: 80, max: 100}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for (id, entry, value) in subject.values() {
        if (entry.alias.is_none() || view_counts(subject, entry))
            && let Some(node) = outside(subject, entry, value)
        {
            findings.push(finding(subject, id, entry, value, node));
        }
    }
}

/// Whether a view is blamed: its limits are those of what is written through it, and of a default that the target
/// can have.
fn view_counts(subject: &Subject<'_>, view: &Entry) -> bool {
    let is_written = subject.node.is_none() || view.is_set();
    let target = view.alias.as_ref().and_then(|alias| subject.device.entry(alias.target));
    let is_right = |target: &Entry| {
        target.default.as_ref().is_none_or(|value| outside(subject, target, value).is_none())
    };
    is_written && target.is_none_or(is_right)
}

/// The first node on which the value is outside.
fn outside(subject: &Subject<'_>, entry: &Entry, value: &Value) -> Option<u8> {
    // Limits in the wrong order allow nothing; that is said by itself.
    if let Value::Real(real) = value {
        let limits = &entry.real_limits;
        let is_outside = !limits.are_swapped(entry.data_type) && !limits.allow(real, entry.data_type);
        return subject.nodes_of(value).next().filter(|_| is_outside);
    }
    let has_order = entry.low.zip(entry.high).is_none_or(|(low, high)| low <= high);
    let (low, high) = entry.data_type.range().filter(|_| has_order)?;
    let is_outside = |raw: i128| (low..=high).contains(&raw) && !entry.allows(raw);
    subject.nodes_of(value).find(|node| value.integer_for(*node).is_some_and(is_outside))
}

fn finding(subject: &Subject<'_>, id: EntryId, entry: &Entry, value: &Value, node: u8) -> Diagnostic {
    let of_node = value.integer_for(node).map_or_else(|| value.clone(), Value::Integer);
    let (shown, on_node) = (format_value(entry, &of_node), subject.on_node(value, node));
    let message = format!("{id} ({}): {shown} is outside {}{on_node}", entry.name, allowed(entry));
    let help = subject.help(Help {
        specification: if of_node.integer().is_some() {
            "correct the value or the limits, or make the value `special`"
        } else {
            "correct the value or the limits"
        },
        eds: "correct the value or the limits",
        setting: "write a value within the limits; the device refuses any other",
    });
    // Where a library says the value, it is the maker's limit that does not fit.
    let places = [Fact::Default, Fact::LowLimit, Fact::HighLimit].map(|fact| subject.place(entry, fact));
    let is_makers = |place: &&Span| **place != subject.device.span && **place != entry.span;
    let place = places.iter().find(is_makers).unwrap_or(&places[0]);
    subject.seen_through(id, Diagnostic::new(CODE, *place, message).about((id, Fact::Default)).help(help))
}
