//! PDOs by their mapping parameters: packing, unpacking, and the rules of changing a mapping (CiA 301 9.6.3, 1400h to 1BFFh).
//!
//! The mapping parameters in the dictionary are the only description of a PDO, so that a mapping changed over the bus works
//! like the default one. For the default mappings, the generator also prints structures with straight-line code.

#![expect(
    clippy::inline_always,
    reason = "not inlined, packing takes four times as long: it waits for its own stores"
)]

use core::ops::Deref;

use crate::abort::AbortCode;
use crate::application::Application;
use crate::communication::{NOT_VALID, at_row, check_cob_id, current};
use crate::dictionary::{Dictionary, holder, value_of, write_row};
use crate::image::unsigned;
use crate::table::{Attributes, DataType, Flags, Found, Place, Row, Table};

/// The mapping object of a PDO is this far behind its communication object.
const MAPPING: u16 = 0x200;
/// Communication object of RPDO 1.
const RECEIVE: u16 = 0x1400;
/// Communication object of TPDO 1.
const TRANSMIT: u16 = 0x1800;
/// Bits of a CAN frame.
const FRAME_BITS: u32 = 64;
/// Bit 30 of a TPDO's COB-ID: no remote frames; reserved in an RPDO's.
const NO_REMOTE_FRAMES: u32 = 1 << 30;

/// The data of a PDO.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
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
pub struct Received<E> {
    /// The frame is longer than the mapping. CiA 301 allows for the emergency 8220h; the bytes beyond were ignored.
    pub too_long: bool,
    /// The first entry that did not take its value (a limit, a lock, the application's veto), and why. The others got
    /// theirs.
    pub refused: Option<(E, AbortCode)>,
}

