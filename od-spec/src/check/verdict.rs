//! Whether a condition is decided before the device is looked at: what its entries can be makes it hold always or
//! never.
//!
//! Each comparison is decided by the values that its sides can have. Several that must hold together are looked at as an order
//! of terms, too: `a < b` and `b < a` never hold together, although each may.

use std::cell::OnceCell;
use std::cmp::Ordering;
use std::collections::BTreeMap;

use super::possible::{Run, bits, is_reserved, possible};
use super::subject::Subject;
use crate::model::{ArithmeticOp, CompareOp, Comparison, Entry, EntryId, EntryRef, Expr, Ratio, Term};

/// What is known about a condition.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::check) enum Verdict {
    /// It holds, whatever the values are.
    Always,
    /// It never holds.
    Never,
    /// It depends on the values.
    Open,
}

impl Verdict {
    /// That all of several conditions hold.
    fn all(verdicts: impl Iterator<Item = Self>) -> Self {
        let list: Vec<Self> = verdicts.collect();
        if list.contains(&Self::Never) {
            Self::Never
        } else if list.contains(&Self::Open) {
            Self::Open
        } else {
            Self::Always
        }
    }

    /// That at least one of several conditions holds.
    fn any(verdicts: impl Iterator<Item = Self>) -> Self {
        match Self::all(verdicts.map(Self::opposite)) {
            Self::Open => Self::Open,
            decided => decided.opposite(),
        }
    }

    /// That a condition does not hold.
    const fn opposite(self) -> Self {
        match self {
            Self::Always => Self::Never,
            Self::Never => Self::Always,
            Self::Open => Self::Open,
        }
    }
}

/// Quantities from one to another, both included.
type Reach = (Ratio, Ratio);

/// Two terms and what is asked of them.
pub(in crate::check) type Link<'t> = (&'t Term, CompareOp, &'t Term);

/// More terms than these are not put into an order.
const MOST_TERMS: usize = 64;

/// What is known about the entries that conditions name.
pub(in crate::check) struct Knowledge<'a> {
    /// The device that the conditions are of.
    pub subject: Subject<'a>,
    /// The device that is meant where a condition names none.
    pub from: &'a str,
    /// Entries of that device that keep a value.
    pub kept: BTreeMap<EntryId, i128>,
}

impl<'a> Knowledge<'a> {
    /// What type, limits, enum and access show.
    pub(in crate::check) const fn of(subject: Subject<'a>, from: &'a str) -> Self {
        Self { subject, from, kept: BTreeMap::new() }
    }

