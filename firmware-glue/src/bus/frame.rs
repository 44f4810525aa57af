//! A CAN frame, as every service of CANopen sends and takes it.

use core::fmt;

/// An identifier of 11 bits. CANopen's own services use no other (CiA 301 7.1).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CanId(u16);

impl CanId {
    /// The lowest identifier, that of NMT commands.
    pub const ZERO: Self = Self(0);

    /// The highest identifier.
    pub const MAX: Self = Self(0x7FF);

    /// An identifier, if it has no more than 11 bits.
    #[must_use]
    pub const fn new(id: u16) -> Option<Self> {
        if id <= Self::MAX.0 { Some(Self(id)) } else { None }
    }

    /// The identifier as a number, 0 to 7FFh.
    #[must_use]
    pub const fn get(self) -> u16 {
        self.0
    }
}

/// `601h`.
impl fmt::Display for CanId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:03X}h", self.0)
    }
}

/// What a frame carries.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
enum Content {
    /// Up to eight bytes; those after the length are 0.
    Data { bytes: [u8; 8], length: u8 },
    /// A remote frame (RTR): a request for a data frame of that length.
    Remote { length: u8 },
}

/// A frame of classical CAN with an identifier of 11 bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Frame {
    id: CanId,
    content: Content,
}

impl Frame {
    /// A data frame, if there are no more than eight bytes.
    #[must_use]
    pub fn data(id: CanId, data: &[u8]) -> Option<Self> {
        let mut bytes = [0; 8];
        bytes.get_mut(..data.len())?.copy_from_slice(data);
        let length = u8::try_from(data.len()).ok()?;
        Some(Self { id, content: Content::Data { bytes, length } })
    }

    /// A data frame of eight bytes, as SDO and EMCY have it.
    #[must_use]
    pub const fn full(id: CanId, bytes: [u8; 8]) -> Self {
        Self { id, content: Content::Data { bytes, length: 8 } }
    }

    /// A remote frame that asks for a data frame of a length, if that is no more than eight.
    #[must_use]
    pub const fn remote(id: CanId, length: u8) -> Option<Self> {
        if length <= 8 { Some(Self { id, content: Content::Remote { length } }) } else { None }
    }

    /// The identifier.
    #[must_use]
    pub const fn id(&self) -> CanId {
        self.id
    }

    /// The bytes of a data frame; nothing for a remote frame.
    #[must_use]
    pub fn bytes(&self) -> Option<&[u8]> {
        match &self.content {
            Content::Data { bytes, length } => bytes.get(..usize::from(*length)),
            Content::Remote { .. } => None,
        }
    }

    /// The bytes of a data frame that has all eight.
    #[inline]
    pub(crate) const fn all_eight(&self) -> Option<&[u8; 8]> {
        match &self.content {
            Content::Data { bytes, length: 8 } => Some(bytes),
            Content::Data { .. } | Content::Remote { .. } => None,
        }
    }

    /// Length of the data that a frame carries or, if it is a remote frame, asks for: 0 to 8 bytes.
    #[must_use]
    pub const fn length(&self) -> u8 {
        match self.content {
            Content::Data { length, .. } | Content::Remote { length } => length,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{CanId, Frame};

    #[test]
    fn an_identifier_has_11_bits() {
        assert_eq!(CanId::new(0x7FF), Some(CanId::MAX));
        assert_eq!(CanId::new(0x800), None);
    }

    #[test]
    fn a_frame_has_no_more_than_8_bytes() {
        let data = Frame::data(CanId::MAX, &[1, 2, 3]).expect("three bytes");
        assert_eq!((data.bytes(), data.length()), (Some(&[1, 2, 3][..]), 3));
        assert_eq!(Frame::data(CanId::MAX, &[0; 9]), None);
        assert_eq!(Frame::remote(CanId::MAX, 9), None);
        let remote = Frame::remote(CanId::MAX, 8).expect("eight bytes");
        assert_eq!((remote.bytes(), remote.length()), (None, 8));
    }
}
