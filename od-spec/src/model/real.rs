//! Floating-point numbers: the number that is written, and whether a type keeps it.

use std::fmt::{self, Debug, Formatter};

use std::cmp::Ordering;

use super::{DataType, Ratio};

/// A number of REAL32 or REAL64.
#[derive(Clone)]
pub struct Real {
    number: f64,
    /// The text, where it names a number that the type does not have.
    departing: Option<Box<str>>,
}

impl Real {
    /// Reads a decimal number for a type; `None` if it is not one, or too large.
    pub fn read(text: &str, data_type: DataType) -> Option<Self> {
        let number: f64 = text.parse().ok()?;
        let kept = kept(number, data_type);
        (number.is_finite() && kept.is_finite())
            .then(|| Self { number, departing: (!is_kept(text, kept, data_type)).then(|| text.into()) })
    }

    /// The number of a fraction, for a type; `None` if it is too large.
    pub fn of_ratio(ratio: Ratio, data_type: DataType) -> Option<Self> {
        if let Some(text) = ratio.decimal_places().and_then(|places| ratio.to_decimal(places)) {
            return Self::read(&text, data_type);
        }
        #[expect(clippy::cast_precision_loss, reason = "what no decimal writes, no binary number has either")]
        let number = ratio.numerator() as f64 / ratio.denominator() as f64;
        kept(number, data_type)
            .is_finite()
            .then(|| Self { number, departing: Some(ratio.to_string().into()) })
    }

    /// How the number compares with another one, as the type keeps both.
    pub fn compare(&self, other: &Self, data_type: DataType) -> Ordering {
        self.order(data_type).cmp(&other.order(data_type))
    }

    /// A whole number that represents the one that the type keeps wherever numbers of the type are compared: its bits
    /// without the sign, and negative where the number is.
    pub fn order(&self, data_type: DataType) -> i64 {
        let kept = kept(self.number, data_type);
        let magnitude = if data_type == DataType::Real32 {
            #[expect(clippy::cast_possible_truncation, reason = "a number that the type has")]
            let bits = (kept as f32).abs().to_bits();
            i64::from(bits)
        } else {
            kept.abs().to_bits().cast_signed()
        };
        if kept.is_sign_negative() { -magnitude } else { magnitude }
    }

    /// The number, as exactly as 64 bits have it.
    pub const fn number(&self) -> f64 {
        self.number
    }

    /// The text, where it says another number than its type keeps.
    pub fn departing(&self) -> Option<&str> {
        self.departing.as_deref()
    }
}

impl From<f64> for Real {
    fn from(number: f64) -> Self {
        Self { number, departing: None }
    }
}

/// The number counts, and not how it is written.
impl PartialEq for Real {
    fn eq(&self, other: &Self) -> bool {
        self.number == other.number
    }
}

impl Debug for Real {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.number.fmt(f)
    }
}

/// The number that a type has instead of this one.
#[expect(clippy::cast_possible_truncation, reason = "the nearest value that the type has")]
fn kept(number: f64, data_type: DataType) -> f64 {
    if data_type == DataType::Real32 { f64::from(number as f32) } else { number }
}

/// Whether a text says what the type keeps: the number to as many digits as are written, or its shortest text, which is not always
/// the nearest of its length.
fn is_kept(text: &str, kept: f64, data_type: DataType) -> bool {
    /// The digits of a REAL64 in full are fewer.
    const MOST_DIGITS: usize = 800;
    let Some(written) = Decimal::of(text) else { return false };
    let digits = written.digits.len();
    let Some(more) = digits.checked_sub(1) else { return kept == 0.0 };
    if digits > MOST_DIGITS {
        return false;
    }
    let is_rounded = Decimal::of(&format!("{kept:.more$e}")) == Some(written.clone());
    is_rounded || Decimal::of(&shortest(kept, data_type)) == Some(written)
}

/// The shortest text that reads back as the same value of the type.
#[expect(clippy::cast_possible_truncation, reason = "a number that the type has")]
fn shortest(kept: f64, data_type: DataType) -> String {
    if data_type == DataType::Real32 { format!("{:e}", kept as f32) } else { format!("{kept:e}") }
}

/// A decimal number without rounding.
#[derive(Clone, PartialEq, Eq)]
struct Decimal {
    is_negative: bool,
    /// Neither with a zero at the beginning nor with one at the end.
    digits: String,
    /// Of ten, for the point before the first digit.
    exponent: i128,
}

