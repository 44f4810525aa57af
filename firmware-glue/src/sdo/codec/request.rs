//! What a client sends.

use super::{
    Aborted, BLOCK_SIZE_STATED, CRC, END, EXPEDITED, Expedited, Piece, RECEIVED, Received, SIZE, START,
    Segment, TOGGLE, alone, checksum, crc_bit, end, frame, id, number, size_if, stated, toggle_bit, unused,
};
use crate::abort::AbortCode;
use crate::table::entry::EntryId;

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
        /// How many bytes of the last segment are padding.
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

/// Command specifiers of what begins a transfer.
const DOWNLOAD: u8 = 1;
const UPLOAD: u8 = 2;

impl Request {
    /// What a frame asks for; `None` if no request has this command.
    pub fn decode(bytes: [u8; 8]) -> Option<Self> {
        let [command, _, _, _, data @ ..] = bytes;
        let id = id(&bytes);
        Some(match (command >> 5, command & 3) {
            (UPLOAD, _) => Self::Upload { id },
            (DOWNLOAD, _) if command & EXPEDITED != 0 => {
                Self::DownloadExpedited { id, value: Expedited::decode(command, data) }
            }
            (DOWNLOAD, _) => Self::Download { id, size: size_if(command & SIZE != 0, bytes) },
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

    /// What a frame reads, if it is [`Self::Upload`]: what a server is asked most, recognized without building the
    /// request.
    #[inline]
    #[expect(
        clippy::trivially_copy_pass_by_ref,
        reason = "the frame stays where it is, and of it is loaded what counts"
    )]
    pub(crate) fn read_entry(bytes: &[u8; 8]) -> Option<EntryId> {
        if bytes[0] >> 5 == UPLOAD { Some(id(bytes)) } else { None }
    }

    /// What a frame writes, and where, if it is [`Self::DownloadExpedited`].
    #[inline]
    #[expect(clippy::trivially_copy_pass_by_ref, reason = "as above")]
    pub(crate) fn written_entry(bytes: &[u8; 8]) -> Option<(EntryId, Expedited)> {
        let [command, _, _, _, data @ ..] = *bytes;
        let is_short = command >> 5 == DOWNLOAD && command & EXPEDITED != 0;
        if is_short { Some((id(bytes), Expedited::decode(command, data))) } else { None }
    }

    /// The frame.
    pub fn encode(self) -> [u8; 8] {
        match self {
            Self::DownloadExpedited { id, value } => frame(DOWNLOAD << 5 | value.command(), id, value.bytes),
            Self::Download { id, size } => {
                frame(DOWNLOAD << 5 | stated(size, SIZE), id, size.unwrap_or(0).to_le_bytes())
            }
            Self::DownloadSegment(segment) => segment.encode(),
            Self::Upload { id } => frame(UPLOAD << 5, id, [0; 4]),
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
