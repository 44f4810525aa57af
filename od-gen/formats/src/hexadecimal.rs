//! Hexadecimal numbers. EDS and JSON are full of them, and `format!` takes many times as long.

const DIGITS: &[u8; 16] = b"0123456789ABCDEF";

/// A number with `0x` and at least so many digits.
pub(crate) fn prefixed(number: impl Into<u64>, digits: usize) -> String {
    let mut text = String::with_capacity(12);
    text.push_str("0x");
    push(&mut text, number, digits);
    text
}

/// Appends at least so many digits of a number.
pub(crate) fn push(text: &mut String, number: impl Into<u64>, digits: usize) {
    let number: u64 = number.into();
    let needed = (u64::BITS - number.leading_zeros()).div_ceil(4) as usize;
    for digit in (0..needed.max(digits)).rev() {
        text.push(char::from(DIGITS[(number >> (4 * digit) & 0xF) as usize]));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_as_format_writes_them() {
        for number in [0, 1, 0xF, 0x10, 0xABC, 0x1000, 0x0012_3456_789A_BCDE, u64::MAX] {
            for digits in [1, 4] {
                assert_eq!(prefixed(number, digits), format!("0x{number:0digits$X}"));
            }
        }
    }
}
