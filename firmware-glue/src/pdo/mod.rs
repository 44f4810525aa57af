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

#![expect(
    clippy::inline_always,
    reason = "not inlined, packing takes four times as long: it waits for its own stores"
)]

pub mod engine;

use core::ops::Deref;

use crate::abort::AbortCode;
use crate::access::application::Application;
use crate::access::communication::cob_id::NOT_VALID;
use crate::access::constraint::{Consistent, Constrained};
use crate::access::dictionary::{Dictionary, write_row};
use crate::table::mapping::{FRAME_BITS, Mapped, RECEIVE, TRANSMIT, width};
use crate::table::stored::{at_row, value_of};
use crate::table::{Found, Place, Row, Table};
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

/// The data of a TPDO, 1 to 512, by its present mapping.
///
/// # Errors
/// [`PdoError`]; never [`PdoError::TooShort`].
pub fn pack<'t, D: Dictionary<'t>, A: Application<D>>(
    dictionary: &mut D,
    number: u16,
    application: &mut A,
) -> Result<Frame, PdoError> {
    let table = dictionary.table();
    let mapping = Mapping::of(dictionary, TRANSMIT, number)?;
    let (mut data, mut length) = (0u64, 0u32);
    for at in 0..mapping.count {
        let Field { found, bits } = mapping.field(dictionary, at)?;
        let Some(found) = found else { return Err(PdoError::NotMapped) };
        if let Some(entry) = dictionary.entry(table.holder(found.row)) {
            application.refresh(dictionary, entry);
        }
        let bytes = value_of(table, dictionary.image(), found).map_err(PdoError::NoValue)?;
        if length + bits > FRAME_BITS {
            return Err(PdoError::NotMapped);
        }
        data |= (unsigned(&bytes) & mask(bits)).checked_shl(length).unwrap_or_default();
        length += bits;
    }
    let length = u8::try_from(length.div_ceil(8)).unwrap_or(8);
    Ok(Frame { bytes: data.to_le_bytes(), length })
}

/// Takes the data of an RPDO, 1 to 512, by its present mapping. Every value is checked as one written by SDO is, and is left
/// out if it is refused; the other entries of the PDO get theirs, so that a bad set-point does not hold up a controlword.
///
/// # Errors
/// [`PdoError`]; nothing was stored then.
pub fn unpack<'t, D: Dictionary<'t>, A: Application<D>>(
    dictionary: &mut D,
    number: u16,
    data: &[u8],
    application: &mut A,
) -> Result<Received<D::Entry>, PdoError> {
    let mapping = Mapping::of(dictionary, RECEIVE, number)?;
    let bytes = mapping.length(dictionary)?;
    if data.len() < bytes {
        return Err(PdoError::TooShort);
    }
    let mut received = Received { too_long: data.len() > bytes, refused: None };
    let mut rest = unsigned(data.get(..bytes).unwrap_or(data));
    for at in 0..mapping.count {
        let Field { found, bits } = mapping.field(dictionary, at)?;
        let number = (rest & mask(bits)).to_le_bytes();
        rest = rest.checked_shr(bits).unwrap_or_default();
        let Some(found) = found else { continue };
        let size = usize::from(found.shared.size).min(8);
        let value = number.get(..size).unwrap_or(&number);
        if let Err(code) = write_row(dictionary, found, value, application)
            && let (None, Some(entry)) = (received.refused, dictionary.entry(found.row))
        {
            received.refused = Some(Refused { entry, code });
        }
    }
    Ok(received)
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

/// Bytes that the data of an RPDO, 1 to 512, has to have by its present mapping.
///
/// # Errors
/// [`PdoError`], of what does not depend on data and values.
pub(crate) fn received_length<'t, D: Dictionary<'t>>(dictionary: &D, number: u16) -> Result<usize, PdoError> {
    Mapping::of(dictionary, RECEIVE, number)?.length(dictionary)
}

/// Whether a TPDO, 1 to 512, carries an entry or a view of it.
pub(crate) fn carries<'t, D: Dictionary<'t>>(dictionary: &D, number: u16, row: Row) -> bool {
    let Ok(mapping) = Mapping::of(dictionary, TRANSMIT, number) else { return false };
    (0..mapping.count).any(|at| {
        let found = mapping.field(dictionary, at).ok().and_then(|field| field.found);
        found.is_some_and(|found| dictionary.table().holder(found.row) == row)
    })
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

/// The mapping of a PDO now.
#[derive(Clone, Copy)]
struct Mapping<'t> {
    /// Row of the number of entries; their parameters follow.
    number: Row,
    count: u8,
    /// The rows that are mapped, as long as the mapping is the default one: then nothing has to be searched.
    rows: Option<&'t [Row]>,
}

/// What is mapped at a position, and its bits; no entry for a placeholder.
struct Field<'t> {
    found: Option<Found<'t>>,
    bits: u32,
}

