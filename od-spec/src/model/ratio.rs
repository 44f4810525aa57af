//! Exact fractions: scales, physical values and constraints never pass through floating point.

use std::cmp::Ordering;
use std::fmt;

/// A fraction in lowest terms with a positive denominator.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Ratio {
    numerator: i128,
    denominator: i128,
}

impl Ratio {
    /// The number zero.
    pub const ZERO: Ratio = Ratio { numerator: 0, denominator: 1 };

    /// The number one.
    pub const ONE: Ratio = Ratio { numerator: 1, denominator: 1 };

    /// `numerator / denominator`; `None` for a zero denominator.
    pub fn new(numerator: i128, denominator: i128) -> Option<Self> {
        if denominator == 0 || numerator == i128::MIN || denominator == i128::MIN {
            return None;
        }
        if denominator == 1 {
            return Some(Self::whole(numerator));
        }
        let divisor = gcd(numerator.unsigned_abs(), denominator.unsigned_abs());
        let divisor = i128::try_from(divisor).ok()?.max(1) * denominator.signum();
        Some(Self { numerator: numerator / divisor, denominator: denominator / divisor })
    }

    /// A whole number.
    pub const fn whole(value: i128) -> Self {
        Self { numerator: value, denominator: 1 }
    }

    /// Upper part, carries the sign.
    pub const fn numerator(self) -> i128 {
        self.numerator
    }

    /// Lower part, positive.
    pub const fn denominator(self) -> i128 {
        self.denominator
    }

    /// The value, when it is a whole number.
    pub const fn to_whole(self) -> Option<i128> {
        if self.denominator == 1 { Some(self.numerator) } else { None }
    }

    /// The largest whole number that is not above the value.
    pub const fn floor(self) -> i128 {
        self.numerator.div_euclid(self.denominator)
    }

    /// Product; `None` when it does not fit 128 bits.
    pub fn checked_mul(self, other: Self) -> Option<Self> {
        // Reduced crosswise, intermediate products stay small, and the product is in lowest terms.
        let left = Self::new(self.numerator, other.denominator)?;
        let right = Self::new(other.numerator, self.denominator)?;
        let numerator =
            left.numerator.checked_mul(right.numerator).filter(|product| *product != i128::MIN)?;
        Some(Self { numerator, denominator: left.denominator.checked_mul(right.denominator)? })
    }

    /// Quotient; `None` for a zero divisor or an overflow.
    pub fn checked_div(self, other: Self) -> Option<Self> {
        self.checked_mul(Self::new(other.denominator, other.numerator)?)
    }

    /// Sum; `None` when it does not fit 128 bits.
    pub fn checked_add(self, other: Self) -> Option<Self> {
        let left = self.numerator.checked_mul(other.denominator)?;
        let right = other.numerator.checked_mul(self.denominator)?;
        Self::new(left.checked_add(right)?, self.denominator.checked_mul(other.denominator)?)
    }

    /// Difference; `None` when it does not fit 128 bits.
    pub fn checked_sub(self, other: Self) -> Option<Self> {
        self.checked_add(Self { numerator: other.numerator.checked_neg()?, ..other })
    }

    /// Comparison; `None` when the cross products do not fit 128 bits.
    pub fn compare(self, other: Self) -> Option<Ordering> {
        let left = self.numerator.checked_mul(other.denominator)?;
        Some(left.cmp(&other.numerator.checked_mul(self.denominator)?))
    }

    /// Number of decimal places needed to write this step exactly; `None` for thirds and the like.
    pub fn decimal_places(self) -> Option<usize> {
        let mut power = 1i128;
        (0..=12).find(|_| {
            let exact = power % self.denominator == 0;
            power *= 10;
            exact
        })
    }

    /// The value with a fixed number of decimal places; `None` when that is not exact.
    pub fn to_decimal(self, places: usize) -> Option<String> {
        let parts = 10i128.checked_pow(u32::try_from(places).ok()?)?;
        let scaled = self.checked_mul(Self::whole(parts))?.to_whole()?;
        if places == 0 {
            return Some(scaled.to_string());
        }
        let sign = if scaled < 0 { "-" } else { "" };
        let (whole, fraction) = (scaled / parts, scaled % parts);
        Some(format!("{sign}{}.{:0places$}", whole.unsigned_abs(), fraction.unsigned_abs()))
    }
}

/// `3`, `1/10` or, where a short decimal is exact, `0.5`.
impl fmt::Display for Ratio {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.decimal_places().and_then(|places| self.to_decimal(places)) {
            Some(text) => f.write_str(&text),
            None => write!(f, "{}/{}", self.numerator, self.denominator),
        }
    }
}

fn gcd(mut a: u128, mut b: u128) -> u128 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ratio(numerator: i128, denominator: i128) -> Ratio {
        Ratio::new(numerator, denominator).unwrap()
    }

    #[test]
    fn arithmetic_is_exact() {
        assert_eq!(ratio(2, -4), ratio(-1, 2));
        assert_eq!(ratio(1, 10).checked_mul(Ratio::whole(500)), Some(Ratio::whole(50)));
        assert_eq!(ratio(1, 3).checked_add(ratio(1, 6)), Some(ratio(1, 2)));
        assert_eq!(Ratio::ONE.checked_div(Ratio::whole(0)), None);
        assert_eq!(ratio(-1, 2).floor(), -1);
        assert_eq!(ratio(1, 3).compare(ratio(1, 2)), Some(Ordering::Less));
    }

    #[test]
    fn decimals_keep_their_places() {
        assert_eq!(ratio(1, 100).decimal_places(), Some(2));
        assert_eq!(Ratio::whole(50).to_decimal(1).as_deref(), Some("50.0"));
        assert_eq!(ratio(-1, 20).to_decimal(2).as_deref(), Some("-0.05"));
        assert_eq!(ratio(1, 3).to_string(), "1/3");
    }
}
