//! Entries of a table: how they are named, found and described.

use core::fmt;
use core::ops::Range;

use crate::table::{Attributes, Flags, Limits, NONE, Place, Row, Storage, Table};
use crate::value::data_type::DataType;
use crate::value::text::prefix;

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

/// An entry, found.
#[derive(Debug, Clone, Copy)]
pub struct Found<'t> {
    /// Its row.
    pub row: Row,
    /// Low half of its offset.
    place: u16,
    /// What it is.
    pub shared: &'t Attributes,
}

impl<'t> Found<'t> {
    /// An entry with what it is and the low half of its offset.
    pub(crate) const fn new(row: Row, place: u16, shared: &'t Attributes) -> Self {
        Self { row, place, shared }
    }

    /// Its bytes in the image, with what holds the length of a string, where it is there.
    pub(crate) fn place_in_image(self) -> Option<Range<usize>> {
        let before = self.shared.data_type.string().map_or(0, prefix);
        let start = self.offset();
        (self.shared.place == Place::Image).then_some(start..start + usize::from(self.shared.size) + before)
    }

    /// Its offset in the image or in the constants.
    #[inline]
    pub(crate) fn offset(self) -> usize {
        usize::from(self.shared.page) << 16 | usize::from(self.place)
    }

    /// Its offset, if that and those of the bytes of a few entries after it are numbers of 16 bits other than
    /// [`NONE`](crate::table::NONE).
    pub(crate) fn near(self) -> Option<u16> {
        const ROOM: u16 = 0xFF;
        u16::try_from(self.offset()).ok().filter(|place| *place < NONE - ROOM)
    }
}

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
