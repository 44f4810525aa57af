//! The frames of SDO: the one place that knows their bits, for servers, clients and listeners (CiA 301 7.2.4.3).
//!
//! Bits that the standard reserves are sent as 0 and not looked at.

mod answer;
mod request;
#[cfg(test)]
mod tests;

pub use answer::Answer;
pub(crate) use answer::{downloaded, uploaded};
pub use request::Request;

use crate::abort::AbortCode;
use crate::table::entry::EntryId;

/// The value in a frame that begins and ends a transfer: one to four bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Expedited {
    bytes: [u8; 4],
    /// 1 to 4; `None` where the sender does not say how many of the four bytes are the value.
    length: Option<u8>,
}

impl Expedited {
    /// A value of one to four bytes.
    pub fn new(value: &[u8]) -> Option<Self> {
        let (bytes, length) = match *value {
            [a] => ([a, 0, 0, 0], 1),
            [a, b] => ([a, b, 0, 0], 2),
            [a, b, c] => ([a, b, c, 0], 3),
            [a, b, c, d] => ([a, b, c, d], 4),
            _ => return None,
        };
        Some(Self { bytes, length: Some(length) })
    }

    /// The first bytes of some, one to four, without a loop.
    #[inline]
    pub(crate) fn first_of(bytes: &[u8], length: u16) -> Option<Self> {
        let (number, length) = match length {
            4 => (u32::from_le_bytes(*bytes.first_chunk()?), 4),
            2 => (u16::from_le_bytes(*bytes.first_chunk()?).into(), 2),
            1 => (u32::from(*bytes.first()?), 1),
            _ => return Self::new(bytes.get(..usize::from(length))?),
        };
        Some(Self { bytes: number.to_le_bytes(), length: Some(length) })
    }

    /// How many bytes the value has, where the sender says so.
    pub fn length(&self) -> Option<u8> {
        self.length
    }

    /// The value; where the sender does not say how long it is, all four bytes that it may have.
    #[inline]
    pub fn bytes(&self) -> &[u8] {
        self.bytes.get(..usize::from(self.length.unwrap_or(4))).unwrap_or(&self.bytes)
    }

    /// The four bytes in which the value is.
    #[inline]
    pub(crate) const fn four(self) -> [u8; 4] {
        self.bytes
    }

    /// Of bits 0 to 3 of a command, and the four bytes after the entry.
    #[inline]
    const fn decode(command: u8, bytes: [u8; 4]) -> Self {
        let length = if command & SIZE == 0 { None } else { Some(4 - (command >> 2 & 3)) };
        Self { bytes, length }
    }

    #[inline]
    fn command(self) -> u8 {
        EXPEDITED | self.length.map_or(0, |length| (4 - length) << 2 | SIZE)
    }
}

/// What a segment carries: up to seven bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Piece {
    bytes: [u8; 7],
    /// 0 to 7.
    length: u8,
    /// Whether the data end with it.
    pub last: bool,
}

impl Piece {
    /// The next piece of data: up to seven of the bytes, and whether nothing follows them.
    pub(crate) fn first_of(data: &[u8]) -> Self {
        let mut bytes = [0; 7];
        bytes.iter_mut().zip(data).for_each(|(byte, new)| *byte = *new);
        let length = u8::try_from(data.len().min(7)).unwrap_or(7);
        Self { bytes, length, last: data.len() <= 7 }
    }

    /// The bytes.
    pub fn bytes(&self) -> &[u8] {
        self.bytes.get(..usize::from(self.length)).unwrap_or(&self.bytes)
    }

    /// The bytes with zeros after them, as they are in a frame.
    #[cfg(feature = "sdo-block")]
    pub(crate) const fn padded(&self) -> [u8; 7] {
        self.bytes
    }

    /// How many bytes a segment leaves unused.
    pub fn unused(&self) -> u8 {
        7 - self.length.min(7)
    }

    fn decode(frame: [u8; 8]) -> Segment {
        let [command, bytes @ ..] = frame;
        let piece = Self { bytes, length: 7 - (command >> 1 & 7), last: command & 1 != 0 };
        Segment { toggle: command & TOGGLE != 0, piece }
    }
}

/// A segment of a segmented transfer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Segment {
    /// Alternates; not set in the first segment.
    pub toggle: bool,
    /// The data.
    pub piece: Piece,
}

impl Segment {
    fn encode(self) -> [u8; 8] {
        let command = toggle_bit(self.toggle) | self.piece.unused() << 1 | u8::from(self.piece.last);
        segment(command, self.piece.bytes)
    }
}

/// A segment of a block, which has no command: what it is follows from where it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BlockSegment {
    /// 1 to 127, from the beginning of the block; 0 is not a number of a segment.
    pub sequence: u8,
    /// Whether the data end in it.
    pub last: bool,
    /// Data; how many bytes of the last segment are data is stated at the end of the transfer.
    pub bytes: [u8; 7],
}

