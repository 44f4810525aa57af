//! Conditions between entries as integer comparisons.
//!
//! A condition is about physical values, raw × scale + offset. Scales are exact fractions, so every comparison can be multiplied out
//! until both sides are integers; how large they can become is known from the types, which decides the width to compute in.

use od_spec::expr::{ArithmeticOp, CompareOp, Comparison, EntryRef, Expr, Term};
use od_spec::model::{Dictionary, EntryId, Ratio};

/// A condition: of one alternative, all comparisons hold.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Condition {
    /// The condition as the specification has it.
    pub text: String,
    /// It holds if all comparisons of one of these hold.
    pub alternatives: Vec<Vec<Compare>>,
    /// Whether 64 bits are enough.
    pub narrow: bool,
}

/// `left op right`, both multiplied out; a side whose divisor is 0 counts as met.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Compare {
    /// The left side.
    pub left: Sum,
    /// How the sides are compared.
    pub op: CompareOp,
    /// The right side.
    pub right: Sum,
    /// Divisors that must not be 0.
    pub divisors: Vec<Sum>,
}

/// An integer expression.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Sum {
    /// A number.
    Number(i128),
    /// The raw value of an entry.
    Entry(EntryId),
    /// A bit of an entry.
    Bit(EntryId, u8),
    /// Two expressions and what is done with them.
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

/// An integer expression and the largest size its value can have.
#[derive(Clone)]
struct Bounded {
    sum: Sum,
    bound: i128,
}

/// A term as numerator / divisor × scale.
struct Fraction {
    numerator: Bounded,
    /// 1 where nothing is divided.
    divisor: Bounded,
    scale: Ratio,
}

/// Turns a condition into comparisons of a device's own entries; links that name entries of other devices are left out, and count
/// as met.
pub(super) fn plan(condition: &Expr, device: &Dictionary) -> Result<Condition, Unusable> {
    let is_local = |term: &Term| own_entries_only(term, device);
    let (mut alternatives, mut narrow) = (Vec::new(), true);
    for comparisons in &condition.alternatives {
        let mut planned = Vec::new();
        for Comparison { first, rest } in comparisons {
            let mut left = first;
            for (op, right) in rest {
                if is_local(left) && is_local(right) {
                    let linked = link(left, *op, right, device).ok_or(Unusable::TooLarge)?;
                    narrow &= linked.bound <= i128::from(i64::MAX);
                    planned.push(linked.compare);
                }
                left = right;
            }
        }
        alternatives.push(planned);
    }
    // What counts as met leaves nothing to be asked.
    if alternatives.iter().any(Vec::is_empty) {
        return Err(Unusable::Elsewhere);
    }
    Ok(Condition { text: condition.text.clone(), alternatives, narrow })
}

fn own_entries_only(term: &Term, device: &Dictionary) -> bool {
    let is_of_device = |entry: &EntryRef| {
        entry.device.as_ref().is_none_or(|key| *key == device.key) && device.entry(entry.id).is_some()
    };
    match term {
        Term::Number(_) => true,
        Term::Entry(entry) | Term::Bit(entry, _) => is_of_device(entry),
        Term::Binary(left, _, right) => own_entries_only(left, device) && own_entries_only(right, device),
    }
}

/// A comparison and the largest size its sides can have.
struct Link {
    compare: Compare,
    bound: i128,
}

fn link(left: &Term, op: CompareOp, right: &Term, device: &Dictionary) -> Option<Link> {
    let (left, right) = (fraction(left, device)?, fraction(right, device)?);
    // value = numerator / divisor × p / q
    let factors = left.scale.checked_div(right.scale)?;
    let left_side = left.numerator.scaled(factors.numerator())?;
    let right_side = right.numerator.scaled(factors.denominator())?;
    let (left_side, right_side) = cleared(&left.divisor, left_side, right_side, device)?;
    let (right_side, left_side) = cleared(&right.divisor, right_side, left_side, device)?;
    let bound = left_side.bound.max(right_side.bound);
    let divisors = [left.divisor.sum, right.divisor.sum];
    let divisors = divisors.into_iter().filter(|divisor| *divisor != Sum::Number(1)).collect();
    Some(Link { compare: Compare { left: left_side.sum, op, right: right_side.sum, divisors }, bound })
}

