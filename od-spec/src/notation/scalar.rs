//! What the text of a scalar means, by the type that its place expects.

use crate::model::Ratio;

/// Why a text is not a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NumberError {
    /// It does not look like a number at all.
    NotANumber,
    /// A decimal number starts with `0`: octal to some readers, decimal to others.
    LeadingZero,
    /// It has more digits than any CANopen type.
    TooLarge,
}

impl NumberError {
    /// What to do about it.
    pub const fn help(self) -> &'static str {
        match self {
            NumberError::NotANumber => "write a decimal number, or `0x`, `0b` or `0o` and digits",
            NumberError::LeadingZero => {
                "remove the leading zero, or write `0o` for octal and `0x` for hexadecimal"
            }
            NumberError::TooLarge => "no CANopen integer has more than 64 bits",
        }
    }
}

/// An integer: decimal, `0x`, `0b` or `0o`, with `_` between digits, with an optional sign.
///
/// # Errors
/// The text is not a number, begins with a zero that CiA 306 reads as octal, or has more than 64 bits.
pub fn integer(text: &str) -> Result<i128, NumberError> {
    let (negative, digits) = match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    };
    let (radix, digits) = match digits.get(..2) {
        Some("0x" | "0X") => (16, &digits[2..]),
        Some("0b" | "0B") => (2, &digits[2..]),
        Some("0o" | "0O") => (8, &digits[2..]),
        _ => (10, digits),
    };
    if digits.is_empty() || digits.starts_with('_') || digits.ends_with('_') {
        return Err(NumberError::NotANumber);
    }
    let mut value = Some(0u64);
    for c in digits.chars().filter(|c| *c != '_') {
        let digit = c.to_digit(radix).ok_or(NumberError::NotANumber)?;
        value = value.and_then(|value| value.checked_mul(radix.into())?.checked_add(digit.into()));
    }
    if radix == 10 && digits.len() > 1 && digits.starts_with('0') {
        return Err(NumberError::LeadingZero);
    }
    let value = value.map(i128::from).ok_or(NumberError::TooLarge)?;
    Ok(if negative { -value } else { value })
}

/// An exact decimal number such as `-5.05`, without exponent.
pub fn decimal(text: &str) -> Option<Ratio> {
    let (negative, digits) = match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text),
    };
    let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
    let is_digits = |part: &str| part.bytes().all(|b| b.is_ascii_digit());
    if whole.is_empty()
        || whole.len() > 18
        || fraction.len() > 12
        || !is_digits(whole)
        || !is_digits(fraction)
    {
        return None;
    }
    if digits.contains('.') && fraction.is_empty() {
        return None;
    }
    let denominator = 10i128.checked_pow(u32::try_from(fraction.len()).ok()?)?;
    let fraction: i128 = if fraction.is_empty() { 0 } else { fraction.parse().ok()? };
    let numerator = whole.parse::<i128>().ok()?.checked_mul(denominator)?.checked_add(fraction)?;
    Ratio::new(if negative { -numerator } else { numerator }, denominator)
}

/// A ratio: `1/10`, `5`, `0.01`.
pub fn ratio(text: &str) -> Option<Ratio> {
    match text.split_once('/') {
        Some((numerator, denominator)) => {
            decimal(numerator.trim())?.checked_div(decimal(denominator.trim())?)
        }
        None => decimal(text),
    }
}

/// `yes`/`no`, `true`/`false`.
pub fn yes_no(text: &str) -> Option<bool> {
    match text {
        "yes" | "true" => Some(true),
        "no" | "false" => Some(false),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integers_in_every_notation() {
        for (text, value) in [
            ("0", 0),
            ("-1", -1),
            ("0x6040", 0x6040),
            ("0xFFFF_FFFF", 0xFFFF_FFFF),
            ("0b1010", 10),
            ("0o17", 15),
            ("1_000", 1000),
            ("18446744073709551615", i128::from(u64::MAX)),
        ] {
            assert_eq!(integer(text), Ok(value), "{text}");
        }
        assert_eq!(integer("010"), Err(NumberError::LeadingZero));
        assert_eq!(integer("18446744073709551616"), Err(NumberError::TooLarge));
        for text in ["", "-", "0x", "1__", "_1", "1.0", "0xG", "é", "0é"] {
            assert_eq!(integer(text), Err(NumberError::NotANumber), "{text}");
        }
    }

    #[test]
    fn decimals_are_exact() {
        assert_eq!(decimal("5.05"), Ratio::new(505, 100));
        assert_eq!(decimal("-0.5"), Ratio::new(-1, 2));
        assert_eq!(ratio("1/1000"), Ratio::new(1, 1000));
        for text in ["", ".", "1.", ".5", "1e3", "1,5", "--1"] {
            assert_eq!(decimal(text), None, "{text}");
        }
        assert_eq!(ratio("1/0"), None);
    }
}
