//! Conditions between entries as integer comparisons.
//!
//! A condition is about physical values, raw × scale. Scales are exact fractions, so every comparison can be multiplied out
//! until both sides are integers; how large they can become is known from the types, which decides the width to compute in.

use od_spec::expr::{ArithmeticOp, CompareOp, Comparison, EntryRef, Expr, Term};
use od_spec::model::{Dictionary, EntryId, Ratio};

/// A condition: all comparisons hold.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Condition {
    pub text: String,
    pub comparisons: Vec<Compare>,
    /// Whether 64 bits are enough.
    pub narrow: bool,
}

/// `left op right`, both multiplied out; a side whose divisor is 0 counts as met.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Compare {
    pub left: Sum,
    pub op: CompareOp,
    pub right: Sum,
    /// Divisors that must not be 0.
    pub divisors: Vec<Sum>,
}

/// An integer expression.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Sum {
    Number(i128),
    Entry(EntryId),
    Bit(EntryId, u8),
    Binary(Box<Sum>, ArithmeticOp, Box<Sum>),
}

impl Sum {
    /// Whether the value cannot be negative.
    fn is_positive(&self, device: &Dictionary) -> bool {
        match self {
            Sum::Number(number) => *number >= 0,
            Sum::Bit(..) => true,
            Sum::Entry(id) => device.entry(*id).is_some_and(|entry| !entry.data_type.is_signed()),
            Sum::Binary(left, ArithmeticOp::Add | ArithmeticOp::Multiply, right) => {
                left.is_positive(device) && right.is_positive(device)
            }
            Sum::Binary(..) => false,
        }
    }
}

/// Why a condition is not code.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Unusable {
    /// It names entries of other devices only.
    Elsewhere,
    /// Its numbers can leave 128 bits.
    TooLarge,
}

/// A term as numerator / divisor × scale, with bounds of the two integers.
struct Fraction {
    numerator: Sum,
    bound: i128,
    divisor: Option<(Sum, i128)>,
    scale: Ratio,
}

/// Turns a condition into comparisons of a device's own entries; links that name entries of other devices are left out.
pub(super) fn plan(condition: &Expr, device: &Dictionary) -> Result<Condition, Unusable> {
    let own = |term: &Term| own_entries_only(term, device);
    let (mut comparisons, mut narrow) = (Vec::new(), true);
    for Comparison { first, rest } in &condition.comparisons {
        let mut left = first;
        for (op, right) in rest {
            if own(left) && own(right) {
                let (compare, fits) = link(left, *op, right, device).ok_or(Unusable::TooLarge)?;
                narrow &= fits;
                comparisons.push(compare);
            }
            left = right;
        }
    }
    if comparisons.is_empty() {
        return Err(Unusable::Elsewhere);
    }
    Ok(Condition { text: condition.text.clone(), comparisons, narrow })
}

fn own_entries_only(term: &Term, device: &Dictionary) -> bool {
    let here = |entry: &EntryRef| {
        entry.device.as_ref().is_none_or(|key| *key == device.key) && device.entry(entry.id).is_some()
    };
    match term {
        Term::Number(_) => true,
        Term::Entry(entry) | Term::Bit(entry, _) => here(entry),
        Term::Binary(left, _, right) => own_entries_only(left, device) && own_entries_only(right, device),
    }
}

/// One comparison, and whether 64 bits are enough for it.
fn link(left: &Term, op: CompareOp, right: &Term, device: &Dictionary) -> Option<(Compare, bool)> {
    let (left, right) = (fraction(left, device)?, fraction(right, device)?);
    // value = numerator / divisor × p / q
    let factors = left.scale.checked_div(right.scale)?;
    let mut one = scaled(left.numerator, left.bound, factors.numerator())?;
    let mut other = scaled(right.numerator, right.bound, factors.denominator())?;
    let mut divisors = Vec::new();
    for (divisor, on_left) in [(left.divisor, true), (right.divisor, false)] {
        let Some((divisor, bound)) = divisor else { continue };
        // A side's divisor goes to the other side. One that may be negative would turn the comparison round, so both sides
        // take it once more: its square is positive.
        let powers = if divisor.is_positive(device) { (0, 1) } else { (1, 2) };
        let (on_one, on_other) = if on_left { powers } else { (powers.1, powers.0) };
        let times = |side: (Sum, i128), power: u32| -> Option<(Sum, i128)> {
            (0..power).try_fold(side, |(sum, most), _| {
                Some((binary(sum, ArithmeticOp::Multiply, divisor.clone()), most.checked_mul(bound)?))
            })
        };
        one = times(one, on_one)?;
        other = times(other, on_other)?;
        divisors.push(divisor);
    }
    let narrow = one.1.max(other.1) <= i128::from(i64::MAX);
    Some((Compare { left: one.0, op, right: other.0, divisors }, narrow))
}