/// The two sides without the divisor of one of them, which goes to the opposite side. One that may be negative would turn
/// the comparison round, so both sides take it once more: its square is positive.
fn cleared(
    divisor: &Bounded,
    divided: Bounded,
    opposite: Bounded,
    device: &Dictionary,
) -> Option<(Bounded, Bounded)> {
    let opposite = opposite.times(divisor)?;
    if divisor.sum.is_positive(device) {
        return Some((divided, opposite));
    }
    Some((divided.times(divisor)?, opposite.times(divisor)?))
}

impl Bounded {
    /// Of a size of one at most.
    const fn unit(sum: Sum) -> Self {
        Self { sum, bound: 1 }
    }

    /// The product; `None` where it can leave 128 bits.
    fn times(self, factor: &Self) -> Option<Self> {
        let bound = self.bound.checked_mul(factor.bound)?;
        Some(Self { sum: binary(self.sum, ArithmeticOp::Multiply, factor.sum.clone()), bound })
    }

    /// The product with a number; `None` where it can leave 128 bits.
    fn scaled(self, factor: i128) -> Option<Self> {
        let bound = self.bound.checked_mul(factor.checked_abs()?)?;
        if factor == 1 {
            return Some(Self { bound, ..self });
        }
        Some(Self { sum: binary(self.sum, ArithmeticOp::Multiply, Sum::Number(factor)), bound })
    }
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
    let whole =
        |numerator, scale| Some(Fraction { numerator, divisor: Bounded::unit(Sum::Number(1)), scale });
    match term {
        // Zero has no direction in which a scale could be divided.
        Term::Number(number) if number.numerator() == 0 => whole(Bounded::unit(Sum::Number(0)), Ratio::ONE),
        Term::Number(number) => {
            let size = Ratio::new(number.numerator().checked_abs()?, number.denominator())?;
            whole(Bounded::unit(Sum::Number(number.numerator().signum())), size)
        }
        Term::Bit(entry, bit) => whole(Bounded::unit(Sum::Bit(entry.id, *bit)), Ratio::ONE),
        Term::Entry(reference) => {
            let entry = device.entry(reference.id)?;
            let (low, high) = entry.data_type.range()?;
            let bound = low.checked_abs()?.max(high);
            let raw = Bounded { sum: Sum::Entry(reference.id), bound };
            let Some(unit) = entry.unit.as_deref() else { return whole(raw, Ratio::ONE) };
            let above = whole(raw, unit.step()?)?;
            let offset = unit.offset_in(unit.base_symbol())?;
            if offset == Ratio::ZERO {
                return Some(above);
            }
            sum(above, ArithmeticOp::Add, fraction(&Term::Number(offset), device)?)
        }
        Term::Binary(left, op, right) => {
            let (left, right) = (fraction(left, device)?, fraction(right, device)?);
            match op {
                ArithmeticOp::Multiply => product(left, &right),
                ArithmeticOp::Divide => product(left, &inverse(right)?),
                ArithmeticOp::Add | ArithmeticOp::Subtract => sum(left, *op, right),
            }
        }
    }
}

fn inverse(of: Fraction) -> Option<Fraction> {
    let scale = Ratio::ONE.checked_div(of.scale)?;
    Some(Fraction { numerator: of.divisor, divisor: of.numerator, scale })
}

fn product(left: Fraction, right: &Fraction) -> Option<Fraction> {
    Some(Fraction {
        numerator: left.numerator.times(&right.numerator)?,
        divisor: left.divisor.times(&right.divisor)?,
        scale: left.scale.checked_mul(right.scale)?,
    })
}

