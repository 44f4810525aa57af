//! What a server sends.

use super::{
    Aborted, BLOCK_SIZE_STATED, CRC, END, EXPEDITED, Expedited, Piece, RECEIVED, Received, SIZE, Segment,
    TOGGLE, alone, checksum, crc_bit, end, frame, id, number, size_if, stated, toggle_bit, unused,
};
use crate::abort::AbortCode;
use crate::table::entry::EntryId;

/// What a server sends, except the segments of blocks.
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
        /// How many bytes of the last segment are padding.
        unused: u8,
        /// The checksum; 0 if there is none.
        crc: u16,
    },
    /// Ends the transfer.
    Abort(Aborted),
}

impl Answer {
    /// What a frame answers; `None` if no answer has this command.
    pub fn decode(bytes: [u8; 8]) -> Option<Self> {
        let [command, _, _, _, data @ ..] = bytes;
        let id = id(&bytes);
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
    pub fn encode(self) -> [u8; 8] {
        match self {
            Self::Download { id } => downloaded(id),
            Self::UploadExpedited { id, value } => uploaded(id, value),
            Self::DownloadSegment { toggle } => alone(1 << 5 | toggle_bit(toggle)),
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

/// [`Answer::Download`], encoded: a server that writes a short value has no other answer to choose from.
#[inline]
pub(crate) const fn downloaded(id: EntryId) -> [u8; 8] {
    frame(3 << 5, id, [0; 4])
}

/// [`Answer::UploadExpedited`], encoded.
#[inline]
pub(crate) fn uploaded(id: EntryId, value: Expedited) -> [u8; 8] {
    frame(2 << 5 | value.command(), id, value.bytes)
}