impl<'t> Mapping<'t> {
    /// The mapping of a PDO that exists now.
    #[inline(always)]
    fn of<D: Dictionary<'t>>(dictionary: &D, first: u16, number: u16) -> Result<Self, PdoError> {
        if !(1..=512).contains(&number) {
            return Err(PdoError::NoPdo);
        }
        let (table, image) = (dictionary.table(), dictionary.image());
        let (pdos, index) = (table.parts().pdos, first + number - 1);
        let at = pdos.binary_search_by_key(&index, |pdo| pdo.index).map_err(|_| PdoError::NoPdo)?;
        let pdo = pdos.get(at).ok_or(PdoError::NoPdo)?;
        let cob_id = at_row(table, image, table.found(pdo.cob_id)).ok_or(PdoError::NoPdo)?;
        if cob_id & NOT_VALID != 0 {
            return Err(PdoError::NotValid);
        }
        let count = at_row(table, image, table.found(pdo.mapping)).and_then(|count| u8::try_from(count).ok());
        let Some(count @ 1..=64) = count else { return Err(PdoError::NotMapped) };
        let rows = Some(pdo.rows).filter(|rows| {
            let first = table.found(pdo.mapping.saturating_add(1));
            rows.len() == usize::from(count) && is_default(table, image, first, count)
        });
        Ok(Self { number: pdo.mapping, count, rows })
    }

    /// A mapping parameter.
    #[inline(always)]
    fn parameter<D: Dictionary<'t>>(self, dictionary: &D, at: u8) -> Result<u32, PdoError> {
        let row = self.number.saturating_add(1 + Row::from(at));
        let table = dictionary.table();
        at_row(table, dictionary.image(), table.found(row)).ok_or(PdoError::NotMapped)
    }

    /// The entry at a position of the default mapping.
    #[inline(always)]
    fn default(table: &Table<'t>, rows: &[Row], at: u8) -> Found<'t> {
        table.found(rows.get(usize::from(at)).copied().unwrap_or(Row::MAX))
    }

    /// What is mapped at a position.
    #[inline(always)]
    fn field<D: Dictionary<'t>>(self, dictionary: &D, at: u8) -> Result<Field<'t>, PdoError> {
        if let Some(rows) = self.rows {
            let found = Self::default(dictionary.table(), rows, at);
            return Ok(Field { found: Some(found), bits: width(found.shared) });
        }
        let mapped = Mapped::of(self.parameter(dictionary, at)?);
        if mapped.is_dummy() {
            return Ok(Field { found: None, bits: mapped.bits });
        }
        let found = dictionary.table().search(mapped.index, mapped.sub).map_err(|_| PdoError::NotMapped)?;
        Ok(Field { found: Some(found), bits: mapped.bits })
    }

    /// Bytes of all that is mapped.
    #[inline(always)]
    fn length<D: Dictionary<'t>>(self, dictionary: &D) -> Result<usize, PdoError> {
        let mut bits = 0;
        for at in 0..self.count {
            bits += self.bits(dictionary, at)?;
        }
        if bits > FRAME_BITS {
            return Err(PdoError::NotMapped);
        }
        Ok(usize::try_from(bits.div_ceil(8)).unwrap_or(usize::MAX))
    }

    /// The bits of what is mapped at a position.
    #[inline(always)]
    fn bits<D: Dictionary<'t>>(self, dictionary: &D, at: u8) -> Result<u32, PdoError> {
        if let Some(rows) = self.rows {
            return Ok(width(Self::default(dictionary.table(), rows, at).shared));
        }
        Ok(Mapped::of(self.parameter(dictionary, at)?).bits)
    }
}

/// Whether mapping parameters are those of the factory; constant ones are.
#[inline]
fn is_default(table: &Table<'_>, image: &[u8], first: Found<'_>, count: u8) -> bool {
    if first.shared.place == Place::Constant {
        return true;
    }
    let part = first.offset()..first.offset() + 4 * usize::from(count);
    match (image.get(part.clone()), table.parts().factory.get(part)) {
        // Word by word: for a few, a call of `memcmp` takes longer.
        (Some(now), Some(factory)) => now.as_chunks::<4>().0.iter().eq(factory.as_chunks::<4>().0),
        _ => false,
    }
}

const fn mask(bits: u32) -> u64 {
    match u64::MAX.checked_shl(bits) {
        Some(above) => !above,
        None => u64::MAX,
    }
}
