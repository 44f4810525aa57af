//! The server.

#[cfg(feature = "sdo-block")]
mod blocks;
mod download;
mod upload;

use crate::abort::AbortCode;
use crate::access::application::Application;
use crate::access::dictionary::{Dictionary, readable, refresh, value};
use crate::bus::clock::{Duration, Instant};
use crate::bus::frame::Frame;
use crate::sdo::Channel;
#[cfg(feature = "sdo-block")]
use crate::sdo::block::{Receiver, Sender};
use crate::sdo::codec::{Aborted, Answer, Expedited, Request, Segment, downloaded, uploaded};
use crate::table::Found;
use crate::table::entry::EntryId;
use download::{Download, write_expedited};
use upload::{Upload, find_short, short_value};

/// The server of one SDO channel (CiA 301 7.2.4). A node with several channels has one for each.
///
/// The buffer holds the value of a transfer that does not fit into one frame: `[u8; N]`, `&mut [u8]` or `Vec<u8>`, of `LARGEST_VALUE`
/// bytes for every value of a generated dictionary; a longer value is refused with [`AbortCode::OUT_OF_MEMORY`]. What is
/// read is copied when the transfer begins, so that its segments belong to one value; what is written is gathered, and
/// written when it is complete and valid. DOMAINs go to and come from the application in pieces and need no buffer:
/// what an application got of a DOMAIN does not count before the piece that is the last, and an offset of 0 begins anew.
///
/// ```
/// use firmware_glue::NodeId;
/// use firmware_glue::clock::Instant;
/// use firmware_glue::frame::Frame;
/// use firmware_glue::sdo::{Channel, SdoServer};
/// # use firmware_glue::table::{Attributes, Block, Directory, EntryRow, Flags, NONE, Parts, Place};
/// # use firmware_glue::{DataType, Storage, Table, TableDictionary};
/// # const NUMBER: Attributes = Attributes {
/// #     data_type: DataType::Unsigned16, flags: Flags::READ.with(Flags::WRITE), place: Place::Image,
/// #     storage: Storage::No, page: 0, size: 2, limits: NONE, values: NONE, condition: NONE,
/// # };
/// # let (mut blocks, mut seeds, mut order) = ([Block::FREE; 1], [0; 1], [0; 1]);
/// # let table = Table::checked(Parts {
/// #     directory: Directory::arrange(&[0x2000], &mut blocks, &mut seeds, &mut order).ok_or("no room")?,
/// #     objects: &[0, 1], entries: &[EntryRow { attributes: 0, place: 0 }], attributes: &[NUMBER],
/// #     factory: &[0x19, 0], ..Parts::EMPTY
/// # })?;
/// # let mut dictionary = TableDictionary::new(&table, [0; 2], 1)?;
/// # let mut application = ();
/// let channel = Channel::predefined(NodeId::new(5).ok_or("1 to 127")?);
/// let mut server = SdoServer::new(channel, [0; 64]);
///
/// // For every frame that comes, with the time:
/// let request = Frame::full(channel.request, [0x40, 0x00, 0x20, 0, 0, 0, 0, 0]);
/// let answer = server.handle(&request, &mut dictionary, &mut application, Instant::from_millis(1));
/// assert_eq!(answer, Some(Frame::full(channel.answer, [0x4B, 0x00, 0x20, 0, 0x19, 0, 0, 0])));
/// // Again and again, until there is nothing to send: segments of blocks, and the end of a transfer that takes too long.
/// assert_eq!(server.poll(&mut dictionary, &mut application, Instant::from_millis(2)), None);
/// assert_eq!(server.next_deadline(), None, "no transfer goes on");
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct SdoServer<B> {
    channel: Channel,
    timeout: Duration,
    #[cfg(feature = "sdo-block")]
    block_size: u8,
    /// When the transfer was last seen to go on.
    heard: Instant,
    transfer: Transfer,
    buffer: B,
}

/// What goes on.
#[derive(Debug, Clone, Copy)]
enum Transfer {
    None,
    Upload {
        upload: Upload,
        offset: u32,
        toggle: bool,
    },
    Download {
        download: Download,
        toggle: bool,
    },
    #[cfg(feature = "sdo-block")]
    BlockUpload {
        upload: Upload,
        sender: Sender,
        crc: bool,
        phase: Phase,
    },
    #[cfg(feature = "sdo-block")]
    BlockDownload {
        download: Download,
        receiver: Receiver,
        crc: bool,
    },
}

