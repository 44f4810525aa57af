//! Elementary data types of the language, and how their values are written.

use od_spec::model::{DataType, Entry, Family, TypeKind};

/// An elementary data type.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Elementary {
    Bool,
    Byte,
    Word,
    Dword,
    Lword,
    Sint,
    Int,
    Dint,
    Lint,
    Usint,
    Uint,
    Udint,
    Ulint,
    Real,
    Lreal,
}

/// What the values of an [`Elementary`] type are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Bool,
    BitString,
    Signed,
    Unsigned,
    Real,
}

impl Elementary {
    /// As programs spell it.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Bool => "BOOL",
            Self::Byte => "BYTE",
            Self::Word => "WORD",
            Self::Dword => "DWORD",
            Self::Lword => "LWORD",
            Self::Sint => "SINT",
            Self::Int => "INT",
            Self::Dint => "DINT",
            Self::Lint => "LINT",
            Self::Usint => "USINT",
            Self::Uint => "UINT",
            Self::Udint => "UDINT",
            Self::Ulint => "ULINT",
            Self::Real => "REAL",
            Self::Lreal => "LREAL",
        }
    }

    /// What its values are.
    pub(super) const fn kind(self) -> Kind {
        match self {
            Self::Bool => Kind::Bool,
            Self::Byte | Self::Word | Self::Dword | Self::Lword => Kind::BitString,
            Self::Sint | Self::Int | Self::Dint | Self::Lint => Kind::Signed,
            Self::Usint | Self::Uint | Self::Udint | Self::Ulint => Kind::Unsigned,
            Self::Real | Self::Lreal => Kind::Real,
        }
    }

    /// Bits of a value; of a BOOL the one that counts.
    pub(super) const fn bits(self) -> u32 {
        match self {
            Self::Bool => 1,
            Self::Byte | Self::Sint | Self::Usint => 8,
            Self::Word | Self::Int | Self::Uint => 16,
            Self::Dword | Self::Dint | Self::Udint | Self::Real => 32,
            Self::Lword | Self::Lint | Self::Ulint | Self::Lreal => 64,
        }
    }

    /// The unsigned number that has at least so many bits, up to 64.
    pub(super) const fn unsigned(bits: u32) -> Self {
        match bits {
            ..=8 => Self::Usint,
            9..=16 => Self::Uint,
            17..=32 => Self::Udint,
            33.. => Self::Ulint,
        }
    }

    /// The signed number that has at least so many bits, up to 64.
    pub(super) const fn signed(bits: u32) -> Self {
        match bits {
            ..=8 => Self::Sint,
            9..=16 => Self::Int,
            17..=32 => Self::Dint,
            33.. => Self::Lint,
        }
    }

    /// The string of at least so many bits, up to 64.
    pub(super) const fn bit_string(bits: u32) -> Self {
        match bits {
            ..=8 => Self::Byte,
            9..=16 => Self::Word,
            17..=32 => Self::Dword,
            33.. => Self::Lword,
        }
    }

    /// The type of an entry's raw value; `None` for texts, bytes and what has no length.
    pub(super) fn of(entry: &Entry) -> Option<Self> {
        let bits = u32::from(entry.data_type.bits()?);
        if let Some(TypeKind::Bits(_)) = entry.named_type.as_ref().map(|named| &named.kind) {
            return Some(Self::bit_string(bits));
        }
        Self::of_type(entry.data_type)
    }

    /// The type of the raw values of a data type; `None` for texts, bytes and what has no length.
    pub(super) fn of_type(data_type: DataType) -> Option<Self> {
        let bits = u32::from(data_type.bits()?);
        match data_type.family() {
            Family::Boolean => Some(Self::Bool),
            Family::Signed => Some(Self::signed(bits)),
            Family::Unsigned => Some(Self::unsigned(bits)),
            Family::Real => Some(if bits == 32 { Self::Real } else { Self::Lreal }),
            Family::Time => Some(Self::bit_string(bits)),
            Family::VisibleString | Family::OctetString | Family::UnicodeString | Family::Domain => None,
        }
    }

    /// A whole number as a value of the type. What a bit string has in its bits is the number's two's complement.
    pub(super) fn literal(self, raw: i128) -> String {
        match self.kind() {
            Kind::Bool => if raw == 0 { "FALSE" } else { "TRUE" }.to_owned(),
            Kind::BitString => {
                let digits = usize::try_from(self.bits() / 4).unwrap_or_default();
                format!("16#{:0digits$X}", raw & ((1 << self.bits()) - 1))
            }
            // The number after the sign of the smallest value is too large for the type.
            Kind::Signed if raw == -(1 << (self.bits() - 1)) => format!("{}#{raw}", self.name()),
            Kind::Signed | Kind::Unsigned => raw.to_string(),
            Kind::Real => format!("{raw}.0"),
        }
    }
}

/// A floating-point number, with the decimal point that the language demands.
pub(super) fn real(number: f64) -> String {
    let text = format!("{number:?}");
    match text.split_once('e') {
        Some((digits, exponent)) if digits.contains('.') => format!("{digits}E{exponent}"),
        Some((digits, exponent)) => format!("{digits}.0E{exponent}"),
        None => text,
    }
}

/// `SINT_TO_DINT(x)`; nothing where both are one type.
pub(super) fn convert(from: Elementary, to: Elementary, expression: &str) -> String {
    if from == to {
        return expression.to_owned();
    }
    format!("{}_TO_{}({expression})", from.name(), to.name())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn literals_have_what_the_language_demands() {
        assert_eq!(real(1e16), "1.0E16");
        assert_eq!(real(-2.5e-9), "-2.5E-9");
        assert_eq!(real(0.1), "0.1");
        assert_eq!(real(40.0), "40.0");
        assert_eq!(Elementary::Word.literal(-1), "16#FFFF");
        assert_eq!(Elementary::Lword.literal(0x12), "16#0000000000000012");
        assert_eq!(Elementary::Lint.literal(i64::MIN.into()), "LINT#-9223372036854775808");
        assert_eq!(Elementary::Sint.literal(-127), "-127");
        assert_eq!(Elementary::Bool.literal(1), "TRUE");
    }
}
