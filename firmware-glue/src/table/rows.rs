//! What a table is made of.

use crate::table::directory::Directory;
use crate::table::flags::{Dummies, Flags};
use crate::table::view::View;
use crate::value::data_type::DataType;
use crate::value::image::NodeIdPlace;

/// Position of an entry in [`Parts::entries`]: entries by ascending index and sub-index.
pub type Row = u16;

/// "None" in the 16-bit references of [`Attributes`].
pub const NONE: u16 = u16::MAX;

/// Everything about a dictionary but the values in RAM.
#[derive(Debug, Clone, Copy)]
pub struct Parts<'t> {
    /// The indices of the objects.
    pub directory: Directory<'t>,
    /// PDOs by ascending index.
    pub pdos: &'t [Pdo<'t>],
    /// The first row at or above index 2000h: the rows before are communication objects.
    pub first_application_row: Row,
    /// The row of the first entry of each object, by ascending index, and the number of entries.
    pub objects: &'t [Row],
    /// Entries in the order of their objects.
    pub entries: &'t [EntryRow],
    /// What entries have in common; each combination once.
    pub attributes: &'t [Attributes],
    /// Objects whose sub-indices have gaps, by ascending first row.
    pub sparse: &'t [SparseObject<'t>],
    /// Views of other entries.
    pub aliases: &'t [Alias],
    /// Smallest and largest values.
    pub limits: &'t [Limits],
    /// Lists of single values, each ascending.
    pub values: &'t [&'t [i64]],
    /// Values that never change.
    pub constants: &'t [u8],
    /// The image with the values after a factory reset, for node-ID 0.
    pub factory: &'t [u8],
    /// Values that are after a factory reset what `factory` says, plus the node-ID.
    pub node_id_places: &'t [NodeIdPlace],
    /// Parts of the image that are stored together, by ascending offset.
    pub regions: &'t [Region],
    /// Smallest step of a PDO mapping in bits, 1 to 64; 0 when mappings cannot be changed.
    pub granularity: u8,
    /// Placeholders in RPDOs.
    pub dummies: Dummies,
}

impl Parts<'_> {
    /// The parts of a dictionary without entries.
    pub const EMPTY: Self = Self {
        directory: Directory::EMPTY,
        pdos: &[],
        first_application_row: 0,
        objects: &[0],
        entries: &[],
        attributes: &[],
        sparse: &[],
        aliases: &[],
        limits: &[],
        values: &[],
        constants: &[],
        factory: &[],
        node_id_places: &[],
        regions: &[],
        granularity: 8,
        dummies: Dummies::NONE,
    };
}

/// A PDO and its default mapping.
#[derive(Debug, Clone, Copy)]
pub struct Pdo<'t> {
    /// Index of its communication object: 1400h to 15FFh, 1800h to 19FFh.
    pub index: u16,
    /// Row of its COB-ID.
    pub cob_id: Row,
    /// Row of the number of mapped entries; the mapping parameters follow.
    pub mapping: Row,
    /// Rows that are mapped after a factory reset; none when placeholders are mapped, too.
    pub rows: &'t [Row],
}

/// An entry.
#[derive(Debug, Clone, Copy)]
pub struct EntryRow {
    /// Position in [`Parts::attributes`].
    pub attributes: u16,
    /// Low half of the offset in the image or in the constants; position in [`Parts::aliases`].
    pub place: u16,
}

/// Entries from their attributes and places in turn.
pub const fn entries<const N: usize>(numbers: &[u16]) -> [EntryRow; N] {
    let mut rows = [EntryRow { attributes: 0, place: 0 }; N];
    let mut at = 0;
    while at < N {
        rows[at] = EntryRow { attributes: numbers[2 * at], place: numbers[2 * at + 1] };
        at += 1;
    }
    rows
}

/// An object whose sub-indices are not 0, 1, 2…
#[derive(Debug, Clone, Copy)]
pub struct SparseObject<'t> {
    /// Row of its first entry.
    pub first: Row,
    /// Its sub-indices, ascending.
    pub subs: &'t [u8],
}

/// A view of another entry.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Alias {
    /// The entry that holds the value.
    pub target: Row,
    /// How the value is shown.
    pub view: View,
}

/// What an entry is, apart from its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Attributes {
    /// Data type.
    pub data_type: DataType,
    /// Access, mapping and more.
    pub flags: Flags,
    /// Where the value lies.
    pub place: Place,
    /// What keeps the value.
    pub storage: Storage,
    /// High half of the offset.
    pub page: u8,
    /// Bytes of the value; of a string, the most that it can have; 0 of a DOMAIN.
    pub size: u16,
    /// Position in [`Parts::limits`], or [`NONE`].
    pub limits: u16,
    /// Position in [`Parts::values`], or [`NONE`]: with [`Flags::ONLY_VALUES`] the only values that can be written, else
    /// values that can be written outside the limits.
    pub values: u16,
    /// Number of the write condition, or [`NONE`].
    pub condition: u16,
}

/// Smallest and largest value that can be written. Of UNSIGNED64, the numbers minus 2^63; of REAL, the bits without the sign,
/// negative where the number is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Limits {
    /// Smallest.
    pub low: i64,
    /// Largest.
    pub high: i64,
}

/// A part of the image that is stored together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Region {
    /// What it holds.
    pub storage: Storage,
    /// First byte in the image.
    pub start: u32,
    /// Byte after the last.
    pub end: u32,
    /// Changes whenever another set of entries, types or places is in the region: data stored under one number must not be
    /// restored under another.
    pub layout: u32,
}

impl Region {
    /// Its bytes in the image.
    pub(crate) fn range(&self) -> core::ops::Range<usize> {
        let place = |offset: u32| usize::try_from(offset).unwrap_or(usize::MAX);
        place(self.start)..place(self.end)
    }
}

/// Where a value lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub enum Place {
    /// In the image.
    Image,
    /// In [`Parts::constants`].
    Constant,
    /// It is another view of the target of an [`Alias`].
    Alias,
    /// With the application: a DOMAIN.
    Application,
}

/// What keeps a value over power-off.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u8)]
pub enum Storage {
    /// Nothing.
    No,
    /// "Store communication parameters", 1010h.2.
    Communication,
    /// "Store application parameters", 1010h.3.
    Application,
    /// Parameters of the manufacturer's choice, 1010h.4 and above.
    Manufacturer,
    /// The device itself, without a command.
    Remanent,
}
