//! Numbers as people read them in code.

use proc_macro2::Literal;

/// A decimal literal, in groups of three digits where it is long.
pub(super) fn decimal(value: i128) -> Literal {
    use std::str::FromStr as _;
    let digits = value.unsigned_abs().to_string();
    if digits.len() < 6 {
        return Literal::i128_unsuffixed(value);
    }
    let mut text = String::from(if value < 0 { "-" } else { "" });
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            text.push('_');
        }
        text.push(digit);
    }
    Literal::from_str(&text).unwrap_or_else(|_| Literal::i128_unsuffixed(value))
}

/// A hexadecimal literal.
pub(super) fn hex(value: u64, digits: usize) -> Literal {
    use std::str::FromStr as _;
    let plain = format!("{value:0digits$X}");
    // Groups of four digits from the right, where there are more.
    let mut text = String::from("0x");
    for (at, digit) in plain.chars().enumerate() {
        let rest = plain.len() - at;
        if at > 0 && plain.len() > 4 && rest.is_multiple_of(4) {
            text.push('_');
        }
        text.push(digit);
    }
    Literal::from_str(&text).unwrap_or_else(|_| Literal::u64_unsuffixed(value))
}
