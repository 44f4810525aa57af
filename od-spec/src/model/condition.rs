//! Conditions between entries: `0x30FC.2 < 0x30FC.1`, `bit(0x6041, 2) == 0`. Values are compared in physical units: raw value
//! × scale + offset, in the unit's base symbol.

use std::cmp::Ordering;
use std::fmt;

use super::{EntryId, Ratio};

/// A condition.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Expr {
    /// The condition as written.
    pub text: String,
    /// Comparisons that all must hold, for one of these at least: `a and b or c`.
    pub alternatives: Vec<Vec<Comparison>>,
    /// Where in the text the entries are named, in the order of [`Expr::entries`].
    pub places: Vec<std::ops::Range<usize>>,
}

/// A chain such as `a < b <= c`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Comparison {
    /// The first term.
    pub first: Term,
    /// Operators with the terms to their right.
    pub rest: Vec<(CompareOp, Term)>,
}

/// A comparison operator.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CompareOp {
    /// `<`
    Less,
    /// `<=`
    LessOrEqual,
    /// `==`
    Equal,
    /// `!=`
    NotEqual,
    /// `>=`
    GreaterOrEqual,
    /// `>`
    Greater,
}

impl CompareOp {
    /// Whether the operator accepts this order of its sides.
    pub const fn accepts(self, order: Ordering) -> bool {
        match self {
            CompareOp::Less => order.is_lt(),
            CompareOp::LessOrEqual => order.is_le(),
            CompareOp::Equal => order.is_eq(),
            CompareOp::NotEqual => order.is_ne(),
            CompareOp::GreaterOrEqual => order.is_ge(),
            CompareOp::Greater => order.is_gt(),
        }
    }

    /// The operator that accepts what this one does not.
    pub const fn opposite(self) -> Self {
        match self {
            CompareOp::Less => CompareOp::GreaterOrEqual,
            CompareOp::LessOrEqual => CompareOp::Greater,
            CompareOp::Equal => CompareOp::NotEqual,
            CompareOp::NotEqual => CompareOp::Equal,
            CompareOp::GreaterOrEqual => CompareOp::Less,
            CompareOp::Greater => CompareOp::LessOrEqual,
        }
    }

    /// The operator as written.
    pub const fn sign(self) -> &'static str {
        match self {
            CompareOp::Less => "<",
            CompareOp::LessOrEqual => "<=",
            CompareOp::Equal => "==",
            CompareOp::NotEqual => "!=",
            CompareOp::GreaterOrEqual => ">=",
            CompareOp::Greater => ">",
        }
    }
}

/// An arithmetic term.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Term {
    /// A number.
    Number(Ratio),
    /// The value of an entry.
    Entry(EntryRef),
    /// One bit of an entry, 0 or 1.
    Bit(EntryRef, u8),
    /// Two terms and an operator.
    Binary(Box<Term>, ArithmeticOp, Box<Term>),
}

/// An arithmetic operator.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ArithmeticOp {
    /// `+`
    Add,
    /// `-`
    Subtract,
    /// `*`
    Multiply,
    /// `/`
    Divide,
}

impl ArithmeticOp {
    /// The operator as written.
    pub const fn sign(self) -> &'static str {
        match self {
            ArithmeticOp::Add => "+",
            ArithmeticOp::Subtract => "-",
            ArithmeticOp::Multiply => "*",
            ArithmeticOp::Divide => "/",
        }
    }
}

/// An entry named in a condition.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct EntryRef {
    /// The device, where it is written.
    pub device: Option<String>,
    /// The entry.
    pub id: EntryId,
}

/// What a condition asks of its surroundings.
pub trait Values {
    /// Value of an entry in physical units.
    fn value(&self, entry: &EntryRef) -> Option<Ratio>;
    /// Raw value of an entry.
    fn raw(&self, entry: &EntryRef) -> Option<i128>;
}

