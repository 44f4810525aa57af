//! Values of the data types of CiA 301: as bytes, as numbers, with units and names.

pub(crate) mod data_type;
pub mod image;
pub mod named;
pub(crate) mod number;
pub mod quantity;
pub(crate) mod special;
pub mod text;
pub(crate) mod time;

use core::ops::Deref;

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
