//! The values of a device meet the conditions between its entries.

use crate::check::findings::Findings;
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::diag::shorten;
use crate::diag::{Code, Diagnostic, Example, Severity};
use crate::model::{CompareOp, Constraint, EntryRef, Incomputable, Outcome, Ratio, Values};
use crate::source::Span;

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Nothing, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0606",
    severity: Severity::Error,
    foreign: Severity::Error,
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
    for constraint in subject.system.constraints_about(&subject.device.key) {
        // A value outside its limits is said by itself.
        let broken = views(subject, constraint)
            .into_iter()
            .filter(|view| !view.names_setting_outside_limits(constraint))
            .find_map(|view| Some((view, view.broken(constraint)?)));
        if let Some((view, broken)) = broken.filter(|_| !is_said_before(subject, constraint)) {
            findings.push_each(finding(&view, constraint, &broken));
        }
    }
}

/// The values of all devices, as a condition sees them from one: what it names without a device is that one's.
#[derive(Clone, Copy)]
pub(in crate::check) struct View<'a> {
    pub subject: Subject<'a>,
    pub from: &'a str,
}

/// From where a constraint is looked at for a device: a configured node may break it for another device, too.
pub(in crate::check) fn views<'a>(subject: &Subject<'a>, constraint: &'a Constraint) -> Vec<View<'a>> {
    let key = &subject.device.key;
    let is_configured_part = subject.node.is_some() && constraint.devices.includes(key);
    let from = constraint.seen_from.iter();
    if constraint.seen_from.contains(key) {
        from.filter(|from| *from == key).map(|from| View { subject: *subject, from }).collect()
    } else {
        from.filter(|_| is_configured_part).map(|from| View { subject: *subject, from }).collect()
    }
}

/// Whether a device before this one breaks the constraint already: of types, it is said once.
fn is_said_before(subject: &Subject<'_>, constraint: &Constraint) -> bool {
    let key = &subject.device.key;
    let mut before = constraint.seen_from.iter().take_while(|from| *from != key);
    subject.node.is_none() && before.any(|from| View { subject: *subject, from }.broken(constraint).is_some())
}

impl View<'_> {
    /// The same entry with its device.
    fn explicit(&self, entry: &EntryRef) -> EntryRef {
        let device = entry.device.clone().unwrap_or_else(|| self.from.to_owned());
        EntryRef { device: Some(device), id: entry.id }
    }

    /// The link that does not hold; none where the constraint holds, its `when` does not, or a value is unknown.
    fn broken(&self, constraint: &Constraint) -> Option<Broken> {
        if constraint.when.as_ref().is_some_and(|when| when.evaluate(self) != Outcome::Holds) {
            return None;
        }
        match constraint.require.evaluate(self) {
            Outcome::Fails { left, op, right } => Some(Broken { left, op, right }),
            Outcome::Holds | Outcome::Unknown => None,
        }
    }

    /// Whether the values break a constraint.
    pub(in crate::check) fn is_broken(&self, constraint: &Constraint) -> bool {
        self.broken(constraint).is_some()
    }

    /// Why a constraint is not decided: a part of its `when` that cannot be worked out, or of what that asks for.
    pub(in crate::check) fn incomputable<'c>(&self, constraint: &'c Constraint) -> Option<Incomputable<'c>> {
        let counts = constraint.when.as_ref().map_or(Outcome::Holds, |when| when.evaluate(self));
        let undecided = match counts {
            Outcome::Holds => &constraint.require,
            Outcome::Unknown => constraint.when.as_ref()?,
            Outcome::Fails { .. } => return None,
        };
        undecided.incomputable(self).filter(|_| undecided.evaluate(self) == Outcome::Unknown)
    }

    /// Whether a setting that the constraint names lies outside its limits.
    fn names_setting_outside_limits(&self, constraint: &Constraint) -> bool {
        constraint.require.entries().into_iter().any(|named| {
            let named = self.explicit(named);
            let Some((entry, place)) = self.subject.named_entry(&named) else { return false };
            let is_set = self.subject.settings().contains(&place.file);
            is_set && self.subject.raw(&named).is_some_and(|raw| !entry.allows(raw))
        })
    }
}

impl Values for View<'_> {
    fn value(&self, entry: &EntryRef) -> Option<Ratio> {
        self.subject.value(&self.explicit(entry))
    }

    fn raw(&self, entry: &EntryRef) -> Option<i128> {
        self.subject.raw(&self.explicit(entry))
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

fn finding(view: &View<'_>, constraint: &Constraint, broken: &Broken) -> Diagnostic {
    let subject = &view.subject;
    let conditions = [Some(&constraint.require), constraint.when.as_ref()];
    let named: Vec<Named<'_>> = conditions
        .into_iter()
        .flatten()
        .flat_map(|condition| condition.entries())
        .filter_map(|entry| {
            let (_, place) = subject.named_entry(&view.explicit(entry))?;
            let is_set = place.file != constraint.span.file && subject.settings().contains(&place.file);
            Some(Named { entry, place, is_set })
        })
        .collect();
    let Broken { left, op, right } = broken;
    let message = format!("the values of `{}` break `{}`", view.from, shorten(&constraint.name));
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
    // A setting of a part of a ladder is checked against the whole of it: each value, once, wherever it is from.
    let of_ladder = set.map_or(&[][..], |_| named.as_slice());
    let mut reported: Vec<Span> = set.map(|set| set.place).into_iter().collect();
    for named in of_ladder {
        let Some(value) = view.value(named.entry).filter(|_| !reported.contains(&named.place)) else {
            continue;
        };
        reported.push(named.place);
        diagnostic = diagnostic.with(named.place, format!("{} is {value}", named.entry));
    }
    for (text, value) in [left, right] {
        let side = named.iter().find(|named| named.entry.to_string() == *text);
        let said = format!("{text} is {value}");
        diagnostic = match side {
            Some(side) if reported.contains(&side.place) => diagnostic,
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