fn scaled(sum: Sum, bound: i128, factor: i128) -> Option<(Sum, i128)> {
    let product = if factor == 1 { sum } else { binary(sum, ArithmeticOp::Multiply, Sum::Number(factor)) };
    Some((product, bound.checked_mul(factor.checked_abs()?)?))
}

fn binary(left: Sum, op: ArithmeticOp, right: Sum) -> Sum {
    match (&left, op, &right) {
        (Sum::Number(1), ArithmeticOp::Multiply, _) => right,
        (_, ArithmeticOp::Multiply, Sum::Number(1)) => left,
        (Sum::Number(a), ArithmeticOp::Multiply, Sum::Number(b)) if a.checked_mul(*b).is_some() => {
            Sum::Number(a * b)
        }
        _ => Sum::Binary(Box::new(left), op, Box::new(right)),
    }
}

fn fraction(term: &Term, device: &Dictionary) -> Option<Fraction> {
    let whole = |numerator, bound, scale| Some(Fraction { numerator, bound, divisor: None, scale });
    match term {
        // Zero has no direction in which a scale could be divided.
        Term::Number(number) if number.numerator() == 0 => whole(Sum::Number(0), 1, Ratio::ONE),
        Term::Number(number) => {
            let size = Ratio::new(number.numerator().checked_abs()?, number.denominator())?;
            whole(Sum::Number(number.numerator().signum()), 1, size)
        }
        Term::Bit(entry, bit) => whole(Sum::Bit(entry.id, *bit), 1, Ratio::ONE),
        Term::Entry(reference) => {
            let entry = device.entry(reference.id)?;
            let (low, high) = entry.data_type.range()?;
            let scale = entry.unit.as_ref().map_or(Some(Ratio::ONE), |unit| unit.step())?;
            whole(Sum::Entry(reference.id), low.checked_abs()?.max(high), scale)
        }
        Term::Binary(left, op, right) => {
            let (left, right) = (fraction(left, device)?, fraction(right, device)?);
            match op {
                ArithmeticOp::Multiply => product(left, right),
                ArithmeticOp::Divide => product(left, inverse(right)?),
                ArithmeticOp::Add | ArithmeticOp::Subtract => sum(left, *op, right),
            }
        }
    }
}

fn inverse(of: Fraction) -> Option<Fraction> {
    let scale = Ratio::ONE.checked_div(of.scale)?;
    let (numerator, bound) = of.divisor.unwrap_or((Sum::Number(1), 1));
    let divisor = match of.numerator {
        Sum::Number(1) => None,
        sum => Some((sum, of.bound)),
    };
    Some(Fraction { numerator, bound, divisor, scale })
}

fn product(left: Fraction, right: Fraction) -> Option<Fraction> {
    let divisor = match (left.divisor, right.divisor) {
        (Some((a, m)), Some((b, n))) => Some((binary(a, ArithmeticOp::Multiply, b), m.checked_mul(n)?)),
        (a, b) => a.or(b),
    };
    Some(Fraction {
        numerator: binary(left.numerator, ArithmeticOp::Multiply, right.numerator),
        bound: left.bound.checked_mul(right.bound)?,
        divisor,
        scale: left.scale.checked_mul(right.scale)?,
    })
}

