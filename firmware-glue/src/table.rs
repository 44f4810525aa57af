//! The table of a dictionary: what every entry is and where its value lies. Generated, constant, in flash.

use crate::abort::AbortCode;
use crate::alias::Alias;
use crate::image::NodeIdPlace;

/// Position of an entry in [`Table::entries`]: entries by ascending index and sub-index.
pub type Row = u16;

/// "None" in the 16-bit references of [`Attributes`].
pub const NONE: u16 = u16::MAX;

/// Everything about a dictionary but the values in RAM.
#[derive(Debug)]
pub struct Table {
    /// Objects whose indices follow each other without a gap, by ascending index, and one that ends them: index FFFFh and
    /// the number of objects.
    pub runs: &'static [Run],
    /// PDOs by ascending index.
    pub pdos: &'static [Pdo],
    /// The first row at or above index 2000h: the rows before are communication objects.
    pub first_application_row: Row,
    /// The row of the first entry of each object, by ascending index, and the number of entries.
    pub objects: &'static [Row],
    /// Entries in the order of their objects.
    pub entries: &'static [EntryRow],
    /// What entries have in common; each combination once.
    pub attributes: &'static [Attributes],
    /// Objects whose sub-indices have gaps, by ascending first row.
    pub sparse: &'static [SparseObject],
    /// Views of other entries.
    pub aliases: &'static [Alias],
    /// Smallest and largest values.
    pub limits: &'static [Limits],
    /// Lists of single values, each ascending.
    pub values: &'static [&'static [i64]],
    /// Values that never change.
    pub constants: &'static [u8],
    /// The image with the values after a factory reset, for node-ID 0.
    pub factory: &'static [u8],
    /// Values that are after a factory reset what `factory` says, plus the node-ID.
    pub node_id_places: &'static [NodeIdPlace],
    /// Parts of the image that are stored together, by ascending offset.
    pub regions: &'static [Region],
    /// Smallest step of a PDO mapping in bits.
    pub granularity: u8,
    /// Data types 0001h to 0007h that may stand in an RPDO as placeholders: bit n for type n.
    pub dummies: u8,
}

/// Objects with consecutive indices.
#[derive(Debug, Clone, Copy)]
pub struct Run {
    /// Index of the first.
    pub index: u16,
    /// Its position in [`Table::objects`].
    pub object: u16,
}

/// A PDO and its default mapping.
#[derive(Debug, Clone, Copy)]
pub struct Pdo {
    /// Index of its communication object.
    pub index: u16,
    /// Row of its COB-ID.
    pub cob_id: Row,
    /// Row of the number of mapped entries.
    pub mapping: Row,
    /// Rows that are mapped after a factory reset.
    pub rows: &'static [Row],
}

/// An entry, found.
#[derive(Debug, Clone, Copy)]
pub struct Found {
    /// Its row.
    pub row: Row,
    /// Low half of its offset.
    pub(crate) place: u16,
    /// What it is.
    pub shared: &'static Attributes,
}

impl Found {
    /// Its offset in the image or in the constants.
    #[inline]
    pub(crate) fn offset(self) -> usize {
        usize::from(self.shared.page) << 16 | usize::from(self.place)
    }
}

/// An entry.
#[derive(Debug, Clone, Copy)]
pub struct EntryRow {
    /// Position in [`Table::attributes`].
    pub attributes: u16,
    /// Low half of the offset in the image or in the constants; position in [`Table::aliases`].
    pub place: u16,
}

/// Entries from pairs of attributes and place.
pub const fn entries<const N: usize>(pairs: [[u16; 2]; N]) -> [EntryRow; N] {
    let mut rows = [EntryRow { attributes: 0, place: 0 }; N];
    let mut at = 0;
    while at < N {
        let [attributes, place] = pairs[at];
        rows[at] = EntryRow { attributes, place };
        at += 1;
    }
    rows
}