impl BlockSegment {
    /// A frame where a segment is expected; `Err` with the abort that it may be instead.
    ///
    /// # Errors
    /// The other side ends the transfer.
    pub fn decode(frame: [u8; 8]) -> Result<Self, Aborted> {
        let [command, bytes @ ..] = frame;
        if command == ABORT {
            return Err(Aborted { id: id(&frame), code: AbortCode(number(frame)) });
        }
        Ok(Self { sequence: command & 0x7F, last: command & LAST_OF_BLOCKS != 0, bytes })
    }

    /// The frame.
    pub fn encode(self) -> [u8; 8] {
        let last = if self.last { LAST_OF_BLOCKS } else { 0 };
        segment(self.sequence & 0x7F | last, self.bytes)
    }
}

/// The end of a transfer before its time. It is not answered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Aborted {
    /// The entry of the transfer.
    pub id: EntryId,
    /// Why.
    pub code: AbortCode,
}

impl Aborted {
    /// The frame.
    pub fn encode(self) -> [u8; 8] {
        frame(ABORT, self.id, self.code.0.to_le_bytes())
    }
}

/// What came of a block, and how many segments the next one may have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Received {
    /// The last segment up to which all came; 0 if the first did not.
    pub sequence: u8,
    /// Segments of the next block, 1 to 127.
    pub block_size: u8,
}

const TOGGLE: u8 = 1 << 4;
const EXPEDITED: u8 = 1 << 1;
/// Bit 0 of "initiate": the size is stated. In block protocols it is bit 1.
const SIZE: u8 = 1;
const BLOCK_SIZE_STATED: u8 = 1 << 1;
const CRC: u8 = 1 << 2;
const LAST_OF_BLOCKS: u8 = 1 << 7;

/// Command specifiers in bits 5 to 7; a number may mean something else in the other direction.
const ABORT: u8 = 4 << 5;
/// Sub-commands of block protocols, bits 0 and 1.
const END: u8 = 1;
const RECEIVED: u8 = 2;
const START: u8 = 3;

impl Received {
    /// Has the same bits in both directions.
    const fn decode(bytes: [u8; 8]) -> Self {
        let [_, sequence, block_size, ..] = bytes;
        Self { sequence, block_size }
    }

    const fn encode(self) -> [u8; 8] {
        [5 << 5 | RECEIVED, self.sequence, self.block_size, 0, 0, 0, 0, 0]
    }
}

#[inline]
#[expect(clippy::cast_possible_truncation, reason = "each takes its part of the word")]
#[expect(clippy::trivially_copy_pass_by_ref, reason = "a copy would be loaded in other parts")]
fn id(bytes: &[u8; 8]) -> EntryId {
    // A word is one load, and one shift for each part.
    let head = bytes.first_chunk().map_or(0, |head| u32::from_le_bytes(*head));
    EntryId { index: (head >> 8) as u16, sub: (head >> 24) as u8 }
}

#[inline]
const fn number([_, _, _, _, data @ ..]: [u8; 8]) -> u32 {
    u32::from_le_bytes(data)
}

fn size_if(stated: bool, bytes: [u8; 8]) -> Option<u32> {
    stated.then_some(number(bytes))
}

const fn unused(command: u8) -> u8 {
    command >> 2 & 7
}

const fn checksum([_, low, high, ..]: [u8; 8]) -> u16 {
    u16::from_le_bytes([low, high])
}

const fn toggle_bit(toggle: bool) -> u8 {
    if toggle { TOGGLE } else { 0 }
}

const fn crc_bit(crc: bool) -> u8 {
    if crc { CRC } else { 0 }
}

const fn stated(size: Option<u32>, bit: u8) -> u8 {
    if size.is_some() { bit } else { 0 }
}

#[inline]
#[expect(clippy::many_single_char_names, reason = "one for each byte")]
const fn frame(command: u8, EntryId { index, sub }: EntryId, data: [u8; 4]) -> [u8; 8] {
    // As a word, of which the compiler makes one store.
    let head = command as u32 | (index as u32) << 8 | (sub as u32) << 24;
    let ([e, f, g, h], [a, b, c, d]) = (head.to_le_bytes(), data);
    [e, f, g, h, a, b, c, d]
}

#[expect(clippy::many_single_char_names, reason = "one for each byte")]
const fn segment(command: u8, [a, b, c, d, e, f, g]: [u8; 7]) -> [u8; 8] {
    [command, a, b, c, d, e, f, g]
}

const fn alone(command: u8) -> [u8; 8] {
    [command, 0, 0, 0, 0, 0, 0, 0]
}

const fn end(specifier: u8, unused: u8, crc: u16) -> [u8; 8] {
    let [low, high] = crc.to_le_bytes();
    [specifier | (unused & 7) << 2 | END, low, high, 0, 0, 0, 0, 0]
}
