//! Bytes as numbers, least significant byte first.

/// Up to 8 bytes as an unsigned number.
#[inline]
pub(crate) fn unsigned(bytes: &[u8]) -> u64 {
    match *bytes {
        [a] => a.into(),
        [a, b] => u16::from_le_bytes([a, b]).into(),
        [a, b, c, d] => u32::from_le_bytes([a, b, c, d]).into(),
        _ => bytes.iter().take(8).rev().fold(0, |value, byte| value << 8 | u64::from(*byte)),
    }
}

/// Up to 8 bytes as a signed number.
#[inline]
pub(crate) fn signed(bytes: &[u8]) -> i64 {
    match *bytes {
        [a] => i8::from_le_bytes([a]).into(),
        [a, b] => i16::from_le_bytes([a, b]).into(),
        [a, b, c, d] => i32::from_le_bytes([a, b, c, d]).into(),
        _ => {
            let unused = 64 - 8 * bytes.len().clamp(1, 8);
            (unsigned(bytes) << unused).cast_signed() >> unused
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_any_width() {
        assert_eq!(signed(&[0xFF, 0xFF, 0x7F]), 0x7F_FFFF);
        assert_eq!(signed(&[0, 0, 0x80]), -0x80_0000);
        assert_eq!(signed(&[0xFE, 0xFF, 0xFF, 0xFF, 0xFF]), -2);
        assert_eq!(signed(&[0; 0]), 0);
        assert_eq!(unsigned(&[1, 2, 3, 4, 5, 6, 7]), 0x0007_0605_0403_0201);
        assert_eq!(unsigned(&[0xFF; 8]), u64::MAX);
        assert_eq!(signed(&[0xFF; 8]), -1);
    }
}