/// An object whose sub-indices are not 0, 1, 2…
#[derive(Debug, Clone, Copy)]
pub struct SparseObject {
    /// Row of its first entry.
    pub first: Row,
    /// Its sub-indices, ascending.
    pub subs: &'static [u8],
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
    /// Bytes of the value; of a string, the most that it can have.
    pub size: u16,
    /// Position in [`Table::limits`], or [`NONE`].
    pub limits: u16,
    /// Position in [`Table::values`], or [`NONE`]: with [`Flags::ONLY_VALUES`] the only values that can be written, else
    /// values that can be written outside the limits.
    pub values: u16,
    /// Number of the write condition, or [`NONE`].
    pub condition: u16,
}

/// Smallest and largest value that can be written. Of UNSIGNED64, the numbers minus 2^63.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
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

/// Where a value lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub enum Place {
    /// In the image.
    Image,
    /// In [`Table::constants`].
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

/// Access, PDO mapping and how to read the rest of [`Attributes`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Flags(pub u8);

impl Flags {
    /// An SDO client can read the entry.
    pub const READ: u8 = 1 << 0;
    /// An SDO client can write the entry.
    pub const WRITE: u8 = 1 << 1;
    /// Writable only while the device is unlocked for service.
    pub const LOCKED: u8 = 1 << 2;
    /// RPDOs can carry it.
    pub const RECEIVE: u8 = 1 << 3;
    /// TPDOs can carry it.
    pub const TRANSMIT: u8 = 1 << 4;
    /// Its object is in [`Table::sparse`].
    pub const SPARSE: u8 = 1 << 5;
    /// [`Attributes::values`] are the only values.
    pub const ONLY_VALUES: u8 = 1 << 6;

    /// Whether all flags of the mask are set.
    #[inline]
    pub const fn has(self, mask: u8) -> bool {
        self.0 & mask == mask
    }
}

/// Data type, by its index in the dictionary (CiA 301 table 39).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u8)]
#[expect(missing_docs, reason = "the names are those of the standard")]
pub enum DataType {
    Boolean = 0x01,
    Integer8 = 0x02,
    Integer16 = 0x03,
    Integer32 = 0x04,
    Unsigned8 = 0x05,
    Unsigned16 = 0x06,
    Unsigned32 = 0x07,
    Real32 = 0x08,
    VisibleString = 0x09,
    OctetString = 0x0A,
    UnicodeString = 0x0B,
    TimeOfDay = 0x0C,
    TimeDifference = 0x0D,
    Domain = 0x0F,
    Integer24 = 0x10,
    Real64 = 0x11,
    Integer40 = 0x12,
    Integer48 = 0x13,
    Integer56 = 0x14,
    Integer64 = 0x15,
    Unsigned24 = 0x16,
    Unsigned40 = 0x18,
    Unsigned48 = 0x19,
    Unsigned56 = 0x1A,
    Unsigned64 = 0x1B,
}

impl DataType {
    /// Whether it is an INTEGERn.
    pub const fn is_signed(self) -> bool {
        matches!(
            self,
            Self::Integer8
                | Self::Integer16
                | Self::Integer24
                | Self::Integer32
                | Self::Integer40
                | Self::Integer48
                | Self::Integer56
                | Self::Integer64
        )
    }

    /// Whether it is a string, whose length varies up to its capacity.
    pub const fn is_string(self) -> bool {
        matches!(self, Self::VisibleString | Self::OctetString | Self::UnicodeString)
    }

    /// Whether it is a number that limits and lists of values are about: INTEGERn or UNSIGNEDn.
    pub const fn is_integer(self) -> bool {
        self.is_signed()
            || matches!(
                self,
                Self::Unsigned8
                    | Self::Unsigned16
                    | Self::Unsigned24
                    | Self::Unsigned32
                    | Self::Unsigned40
                    | Self::Unsigned48
                    | Self::Unsigned56
                    | Self::Unsigned64
            )
    }
}

impl Table {
    /// The row of an entry.
    #[inline]
    pub fn find(&self, index: u16, sub: u8) -> Result<Row, AbortCode> {
        self.lookup(index, sub).map(|found| found.row)
    }