/// The data of a TPDO, 1 to 512, by its present mapping.
///
/// # Errors
/// [`PdoError`]; never [`PdoError::TooShort`].
pub fn pack<D: Dictionary, A: Application<D>>(
    dictionary: &mut D,
    number: u16,
    application: &mut A,
) -> Result<Frame, PdoError> {
    let mapping = Mapping::of(dictionary, TRANSMIT, number)?;
    let (mut data, mut length) = (0u64, 0u32);
    for at in 0..mapping.count {
        let (found, bits) = mapping.mapped(dictionary, at)?;
        let Some(found) = found else { return Err(PdoError::NotMapped) };
        if let Some(entry) = D::entry(holder(D::TABLE, found.row)) {
            application.refresh(dictionary, entry);
        }
        let bytes = value_of(D::TABLE, dictionary.image(), found).map_err(PdoError::NoValue)?;
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
pub fn unpack<D: Dictionary, A: Application<D>>(
    dictionary: &mut D,
    number: u16,
    data: &[u8],
    application: &mut A,
) -> Result<Received<D::Entry>, PdoError> {
    let mapping = Mapping::of(dictionary, RECEIVE, number)?;
    let mut length = 0;
    for at in 0..mapping.count {
        length += mapping.mapped_bits(dictionary, at)?;
    }
    let bytes = usize::try_from(length.div_ceil(8)).unwrap_or(usize::MAX);
    if length > FRAME_BITS {
        return Err(PdoError::NotMapped);
    }
    if data.len() < bytes {
        return Err(PdoError::TooShort);
    }
    let mut received = Received { too_long: data.len() > bytes, refused: None };
    let mut rest = unsigned(data.get(..bytes).unwrap_or(data));
    for at in 0..mapping.count {
        let (found, bits) = mapping.mapped(dictionary, at)?;
        let number = (rest & mask(bits)).to_le_bytes();
        rest = rest.checked_shr(bits).unwrap_or_default();
        let Some(found) = found else { continue };
        let size = usize::from(found.shared.size).min(8);
        let value = number.get(..size).unwrap_or(&number);
        if let Err(code) = write_row(dictionary, found, value, application)
            && let (None, Some(entry)) = (received.refused, D::entry(found.row))
        {
            received.refused = Some((entry, code));
        }
    }
    Ok(received)
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
struct Mapping {
    /// Row of the number of entries; their parameters follow.
    number: Row,
    count: u8,
    /// The rows that are mapped, as long as the mapping is the default one: then nothing has to be searched.
    rows: Option<&'static [Row]>,
}

impl Mapping {
    /// The mapping of a PDO that exists now.
    #[inline(always)]
    fn of<D: Dictionary>(dictionary: &D, first: u16, number: u16) -> Result<Self, PdoError> {
        if !(1..=512).contains(&number) {
            return Err(PdoError::NoPdo);
        }
        let (table, image) = (D::TABLE, dictionary.image());
        let index = first + number - 1;
        let at = table.pdos.binary_search_by_key(&index, |pdo| pdo.index).map_err(|_| PdoError::NoPdo)?;
        let pdo = table.pdos.get(at).ok_or(PdoError::NoPdo)?;
        let cob_id = at_row(table, image, table.found(pdo.cob_id)).ok_or(PdoError::NoPdo)?;
        if cob_id & NOT_VALID != 0 {
            return Err(PdoError::NotValid);
        }
        let count = at_row(table, image, table.found(pdo.mapping)).and_then(|count| u8::try_from(count).ok());
        let Some(count @ 1..=64) = count else { return Err(PdoError::NotMapped) };
        let rows = Some(pdo.rows).filter(|rows| {
            rows.len() == usize::from(count) && is_default(table, image, table.found(pdo.mapping + 1), count)
        });
        Ok(Self { number: pdo.mapping, count, rows })
    }

    /// A mapping parameter.
    #[inline(always)]
    fn parameter<D: Dictionary>(self, dictionary: &D, at: u8) -> Result<u32, PdoError> {
        let row = self.number + 1 + Row::from(at);
        at_row(D::TABLE, dictionary.image(), D::TABLE.found(row)).ok_or(PdoError::NotMapped)
    }

    /// What is mapped at a position, and its bits; no entry for a placeholder.
    #[inline(always)]
    fn mapped<D: Dictionary>(self, dictionary: &D, at: u8) -> Result<(Option<Found>, u32), PdoError> {
        if let Some(rows) = self.rows {
            let found = D::TABLE.found(rows.get(usize::from(at)).copied().unwrap_or(Row::MAX));
            return Ok((Some(found), width(found.shared)));
        }
        let (index, sub, bits) = parts(self.parameter(dictionary, at)?);
        if is_dummy(index, sub) {
            return Ok((None, bits));
        }
        let found = D::TABLE.lookup(index, sub).map_err(|_| PdoError::NotMapped)?;
        Ok((Some(found), bits))
    }

    /// The bits of what is mapped at a position.
    #[inline(always)]
    fn mapped_bits<D: Dictionary>(self, dictionary: &D, at: u8) -> Result<u32, PdoError> {
        if let Some(rows) = self.rows {
            let found = D::TABLE.found(rows.get(usize::from(at)).copied().unwrap_or(Row::MAX));
            return Ok(width(found.shared));
        }
        Ok(parts(self.parameter(dictionary, at)?).2)
    }
}

/// Whether mapping parameters are those of the factory; constant ones are.
#[inline]
fn is_default(table: &Table, image: &[u8], first: Found, count: u8) -> bool {
    if first.shared.place == Place::Constant {
        return true;
    }
    let part = first.offset()..first.offset() + 4 * usize::from(count);
    match (image.get(part.clone()), table.factory.get(part)) {
        // Word by word: for a few, a call of `memcmp` takes longer.
        (Some(now), Some(factory)) => now.as_chunks::<4>().0.iter().eq(factory.as_chunks::<4>().0),
        _ => false,
    }
}

/// Bits of a value in a PDO.
#[inline]
fn width(shared: &Attributes) -> u32 {
    if shared.data_type == DataType::Boolean { 1 } else { u32::from(shared.size) * 8 }
}

/// Index, sub-index and bits of a mapping parameter.
fn parts(parameter: u32) -> (u16, u8, u32) {
    let [bits, sub, low, high] = parameter.to_le_bytes();
    (u16::from_le_bytes([low, high]), sub, bits.into())
}

const fn mask(bits: u32) -> u64 {
    match u64::MAX.checked_shl(bits) {
        Some(above) => !above,
        None => u64::MAX,
    }
}

const fn is_dummy(index: u16, sub: u8) -> bool {
    matches!(index, 1..=7) && sub == 0
}

/// Rules of 1400h to 15FFh and 1800h to 19FFh.
pub(crate) fn check_communication(
    table: &'static Table,
    image: &[u8],
    index: u16,
    sub: u8,
    new: u32,
) -> Result<bool, AbortCode> {
    let cob_id = current(table, image, index, 1).unwrap_or(NOT_VALID);
    let is_valid = cob_id & NOT_VALID == 0;
    let refused = match sub {
        1 if index < TRANSMIT && new & NO_REMOTE_FRAMES != 0 => true,
        1 => return check_cob_id(cob_id, new),
        2 => matches!(new, 241..=251) || index < TRANSMIT && matches!(new, 252 | 253),
        3 => is_valid && current(table, image, index, 3) != Some(new),
        6 => new > 240 || is_valid && current(table, image, index, 6) != Some(new),
        _ => false,
    };
    if refused { Err(AbortCode::INVALID_VALUE) } else { Ok(true) }
}

/// Rules of 1600h to 17FFh and 1A00h to 1BFFh: the mapping changes only while the PDO does not exist; its entries, only
/// while their number is 0.
pub(crate) fn check_mapping(
    table: &'static Table,
    image: &[u8],
    index: u16,
    sub: u8,
    new: u32,
) -> Result<bool, AbortCode> {
    let cob_id = current(table, image, index - MAPPING, 1).unwrap_or(NOT_VALID);
    let count = current(table, image, index, 0).unwrap_or_default();
    if cob_id & NOT_VALID == 0 || sub != 0 && count != 0 {
        return Err(AbortCode::UNSUPPORTED_ACCESS);
    }
    let flag = if index >= TRANSMIT { Flags::TRANSMIT } else { Flags::RECEIVE };
    if sub != 0 {
        // An entry of 0 maps nothing; it is refused when it is to be used.
        return if new == 0 { Ok(true) } else { check_mapped(table, flag, new).map(|_| true) };
    }
    let Ok(count @ 0..=64) = u8::try_from(new) else { return Err(AbortCode::PDO_LENGTH) };
    if current(table, image, index, count).is_none() {
        return Err(AbortCode::PDO_LENGTH);
    }
    let mut bits = 0;
    for sub in 1..=count {
        let parameter = current(table, image, index, sub).ok_or(AbortCode::PDO_LENGTH)?;
        bits += check_mapped(table, flag, parameter)?;
    }
    if bits > FRAME_BITS { Err(AbortCode::PDO_LENGTH) } else { Ok(true) }
}

/// Whether a mapping parameter can be used in a direction; its bits.
fn check_mapped(table: &Table, flag: u8, parameter: u32) -> Result<u32, AbortCode> {
    const DUMMY_BITS: [u32; 8] = [0, 1, 8, 16, 32, 8, 16, 32];
    let (index, sub, bits) = parts(parameter);
    let needed = if is_dummy(index, sub) {
        if flag != Flags::RECEIVE || table.dummies & 1 << index == 0 {
            return Err(AbortCode::NO_OBJECT);
        }
        DUMMY_BITS.get(usize::from(index)).copied().unwrap_or_default()
    } else {
        let Found { shared, .. } = table.lookup(index, sub).map_err(|_| AbortCode::NO_OBJECT)?;
        if !shared.flags.has(flag) {
            return Err(AbortCode::NOT_MAPPABLE);
        }
        width(shared)
    };
    let in_step = table.granularity != 0 && bits % u32::from(table.granularity) == 0;
    if bits == needed && in_step { Ok(bits) } else { Err(AbortCode::NOT_MAPPABLE) }
}
