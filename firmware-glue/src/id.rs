//! Index and sub-index.

use core::fmt;

/// Which entry of a dictionary: what an SDO client names.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct EntryId {
    /// Index of the object.
    pub index: u16,
    /// Sub-index of the entry in its object.
    pub sub: u8,
}

/// `6064h.0`: the index in hexadecimal, the sub-index in decimal.
impl fmt::Display for EntryId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:04X}h.{}", self.index, self.sub)
    }
}