    /// The rows of an object: the first, and the one after the last.
    #[inline]
    pub(crate) fn object(&self, index: u16) -> Result<(Row, Row), AbortCode> {
        let after = self.runs.partition_point(|run| run.index <= index);
        let (Some(run), Some(next)) =
            (after.checked_sub(1).and_then(|at| self.runs.get(at)), self.runs.get(after))
        else {
            return Err(AbortCode::NO_OBJECT);
        };
        let object = usize::from(run.object) + usize::from(index - run.index);
        if object >= usize::from(next.object) {
            return Err(AbortCode::NO_OBJECT);
        }
        match self.objects.get(object..).and_then(<[Row]>::first_chunk::<2>) {
            Some([first, end]) => Ok((*first, *end)),
            None => Err(AbortCode::NO_OBJECT),
        }
    }

    /// An entry.
    #[inline]
    pub fn lookup(&self, index: u16, sub: u8) -> Result<Found, AbortCode> {
        let (first, end) = self.object(index)?;
        let row = first.saturating_add(u16::from(sub));
        if row < end {
            let found = self.found(row);
            if !found.shared.flags.has(Flags::SPARSE) {
                return Ok(found);
            }
        }
        self.find_sparse(first, sub)
    }

    /// What is in a row.
    #[inline]
    pub(crate) fn found(&self, row: Row) -> Found {
        let EntryRow { attributes, place } = self.row(row);
        Found { row, place, shared: self.attributes.get(usize::from(attributes)).unwrap_or(&NOTHING) }
    }

    #[cold]
    fn find_sparse(&self, first: Row, sub: u8) -> Result<Found, AbortCode> {
        let object = self.sparse.binary_search_by_key(&first, |object| object.first);
        let subs = object.ok().and_then(|at| self.sparse.get(at)).map_or(&[][..], |object| object.subs);
        match subs.binary_search(&sub) {
            Ok(at) => Ok(self.found(first + u16::try_from(at).unwrap_or_default())),
            Err(_) => Err(AbortCode::NO_SUB_INDEX),
        }
    }

    /// Index and sub-index of a row.
    pub fn id(&self, row: Row) -> (u16, u8) {
        let after = self.objects.partition_point(|first| *first <= row);
        let Some((at, first)) = after.checked_sub(1).and_then(|at| Some((at, *self.objects.get(at)?))) else {
            return (0, 0);
        };
        let Some(run) = self
            .runs
            .partition_point(|run| usize::from(run.object) <= at)
            .checked_sub(1)
            .and_then(|at| self.runs.get(at))
        else {
            return (0, 0);
        };
        // The end of the list stands for rows that nothing has.
        if self.entries.get(usize::from(row)).is_none() {
            return (0, 0);
        }
        let index = run.index + (u16::try_from(at).unwrap_or_default() - run.object);
        let distance = row - first;
        let sub = if self.attributes(row).flags.has(Flags::SPARSE) {
            let sparse = self.sparse.binary_search_by_key(&first, |object| object.first);
            let subs = sparse.ok().and_then(|at| self.sparse.get(at)).map(|object| object.subs);
            subs.and_then(|subs| subs.get(usize::from(distance))).copied().unwrap_or_default()
        } else {
            u8::try_from(distance).unwrap_or_default()
        };
        (index, sub)
    }

    /// What an entry is.
    #[inline]
    pub fn attributes(&self, row: Row) -> &'static Attributes {
        self.found(row).shared
    }

    #[inline]
    fn row(&self, row: Row) -> EntryRow {
        self.entries.get(usize::from(row)).copied().unwrap_or(EntryRow { attributes: NONE, place: 0 })
    }

    /// The alias behind an entry.
    pub(crate) fn alias(&self, row: Row) -> Option<&'static Alias> {
        self.aliases.get(usize::from(self.row(row).place))
    }

    /// The parts of the image that are stored.
    pub fn region(&self, storage: Storage) -> Option<&'static Region> {
        self.regions.iter().find(|region| region.storage == storage)
    }
}

/// What a row outside the table is: nothing that could be read or written.
static NOTHING: Attributes = Attributes {
    data_type: DataType::Domain,
    flags: Flags(0),
    place: Place::Application,
    storage: Storage::No,
    page: 0,
    size: 0,
    limits: NONE,
    values: NONE,
    condition: NONE,
};
