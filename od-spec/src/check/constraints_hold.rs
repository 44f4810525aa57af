//! The values of a device meet the conditions between its entries.

use super::findings::Findings;
use super::rule::{Check, Needs, Rule};
use super::subject::Subject;
use crate::diag::shorten;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{CompareOp, Constraint, EntryRef, Outcome, Ratio, Values};
use crate::source::Span;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0606",
    severity: Severity::Error,
    title: "a constraint that is broken",
    explanation: "The values at hand do not meet a condition of the specification, such as thresholds that must keep their order. They are compared \
        exactly, in physical units; an entry that is not set has its default. Each value may be right by itself: it is the combination that \
        the device cannot work with. Correct a value, or the condition.",
    clause: None,
    example: Some(Example::new(
        "objects:\n  0x2000: {name: low, type: unsigned8, access: rw, default: 50}\n  0x2001: {name: high, type: unsigned8, access: rw, default: 40}\nconstraints:\n  order: {require: \"0x2000 < 0x2001\"}",
        "objects:\n  0x2000: {name: low, type: unsigned8, access: rw, default: 30}\n  0x2001: {name: high, type: unsigned8, access: rw, default: 40}\nconstraints:\n  order: {require: \"0x2000 < 0x2001\"}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    let key = &subject.device.key;
    for constraint in subject.system.constraints.iter().filter(|constraint| constraint.devices.includes(key))
    {
        // A condition that names the device of every entry says the same on each of them.
        let prefixed = constraint.require.entries().iter().all(|entry| entry.device.is_some());
        if prefixed && subject.node.is_none() && constraint.devices.keys().first() != Some(key) {
            continue;
        }
        // A value outside its limits is said by itself.
        if set_outside_limits(subject, constraint) {
            continue;
        }
        if let Outcome::Fails { left, op, right } = outcome(constraint, subject) {
            findings.push_each(finding(subject, constraint, &Broken { left, op, right }));
        }
    }
}

/// Whether a setting that the constraint names lies outside its limits.
fn set_outside_limits(subject: &Subject<'_>, constraint: &Constraint) -> bool {
    constraint.require.entries().into_iter().any(|named| {
        let Some((entry, place)) = subject.named_entry(named) else { return false };
        let is_set = subject.settings().contains(&place.file);
        is_set && subject.raw(named).is_some_and(|raw| !entry.allows(raw))
    })
}

/// Whether a constraint holds; one whose `when` does not hold, or cannot be decided, holds.
fn outcome(constraint: &Constraint, subject: &Subject<'_>) -> Outcome {
    match &constraint.when {
        Some(when) if when.evaluate(subject) != Outcome::Holds => Outcome::Holds,
        Some(_) | None => constraint.require.evaluate(subject),
    }
}

/// The link of a chain that does not hold: its sides as written, with their values.
struct Broken {
    left: (String, Ratio),
    op: CompareOp,
    right: (String, Ratio),
}

/// An entry that a condition names, with the place of its value.
struct Named<'a> {
    entry: &'a EntryRef,
    place: Span,
    is_set: bool,
}

fn finding(subject: &Subject<'_>, constraint: &Constraint, broken: &Broken) -> Diagnostic {
    let conditions = [Some(&constraint.require), constraint.when.as_ref()];
    let named: Vec<Named<'_>> = conditions
        .into_iter()
        .flatten()
        .flat_map(|condition| condition.entries())
        .filter_map(|entry| {
            let (_, place) = subject.named_entry(entry)?;
            let is_set = place.file != constraint.span.file && subject.settings().contains(&place.file);
            Some(Named { entry, place, is_set })
        })
        .collect();
    let Broken { left, op, right } = broken;
    let message = format!("the values of `{}` break `{}`", subject.device.key, shorten(&constraint.name));
    let sides = format!("{} is {}, {} is {}: not {}", left.0, left.1, right.0, right.1, op.sign());
    let set = named.iter().find(|named| named.is_set);
    let mut diagnostic = match set {
        Some(set) => Diagnostic::new(CODE, set.place, message)
            .label(sides)
            .with(constraint.span, "the constraint")
            .help("set values that meet the condition; entries that are not set have their defaults"),
        None => Diagnostic::new(CODE, link(constraint, broken), message)
            .label(format!("not {}", op.sign()))
            .help("correct a default or the condition; values are compared in physical units"),
    };
    for (text, value) in [left, right] {
        let side = named.iter().find(|named| named.entry.to_string() == *text);
        let said = format!("{text} is {value}");
        diagnostic = match side {
            Some(side) if set.is_some_and(|set| set.place == side.place) => diagnostic,
            Some(side) => diagnostic.with(side.place, said),
            None if set.is_some() || *text == value.to_string() => diagnostic,
            None => diagnostic.note(said),
        };
    }
    diagnostic
}

/// The place of the link of a chain that does not hold; of the whole condition, where its sides are not entries.
fn link(constraint: &Constraint, broken: &Broken) -> Span {
    let entries = constraint.require.entries();
    let is_link =
        |pair: &[&EntryRef]| pair[0].to_string() == broken.left.0 && pair[1].to_string() == broken.right.0;
    let at = entries.windows(2).position(is_link);
    let places = at.and_then(|at| Some((constraint.places.get(at)?, constraint.places.get(at + 1)?)));
    places.map_or(constraint.span, |(first, second)| first.to(*second))
}
