//! Conditions between entries as expressions of C99, which has no integer of 128 bits: those that need one are computed by functions of the plain
//! dictionary's runtime.

use od_gen::plan::{Compare, Condition, Plan, PlannedConstraint, Sum};
use od_spec::expr::{ArithmeticOp, CompareOp};
use od_spec::model::{DataType, EntryId};

use super::literal::Integer;

const NUMBER: Integer = Integer { signed: true, bits: 64 };

/// How an expression gets at the values of entries.
pub(super) trait Entries {
    /// The number of an entry that is no UNSIGNED64, as an `int64_t`.
    fn number(&self, id: EntryId) -> String;

    /// The number of an UNSIGNED64, as a `uint64_t`.
    fn count(&self, id: EntryId) -> String;
}

/// A condition as an expression. A divisor of 0 leaves it undecided; a condition that is undecided counts as met.
pub(super) fn holds(plan: &Plan<'_>, entries: &dyn Entries, condition: &Condition) -> String {
    let sides = Sides { plan, entries, narrow: condition.narrow };
    let all = |comparisons: &Vec<Compare>| {
        let links = comparisons.iter().map(|compare| sides.link(compare, compare.op));
        links.collect::<Vec<_>>().join(" && ")
    };
    alternatives(condition.alternatives.iter().map(all), "||")
}

/// That a condition does not hold, or is undecided.
fn is_not_met(plan: &Plan<'_>, entries: &dyn Entries, condition: &Condition) -> String {
    let sides = Sides { plan, entries, narrow: condition.narrow };
    let one_fails = |comparisons: &Vec<Compare>| {
        let links = comparisons.iter().map(|compare| sides.link(compare, compare.op.opposite()));
        links.collect::<Vec<_>>().join(" || ")
    };
    alternatives(condition.alternatives.iter().map(one_fails), "&&")
}

/// A constraint as an expression.
pub(super) fn constraint(plan: &Plan<'_>, entries: &dyn Entries, planned: &PlannedConstraint<'_>) -> String {
    let require = holds(plan, entries, &planned.require);
    match &planned.when {
        Some(when) => format!("({}) || ({require})", is_not_met(plan, entries, when)),
        None => require,
    }
}

fn alternatives(parts: impl Iterator<Item = String>, between: &str) -> String {
    let parts: Vec<String> = parts.collect();
    match parts.as_slice() {
        [only] => only.clone(),
        parts => {
            let parts: Vec<String> = parts.iter().map(|part| format!("({part})")).collect();
            parts.join(&format!(" {between} "))
        }
    }
}

/// How the sides of a comparison are computed.
struct Sides<'p, 'a> {
    plan: &'p Plan<'a>,
    entries: &'p dyn Entries,
    /// Whether 64 bits are enough.
    narrow: bool,
}

impl Sides<'_, '_> {
    /// A comparison, which is met where a divisor is 0.
    fn link(&self, compare: &Compare, op: CompareOp) -> String {
        let link = self.compared(&compare.left, op, &compare.right);
        if compare.divisors.is_empty() {
            return link;
        }
        let is_zero = |divisor| self.compared(divisor, CompareOp::Equal, &Sum::Number(0));
        let zeros: Vec<String> = compare.divisors.iter().map(is_zero).collect();
        format!("({} || {link})", zeros.join(" || "))
    }

    fn compared(&self, left: &Sum, op: CompareOp, right: &Sum) -> String {
        let op = match op {
            CompareOp::Less => "<",
            CompareOp::LessOrEqual => "<=",
            CompareOp::Equal => "==",
            CompareOp::NotEqual => "!=",
            CompareOp::GreaterOrEqual => ">=",
            CompareOp::Greater => ">",
        };
        let (left, right) = (self.sum(left), self.sum(right));
        if self.narrow {
            format!("({left} {op} {right})")
        } else {
            format!("(od_wide_compare({left}, {right}) {op} 0)")
        }
    }

    fn sum(&self, sum: &Sum) -> String {
        match sum {
            Sum::Number(number) if self.narrow => NUMBER.literal(*number),
            Sum::Number(number) => wide(*number),
            Sum::Entry(id) if self.narrow => self.entries.number(*id),
            Sum::Entry(id) if self.is_widest(*id) => format!("od_wide(0U, {})", self.entries.count(*id)),
            Sum::Entry(id) => format!("od_wide_of({})", self.entries.number(*id)),
            Sum::Bit(id, bit) => {
                let bits = if self.is_widest(*id) {
                    self.entries.count(*id)
                } else {
                    format!("(uint64_t){}", self.entries.number(*id))
                };
                let level = format!("((({bits}) >> {bit}U) & 1U)");
                if self.narrow { format!("(int64_t){level}") } else { format!("od_wide(0U, {level})") }
            }
            Sum::Binary(left, op, right) => {
                let (left, right) = (self.sum(left), self.sum(right));
                let (narrow, wide) = match op {
                    ArithmeticOp::Add => ("+", "add"),
                    ArithmeticOp::Subtract => ("-", "subtract"),
                    ArithmeticOp::Multiply => ("*", "multiply"),
                    // Quotients have become products before; the runtime divides nothing, so that one would not compile.
                    ArithmeticOp::Divide => return format!("od_wide_divide({left}, {right})"),
                };
                if self.narrow {
                    format!("({left} {narrow} {right})")
                } else {
                    format!("od_wide_{wide}({left}, {right})")
                }
            }
        }
    }

    fn is_widest(&self, id: EntryId) -> bool {
        self.plan.device.entry(id).is_some_and(|entry| entry.data_type == DataType::Unsigned64)
    }
}

/// A number of 128 bits.
fn wide(number: i128) -> String {
    let bits = number.cast_unsigned();
    format!("od_wide(0x{:016X}ULL, 0x{:016X}ULL)", bits >> 64, bits & u128::from(u64::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wide_numbers_are_in_twos_complement() {
        assert_eq!(wide(1), "od_wide(0x0000000000000000ULL, 0x0000000000000001ULL)");
        assert_eq!(wide(-2), "od_wide(0xFFFFFFFFFFFFFFFFULL, 0xFFFFFFFFFFFFFFFEULL)");
        assert_eq!(wide(1 << 64), "od_wide(0x0000000000000001ULL, 0x0000000000000000ULL)");
    }
}
