//! Bytes as numbers, least significant byte first.

use crate::value::data_type::DataType;

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

/// The number that represents a value wherever values are compared: the value itself, but of UNSIGNED64 the value minus
/// 2^63, which keeps the order and fits, and of REAL the bits without the sign, negative where the value is. What is no number
/// (NaN) lies beyond infinity.
#[inline]
pub(crate) fn number(data_type: DataType, bytes: &[u8]) -> i64 {
    if data_type.is_signed() {
        return signed(bytes);
    }
    let value = unsigned(bytes);
    let real = |sign: u32| {
        let magnitude = (value & !(1 << sign)).cast_signed();
        if value >> sign & 1 == 1 { -magnitude } else { magnitude }
    };
    if data_type == DataType::Real32 {
        real(31)
    } else if data_type == DataType::Real64 {
        real(63)
    } else if data_type == DataType::Unsigned64 {
        (value ^ 1 << 63).cast_signed()
    } else {
        value.cast_signed()
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

    #[test]
    fn reals_are_ordered_by_their_bits() {
        let single = |value: f32| number(DataType::Real32, &value.to_le_bytes());
        let double = |value: f64| number(DataType::Real64, &value.to_le_bytes());
        let ascending =
            [f32::NEG_INFINITY, f32::MIN, -1.0, -f32::MIN_POSITIVE, 0.0, 1e-45, 0.5, 1.0, f32::INFINITY];
        for pair in ascending.windows(2) {
            assert!(single(pair[0]) < single(pair[1]) && double(pair[0].into()) < double(pair[1].into()));
        }
        assert_eq!((single(-0.0), double(-0.0)), (0, 0));
        assert!(single(f32::NAN) > single(f32::INFINITY) && double(f64::NAN) > double(f64::INFINITY));
        assert!(
            single(-f32::NAN) < single(f32::NEG_INFINITY) && double(-f64::NAN) < double(f64::NEG_INFINITY)
        );
    }
}
