//! Why a store cannot be made, and why it does not store.

use core::fmt;

use crate::abort::AbortCode;

/// Why a part of a flash cannot be used.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum BadArea {
    /// The start or the size of a slot is no multiple of what the flash erases.
    EraseSize,
    /// `CHUNK` is 0, or no multiple of what the flash reads or writes, or a slot is no multiple of it.
    ChunkSize,
    /// The flash ends before the slots do.
    Capacity,
}

/// Why parameters were not stored. The next load finds those of before; or the new ones, if the flash has taken everything and only said that it had not.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum StoreError<E> {
    /// What the flash says.
    Flash(E),
    /// The record is larger than a slot.
    TooLarge,
    /// What was written is not what is read.
    NotVerified,
    /// Values of a group follow the node-ID, and the group was not loaded, so that it is unknown whose they are.
    NotLoaded,
}

/// A store that failed is a hardware error (CiA 301 9.6.3, 1010h).
impl<E> From<StoreError<E>> for AbortCode {
    fn from(error: StoreError<E>) -> Self {
        match error {
            StoreError::Flash(_) | StoreError::TooLarge | StoreError::NotVerified => Self::HARDWARE,
            StoreError::NotLoaded => Self::INTERNAL,
        }
    }
}

impl<E: fmt::Debug> fmt::Display for StoreError<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Flash(error) => write!(f, "flash: {error:?}"),
            Self::TooLarge => f.write_str("the parameters are larger than a slot"),
            Self::NotVerified => f.write_str("the parameters are not as they were written"),
            Self::NotLoaded => f.write_str("the parameters were not loaded for a node-ID"),
        }
    }
}

impl<E: fmt::Debug> core::error::Error for StoreError<E> {}