fn sum(left: Fraction, op: ArithmeticOp, right: Fraction) -> Option<Fraction> {
    let factors = left.scale.checked_div(right.scale)?;
    let scale = right.scale.checked_mul(Ratio::new(1, factors.denominator())?)?;
    let of_left = left.numerator.scaled(factors.numerator())?.times(&right.divisor)?;
    let of_right = right.numerator.scaled(factors.denominator())?.times(&left.divisor)?;
    Some(Fraction {
        numerator: Bounded {
            bound: of_left.bound.checked_add(of_right.bound)?,
            sum: binary(of_left.sum, op, of_right.sum),
        },
        divisor: left.divisor.times(&right.divisor)?,
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
  above: {symbol: mV, scale: 20, offset: -5000.5, base: 1/1000 V}
  volt: {symbol: V}
objects:
  0x2000: {name: a, type: unsigned16, unit: millivolt, access: rw}
  0x2001: {name: b, type: integer16, unit: volt, access: rw}
  0x2002: {name: c, type: integer32, unit: third, access: rw}
  0x2003: {name: d, type: integer8, access: rw}
  0x2004: {name: e, type: unsigned8, unit: above, access: rw}
";

    const CONDITIONS: [&str; 18] = [
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
        "0x2004 < 0x2000",
        "-5.0005 <= 0x2004 <= 0x2001 + 0x2004",
        "0x2004 * 0x2003 > 0x2001 / 0x2004",
        "0x2004 >= -0.0005",
        "0x2000 < 0x2001 or 0x2003 == 0 and 0x2002 > 0 or bit(0x2004, 0) == 1",
        "0x2001 > 0x2000 / 0x2003 or 0x2003 < 0",
    ];

    struct Raw<'a> {
        system: &'a System,
        values: BTreeMap<u16, i128>,
    }

    impl Values for Raw<'_> {
        fn value(&self, entry: &EntryRef) -> Option<Ratio> {
            let raw = Ratio::whole(self.raw(entry)?);
            let Some(unit) = &self.system.devices[0].entry(entry.id)?.unit else { return Some(raw) };
            let (factor, offset) = (unit.base.as_ref().map_or(Ratio::ONE, |base| base.factor), unit.offset);
            raw.checked_mul(unit.scale)?.checked_add(offset)?.checked_mul(factor)
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
            e in prop_oneof![Just(0), Just(255), 245..255i128],
        ) {
            let mut sources = SourceMap::new();
            let root = sources.add("random.od.yaml", SPECIFICATION);
            let system = compile(&mut sources, root, &mut NoFiles).system.unwrap();
            let values = BTreeMap::from([(0x2000, a), (0x2001, b), (0x2002, c), (0x2003, d), (0x2004, e)]);
            for text in CONDITIONS {
                let expr = Expr::parse(text).unwrap();
                let planned = plan(&expr, &system.devices[0]).unwrap();
                let mut most = 0;
                let mut link = |compare: &Compare| {
                    let mut value = |sum: &Sum| number(sum, &values, &mut most);
                    let (left, right) = (value(&compare.left), value(&compare.right));
                    compare.divisors.iter().any(|divisor| value(divisor) == 0) || compare.op.accepts(left.cmp(&right))
                };
                let mut holds = false;
                for comparisons in &planned.alternatives {
                    holds |= comparisons.iter().all(&mut link);
                }
                let expected = expr.evaluate(&Raw { system: &system, values: values.clone() });
                prop_assert_eq!(holds, !matches!(expected, Outcome::Fails { .. }), "{} with {:?}", text, values);
                prop_assert!(!planned.narrow || most <= i128::from(i64::MAX), "{}: {}", text, most);
            }
        }
    }

    #[test]
    fn what_others_have_or_what_is_too_large_is_reported() {
        let mut sources = SourceMap::new();
        let root = sources.add("random.od.yaml", SPECIFICATION);
        let system = compile(&mut sources, root, &mut NoFiles).system.unwrap();
        let planned = |text: &str| plan(&Expr::parse(text).unwrap(), &system.devices[0]);
        assert_eq!(planned("other:0x2000 < 0x2001"), Err(Unusable::Elsewhere));
        assert_eq!(planned("other:0x2000 < 0x2001 < 0x2002").unwrap().alternatives[0].len(), 1);
        assert_eq!(planned("other:0x2000 < 0x2001 or 0x2001 < 0x2002"), Err(Unusable::Elsewhere));
        let product = ["0x2002"; 5].join(" * ");
        assert_eq!(planned(&format!("{product} > 0")), Err(Unusable::TooLarge));
        // Reached only by the fifth power; the entry's own index counts.
        let id = EntryId { index: Index(0x2003), sub: SubIndex(0) };
        assert_eq!(planned("0x2003 > 0").unwrap().alternatives[0][0].left, Sum::Entry(id));
    }
}