    /// The entry that a condition names.
    pub(in crate::check) fn entry(&self, named: &EntryRef) -> Option<&'a Entry> {
        self.subject.device_of(named.device.as_deref().unwrap_or(self.from))?.entry(named.id)
    }

    fn raw(&self, named: &EntryRef) -> Option<Vec<Run>> {
        let is_own = named.device.as_deref().is_none_or(|device| device == self.from);
        match self.kept.get(&named.id).filter(|_| is_own) {
            Some(raw) => Some(vec![(*raw, *raw)]),
            None => possible(self.entry(named)?),
        }
    }

    /// Where the value of a term lies, in physical units.
    fn reach(&self, term: &Term) -> Option<Vec<Reach>> {
        let whole = |(low, high): Run| (Ratio::whole(low), Ratio::whole(high));
        match term {
            Term::Number(number) => Some(vec![(*number, *number)]),
            Term::Bit(entry, bit) if is_reserved(self.entry(entry)?, *bit) => Some(vec![whole((0, 0))]),
            Term::Bit(entry, bit) => Some(bits(&self.raw(entry)?, *bit).into_iter().map(whole).collect()),
            Term::Entry(entry) => {
                let runs = self.raw(entry)?;
                let Some(unit) = self.entry(entry)?.unit.as_deref() else {
                    return Some(runs.into_iter().map(whole).collect());
                };
                // What one step is worth depends on other entries.
                if unit.formula.is_some() {
                    return None;
                }
                runs.into_iter()
                    .map(|(low, high)| {
                        let (low, high) = (unit.quantity(low)?, unit.quantity(high)?);
                        Some(if low.compare(high)?.is_gt() { (high, low) } else { (low, high) })
                    })
                    .collect()
            }
            Term::Binary(left, op, right) => {
                let (left, right) = (hull(&self.reach(left)?)?, hull(&self.reach(right)?)?);
                Some(vec![combined(left, *op, right)?])
            }
        }
    }

    /// Whether an entry can have a number at all, which may lie between its steps.
    fn can_be(&self, entry: &EntryRef, number: Ratio) -> Option<bool> {
        let steps = match self.entry(entry)?.unit.as_deref() {
            Some(unit) if unit.formula.is_some() => return None,
            Some(unit) => unit.steps(number, unit.base_symbol())?,
            None => number,
        };
        let runs = self.raw(entry)?;
        Some(steps.to_whole().is_some_and(|raw| runs.iter().any(|(low, high)| (*low..=*high).contains(&raw))))
    }

    fn link(&self, (left, op, right): Link<'_>) -> Verdict {
        let on = |holds: bool| if holds { Verdict::Always } else { Verdict::Never };
        if left == right && !matches!(left, Term::Binary(..)) {
            return on(op.accepts(Ordering::Equal));
        }
        if let (Term::Entry(entry), Term::Number(number)) | (Term::Number(number), Term::Entry(entry)) =
            (left, right)
            && matches!(op, CompareOp::Equal | CompareOp::NotEqual)
            && self.can_be(entry, *number) == Some(false)
        {
            return on(op == CompareOp::NotEqual);
        }
        let (Some(left), Some(right)) = (self.reach(left), self.reach(right)) else { return Verdict::Open };
        let pairs = left.iter().flat_map(|left| right.iter().map(move |right| (*left, *right)));
        let verdicts: Vec<Verdict> = pairs.map(|(left, right)| between(left, op, right)).collect();
        match verdicts.split_first() {
            Some((first, others)) if others.iter().all(|other| other == first) => *first,
            Some(_) | None => Verdict::Open,
        }
    }

    fn together(&self, comparisons: &[Comparison]) -> Verdict {
        let links: Vec<Link<'_>> = comparisons.iter().flat_map(links).collect();
        if self.contradict(&links) {
            return Verdict::Never;
        }
        Verdict::all(links.into_iter().map(|link| self.link(link)))
    }

    /// What is known about a condition.
    pub(in crate::check) fn verdict(&self, condition: &Expr) -> Verdict {
        if condition.is_unresolved() {
            return Verdict::Open;
        }
        let verdict =
            Verdict::any(condition.alternatives.iter().map(|comparisons| self.together(comparisons)));
        match verdict {
            Verdict::Open if self.leaves_nothing(condition) => Verdict::Always,
            Verdict::Open | Verdict::Always | Verdict::Never => verdict,
        }
    }

    /// Whether alternatives of one comparison each leave no case out, such as `a < 5 or a >= 5`.
    fn leaves_nothing(&self, condition: &Expr) -> bool {
        let single = condition.alternatives.iter().map(|comparisons| match comparisons.as_slice() {
            [Comparison { first, rest }] => match rest.as_slice() {
                [(op, last)] => Some((first, op.opposite(), last)),
                _ => None,
            },
            _ => None,
        });
        single.collect::<Option<Vec<Link<'_>>>>().is_some_and(|links| self.contradict(&links))
    }

    /// Whether links can never hold together: they ask for an order that goes in a circle, or that ends of ranges do not have.
    pub(in crate::check) fn contradict(&self, links: &[Link<'_>]) -> bool {
        let mut terms: Vec<&Term> = Vec::new();
        let mut place = |term| {
            terms.iter().position(|one| *one == term).unwrap_or_else(|| {
                terms.push(term);
                terms.len() - 1
            })
        };
        let edges: Vec<(usize, CompareOp, usize)> =
            links.iter().map(|(left, op, right)| (place(left), *op, place(right))).collect();
        if terms.len() > MOST_TERMS {
            return false;
        }
        let order = Order::of(terms.len(), &edges);
        let reached: Vec<OnceCell<Option<Reach>>> = vec![OnceCell::new(); terms.len()];
        let ends = |term: usize| *reached[term].get_or_init(|| hull(&self.reach(terms[term])?));
        let breaks_ends = order.pairs().any(|(below, above, step)| match (ends(below), ends(above)) {
            (Some((low, _)), Some((_, high))) => match low.compare(high) {
                Some(Ordering::Greater) => true,
                Some(Ordering::Equal) => step == Step::Below,
                Some(Ordering::Less) | None => false,
            },
            _ => false,
        });
        breaks_ends || order.is_circle(&edges)
    }
}

/// The links of a chain `a < b <= c`.
pub(in crate::check) fn links(comparison: &Comparison) -> impl Iterator<Item = Link<'_>> {
    let left = [&comparison.first].into_iter().chain(comparison.rest.iter().map(|(_, term)| term));
    left.zip(&comparison.rest).map(|(left, (op, right))| (left, *op, right))
}

/// The ends of several reaches.
fn hull(reaches: &[Reach]) -> Option<Reach> {
    let mut ends = *reaches.first()?;
    for (low, high) in reaches {
        ends.0 = least(ends.0, *low)?;
        ends.1 = largest(ends.1, *high)?;
    }
    Some(ends)
}