impl Decimal {
    /// `None` if the exponent is beyond all bounds.
    fn of(text: &str) -> Option<Self> {
        let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
        let is_negative = mantissa.starts_with('-');
        let mantissa = mantissa.trim_start_matches(['+', '-']);
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let whole = whole.trim_start_matches('0');
        let (digits, before) = if whole.is_empty() {
            let digits = fraction.trim_start_matches('0');
            (digits.to_owned(), -i128::try_from(fraction.len() - digits.len()).ok()?)
        } else {
            (format!("{whole}{fraction}"), i128::try_from(whole.len()).ok()?)
        };
        let digits = digits.trim_end_matches('0').to_owned();
        let exponent =
            if digits.is_empty() { 0 } else { exponent.parse::<i128>().ok()?.checked_add(before)? };
        Some(Self { is_negative, digits, exponent })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_type_keeps_is_judged_by_the_digits_that_are_written() {
        let long = format!("0.1{}1", "0".repeat(100_000));
        let zeros = format!("0.1{}", "0".repeat(100_000));
        for (text, single, double) in [
            ("0.1", true, true),
            ("0.1000", true, true),
            (zeros.as_str(), true, true),
            ("1e-1", true, true),
            ("+.1", true, true),
            ("-0.1", true, true),
            ("-0", true, true),
            ("0.0e99999999999999999999999999999999999999999", true, true),
            ("1e-50", false, true),
            ("1e-400", false, false),
            ("0.123456789", false, true),
            ("0.10000000149011612", true, true),
            ("0.10000000000000001", false, true),
            ("0.1000000000000000055511151231257827", false, true),
            ("0.100000001490116119384765625", true, true),
            ("0.10000000000000000001", false, false),
            (long.as_str(), false, false),
            ("16777217", false, true),
            ("9007199254740992", true, true),
            ("9007199254740993", false, false),
            ("5e-324", false, true),
            ("4.9406564584124654e-324", false, true),
            ("1.7976931348623157e308", false, true),
            ("0.3", true, true),
            ("0.29999999999999999", false, true),
            ("0.30000000000000000", true, true),
            ("123456.7", true, true),
        ] {
            let is_kept =
                |data_type| Real::read(text, data_type).is_some_and(|real| real.departing().is_none());
            let shown = &text[..text.len().min(40)];
            assert_eq!(is_kept(DataType::Real32), single, "{shown} as REAL32");
            assert_eq!(is_kept(DataType::Real64), double, "{shown} as REAL64");
        }
    }

    #[test]
    fn numbers_are_ordered_as_their_type_keeps_them() {
        let real = |number: f64| Real::from(number);
        let ascending = [-1e38, -1.5, -1e-45, 0.0, 1e-45, 0.1, 1.0, 16_777_216.0, 3e38];
        for data_type in [DataType::Real32, DataType::Real64] {
            assert!(
                ascending.windows(2).all(|pair| real(pair[0]).compare(&real(pair[1]), data_type).is_lt())
            );
            assert_eq!(real(-0.0).order(data_type), 0);
        }
        assert_eq!(real(16_777_217.0).compare(&real(16_777_216.0), DataType::Real32), Ordering::Equal);
        assert_eq!(real(16_777_217.0).compare(&real(16_777_216.0), DataType::Real64), Ordering::Greater);
        assert_eq!(real(1.0).order(DataType::Real32), 0x3F80_0000);
        assert_eq!(real(-1.0).order(DataType::Real64), -0x3FF0_0000_0000_0000);
    }

    #[test]
    fn fractions_are_the_nearest_number() {
        let of = |upper, lower| Real::of_ratio(Ratio::new(upper, lower).unwrap(), DataType::Real32).unwrap();
        assert_eq!((of(41, 2).number(), of(41, 2).departing()), (20.5, None));
        assert_eq!((of(1, 3).number(), of(1, 3).departing()), (1.0 / 3.0, Some("1/3")));
    }

    #[test]
    fn what_is_no_finite_number_of_the_type_is_refused() {
        for (text, data_type) in [
            ("1e39", DataType::Real32),
            ("1e309", DataType::Real64),
            ("inf", DataType::Real64),
            ("NaN", DataType::Real32),
            ("", DataType::Real64),
            ("0x10", DataType::Real64),
        ] {
            assert!(Real::read(text, data_type).is_none(), "{text}");
        }
    }
}
