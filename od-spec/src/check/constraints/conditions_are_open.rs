//! A condition depends on the device: it neither always nor never holds.

use std::collections::BTreeMap;

use crate::check::constraints::constraints_hold::{View, views};
use crate::check::findings::Findings;
use crate::check::possible::{Run, possible};
use crate::check::rule::{Check, Needs, Rule};
use crate::check::subject::Subject;
use crate::check::verdict::{Knowledge, Link, Verdict, links};
use crate::diag::{Code, Diagnostic, Example, Severity, shorten};
use crate::model::{Constraint, EntryId, EntryRef, Expr, Fact, Term, Value};

pub(super) const RULE: Rule = Rule { code: CODE, needs: Needs::Everything, check: Check::Device(check) };

const CODE: &Code = &Code {
    id: "OD0880",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a condition whose answer is known beforehand",
    explanation: "Types, limits, enums and constants decide the condition: it holds always, and guards nothing, or never, and what waits for it is out of reach. The same is said of \
        constraints that cannot hold together, and of entries each of which can be written only after the other. Numbers are compared in physical units, so that a number in mV is a \
        thousand times too large for a value in V. Correct the condition, or what it compares.",
    clause: None,
    example: Some(Example::new(
        "objects:\n  0x2000: {name: speed, type: unsigned8, access: rw, writable-when: \"0x2001 == 4\"}\n  0x2001: {name: mode, type: unsigned8, access: ro, max: 3}",
        "objects:\n  0x2000: {name: speed, type: unsigned8, access: rw, writable-when: \"0x2001 == 3\"}\n  0x2001: {name: mode, type: unsigned8, access: ro, max: 3}",
    )),
};

fn check(subject: &Subject<'_>, findings: &mut Findings) {
    for_writing(subject, findings);
    let mut certain: Vec<Certain<'_>> = Vec::new();
    for constraint in subject.system.constraints_about(&subject.device.key) {
        let views = views(subject, constraint);
        let Some(view) = views.first() else { continue };
        // What the values at hand break is said by itself.
        if views.iter().any(|view| view.is_broken(constraint)) {
            continue;
        }
        if let Some(finding) = decided(view, constraint) {
            findings.push(finding);
            continue;
        }
        let Some(links) = demanded(constraint) else { continue };
        let one = Certain { constraint, from: view.from, links };
        if let Some(other) = against(view, &one, &certain) {
            let message =
                format!("`{}` and `{}` never hold together", shorten(&other.name), shorten(&constraint.name));
            findings.push(
                Diagnostic::new(CODE, constraint.span, message)
                    .with(other.span, "the other one")
                    .help("correct one of the two"),
            );
        } else {
            certain.push(one);
        }
    }
}

/// A constraint whose condition, or whose case, is decided.
fn decided(view: &View<'_>, constraint: &Constraint) -> Option<Diagnostic> {
    let knowledge = Knowledge::of(view.subject, view.from);
    let name = shorten(&constraint.name);
    let (condition, message, help) = match constraint.when.as_ref() {
        Some(when) if knowledge.verdict(when) == Verdict::Never => {
            (when, format!("`{name}` never counts: its `when` never holds"), "correct the condition")
        }
        Some(when) if knowledge.verdict(when) == Verdict::Always => (
            when,
            format!("`{name}` always counts: its `when` always holds"),
            "correct the condition, or leave it out",
        ),
        Some(_) | None => match knowledge.verdict(&constraint.require) {
            Verdict::Never => (
                &constraint.require,
                format!("`{name}` can never hold"),
                "correct the condition; values are compared in physical units",
            ),
            Verdict::Always => (
                &constraint.require,
                format!("`{name}` always holds, it guards nothing"),
                "correct the condition; values are compared in physical units",
            ),
            Verdict::Open => return None,
        },
    };
    Some(explained(&knowledge, condition, Diagnostic::new(CODE, constraint.span, message)).help(help))
}

/// A constraint that holds in every case, and can hold.
struct Certain<'a> {
    constraint: &'a Constraint,
    /// The device that is meant where it names none.
    from: &'a str,
    links: Vec<Link<'a>>,
}

/// A constraint before this one with which it never holds together.
fn against<'a>(view: &View<'a>, one: &Certain<'a>, before: &[Certain<'a>]) -> Option<&'a Constraint> {
    let knowledge = Knowledge::of(view.subject, view.from);
    // Each can hold alone, so a conflict needs a term that both have.
    let mut near =
        before.iter().filter(|other| other.from == one.from && have_common_term(&one.links, &other.links));
    let other = near.find(|other| {
        let both: Vec<Link<'_>> = one.links.iter().chain(&other.links).copied().collect();
        knowledge.contradict(&both)
    })?;
    Some(other.constraint)
}

