//! The bytes of an entry, and the numbers in them.

use core::ops::Deref;

use crate::data_type::DataType;
use crate::number::{signed, unsigned};

/// The value of an entry as it travels: the least significant byte first, strings without padding.
#[derive(Debug, Clone, Copy)]
pub struct Value<'a>(Bytes<'a>);

#[derive(Debug, Clone, Copy)]
enum Bytes<'a> {
    /// In the image or in flash.
    Place(&'a [u8]),
    /// Computed, because it is an alias: bytes and their number.
    Computed([u8; 8], u8),
}

impl<'a> Value<'a> {
    #[inline]
    pub(crate) const fn of(bytes: &'a [u8]) -> Self {
        Self(Bytes::Place(bytes))
    }

    #[inline]
    pub(crate) fn computed(number: i64, size: u16) -> Self {
        Self(Bytes::Computed(number.to_le_bytes(), u8::try_from(size.min(8)).unwrap_or(8)))
    }

    /// The bytes.
    #[inline]
    pub fn bytes(&self) -> &[u8] {
        match &self.0 {
            Bytes::Place(bytes) => bytes,
            Bytes::Computed(bytes, size) => bytes.get(..usize::from(*size)).unwrap_or(bytes),
        }
    }
}

impl Deref for Value<'_> {
    type Target = [u8];

    #[inline]
    fn deref(&self) -> &[u8] {
        self.bytes()
    }
}

/// The number that stands for a value wherever values are compared: the value itself, but of UNSIGNED64 the value minus
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
