//! Conditions between entries, evaluated as the printed code would: over raw numbers, by row.

use firmware_glue::DataType;
use firmware_glue::table::Row;
use od_gen::plan::{self, Plan};
use od_spec::expr::{ArithmeticOp, CompareOp};

/// A condition: of one alternative, all comparisons hold.
#[derive(Debug, Clone)]
pub(super) struct Condition {
    alternatives: Vec<Vec<Compare>>,
}

/// A comparison of two sums; where a divisor is 0 it is undecided, which counts as allowed for the client that asks.
#[derive(Debug, Clone)]
struct Compare {
    left: Sum,
    op: CompareOp,
    right: Sum,
    divisors: Vec<Sum>,
}

/// A sum over rows.
#[derive(Debug, Clone)]
enum Sum {
    Number(i128),
    Row(Row),
    Bit(Row, u8),
    Binary(Box<Sum>, ArithmeticOp, Box<Sum>),
}

/// The number in a row.
type Numbers<'n> = &'n dyn Fn(Row) -> i128;

/// Whether a comparison holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Verdict {
    Holds,
    Fails,
    /// A divisor is 0.
    Undecided,
}

impl Condition {
    pub(super) fn of(plan: &Plan<'_>, condition: &plan::Condition) -> Self {
        let all =
            |comparisons: &Vec<plan::Compare>| comparisons.iter().map(|one| compare(plan, one)).collect();
        Self { alternatives: condition.alternatives.iter().map(all).collect() }
    }

    /// Whether it holds, or is undecided.
    pub(super) fn holds(&self, numbers: Numbers<'_>) -> bool {
        let mut alternatives = self.alternatives.iter();
        alternatives.any(|all| all.iter().all(|one| one.verdict(numbers) != Verdict::Fails))
    }

    /// Whether it does not hold, or is undecided.
    pub(super) fn is_not_met(&self, numbers: Numbers<'_>) -> bool {
        let mut alternatives = self.alternatives.iter();
        alternatives.all(|all| all.iter().any(|one| one.verdict(numbers) != Verdict::Holds))
    }
}

impl Compare {
    fn verdict(&self, numbers: Numbers<'_>) -> Verdict {
        if self.divisors.iter().any(|divisor| divisor.value(numbers) == 0) {
            Verdict::Undecided
        } else if self.op.accepts(self.left.value(numbers).cmp(&self.right.value(numbers))) {
            Verdict::Holds
        } else {
            Verdict::Fails
        }
    }
}

impl Sum {
    /// Its value. The plan has made sure that no sum leaves 128 bits.
    fn value(&self, numbers: Numbers<'_>) -> i128 {
        match self {
            Sum::Number(number) => *number,
            Sum::Row(row) => numbers(*row),
            Sum::Bit(row, bit) => numbers(*row) >> bit & 1,
            Sum::Binary(left, op, right) => {
                let (left, right) = (left.value(numbers), right.value(numbers));
                match op {
                    ArithmeticOp::Add => left.saturating_add(right),
                    ArithmeticOp::Subtract => left.saturating_sub(right),
                    ArithmeticOp::Multiply => left.saturating_mul(right),
                    // Quotients have become products before.
                    ArithmeticOp::Divide => left.checked_div(right).unwrap_or_default(),
                }
            }
        }
    }
}

fn compare(plan: &Plan<'_>, compare: &plan::Compare) -> Compare {
    Compare {
        left: sum(plan, &compare.left),
        op: compare.op,
        right: sum(plan, &compare.right),
        divisors: compare.divisors.iter().map(|divisor| sum(plan, divisor)).collect(),
    }
}

/// A sum over rows; the plan names no entry that has none.
fn sum(plan: &Plan<'_>, of: &plan::Sum) -> Sum {
    match of {
        plan::Sum::Number(number) => Sum::Number(*number),
        plan::Sum::Entry(id) => plan.row(*id).map_or(Sum::Number(0), Sum::Row),
        plan::Sum::Bit(id, bit) => plan.row(*id).map_or(Sum::Number(0), |row| Sum::Bit(row, *bit)),
        plan::Sum::Binary(left, op, right) => {
            Sum::Binary(Box::new(sum(plan, left)), *op, Box::new(sum(plan, right)))
        }
    }
}

/// The number that bytes of a type are; 0 of a type that has no numbers to compare.
pub(super) fn number(data_type: DataType, bytes: &[u8]) -> i128 {
    if !data_type.is_integer() && data_type != DataType::Boolean {
        return 0;
    }
    let negative = data_type.is_signed() && bytes.last().is_some_and(|last| last & 0x80 != 0);
    let mut wide = [if negative { 0xFF } else { 0 }; 16];
    wide.iter_mut().zip(bytes).for_each(|(wide, byte)| *wide = *byte);
    i128::from_le_bytes(wide)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_their_sign_and_their_highest_bit() {
        assert_eq!(number(DataType::Integer24, &[0xFE, 0xFF, 0xFF]), -2);
        assert_eq!(number(DataType::Unsigned64, &[0xFF; 8]), i128::from(u64::MAX));
        assert_eq!(number(DataType::Real32, &1f32.to_le_bytes()), 0);
    }

    #[test]
    fn a_divisor_of_0_leaves_undecided() {
        let undecided = Condition {
            alternatives: vec![vec![Compare {
                left: Sum::Number(1),
                op: CompareOp::Less,
                right: Sum::Number(0),
                divisors: vec![Sum::Row(7)],
            }]],
        };
        assert!(undecided.holds(&|_| 0) && undecided.is_not_met(&|_| 0));
        assert!(!undecided.holds(&|_| 1) && undecided.is_not_met(&|_| 1));
    }
}
