//! Aliases: views of another entry in a narrower type or another unit.

use crate::abort::AbortCode;
use crate::value::data_type::DataType;

/// How an alias shows the value of its target: value × numerator / denominator, rounded, and fitted into a type.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct View {
    /// Raw values of the view per [`denominator`](Self::denominator) raw values of its target; positive.
    pub numerator: u32,
    /// Raw values of the target per [`numerator`](Self::numerator) raw values of the view; positive.
    pub denominator: u32,
    /// The type of the view: INTEGERn or UNSIGNEDn.
    pub data_type: DataType,
    /// What a value between two steps becomes.
    pub rounding: Rounding,
    /// What a value outside the type becomes.
    pub outside: Outside,
}

/// What a value between two steps becomes on reading.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rounding {
    /// The step below.
    Down,
    /// The step above.
    Up,
    /// The nearest step, halves away from zero.
    Nearest,
    /// The step nearer to zero.
    Zero,
}

/// What a value outside the alias' type becomes on reading.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outside {
    /// The nearest value that the alias can show.
    Saturate,
    /// Its low bits.
    Wrap,
    /// An SDO abort, 0800 0020h.
    Abort,
}

impl View {
    /// A view without rescaling.
    pub const fn plain(data_type: DataType, outside: Outside) -> Self {
        Self::scaled(data_type, outside, 1, 1, Rounding::Down)
    }

    /// A view with a scale: raw alias value per raw target value. The generator makes sure that no product overflows.
    pub const fn scaled(
        data_type: DataType,
        outside: Outside,
        numerator: u32,
        denominator: u32,
        rounding: Rounding,
    ) -> Self {
        Self { numerator, denominator, data_type, rounding, outside }
    }

    /// What the alias shows of a value of its target.
    ///
    /// # Errors
    /// [`AbortCode::NOT_STORED`] for a value that it cannot show and may neither saturate nor wrap.
    pub const fn show(&self, target: i64) -> Result<i64, AbortCode> {
        let value = self.rounded(target);
        // Bits of 64 that the type leaves unused.
        let unused = match self.data_type.integer_bits() {
            Some(bits) => 64 - bits,
            None => 0,
        };
        let (low, high) = if self.data_type.is_signed() {
            (i64::MIN >> unused, i64::MAX >> unused)
        } else {
            (0, if unused == 0 { i64::MAX } else { i64::MAX >> (unused - 1) })
        };
        if value >= low && value <= high {
            return Ok(value);
        }
        match self.outside {
            Outside::Saturate => Ok(if value < low { low } else { high }),
            Outside::Wrap if self.data_type.is_signed() => Ok(value << unused >> unused),
            Outside::Wrap => Ok(value & high),
            Outside::Abort => Err(AbortCode::NOT_STORED),
        }
    }

    /// As [`show`](Self::show); what the alias cannot show is 0.
    pub const fn show_or_zero(&self, target: i64) -> i64 {
        match self.show(target) {
            Ok(value) => value,
            Err(_) => 0,
        }
    }

    const fn rounded(&self, target: i64) -> i64 {
        if self.numerator == 1 && self.denominator == 1 {
            return target;
        }
        let product = target.saturating_mul(self.numerator as i64);
        let denominator = self.denominator as i64;
        // A denominator of 0 would be a mistake of the generator, which a view then shows unscaled.
        let Some(floor) = floor(product, self.denominator) else { return product };
        let rest = product - floor * denominator;
        let up = match self.rounding {
            Rounding::Down => false,
            Rounding::Up => rest != 0,
            Rounding::Zero => rest != 0 && product < 0,
            Rounding::Nearest => {
                let twice = rest * 2;
                twice > denominator || twice == denominator && product >= 0
            }
        };
        if up { floor + 1 } else { floor }
    }

    /// The value that the target gets when the alias is written.
    ///
    /// # Errors
    /// [`AbortCode::INVALID_VALUE`] for a value that falls between two steps of the target.
    pub const fn target(&self, value: i64) -> Result<i64, AbortCode> {
        let (numerator, denominator) = (self.numerator as i64, self.denominator as i64);
        let Some(product) = value.checked_mul(denominator) else { return Err(AbortCode::INVALID_VALUE) };
        match floor(product, self.numerator) {
            Some(target) if target * numerator == product => Ok(target),
            _ => Err(AbortCode::INVALID_VALUE),
        }
    }
}

