//! What a table tells about an entry.

use crate::data_type::DataType;
use crate::id::EntryId;
use crate::table::{Attributes, Flags, Found, Limits, Place, Row, Storage, Table};

/// What is known about an entry.
#[derive(Debug, Clone, Copy)]
pub struct Info<'t> {
    table: &'t Table<'t>,
    row: Row,
    shared: &'t Attributes,
}

impl<'t> Info<'t> {
    /// What is known about the entry of a row.
    #[inline]
    pub fn new(table: &'t Table<'t>, row: Row) -> Self {
        Self { table, row, shared: table.attributes(row) }
    }

    /// What is known about an entry that was found.
    #[inline]
    pub(crate) fn of(table: &'t Table<'t>, found: Found<'t>) -> Self {
        Self { table, row: found.row, shared: found.shared }
    }

    /// Index and sub-index.
    pub fn id(&self) -> EntryId {
        self.table.id(self.row)
    }

    /// Data type.
    pub const fn data_type(&self) -> DataType {
        self.shared.data_type
    }

    /// Bytes of a value; of a string, the most that it can have; 0 of a DOMAIN.
    pub const fn size(&self) -> u16 {
        self.shared.size
    }

    /// Whether an SDO client can read it.
    pub const fn is_readable(&self) -> bool {
        self.shared.flags.has(Flags::READ)
    }

    /// Whether an SDO client can write it (in some state of the device).
    pub const fn is_writable(&self) -> bool {
        self.shared.flags.has(Flags::WRITE)
    }

    /// Whether it can be written only while the device is unlocked for service.
    pub const fn is_locked(&self) -> bool {
        self.shared.flags.has(Flags::LOCKED)
    }

    /// Whether RPDOs can carry it.
    pub const fn is_receivable(&self) -> bool {
        self.shared.flags.has(Flags::RECEIVE)
    }

    /// Whether TPDOs can carry it.
    pub const fn is_transmittable(&self) -> bool {
        self.shared.flags.has(Flags::TRANSMIT)
    }

    /// What keeps its value over power-off.
    pub const fn storage(&self) -> Storage {
        self.shared.storage
    }

    /// Whether it is a view of another entry.
    pub const fn is_alias(&self) -> bool {
        matches!(self.shared.place, Place::Alias)
    }

    /// Smallest and largest value that can be written, where there are limits. Of UNSIGNED64, the numbers minus 2^63; of REAL, the bits
    /// without the sign, negative where the number is.
    pub fn limits(&self) -> Option<Limits> {
        self.table.parts().limits.get(usize::from(self.shared.limits)).copied()
    }
}
