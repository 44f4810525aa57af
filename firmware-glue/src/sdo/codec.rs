//! The frames of SDO: the one place that knows their bits, for servers, clients and whoever listens (CiA 301 7.2.4.3).
//!
//! Bits that the standard reserves are sent as 0 and not looked at.

use crate::abort::AbortCode;
use crate::id::EntryId;

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
    #[inline]
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

    /// How many bytes the value has, where the sender says so.
    pub fn length(&self) -> Option<u8> {
        self.length
    }

    /// The value; where the sender does not say how long it is, all four bytes that it may have.
    #[inline]
    pub fn bytes(&self) -> &[u8] {
        self.bytes.get(..usize::from(self.length.unwrap_or(4))).unwrap_or(&self.bytes)
    }

    /// Of bits 0 to 3 of a command, and the four bytes behind the entry.
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
    /// The next piece of data: up to seven of the bytes, and whether nothing is behind them.
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

    /// The bytes with zeros behind them, as they stand in a frame.
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

/// A segment of a block, which has no command: what it is follows from where it stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BlockSegment {
    /// 1 to 127, from the beginning of the block; 0 is none.
    pub sequence: u8,
    /// Whether the data end in it.
    pub last: bool,
    /// Data; how many bytes of the last segment are some is told at the end of the transfer.
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
            return Err(Aborted { id: id(frame), code: AbortCode(number(frame)) });
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

/// What a client sends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Request {
    /// Writes up to four bytes.
    DownloadExpedited {
        /// What is written.
        id: EntryId,
        /// The value.
        value: Expedited,
    },
    /// Begins to write in segments.
    Download {
        /// What is written.
        id: EntryId,
        /// How many bytes will come, if the client says so.
        size: Option<u32>,
    },
    /// The next segment to be written.
    DownloadSegment(Segment),
    /// Reads.
    Upload {
        /// What is read.
        id: EntryId,
    },
    /// Asks for the next segment.
    UploadSegment {
        /// Alternates; not set in the first request.
        toggle: bool,
    },
    /// Begins to write in blocks.
    BlockDownload {
        /// What is written.
        id: EntryId,
        /// Whether the client can do checksums.
        crc: bool,
        /// How many bytes will come, if the client says so.
        size: Option<u32>,
    },
    /// Ends writing in blocks.
    BlockDownloadEnd {
        /// How many bytes of the last segment are none.
        unused: u8,
        /// The checksum; 0 if there is none.
        crc: u16,
    },
    /// Begins to read in blocks.
    BlockUpload {
        /// What is read.
        id: EntryId,
        /// Whether the client can do checksums.
        crc: bool,
        /// How many segments the first block may have, 1 to 127.
        block_size: u8,
        /// Up to so many bytes, the server may answer as if segments had been asked for; 0: never.
        threshold: u8,
    },
    /// Asks for the first block.
    BlockUploadStart,
    /// Says what came of a block, and asks for the next.
    BlockUploadReceived(Received),
    /// Says that the last block, and so everything, came.
    BlockUploadEnd,
    /// Ends the transfer.
    Abort(Aborted),
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

/// What a server sends, but for the segments of blocks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Answer {
    /// Written, or ready for segments.
    Download {
        /// What is written.
        id: EntryId,
    },
    /// A segment was taken.
    DownloadSegment {
        /// That of the segment.
        toggle: bool,
    },
    /// A value of up to four bytes.
    UploadExpedited {
        /// What was read.
        id: EntryId,
        /// The value.
        value: Expedited,
    },
    /// The value comes in segments.
    Upload {
        /// What is read.
        id: EntryId,
        /// How many bytes it has, if the server says so.
        size: Option<u32>,
    },
    /// The next segment.
    UploadSegment(Segment),
    /// Ready for blocks.
    BlockDownload {
        /// What is written.
        id: EntryId,
        /// Whether the server can do checksums.
        crc: bool,
        /// How many segments the first block may have, 1 to 127.
        block_size: u8,
    },
    /// Says what came of a block.
    BlockDownloadReceived(Received),
    /// Says that everything came and was written.
    BlockDownloadEnd,
    /// The value comes in blocks.
    BlockUpload {
        /// What is read.
        id: EntryId,
        /// Whether the server can do checksums.
        crc: bool,
        /// How many bytes it has, if the server says so.
        size: Option<u32>,
    },
    /// No more blocks.
    BlockUploadEnd {
        /// How many bytes of the last segment are none.
        unused: u8,
        /// The checksum; 0 if there is none.
        crc: u16,
    },
    /// Ends the transfer.
    Abort(Aborted),
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

impl Request {
    /// What a frame asks for; `None` if no request has this command.
    ///
    /// What is asked most is told apart here, so that a server that matches on it need not build the request; the rest follows in a
    /// function of its own.
    #[inline]
    pub fn decode(bytes: [u8; 8]) -> Option<Self> {
        let [command, _, _, _, data @ ..] = bytes;
        match command >> 5 {
            2 => Some(Self::Upload { id: id(bytes) }),
            1 if command & EXPEDITED != 0 => {
                Some(Self::DownloadExpedited { id: id(bytes), value: Expedited::decode(command, data) })
            }
            _ => Self::decode_longer(bytes),
        }
    }