/// The quotient, rounded down; `None` of a division by 0.
const fn floor(number: i64, divisor: u32) -> Option<i64> {
    if divisor == 0 {
        return None;
    }
    // -1 - n has the bits of n inverted, and the quotients of both are each other's inverse, too.
    let sign = number >> 63;
    Some(divide((number ^ sign).cast_unsigned(), divisor).cast_signed() ^ sign)
}

/// The quotient of a number below 2^63. A division of 64 bits is a kilobyte of code on a microcontroller of 32 bits: what has more bits is
/// divided one bit after the other.
#[expect(clippy::cast_possible_truncation, reason = "it was compared")]
const fn divide(number: u64, divisor: u32) -> u64 {
    if number <= u32::MAX as u64 {
        return (number as u32 / divisor) as u64;
    }
    // The quotient comes from below into what is shifted out above.
    let (mut number, mut rest, mut bits) = (number, 0u64, u64::BITS);
    while bits > 0 {
        rest = rest << 1 | number >> 63;
        number <<= 1;
        if rest >= divisor as u64 {
            rest -= divisor as u64;
            number |= 1;
        }
        bits -= 1;
    }
    number
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotients_are_those_of_the_processor() {
        let ends =
            [0, 1, 7, 1000, 0xFFFF_FFFE, 0xFFFF_FFFF, 0x1_0000_0000, 0x1_0000_0001, i64::MAX - 1, i64::MAX];
        for number in ends.into_iter().flat_map(|number| [number, -number, -1 - number]) {
            for divisor in [1, 2, 3, 10, 1000, 0x8000_0000, 0xFFFF_FFFF] {
                let expected = number.div_euclid(i64::from(divisor));
                assert_eq!(floor(number, divisor), Some(expected), "{number} / {divisor}");
            }
        }
        assert_eq!(floor(1, 0), None);
    }

    #[test]
    fn sixteen_bits_saturate_at_their_ends() {
        let view = View::plain(DataType::Integer16, Outside::Saturate);
        for (target, shown) in [
            (0, 0),
            (-1, -1),
            (32_767, 32_767),
            (32_768, 32_767),
            (-32_768, -32_768),
            (-32_769, -32_768),
            (i64::from(i32::MAX), 32_767),
            (i64::from(i32::MIN), -32_768),
        ] {
            assert_eq!(view.show(target), Ok(shown), "{target}");
        }
        let view = View::plain(DataType::Unsigned16, Outside::Wrap);
        assert_eq!(view.show(65_535), Ok(65_535));
        assert_eq!(view.show(65_536), Ok(0));
        let view = View::plain(DataType::Integer16, Outside::Wrap);
        assert_eq!(view.show(32_768), Ok(-32_768));
        assert_eq!(view.show(-32_769), Ok(32_767));
        let view = View::plain(DataType::Integer16, Outside::Abort);
        assert_eq!(view.show(32_768), Err(AbortCode::NOT_STORED));
        assert_eq!(view.show_or_zero(32_768), 0);
    }

    #[test]
    fn rescaling_rounds_as_told() {
        let view = |rounding| View::scaled(DataType::Integer16, Outside::Saturate, 1, 1000, rounding);
        let show = |rounding, value| view(rounding).show(value).unwrap_or(i64::MIN);
        assert_eq!(show(Rounding::Down, 560_999), 560);
        assert_eq!(show(Rounding::Down, -999), -1);
        assert_eq!(show(Rounding::Up, 560_001), 561);
        assert_eq!(show(Rounding::Up, 7000), 7);
        assert_eq!(show(Rounding::Zero, -999), 0);
        assert_eq!(show(Rounding::Zero, 999), 0);
        assert_eq!(show(Rounding::Nearest, 560_500), 561);
        assert_eq!(show(Rounding::Nearest, 560_499), 560);
        assert_eq!(show(Rounding::Nearest, -500), -1);
        assert_eq!(show(Rounding::Nearest, -499), 0);
    }

    #[test]
    fn writing_is_exact_or_refused() {
        let volts = View::scaled(DataType::Unsigned16, Outside::Saturate, 1, 1000, Rounding::Down);
        assert_eq!(volts.target(560), Ok(560_000));
        let tenths = View::scaled(DataType::Integer16, Outside::Saturate, 10, 1, Rounding::Down);
        assert_eq!(tenths.target(-50), Ok(-5));
        assert_eq!(tenths.target(-55), Err(AbortCode::INVALID_VALUE));
    }
}