/// Where an upload in blocks is.
#[cfg(feature = "sdo-block")]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Phase {
    /// The client has to ask for the first block.
    Announced,
    /// Blocks are sent.
    Sending,
    /// All came; the client has to say that it knows.
    Ended,
}

/// An entry that may be read. One function for callers that are not in a hurry.
#[inline(never)]
fn find_to_upload<'t, D: Dictionary<'t>, A: Application<D>>(
    EntryId { index, sub }: EntryId,
    dictionary: &mut D,
    application: &mut A,
) -> Result<Found<'t>, AbortCode> {
    readable(dictionary, index, sub, application)
}

/// Of an abort when no transfer goes on.
const NO_ENTRY: EntryId = EntryId { index: 0, sub: 0 };

impl Transfer {
    fn id(&self) -> EntryId {
        match self {
            Self::None => NO_ENTRY,
            Self::Upload { upload, .. } => upload.id,
            Self::Download { download, .. } => download.id,
            #[cfg(feature = "sdo-block")]
            Self::BlockUpload { upload, .. } => upload.id,
            #[cfg(feature = "sdo-block")]
            Self::BlockDownload { download, .. } => download.id,
        }
    }
}

impl<B: AsRef<[u8]> + AsMut<[u8]>> SdoServer<B> {
    /// A server on a channel.
    pub const fn new(channel: Channel, buffer: B) -> Self {
        Self {
            channel,
            timeout: super::DEFAULT_TIMEOUT,
            #[cfg(feature = "sdo-block")]
            block_size: super::DEFAULT_BLOCK_SIZE,
            heard: Instant::ZERO,
            transfer: Transfer::None,
            buffer,
        }
    }

    /// Sets after what time without a request a transfer is given up.
    pub const fn set_timeout(&mut self, timeout: Duration) {
        self.timeout = timeout;
    }

    /// Sets how many segments a client may send at once in a block, 1 to 127: no more than the CAN driver keeps while the program
    /// does something else.
    #[cfg(feature = "sdo-block")]
    pub fn set_block_size(&mut self, segments: u8) {
        self.block_size = segments.clamp(1, 127);
    }

    /// The channel that is served.
    pub const fn channel(&self) -> Channel {
        self.channel
    }

    /// Serves another channel from now on; what goes on ends without a word.
    pub fn set_channel(&mut self, channel: Channel) {
        self.channel = channel;
        self.reset();
    }

    /// Ends what goes on without a word: after a reset, or when the node is stopped.
    pub fn reset(&mut self) {
        self.transfer = Transfer::None;
    }

    /// Whether a transfer goes on.
    pub const fn is_busy(&self) -> bool {
        !matches!(self.transfer, Transfer::None)
    }

    /// Takes a frame that was received, and gives the one to be sent. Frames with other identifiers,
    /// remote frames and frames that do not have eight bytes do not concern the server.
    ///
    /// Call it with everything that comes while the node is pre-operational or operational.
    #[inline]
    pub fn handle<'t, D: Dictionary<'t>, A: Application<D>>(
        &mut self,
        frame: &Frame,
        dictionary: &mut D,
        application: &mut A,
        now: Instant,
    ) -> Option<Frame> {
        if frame.id() != self.channel.request {
            return None;
        }
        let bytes = frame.all_eight()?;
        self.heard = now;
        // Almost every request reads a number. That goes from its place into the frame, after one look into the table.
        let Some(id) = Request::read_entry(bytes) else {
            return self.handle_other(bytes, dictionary, application);
        };
        if !self.is_taking_blocks()
            && let Some(found) = find_short(dictionary.table(), id)
        {
            self.transfer = Transfer::None;
            refresh(dictionary, found, application);
            let value = short_value(dictionary.table(), dictionary.image(), found)?;
            return Some(Frame::full(self.channel.answer, uploaded(id, value)));
        }
        self.handle_longer(bytes, dictionary, application)
    }