    /// The requests of transfers of several frames.
    #[inline(never)]
    fn decode_longer(bytes: [u8; 8]) -> Option<Self> {
        let [command, _, _, _, data @ ..] = bytes;
        let id = id(bytes);
        Some(match (command >> 5, command & 3) {
            (1, _) => Self::Download { id, size: size_if(command & SIZE != 0, bytes) },
            (0, _) => Self::DownloadSegment(Piece::decode(bytes)),
            (3, _) => Self::UploadSegment { toggle: command & TOGGLE != 0 },
            (4, _) => Self::Abort(Aborted { id, code: AbortCode(number(bytes)) }),
            (6, 0 | 2) => Self::BlockDownload {
                id,
                crc: command & CRC != 0,
                size: size_if(command & BLOCK_SIZE_STATED != 0, bytes),
            },
            (6, _) => Self::BlockDownloadEnd { unused: unused(command), crc: checksum(bytes) },
            (5, 0) => {
                let [block_size, threshold, ..] = data;
                Self::BlockUpload { id, crc: command & CRC != 0, block_size, threshold }
            }
            (5, END) => Self::BlockUploadEnd,
            (5, RECEIVED) => Self::BlockUploadReceived(Received::decode(bytes)),
            (5, START) => Self::BlockUploadStart,
            _ => return None,
        })
    }

    /// The frame.
    pub fn encode(self) -> [u8; 8] {
        match self {
            Self::DownloadExpedited { id, value } => frame(1 << 5 | value.command(), id, value.bytes),
            Self::Download { id, size } => {
                frame(1 << 5 | stated(size, SIZE), id, size.unwrap_or(0).to_le_bytes())
            }
            Self::DownloadSegment(segment) => segment.encode(),
            Self::Upload { id } => frame(2 << 5, id, [0; 4]),
            Self::UploadSegment { toggle } => alone(3 << 5 | toggle_bit(toggle)),
            Self::BlockDownload { id, crc, size } => {
                let command = 6 << 5 | crc_bit(crc) | stated(size, BLOCK_SIZE_STATED);
                frame(command, id, size.unwrap_or(0).to_le_bytes())
            }
            Self::BlockDownloadEnd { unused, crc } => end(6 << 5, unused, crc),
            Self::BlockUpload { id, crc, block_size, threshold } => {
                frame(5 << 5 | crc_bit(crc), id, [block_size, threshold, 0, 0])
            }
            Self::BlockUploadStart => alone(5 << 5 | START),
            Self::BlockUploadReceived(received) => received.encode(),
            Self::BlockUploadEnd => alone(5 << 5 | END),
            Self::Abort(aborted) => aborted.encode(),
        }
    }
}

impl Answer {
    /// What a frame answers; `None` if no answer has this command.
    pub fn decode(bytes: [u8; 8]) -> Option<Self> {
        let [command, _, _, _, data @ ..] = bytes;
        let id = id(bytes);
        Some(match (command >> 5, command & 3) {
            (3, _) => Self::Download { id },
            (1, _) => Self::DownloadSegment { toggle: command & TOGGLE != 0 },
            (2, _) if command & EXPEDITED != 0 => {
                Self::UploadExpedited { id, value: Expedited::decode(command, data) }
            }
            (2, _) => Self::Upload { id, size: size_if(command & SIZE != 0, bytes) },
            (0, _) => Self::UploadSegment(Piece::decode(bytes)),
            (4, _) => Self::Abort(Aborted { id, code: AbortCode(number(bytes)) }),
            (5, 0) => {
                let [block_size, ..] = data;
                Self::BlockDownload { id, crc: command & CRC != 0, block_size }
            }
            (5, END) => Self::BlockDownloadEnd,
            (5, RECEIVED) => Self::BlockDownloadReceived(Received::decode(bytes)),
            (6, 0 | 2) => Self::BlockUpload {
                id,
                crc: command & CRC != 0,
                size: size_if(command & BLOCK_SIZE_STATED != 0, bytes),
            },
            (6, _) => Self::BlockUploadEnd { unused: unused(command), crc: checksum(bytes) },
            _ => return None,
        })
    }

    /// The frame.
    #[inline]
    pub fn encode(self) -> [u8; 8] {
        match self {
            Self::Download { id } => frame(3 << 5, id, [0; 4]),
            Self::UploadExpedited { id, value } => frame(2 << 5 | value.command(), id, value.bytes),
            other => other.encode_longer(),
        }
    }

    /// The answers in transfers of several frames.
    #[inline(never)]
    fn encode_longer(self) -> [u8; 8] {
        match self {
            Self::Download { id } => frame(3 << 5, id, [0; 4]),
            Self::DownloadSegment { toggle } => alone(1 << 5 | toggle_bit(toggle)),
            Self::UploadExpedited { id, value } => frame(2 << 5 | value.command(), id, value.bytes),
            Self::Upload { id, size } => {
                frame(2 << 5 | stated(size, SIZE), id, size.unwrap_or(0).to_le_bytes())
            }
            Self::UploadSegment(segment) => segment.encode(),
            Self::BlockDownload { id, crc, block_size } => {
                frame(5 << 5 | crc_bit(crc), id, [block_size, 0, 0, 0])
            }
            Self::BlockDownloadReceived(received) => received.encode(),
            Self::BlockDownloadEnd => alone(5 << 5 | END),
            Self::BlockUpload { id, crc, size } => {
                let command = 6 << 5 | crc_bit(crc) | stated(size, BLOCK_SIZE_STATED);
                frame(command, id, size.unwrap_or(0).to_le_bytes())
            }
            Self::BlockUploadEnd { unused, crc } => end(6 << 5, unused, crc),
            Self::Abort(aborted) => aborted.encode(),
        }
    }
}

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
const fn id([_, low, high, sub, ..]: [u8; 8]) -> EntryId {
    EntryId { index: u16::from_le_bytes([low, high]), sub }
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
const fn frame(command: u8, id: EntryId, data: [u8; 4]) -> [u8; 8] {
    let ([low, high], [a, b, c, d]) = (id.index.to_le_bytes(), data);
    [command, low, high, id.sub, a, b, c, d]
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

#[cfg(test)]
#[path = "codec_tests.rs"]
mod tests;