fn least(one: Ratio, other: Ratio) -> Option<Ratio> {
    Some(if one.compare(other)?.is_le() { one } else { other })
}

fn largest(one: Ratio, other: Ratio) -> Option<Ratio> {
    Some(if one.compare(other)?.is_ge() { one } else { other })
}

/// Where the result of an operation lies. None where the divisor may be 0.
fn combined(left: Reach, op: ArithmeticOp, right: Reach) -> Option<Reach> {
    let apply = |a: Ratio, b: Ratio| match op {
        ArithmeticOp::Add => a.checked_add(b),
        ArithmeticOp::Subtract => a.checked_sub(b),
        ArithmeticOp::Multiply => a.checked_mul(b),
        ArithmeticOp::Divide => a.checked_div(b),
    };
    if op == ArithmeticOp::Divide
        && right.0.compare(Ratio::ZERO)?.is_le()
        && right.1.compare(Ratio::ZERO)?.is_ge()
    {
        return None;
    }
    let corners = [(left.0, right.0), (left.0, right.1), (left.1, right.0), (left.1, right.1)];
    let values = corners.map(|(a, b)| apply(a, b).map(|value| (value, value)));
    hull(&values.into_iter().collect::<Option<Vec<Reach>>>()?)
}

/// Whether all quantities of one reach are to all of another one as the operator asks.
fn between(left: Reach, op: CompareOp, right: Reach) -> Verdict {
    let (Some(first), Some(last)) = (left.0.compare(right.1), left.1.compare(right.0)) else {
        return Verdict::Open;
    };
    // `first` compares the lowest left with the highest right, `last` the other ends.
    let decide = |always: bool, never: bool| match (always, never) {
        (true, _) => Verdict::Always,
        (_, true) => Verdict::Never,
        (false, false) => Verdict::Open,
    };
    match op {
        CompareOp::Less => decide(last.is_lt(), first.is_ge()),
        CompareOp::LessOrEqual => decide(last.is_le(), first.is_gt()),
        CompareOp::Greater => decide(first.is_gt(), last.is_le()),
        CompareOp::GreaterOrEqual => decide(first.is_ge(), last.is_lt()),
        CompareOp::Equal => decide(first.is_eq() && last.is_eq(), first.is_gt() || last.is_lt()),
        CompareOp::NotEqual => decide(first.is_gt() || last.is_lt(), first.is_eq() && last.is_eq()),
    }
}

/// How a term lies to another one in an [`Order`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Step {
    /// Not above.
    NotAbove,
    /// Below.
    Below,
}

/// What follows from some links about the order of their terms.
struct Order {
    steps: Vec<Vec<Option<Step>>>,
}

impl Order {
    fn of(count: usize, edges: &[(usize, CompareOp, usize)]) -> Self {
        let mut steps = vec![vec![None; count]; count];
        let mut add = |from: usize, to: usize, step: Step| steps[from][to] = steps[from][to].max(Some(step));
        // A term equals itself.
        (0..count).for_each(|term| add(term, term, Step::NotAbove));
        for (left, op, right) in edges {
            match op {
                CompareOp::Less => add(*left, *right, Step::Below),
                CompareOp::LessOrEqual => add(*left, *right, Step::NotAbove),
                CompareOp::Greater => add(*right, *left, Step::Below),
                CompareOp::GreaterOrEqual => add(*right, *left, Step::NotAbove),
                CompareOp::Equal => {
                    add(*left, *right, Step::NotAbove);
                    add(*right, *left, Step::NotAbove);
                }
                CompareOp::NotEqual => {}
            }
        }
        for over in 0..count {
            for from in 0..count {
                for to in 0..count {
                    if let (Some(first), Some(second)) = (steps[from][over], steps[over][to]) {
                        steps[from][to] = steps[from][to].max(Some(first.max(second)));
                    }
                }
            }
        }
        Self { steps }
    }

    /// Terms that do not lie above others.
    fn pairs(&self) -> impl Iterator<Item = (usize, usize, Step)> + '_ {
        self.steps.iter().enumerate().flat_map(|(from, row)| {
            let others = row.iter().enumerate().filter(move |(to, _)| *to != from);
            others.filter_map(move |(to, step)| Some((from, to, (*step)?)))
        })
    }

    /// Whether a term would lie below itself, or terms that must differ are equal.
    fn is_circle(&self, edges: &[(usize, CompareOp, usize)]) -> bool {
        let is_below_itself = (0..self.steps.len()).any(|term| self.steps[term][term] == Some(Step::Below));
        let are_equal = |left: usize, right: usize| {
            self.steps[left][right].is_some() && self.steps[right][left].is_some()
        };
        is_below_itself
            || edges.iter().any(|(left, op, right)| *op == CompareOp::NotEqual && are_equal(*left, *right))
    }
}