/// The links that hold in every case.
fn demanded(constraint: &Constraint) -> Option<Vec<Link<'_>>> {
    match (&constraint.when, constraint.require.alternatives.as_slice()) {
        (None, [comparisons]) => Some(comparisons.iter().flat_map(links).collect()),
        _ => None,
    }
}

/// Whether two constraints have a term in common. A number is none: what is compared with it has its ends in either.
fn have_common_term(links: &[Link<'_>], others: &[Link<'_>]) -> bool {
    let mut terms = links.iter().flat_map(|(left, _, right)| [*left, *right]);
    terms.any(|term| {
        let is_other = |(left, _, right): &Link<'_>| *left == term || *right == term;
        !matches!(term, Term::Number(_)) && others.iter().any(is_other)
    })
}

/// The conditions under which entries can be written.
fn for_writing(subject: &Subject<'_>, findings: &mut Findings) {
    let mut knowledge = Knowledge::of(*subject, &subject.device.key);
    let guarded = subject.device.entries().filter_map(|(id, _, entry)| {
        // That of a view is its target's.
        let own = entry.alias.is_none() && entry.access.is_writable();
        Some((id, entry, entry.writable_when.as_ref().filter(|_| own)?))
    });
    let mut waiting = Vec::new();
    for (id, entry, condition) in guarded {
        let word = match knowledge.verdict(condition) {
            Verdict::Never => "never",
            Verdict::Always => "always",
            Verdict::Open => {
                waiting.push((id, entry, condition));
                continue;
            }
        };
        let message = format!("{id} ({}): the condition for writing {word} holds", entry.name);
        let finding = subject.finding(CODE, id, entry, Fact::WriteCondition, message);
        findings.push(
            explained(&knowledge, condition, finding)
                .help("correct the condition; values are compared in physical units"),
        );
    }
    // As long as an entry cannot be written, it keeps its default; what waits for another value waits for ever.
    let kept = waiting
        .iter()
        .filter_map(|(id, entry, _)| Some((*id, entry.default.as_ref().and_then(Value::integer)?)));
    knowledge.kept = kept.collect();
    loop {
        let names_kept = |condition: &Expr| {
            condition.entries().into_iter().any(|named| knowledge.kept.contains_key(&named.id))
        };
        let free = |(_, _, condition): &(_, _, &Expr)| {
            !names_kept(condition) || knowledge.verdict(condition) != Verdict::Never
        };
        let opened: Vec<EntryId> = waiting.iter().filter(|one| free(one)).map(|(id, ..)| *id).collect();
        if opened.is_empty() {
            break;
        }
        waiting.retain(|(id, ..)| !opened.contains(id));
        for id in &opened {
            knowledge.kept.remove(id);
        }
    }
    for (id, entry, condition) in waiting {
        let message = format!("{id} ({}) can never be written", entry.name);
        let finding = subject.finding(CODE, id, entry, Fact::WriteCondition, message);
        findings.push(
            explained(&knowledge, condition, finding)
                .help("correct the condition, or a default; entries must not wait for each other"),
        );
    }
}

/// Adds what the entries of a condition can be.
fn explained(knowledge: &Knowledge<'_>, condition: &Expr, finding: Diagnostic) -> Diagnostic {
    let ranges: BTreeMap<&EntryRef, String> =
        condition.entries().into_iter().filter_map(|named| Some((named, range(knowledge, named)?))).collect();
    ranges.into_iter().fold(finding, |finding, (named, range)| finding.note(format!("{named} is {range}")))
}

/// `0 to 3`, `20`, `0 V to 65.535 V`.
fn range(knowledge: &Knowledge<'_>, named: &EntryRef) -> Option<String> {
    let entry = knowledge.entry(named)?;
    let show = |raw: i128| match entry.unit.as_deref() {
        Some(unit) => unit.quantity(raw).map(|value| format!("{value} {}", unit.base_symbol())),
        None => Some(raw.to_string()),
    };
    let kept = knowledge.kept.get(&named.id).filter(|_| named.device.is_none());
    if let Some(kept) = kept {
        return Some(format!("{}, and cannot be written", show(*kept)?));
    }
    let one = |(low, high): Run| {
        Some(if low == high { show(low)? } else { format!("{} to {}", show(low)?, show(high)?) })
    };
    match possible(entry)?.as_slice() {
        [run] => one(*run),
        [first, .., last] => one((first.0, last.1)).map(|hull| format!("{hull}, with gaps")),
        [] => None,
    }
}
