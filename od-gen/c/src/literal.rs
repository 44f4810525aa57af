//! Numbers and strings as C writes them, of a width that every platform has: an `int` may have 16 bits.

use std::fmt::Write as _;

use od_spec::model::DataType;

/// An integer type of exactly 8, 16, 32 or 64 bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Integer {
    pub signed: bool,
    pub bits: u8,
}

impl Integer {
    /// The type that carries the values of a data type; `None` of what is not an integer.
    pub(super) fn of(data_type: DataType) -> Option<Self> {
        let bits = data_type.bits().filter(|_| data_type.is_integer())?;
        let bits = match bits {
            0..=8 => 8,
            9..=16 => 16,
            17..=32 => 32,
            33.. => 64,
        };
        Some(Self { signed: data_type.is_signed(), bits })
    }

    /// The same width without a sign, as the bits of a word are.
    pub(super) const fn unsigned(self) -> Self {
        Self { signed: false, ..self }
    }

    /// `uint16_t`.
    pub(super) fn name(self) -> String {
        format!("{}int{}_t", if self.signed { "" } else { "u" }, self.bits)
    }

    const fn suffix(self) -> &'static str {
        match (self.signed, self.bits) {
            (false, ..=16) => "U",
            (false, ..=32) => "UL",
            (false, _) => "ULL",
            (true, ..=16) => "",
            (true, ..=32) => "L",
            (true, _) => "LL",
        }
    }

    /// A value as an expression in brackets, of this width and usable by the preprocessor. The lowest value of a type is a difference, as
    /// its digits alone are beyond the type.
    pub(super) fn literal(self, value: i128) -> String {
        let suffix = self.suffix();
        let lowest = -(1 << (self.bits - 1));
        if self.signed && self.bits > 8 && value == lowest {
            return format!("(-{}{suffix} - 1{suffix})", -(value + 1));
        }
        format!("({value}{suffix})")
    }

    /// The same, for patterns: with the digits of a number of bits.
    pub(super) fn pattern(self, value: u64, bits: u8) -> String {
        let digits = usize::from(bits.div_ceil(4)).max(2);
        format!("(0x{value:0digits$X}{})", self.unsigned().suffix())
    }
}

/// The smallest type that a product of a raw value with a number should be computed in, and the number in it: signed, as an unsigned factor would
/// make a negative raw value a large one.
pub(super) fn factor(value: i128) -> String {
    let bits = if i32::try_from(value).is_ok() { 32 } else { 64 };
    let signed = i64::try_from(value).is_ok();
    Integer { signed, bits }.literal(value)
}

/// A `float` in brackets, with the fewest digits that make this number; `None` of what is not a number or none that
/// ends.
pub(super) fn real32(number: f64) -> Option<String> {
    #[expect(clippy::cast_possible_truncation, reason = "the nearest value that the type has")]
    let single = number as f32;
    single.is_finite().then(|| format!("({single:?}F)"))
}

/// A `double`, as [`real32`].
pub(super) fn real64(number: f64) -> Option<String> {
    number.is_finite().then(|| format!("({number:?})"))
}

/// A string literal of bytes. Everything but printable ASCII is an octal escape, which has at most three digits, where a hexadecimal one would
/// swallow what follows.
pub(super) fn string(bytes: &[u8]) -> String {
    let mut out = String::from("\"");
    for byte in bytes {
        match byte {
            b'"' => out.push_str("\\\""),
            b'\\' => out.push_str("\\\\"),
            // Two of them begin a trigraph.
            b'?' => out.push_str("\\?"),
            b' '..=b'~' => out.push(char::from(*byte)),
            _ => {
                let _ = write!(out, "\\{byte:03o}");
            }
        }
    }
    out.push('"');
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn signed(bits: u8) -> Integer {
        Integer { signed: true, bits }
    }

    #[test]
    fn literals_have_their_width_and_sign() {
        assert_eq!(signed(8).literal(-128), "(-128)");
        assert_eq!(signed(16).literal(-32_768), "(-32767 - 1)");
        assert_eq!(signed(32).literal(i32::MIN.into()), "(-2147483647L - 1L)");
        assert_eq!(signed(32).literal(-8_388_608), "(-8388608L)");
        assert_eq!(signed(64).literal(i64::MIN.into()), "(-9223372036854775807LL - 1LL)");
        assert_eq!(signed(16).unsigned().literal(65_535), "(65535U)");
        assert_eq!(signed(32).unsigned().literal(1), "(1UL)");
        assert_eq!(signed(64).unsigned().literal(u64::MAX.into()), "(18446744073709551615ULL)");
        assert_eq!(signed(16).pattern(8, 16), "(0x0008U)");
        assert_eq!(signed(32).pattern(8, 24), "(0x000008UL)");
    }

    #[test]
    fn types_carry_odd_widths() {
        let carrier = |data_type| Integer::of(data_type).map(Integer::name);
        assert_eq!(carrier(DataType::Integer24).as_deref(), Some("int32_t"));
        assert_eq!(carrier(DataType::Unsigned40).as_deref(), Some("uint64_t"));
        assert_eq!((carrier(DataType::Boolean), carrier(DataType::Real32)), (None, None));
    }

    #[test]
    fn factors_keep_the_sign_of_what_they_multiply() {
        assert_eq!((factor(10).as_str(), factor(-5).as_str()), ("(10L)", "(-5L)"));
        assert_eq!(factor(1 << 40), "(1099511627776LL)");
        assert_eq!(factor(u64::MAX.into()), "(18446744073709551615ULL)");
    }

    #[test]
    fn reals_are_constants_of_their_type() {
        assert_eq!(real32(0.1).as_deref(), Some("(0.1F)"));
        assert_eq!((real32(-2.0).as_deref(), real64(1e300).as_deref()), (Some("(-2.0F)"), Some("(1e300)")));
        assert_eq!((real32(1e300), real64(f64::NAN)), (None, None));
    }

    #[test]
    fn strings_hold_any_bytes() {
        assert_eq!(string(b"a\"b\\c"), "\"a\\\"b\\\\c\"");
        assert_eq!(string(b"what??/"), "\"what\\?\\?/\"");
        assert_eq!(string(&[0, 1, b'1', 0xE4]), "\"\\000\\0011\\344\"");
    }
}