/// Whether a condition holds.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Outcome {
    /// It holds.
    Holds,
    /// This link of a chain does not hold: left term, value, operator, right term, value.
    Fails {
        /// Left side as written, and its value.
        left: (String, Ratio),
        /// The operator between them.
        op: CompareOp,
        /// Right side as written, and its value.
        right: (String, Ratio),
    },
    /// A value is missing, a divisor is zero, or a number is too large.
    Unknown,
}

impl Expr {
    /// A condition whose names are not looked up yet.
    pub(crate) fn unresolved(text: &str) -> Self {
        Self { text: text.to_owned(), alternatives: Vec::new(), places: Vec::new() }
    }

    /// Whether names have to be looked up in it.
    pub(crate) const fn is_unresolved(&self) -> bool {
        self.alternatives.is_empty()
    }

    /// A write condition as it reads where the device has no key, such as in an EDS: all its entries are of one device.
    pub fn text_without_device(&self, key: &str) -> String {
        self.text.replace(&format!("{key}:0x"), "0x")
    }

    /// All comparisons, in order.
    pub fn comparisons(&self) -> impl Iterator<Item = &Comparison> {
        self.alternatives.iter().flatten()
    }

    /// All entries that the condition names.
    pub fn entries(&self) -> Vec<&EntryRef> {
        self.operands().into_iter().map(|(entry, _)| entry).collect()
    }

    /// All entries that the condition names, with the bit that it asks for.
    pub fn operands(&self) -> Vec<(&EntryRef, Option<u8>)> {
        let mut operands = Vec::new();
        for comparison in self.comparisons() {
            comparison.first.operands(&mut operands);
            for (_, term) in &comparison.rest {
                term.operands(&mut operands);
            }
        }
        operands
    }

    /// The first part of the condition that cannot be worked out with these values; none that only lacks a value.
    pub fn incomputable(&self, values: &dyn Values) -> Option<Incomputable<'_>> {
        self.comparisons().find_map(|comparison| {
            let terms = [&comparison.first].into_iter().chain(comparison.rest.iter().map(|(_, term)| term));
            let computed: Vec<(&Term, Result<Ratio, NoValue<'_>>)> =
                terms.map(|term| (term, term.compute(values))).collect();
            let of_terms = computed.iter().find_map(|(_, computed)| match computed {
                Err(NoValue::Incomputable(incomputable)) => Some(*incomputable),
                Ok(_) | Err(NoValue::Missing) => None,
            });
            let compared = || {
                computed.windows(2).find_map(|pair| match pair {
                    [(term, Ok(left)), (_, Ok(right))] if left.compare(*right).is_none() => {
                        Some(Incomputable::TooLarge(term))
                    }
                    _ => None,
                })
            };
            of_terms.or_else(compared)
        })
    }

    /// Whether the condition holds for these values. Of alternatives that all fail, the first is reported.
    pub fn evaluate(&self, values: &dyn Values) -> Outcome {
        let mut outcomes = self.alternatives.iter().map(|comparisons| all_hold(comparisons, values));
        let mut outcome = outcomes.next().unwrap_or(Outcome::Holds);
        for other in outcomes {
            outcome = match (outcome, other) {
                (Outcome::Holds, _) | (_, Outcome::Holds) => Outcome::Holds,
                (Outcome::Unknown, _) | (_, Outcome::Unknown) => Outcome::Unknown,
                (first @ Outcome::Fails { .. }, Outcome::Fails { .. }) => first,
            };
        }
        outcome
    }
}

