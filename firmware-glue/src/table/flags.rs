//! Sets of yes-or-no facts in a table, one bit each.

use crate::value::data_type::DataType;

/// Access, PDO mapping and how to read the rest of [`Attributes`](crate::table::Attributes).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Flags(u8);

impl Flags {
    /// None of them.
    pub const NONE: Self = Self(0);
    /// An SDO client can read the entry.
    pub const READ: Self = Self(1 << 0);
    /// An SDO client can write the entry.
    pub const WRITE: Self = Self(1 << 1);
    /// Writable only while the device is unlocked for service.
    pub const LOCKED: Self = Self(1 << 2);
    /// RPDOs can carry it.
    pub const RECEIVE: Self = Self(1 << 3);
    /// TPDOs can carry it.
    pub const TRANSMIT: Self = Self(1 << 4);
    /// Its object is in [`Parts::sparse`](crate::table::Parts::sparse).
    pub const SPARSE: Self = Self(1 << 5);
    /// [`Attributes::values`](crate::table::Attributes::values) are the only values.
    pub const ONLY_VALUES: Self = Self(1 << 6);

    /// These flags and more.
    pub const fn with(self, more: Self) -> Self {
        Self(self.0 | more.0)
    }

    /// Those of some flags that are set.
    #[inline]
    pub(crate) const fn of(self, some: Self) -> Self {
        Self(self.0 & some.0)
    }

    /// Whether all of some flags are set.
    #[inline]
    pub const fn has(self, all: Self) -> bool {
        self.0 & all.0 == all.0
    }
}

/// Data types 0001h to 0007h that may be in an RPDO as placeholders for bits that the device does not use.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Dummies(u8);

impl Dummies {
    /// No placeholders.
    pub const NONE: Self = Self(0);

    /// These and another one; a data type other than 0001h to 0007h changes nothing.
    pub const fn with(self, data_type: DataType) -> Self {
        match data_type as u8 {
            code @ 1..=7 => Self(self.0 | 1 << code),
            _ => self,
        }
    }

    /// Whether the data type at an index, 1 to 7, may be in an RPDO.
    pub(crate) const fn has(self, index: u16) -> bool {
        matches!(index, 1..=7) && self.0 & 1 << index != 0
    }
}