fn sum(left: Fraction, op: ArithmeticOp, right: Fraction) -> Option<Fraction> {
    let factors = left.scale.checked_div(right.scale)?;
    let scale = right.scale.checked_mul(Ratio::new(1, factors.denominator())?)?;
    let (mut one, mut bound_one) = scaled(left.numerator, left.bound, factors.numerator())?;
    let (mut other, mut bound_other) = scaled(right.numerator, right.bound, factors.denominator())?;
    if let Some((divisor, bound)) = &right.divisor {
        (one, bound_one) =
            (binary(one, ArithmeticOp::Multiply, divisor.clone()), bound_one.checked_mul(*bound)?);
    }
    if let Some((divisor, bound)) = &left.divisor {
        (other, bound_other) =
            (binary(other, ArithmeticOp::Multiply, divisor.clone()), bound_other.checked_mul(*bound)?);
    }
    let divisor = match (left.divisor, right.divisor) {
        (Some((a, m)), Some((b, n))) => Some((binary(a, ArithmeticOp::Multiply, b), m.checked_mul(n)?)),
        (a, b) => a.or(b),
    };
    Some(Fraction {
        numerator: binary(one, op, other),
        bound: bound_one.checked_add(bound_other)?,
        divisor,
        scale,
    })
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use od_spec::expr::{Outcome, Values};
    use od_spec::model::{Index, SubIndex, System};
    use od_spec::source::SourceMap;
    use od_spec::{NoFiles, compile};
    use proptest::prelude::*;

    use super::*;

    const SPECIFICATION: &str = "
od-spec: 1
title: Random
uses: [cia301]
devices: {d: {name: D, bit-rates: [125]}}
units:
  millivolt: {symbol: mV, base: 1/1000 V}
  third: {symbol: V, scale: 1/3}
  volt: {symbol: V}
objects:
  0x2000: {name: a, type: unsigned16, unit: millivolt, access: rw}
  0x2001: {name: b, type: integer16, unit: volt, access: rw}
  0x2002: {name: c, type: integer32, unit: third, access: rw}
  0x2003: {name: d, type: integer8, access: rw}
";

    const CONDITIONS: [&str; 12] = [
        "0x2000 < 0x2001",
        "0x2000 <= 0x2001 < 0x2002",
        "0x2001 == 0x2002 and 0x2000 >= 0",
        "0x2000 + 0x2001 > 0x2002 - 0.5",
        "0x2001 * 0x2003 != 0x2002",
        "0x2000 / 0x2003 < 0x2001",
        "0x2001 > 0x2000 / 0x2003 - 1",
        "0x2000 / 0x2003 <= 0x2001 / 0x2003",
        "bit(0x2003, 1) == 1",
        "-0x2001 < 2.5 and 0x2003 / 3 >= -10",
        "(0x2000 + 1) * (0x2001 - 2) / 4 > 0x2002",
        "0x2001 / (0x2003 + 1) > 0",
    ];

    struct Raw<'a> {
        system: &'a System,
        values: BTreeMap<u16, i128>,
    }

    impl Values for Raw<'_> {
        fn value(&self, entry: &EntryRef) -> Option<Ratio> {
            let unit = self.system.devices[0].entry(entry.id)?.unit.as_ref();
            Ratio::whole(self.raw(entry)?).checked_mul(unit.map_or(Some(Ratio::ONE), |unit| unit.step())?)
        }
        fn raw(&self, entry: &EntryRef) -> Option<i128> {
            self.values.get(&entry.id.index.0).copied()
        }
    }

    fn number(sum: &Sum, values: &BTreeMap<u16, i128>, most: &mut i128) -> i128 {
        let value = match sum {
            Sum::Number(number) => *number,
            Sum::Entry(id) => values[&id.index.0],
            Sum::Bit(id, bit) => values[&id.index.0] >> bit & 1,
            Sum::Binary(left, op, right) => {
                let (left, right) = (number(left, values, most), number(right, values, most));
                match op {
                    ArithmeticOp::Add => left + right,
                    ArithmeticOp::Subtract => left - right,
                    ArithmeticOp::Multiply => left * right,
                    ArithmeticOp::Divide => panic!("quotients are multiplied out"),
                }
            }
        };
        *most = (*most).max(value.abs());
        value
    }

    proptest! {
        #[test]
        fn code_decides_as_the_specification_does(
            a in prop_oneof![Just(0), Just(65_535), 0..=65_535i128, 0..20i128],
            b in prop_oneof![Just(-32_768), Just(32_767), -32_768..=32_767i128, -20..20i128],
            c in prop_oneof![Just(-2_147_483_648i128), Just(2_147_483_647), -100..100i128],
            d in prop_oneof![Just(-128), Just(127), -5..5i128],
        ) {
            let mut sources = SourceMap::new();
            let root = sources.add("random.od.yaml", SPECIFICATION);
            let system = compile(&mut sources, root, &mut NoFiles).system.unwrap();
            let values = BTreeMap::from([(0x2000, a), (0x2001, b), (0x2002, c), (0x2003, d)]);
            for text in CONDITIONS {
                let expr = Expr::parse(text).unwrap();
                let planned = plan(&expr, &system.devices[0]).unwrap();
                let mut most = 0;
                let holds = planned.comparisons.iter().all(|compare| {
                    let mut value = |sum: &Sum| number(sum, &values, &mut most);
                    let (left, right) = (value(&compare.left), value(&compare.right));
                    compare.divisors.iter().any(|divisor| value(divisor) == 0) || compare.op.accepts(left.cmp(&right))
                });
                let expected = expr.evaluate(&Raw { system: &system, values: values.clone() });
                prop_assert_eq!(holds, !matches!(expected, Outcome::Fails { .. }), "{} with {:?}", text, values);
                prop_assert!(!planned.narrow || most <= i128::from(i64::MAX), "{}: {}", text, most);
            }
        }
    }

    #[test]
    fn what_others_have_or_what_is_too_large_is_told() {
        let mut sources = SourceMap::new();
        let root = sources.add("random.od.yaml", SPECIFICATION);
        let system = compile(&mut sources, root, &mut NoFiles).system.unwrap();
        let planned = |text: &str| plan(&Expr::parse(text).unwrap(), &system.devices[0]);
        assert_eq!(planned("other:0x2000 < 0x2001"), Err(Unusable::Elsewhere));
        assert_eq!(planned("other:0x2000 < 0x2001 < 0x2002").unwrap().comparisons.len(), 1);
        let product = ["0x2002"; 5].join(" * ");
        assert_eq!(planned(&format!("{product} > 0")), Err(Unusable::TooLarge));
        // Reached only by the fifth power; the entry's own index counts.
        let id = EntryId { index: Index(0x2003), sub: SubIndex(0) };
        assert_eq!(planned("0x2003 > 0").unwrap().comparisons[0].left, Sum::Entry(id));
    }
}