/// Why a condition cannot be worked out although all its values are known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Incomputable<'t> {
    /// This divisor is 0.
    DivisorIsZero(&'t Term),
    /// The numbers of this term, or of its comparison with the next one, need more than fractions of 128 bits.
    TooLarge(&'t Term),
}

/// Why a term has no value.
#[derive(Debug, Clone, Copy)]
enum NoValue<'t> {
    /// An entry of it has none.
    Missing,
    /// All its entries have one.
    Incomputable(Incomputable<'t>),
}

/// Whether comparisons all hold. A failing link is reported also where an earlier link is unknown.
fn all_hold(comparisons: &[Comparison], values: &dyn Values) -> Outcome {
    let mut outcome = Outcome::Holds;
    for comparison in comparisons {
        let mut left = &comparison.first;
        for (op, right) in &comparison.rest {
            match (left.evaluate(values), right.evaluate(values)) {
                (Some(a), Some(b)) => match a.compare(b) {
                    Some(order) if op.accepts(order) => {}
                    Some(_) => {
                        return Outcome::Fails {
                            left: (left.to_string(), a),
                            op: *op,
                            right: (right.to_string(), b),
                        };
                    }
                    None => outcome = Outcome::Unknown,
                },
                _ => outcome = Outcome::Unknown,
            }
            left = right;
        }
    }
    outcome
}

impl Term {
    fn operands<'a>(&'a self, operands: &mut Vec<(&'a EntryRef, Option<u8>)>) {
        match self {
            Term::Number(_) => {}
            Term::Entry(entry) => operands.push((entry, None)),
            Term::Bit(entry, bit) => operands.push((entry, Some(*bit))),
            Term::Binary(left, _, right) => {
                left.operands(operands);
                right.operands(operands);
            }
        }
    }

    /// Whether an entry is in the term.
    pub fn names_entry(&self) -> bool {
        let mut operands = Vec::new();
        self.operands(&mut operands);
        !operands.is_empty()
    }

    /// Value of the term; `None` when something is missing or cannot be worked out.
    pub fn evaluate(&self, values: &dyn Values) -> Option<Ratio> {
        self.compute(values).ok()
    }

    /// Value of the term. What cannot be worked out counts before what is missing.
    fn compute(&self, values: &dyn Values) -> Result<Ratio, NoValue<'_>> {
        match self {
            Term::Number(number) => Ok(*number),
            Term::Entry(entry) => values.value(entry).ok_or(NoValue::Missing),
            Term::Bit(entry, bit) => {
                let raw = values.raw(entry).and_then(|raw| raw.checked_shr(u32::from(*bit)));
                raw.map(|raw| Ratio::whole(raw & 1)).ok_or(NoValue::Missing)
            }
            Term::Binary(left, op, right) => {
                let computed = match (left.compute(values), right.compute(values)) {
                    (Ok(left), Ok(right)) => (left, right),
                    (Ok(_) | Err(NoValue::Missing), Err(no_value)) | (Err(no_value), _) => {
                        return Err(no_value);
                    }
                };
                let value = match op {
                    ArithmeticOp::Add => computed.0.checked_add(computed.1),
                    ArithmeticOp::Subtract => computed.0.checked_sub(computed.1),
                    ArithmeticOp::Multiply => computed.0.checked_mul(computed.1),
                    ArithmeticOp::Divide => computed.0.checked_div(computed.1),
                };
                let is_zero = *op == ArithmeticOp::Divide && computed.1 == Ratio::whole(0);
                value.ok_or(NoValue::Incomputable(if is_zero {
                    Incomputable::DivisorIsZero(right)
                } else {
                    Incomputable::TooLarge(self)
                }))
            }
        }
    }
}

impl fmt::Display for EntryRef {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(device) = &self.device {
            write!(f, "{device}:")?;
        }
        self.id.fmt(f)
    }
}

impl fmt::Display for Term {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Term::Number(number) => number.fmt(f),
            Term::Entry(entry) => entry.fmt(f),
            Term::Bit(entry, bit) => write!(f, "bit({entry}, {bit})"),
            Term::Binary(left, op, right) => write!(f, "({left} {} {right})", op.sign()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Generated code negates the conditions of cases with this, at equal sides, too.
    #[test]
    fn an_opposite_operator_accepts_exactly_the_rest() {
        for op in [
            CompareOp::Less,
            CompareOp::LessOrEqual,
            CompareOp::Equal,
            CompareOp::NotEqual,
            CompareOp::GreaterOrEqual,
            CompareOp::Greater,
        ] {
            for order in [Ordering::Less, Ordering::Equal, Ordering::Greater] {
                assert_ne!(op.accepts(order), op.opposite().accepts(order), "{op:?} {order:?}");
            }
        }
    }
}