    /// The same, beyond short values that are read: those that are written.
    #[inline(never)]
    #[expect(
        clippy::trivially_copy_pass_by_ref,
        reason = "the frame stays where it is, and of it is loaded what counts"
    )]
    fn handle_other<'t, D: Dictionary<'t>, A: Application<D>>(
        &mut self,
        bytes: &[u8; 8],
        dictionary: &mut D,
        application: &mut A,
    ) -> Option<Frame> {
        if let Some((id, value)) = Request::written_entry(bytes)
            && !self.is_taking_blocks()
        {
            self.transfer = Transfer::None;
            let answer = match write_expedited(id, value, dictionary, application) {
                Ok(()) => downloaded(id),
                Err(code) => self.abort(id, code),
            };
            return Some(Frame::full(self.channel.answer, answer));
        }
        self.handle_longer(bytes, dictionary, application)
    }

    /// The same, for transfers of several frames.
    #[inline(never)]
    #[expect(clippy::trivially_copy_pass_by_ref, reason = "as above")]
    fn handle_longer<'t, D: Dictionary<'t>, A: Application<D>>(
        &mut self,
        bytes: &[u8; 8],
        dictionary: &mut D,
        application: &mut A,
    ) -> Option<Frame> {
        let answer = self.take(*bytes, dictionary, application)?;
        Some(Frame::full(self.channel.answer, answer))
    }

    /// Whether what comes is a segment of a block, which may look like any request.
    const fn is_taking_blocks(&self) -> bool {
        match &self.transfer {
            #[cfg(feature = "sdo-block")]
            Transfer::BlockDownload { receiver, .. } => !receiver.is_complete(),
            _ => false,
        }
    }

    /// What is to be sent without being asked: segments of a block, one in each call, and
    /// [`AbortCode::TIMEOUT`] to a client that says nothing.
    pub fn poll<'t, D: Dictionary<'t>, A: Application<D>>(
        &mut self,
        dictionary: &mut D,
        application: &mut A,
        now: Instant,
    ) -> Option<Frame> {
        if !self.is_busy() {
            return None;
        }
        #[cfg(feature = "sdo-block")]
        if let Some(segment) = self.next_of_block(dictionary, application) {
            self.heard = now;
            return Some(Frame::full(self.channel.answer, segment));
        }
        let _ = (dictionary, application);
        if now.since(self.heard) < self.timeout {
            return None;
        }
        let id = self.transfer.id();
        Some(Frame::full(self.channel.answer, self.abort(id, AbortCode::TIMEOUT)))
    }

    /// When [`poll`](Self::poll) has something to send, unless a frame comes before; a time that has passed while a block is sent.
    pub fn next_deadline(&self) -> Option<Instant> {
        if !self.is_busy() {
            return None;
        }
        #[cfg(feature = "sdo-block")]
        if self.is_sending_blocks() {
            return Some(Instant::ZERO);
        }
        Some(self.heard + self.timeout)
    }

    /// The answer to eight bytes.
    fn take<'t, D: Dictionary<'t>, A: Application<D>>(
        &mut self,
        bytes: [u8; 8],
        dictionary: &mut D,
        application: &mut A,
    ) -> Option<[u8; 8]> {
        #[cfg(feature = "sdo-block")]
        if self.is_taking_blocks() {
            return self.take_segment(bytes, dictionary, application);
        }
        match Request::decode(bytes) {
            Some(Request::Upload { id }) => {
                self.transfer = Transfer::None;
                Some(match find_to_upload(id, dictionary, application) {
                    Ok(found) => self.begin_longer_upload(id, found, dictionary, application),
                    Err(code) => self.abort(id, code),
                })
            }
            Some(Request::Abort(_)) => {
                self.transfer = Transfer::None;
                None
            }
            #[cfg(feature = "sdo-block")]
            Some(
                request @ (Request::BlockDownload { .. }
                | Request::BlockDownloadEnd { .. }
                | Request::BlockUpload { .. }
                | Request::BlockUploadStart
                | Request::BlockUploadReceived(_)
                | Request::BlockUploadEnd),
            ) => self.take_block(request, dictionary, application),
            other => Some(self.take_other(other, dictionary, application)),
        }
    }

    /// The answer to what belongs to a transfer in segments.
    fn take_other<'t, D: Dictionary<'t>, A: Application<D>>(
        &mut self,
        request: Option<Request>,
        dictionary: &mut D,
        application: &mut A,
    ) -> [u8; 8] {
        let mut id = self.transfer.id();
        let outcome = match request {
            Some(Request::Download { id: begun, size }) => {
                id = begun;
                self.begin_download(id, size, dictionary, application)
            }
            Some(Request::UploadSegment { toggle }) => self.upload_segment(toggle, dictionary, application),
            Some(Request::DownloadSegment(segment)) => {
                self.download_segment(segment, dictionary, application)
            }
            // What has no meaning here (a short value is written elsewhere), or none at all.
            Some(_) | None => Err(AbortCode::COMMAND),
        };
        match outcome {
            Ok(answer) => answer.encode(),
            Err(code) => self.abort(id, code),
        }
    }

    /// Ends the transfer.
    #[cold]
    fn abort(&mut self, id: EntryId, code: AbortCode) -> [u8; 8] {
        self.transfer = Transfer::None;
        Aborted { id, code }.encode()
    }

    /// The answer to a request to read an entry that may be read.
    #[inline(never)]
    fn begin_longer_upload<'t, D: Dictionary<'t>, A: Application<D>>(
        &mut self,
        id: EntryId,
        found: Found<'t>,
        dictionary: &mut D,
        application: &mut A,
    ) -> [u8; 8] {
        if let Ok(value) = value(dictionary, found)
            && let Some(value) = Expedited::new(&value)
        {
            return uploaded(id, value);
        }
        let upload = Upload::begin(id, found, self.buffer.as_mut(), dictionary, application);
        self.announce(id, upload)
    }

    /// Begins to send segments, if there is something to send.
    fn announce(&mut self, id: EntryId, upload: Result<Upload, AbortCode>) -> [u8; 8] {
        match upload {
            Ok(upload) => {
                self.transfer = Transfer::Upload { upload, offset: 0, toggle: false };
                Answer::Upload { id, size: upload.size() }.encode()
            }
            Err(code) => self.abort(id, code),
        }
    }

    fn upload_segment<'t, D: Dictionary<'t>, A: Application<D>>(
        &mut self,
        asked: bool,
        dictionary: &mut D,
        application: &mut A,
    ) -> Result<Answer, AbortCode> {
        let Transfer::Upload { upload, offset, toggle } = &mut self.transfer else {
            return Err(AbortCode::COMMAND);
        };
        if asked != *toggle {
            return Err(AbortCode::TOGGLE_BIT);
        }
        let piece = upload.piece(*offset, self.buffer.as_ref(), dictionary, application)?;
        *offset = offset.checked_add(u32::from(7 - piece.unused())).ok_or(AbortCode::TOO_LONG)?;
        *toggle = !asked;
        if piece.last {
            self.transfer = Transfer::None;
        }
        Ok(Answer::UploadSegment(Segment { toggle: asked, piece }))
    }

    fn begin_download<'t, D: Dictionary<'t>, A: Application<D>>(
        &mut self,
        id: EntryId,
        size: Option<u32>,
        dictionary: &D,
        application: &A,
    ) -> Result<Answer, AbortCode> {
        let download = Download::begin(id, size, self.buffer.as_ref(), dictionary, application)?;
        self.transfer = Transfer::Download { download, toggle: false };
        Ok(Answer::Download { id })
    }

    fn download_segment<'t, D: Dictionary<'t>, A: Application<D>>(
        &mut self,
        Segment { toggle: sent, piece }: Segment,
        dictionary: &mut D,
        application: &mut A,
    ) -> Result<Answer, AbortCode> {
        let Transfer::Download { download, toggle } = &mut self.transfer else {
            return Err(AbortCode::COMMAND);
        };
        if sent != *toggle {
            return Err(AbortCode::TOGGLE_BIT);
        }
        download.put(piece.bytes(), piece.last, self.buffer.as_mut(), dictionary, application)?;
        *toggle = !sent;
        if piece.last {
            self.transfer = Transfer::None;
        }
        Ok(Answer::DownloadSegment { toggle: sent })
    }
}

#[cfg(test)]
mod tests;
