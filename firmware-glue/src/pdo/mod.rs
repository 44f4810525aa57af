//! PDOs by their mapping parameters: packing and unpacking (CiA 301 9.6.3, 1400h to 1BFFh).
//!
//! The mapping parameters in the dictionary are the only description of a PDO, so that a mapping changed over the bus works
//! like the default one. For the default mappings, the generator also prints structures with straight-line code.
//!
//! ```
//! use firmware_glue::table::{Attributes, Block, Directory, EntryRow, Flags, NONE, Parts, Pdo, Place};
//! use firmware_glue::{DataType, Dictionary, Storage, Table, TableDictionary, pdo};
//!
//! // 1400h, 1600h: RPDO 1 with COB-ID 201h, which carries 2000h.0, an UNSIGNED16. The generator makes this of a specification.
//! let entry = |data_type: DataType, flags| Attributes {
//!     data_type,
//!     flags,
//!     place: Place::Image,
//!     storage: Storage::No,
//!     page: 0,
//!     size: data_type.size().unwrap_or(0),
//!     limits: NONE,
//!     values: NONE,
//!     condition: NONE,
//! };
//! let row = |attributes, place| EntryRow { attributes, place };
//! let written = Flags::READ.with(Flags::WRITE);
//! let (mut blocks, mut seeds, mut order) = ([Block::FREE; 3], [0; 2], [0; 3]);
//! let directory = Directory::arrange(&[0x1400, 0x1600, 0x2000], &mut blocks, &mut seeds, &mut order);
//! let entries = [row(0, 0), row(1, 4), row(0, 1), row(1, 8), row(2, 2)];
//! let attributes = [
//!     entry(DataType::Unsigned8, Flags::READ),
//!     entry(DataType::Unsigned32, written),
//!     entry(DataType::Unsigned16, written.with(Flags::RECEIVE)),
//! ];
//! let table = Table::checked(Parts {
//!     directory: directory.ok_or("there is a block for each object")?,
//!     pdos: &[Pdo { index: 0x1400, cob_id: 1, mapping: 2, rows: &[4] }],
//!     first_application_row: 4,
//!     objects: &[0, 2, 4, 5],
//!     entries: &entries,
//!     attributes: &attributes,
//!     factory: &[1, 1, 0, 0, 0x01, 0x02, 0, 0, 0x10, 0, 0x00, 0x20],
//!     ..Parts::EMPTY
//! })?;
//! let mut dictionary = TableDictionary::new(&table, [0; 12], 1)?;
//!
//! let received = pdo::unpack(&mut dictionary, 1, &[0x34, 0x12], &mut ()).expect("RPDO 1 exists");
//! assert_eq!(received.refused, None);
//! assert_eq!(*dictionary.read(0x2000, 0)?, [0x34, 0x12]);
//! assert_eq!(pdo::unpack(&mut dictionary, 1, &[0x34], &mut ()), Err(pdo::PdoError::TooShort));
//! assert_eq!(pdo::pack(&mut dictionary, 1, &mut ()), Err(pdo::PdoError::NoPdo), "there is no TPDO");
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```

pub mod engine;
mod mapping;

use core::ops::Deref;

use crate::abort::AbortCode;
use crate::access::application::Application;
use crate::access::constraint::{Consistent, Constrained};
use crate::access::dictionary::Dictionary;
use crate::pdo::mapping::Mapping;
use crate::table::Table;
use crate::table::mapping::{RECEIVE, TRANSMIT};
use crate::value::number::unsigned;

/// The data of a PDO.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Frame {
    bytes: [u8; 8],
    length: u8,
}

impl Deref for Frame {
    type Target = [u8];

    fn deref(&self) -> &[u8] {
        self.bytes.get(..usize::from(self.length)).unwrap_or(&self.bytes)
    }
}

/// Why a PDO was not packed or unpacked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum PdoError {
    /// The dictionary has no PDO of this number.
    NoPdo,
    /// It does not exist at present (bit 31 of its COB-ID).
    NotValid,
    /// Its mapping is being changed, or maps what is not there.
    NotMapped,
    /// The frame is shorter than the mapping. CiA 301 asks for the emergency 8210h; nothing was stored.
    TooShort,
    /// An entry that was to be sent has no value to show.
    NoValue(AbortCode),
}

/// What became of a received PDO.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct Received<E> {
    /// The frame is longer than the mapping. CiA 301 allows for the emergency 8220h; the bytes beyond were ignored.
    pub too_long: bool,
    /// The first entry that did not take its value. Those that none refuses got theirs.
    pub refused: Option<Refused<E>>,
}

/// An entry that did not take its value from a PDO.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Refused<E> {
    /// The entry, as it is mapped.
    pub entry: E,
    /// Why: a limit, a lock, the application's veto.
    pub code: AbortCode,
}

/// A TPDO, and its mapping as it was when it was packed last: nothing is searched until the mapping changes.
#[derive(Debug, Clone)]
pub struct Tpdo {
    /// Position in [`Parts::pdos`](crate::table::Parts::pdos).
    position: usize,
    mapping: Mapping,
}

impl Tpdo {
    /// The TPDO of a number, 1 to 512, of a table.
    ///
    /// # Errors
    /// [`PdoError::NoPdo`].
    pub fn new(table: &Table<'_>, number: u16) -> Result<Self, PdoError> {
        Ok(Self { position: position(table, TRANSMIT, number)?, mapping: Mapping::NEW })
    }

    /// Its data now, by its present mapping.
    ///
    /// # Errors
    /// [`PdoError`]; never [`PdoError::TooShort`].
    #[inline]
    pub fn pack<'t, D: Dictionary<'t>, A: Application<D>>(
        &mut self,
        dictionary: &mut D,
        application: &mut A,
    ) -> Result<Frame, PdoError> {
        let pdo = dictionary.table().parts().pdos.get(self.position).ok_or(PdoError::NoPdo)?;
        self.mapping.pack(pdo, dictionary, application)
    }
}

/// An RPDO, and its mapping as it was when it was unpacked last: nothing is searched until the mapping changes.
#[derive(Debug, Clone)]
pub struct Rpdo {
    /// Position in [`Parts::pdos`](crate::table::Parts::pdos).
    position: usize,
    mapping: Mapping,
}

impl Rpdo {
    /// The RPDO of a number, 1 to 512, of a table.
    ///
    /// # Errors
    /// [`PdoError::NoPdo`].
    pub fn new(table: &Table<'_>, number: u16) -> Result<Self, PdoError> {
        Ok(Self { position: position(table, RECEIVE, number)?, mapping: Mapping::NEW })
    }

    /// Takes data by its present mapping. Every value is checked as one written by SDO is, and is left out if it is refused; the
    /// other entries of the PDO get theirs, so that a bad set-point does not hold up a controlword.
    ///
    /// # Errors
    /// [`PdoError`]; nothing was stored then.
    #[inline]
    pub fn unpack<'t, D: Dictionary<'t>, A: Application<D>>(
        &mut self,
        dictionary: &mut D,
        data: &[u8],
        application: &mut A,
    ) -> Result<Received<D::Entry>, PdoError> {
        let pdo = dictionary.table().parts().pdos.get(self.position).ok_or(PdoError::NoPdo)?;
        self.mapping.unpack(pdo, data, dictionary, application)
    }
}

/// The data of a TPDO, 1 to 512, by its present mapping. A [`Tpdo`] that is kept does the same without a search.
///
/// # Errors
/// [`PdoError`]; never [`PdoError::TooShort`].
pub fn pack<'t, D: Dictionary<'t>, A: Application<D>>(
    dictionary: &mut D,
    number: u16,
    application: &mut A,
) -> Result<Frame, PdoError> {
    Tpdo::new(dictionary.table(), number)?.pack(dictionary, application)
}

/// Takes the data of an RPDO, 1 to 512, by its present mapping, as [`Rpdo::unpack`] does. An [`Rpdo`] that is kept does the same without
/// a search.
///
/// # Errors
/// [`PdoError`]; nothing was stored then.
pub fn unpack<'t, D: Dictionary<'t>, A: Application<D>>(
    dictionary: &mut D,
    number: u16,
    data: &[u8],
    application: &mut A,
) -> Result<Received<D::Entry>, PdoError> {
    Rpdo::new(dictionary.table(), number)?.unpack(dictionary, data, application)
}

/// [`unpack`] that leaves out a value with which a condition breaks that held before, and reports it as
/// [`AbortCode::INCOMPATIBLE`].
///
/// # Errors
/// As [`unpack`].
pub fn unpack_consistent<D: Constrained, A: Application<D>>(
    dictionary: &mut D,
    number: u16,
    data: &[u8],
    application: &mut A,
) -> Result<Received<D::Entry>, PdoError> {
    unpack(dictionary, number, data, &mut Consistent(application))
}

/// Where the PDO of a number, 1 to 512, is in the list of all.
fn position(table: &Table<'_>, first: u16, number: u16) -> Result<usize, PdoError> {
    if !(1..=512).contains(&number) {
        return Err(PdoError::NoPdo);
    }
    table
        .parts()
        .pdos
        .binary_search_by_key(&(first + number - 1), |pdo| pdo.index)
        .map_err(|_| PdoError::NoPdo)
}

/// The bits of a PDO's data, from a bit on: what generated code does with values that fill no whole bytes.
#[inline]
pub fn get_bits(data: &[u8], first: u32, bits: u32) -> u64 {
    unsigned(data).checked_shr(first).unwrap_or_default() & mask(bits)
}

/// Bits in all of some mapping parameters.
pub const fn mapped_bits(mapping: &[u32]) -> usize {
    let (mut bits, mut at) = (0, 0);
    while at < mapping.len() {
        bits += (mapping[at] & 0xFF) as usize;
        at += 1;
    }
    bits
}

/// Puts bits into a PDO's data, which were 0 before.
#[inline]
pub fn put_bits<const N: usize>(data: &mut [u8; N], first: u32, bits: u32, value: u64) {
    let all = (value & mask(bits)).checked_shl(first).unwrap_or_default().to_le_bytes();
    data.iter_mut().zip(all).for_each(|(byte, new)| *byte |= new);
}

const fn mask(bits: u32) -> u64 {
    match u64::MAX.checked_shl(bits) {
        Some(above) => !above,
        None => u64::MAX,
    }
}
