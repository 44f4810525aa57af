//! How a value lies in memory: the stack reads it there as bytes, in the order of the processor.

use od_spec::model::{Access, Author, DataType, Entry, Fact, Family};

use super::super::literal::Integer;

/// The variable of a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Cell {
    /// `bool_t`.
    Boolean,
    /// 8, 16, 32 or 64 bits.
    Integer(Integer),
    /// `float32_t`.
    Real32,
    /// `float64_t`.
    Real64,
    /// Bytes as they go over the bus: widths that C has no type for, times, OCTET_STRINGs.
    Bytes(u32),
    /// Characters, and one that ends them.
    Characters(u32),
    /// Characters of 16 bits, and one that ends them.
    WideCharacters(u32),
}

impl Cell {
    /// The variable of an entry; `None` where no memory is needed: a DOMAIN, bytes of which there are none.
    pub(super) fn of(entry: &Entry) -> Option<Self> {
        let data_type = entry.data_type;
        Some(match data_type.family() {
            Family::Boolean => Self::Boolean,
            Family::Signed | Family::Unsigned => {
                let carrier = Integer::of(data_type)?;
                match data_type.bits()? {
                    bits if bits == u16::from(carrier.bits) => Self::Integer(carrier),
                    bits => Self::Bytes(u32::from(bits / 8)),
                }
            }
            Family::Real if data_type == DataType::Real32 => Self::Real32,
            Family::Real => Self::Real64,
            Family::Time => Self::Bytes(6),
            // An empty text can be read, too.
            Family::VisibleString => Self::Characters(room(entry).max(1)),
            Family::UnicodeString => Self::WideCharacters((room(entry) / 2).max(1)),
            Family::OctetString => Self::Bytes(Some(room(entry)).filter(|room| *room > 0)?),
            Family::Domain => return None,
        })
    }

    /// The length that the stack knows, in bytes: of a string, without what ends it.
    pub(super) const fn length(self) -> u32 {
        match self {
            Self::Boolean => 1,
            Self::Integer(integer) => integer.bits as u32 / 8,
            Self::Real32 => 4,
            Self::Real64 => 8,
            Self::Bytes(length) | Self::Characters(length) => length,
            Self::WideCharacters(length) => 2 * length,
        }
    }

    /// The type of the variable, without what follows its name.
    pub(super) fn type_name(self) -> String {
        match self {
            Self::Boolean => "bool_t".to_owned(),
            Self::Integer(integer) => integer.name(),
            Self::Real32 => "float32_t".to_owned(),
            Self::Real64 => "float64_t".to_owned(),
            Self::Bytes(_) => "uint8_t".to_owned(),
            Self::Characters(_) => "char".to_owned(),
            Self::WideCharacters(_) => "uint16_t".to_owned(),
        }
    }

    /// What follows the name of the variable: `[9]`.
    pub(super) fn dimension(self) -> String {
        match self {
            Self::Boolean | Self::Integer(_) | Self::Real32 | Self::Real64 => String::new(),
            Self::Bytes(length) => format!("[{length}]"),
            Self::Characters(length) | Self::WideCharacters(length) => format!("[{}]", length + 1),
        }
    }
}

/// Bytes that a string has room for. What never changes needs as many as it has, and so do bytes of which no one
/// says how many there can be: the stack knows no shorter ones.
fn room(entry: &Entry) -> u32 {
    let length =
        entry.default.as_ref().and_then(|value| value.bytes_for(entry.data_type, 0)).map(|bytes| bytes.len());
    let is_assumed =
        entry.facts.is_said_by(Fact::Capacity, Author::Derived) && entry.data_type == DataType::OctetString;
    let room = match (length, entry.capacity) {
        (Some(length), _) if entry.access == Access::Const || is_assumed => length,
        (Some(length), None) => length,
        (_, capacity) => usize::from(capacity.unwrap_or(0)),
    };
    u32::try_from(room).unwrap_or(u32::MAX)
}
