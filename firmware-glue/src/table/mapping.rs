//! Where the parameters of PDOs are, and what a mapping parameter says (CiA 301 9.6.3, 1400h to 1BFFh).

use crate::table::Attributes;
use crate::value::data_type::DataType;

/// The mapping object of a PDO is this far after its communication object.
pub(crate) const MAPPING: u16 = 0x200;
/// Communication object of RPDO 1.
pub(crate) const RECEIVE: u16 = 0x1400;
/// Communication object of TPDO 1.
pub(crate) const TRANSMIT: u16 = 0x1800;
/// Bits of a CAN frame.
pub(crate) const FRAME_BITS: u32 = 64;

/// A mapping parameter, taken apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Mapped {
    pub index: u16,
    pub sub: u8,
    pub bits: u32,
}

impl Mapped {
    #[inline]
    pub(crate) fn of(parameter: u32) -> Self {
        let [bits, sub, low, high] = parameter.to_le_bytes();
        Self { index: u16::from_le_bytes([low, high]), sub, bits: bits.into() }
    }

    /// Whether it is a placeholder: a data type of 0001h to 0007h in place of an entry.
    #[inline]
    pub(crate) const fn is_dummy(self) -> bool {
        matches!(self.index, 1..=7) && self.sub == 0
    }
}

/// Bits of a value in a PDO.
#[inline]
pub(crate) fn width(shared: &Attributes) -> u32 {
    if shared.data_type == DataType::Boolean { 1 } else { u32::from(shared.size) * 8 }
}
