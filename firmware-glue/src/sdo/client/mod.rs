//! The client.

mod data;
mod read;
mod write;

pub use data::{Filled, Sink, Source};
pub use read::SdoRead;
pub use write::SdoWrite;

use core::fmt;

use crate::abort::AbortCode;
use crate::bus::clock::{Duration, Instant};
use crate::bus::frame::Frame;
use crate::sdo::Channel;
use crate::sdo::codec::{Aborted, Answer, Request};
use crate::table::entry::EntryId;

/// How data travel that do not fit into one frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Way {
    /// In segments: every server can.
    Segments,
    /// In blocks with a checksum; in segments after all, if the server cannot do the one or the other.
    #[cfg(feature = "sdo-block")]
    Blocks,
}

/// A client on one SDO channel: how it reads and writes. What goes on is in [`SdoRead`] and
/// [`SdoWrite`], which the methods begin; a channel has room for one at a time.
///
/// ```
/// use firmware_glue::clock::Instant;
/// use firmware_glue::frame::Frame;
/// use firmware_glue::sdo::{Channel, Filled, SdoClient};
/// use firmware_glue::{EntryId, NodeId};
///
/// let channel = Channel::predefined(NodeId::new(5).ok_or("1 to 127")?);
/// let (mut buffer, entry) = ([0; 64], EntryId { index: 0x1000, sub: 0 });
/// let client = SdoClient::new(channel);
/// let (mut reading, request) = client.start_read(entry, Filled::new(&mut buffer), Instant::ZERO);
/// // Send the request. Then, for every frame that comes, and now and then with `poll`:
/// assert_eq!(request, Frame::full(channel.request, [0x40, 0x00, 0x10, 0, 0, 0, 0, 0]));
/// let answer = Frame::full(channel.answer, [0x43, 0x00, 0x10, 0, 0x92, 1, 2, 0]);
/// let step = reading.handle(&answer, Instant::from_millis(1));
/// assert_eq!((step.send, step.outcome), (None, Some(Ok(4))));
/// assert_eq!(reading.sink().bytes(), [0x92, 1, 2, 0]);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct SdoClient {
    /// The channel to the server.
    pub channel: Channel,
    /// How longer data travel; in segments, unless something else is asked for.
    pub way: Way,
    /// Time without an answer after which a transfer is given up.
    pub timeout: Duration,
    /// Segments that a server may send at once in a block, 1 to 127.
    #[cfg(feature = "sdo-block")]
    pub block_size: u8,
}

/// What has to be done after a frame or a while.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[must_use = "it may hold a frame to be sent"]
pub struct Step {
    /// What is to be sent, also when the transfer is over.
    pub send: Option<Frame>,
    /// How the transfer ended, if it did: the number of bytes that went over.
    pub outcome: Option<Result<u32, Failure>>,
}

/// Why a transfer failed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Failure {
    /// The server refused or gave up.
    Server(AbortCode),
    /// The client gave up, and informs the server: no answer in time, a wrong one, what the sink or the source says.
    Client(AbortCode),
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Server(code) => write!(f, "refused by the server: {code}"),
            Self::Client(code) => write!(f, "given up by the client: {code}"),
        }
    }
}

impl core::error::Error for Failure {}

impl Step {
    pub(super) const NOTHING: Self = Self { send: None, outcome: None };

    pub(super) const fn done(bytes: u32) -> Self {
        Self { send: None, outcome: Some(Ok(bytes)) }
    }

    pub(super) const fn failed(failure: Failure) -> Self {
        Self { send: None, outcome: Some(Err(failure)) }
    }
}

impl SdoClient {
    /// A client on a channel.
    pub const fn new(channel: Channel) -> Self {
        Self {
            channel,
            way: Way::Segments,
            timeout: super::DEFAULT_TIMEOUT,
            #[cfg(feature = "sdo-block")]
            block_size: super::DEFAULT_BLOCK_SIZE,
        }
    }

    pub(super) const fn line(self, id: EntryId, now: Instant) -> Line {
        Line { channel: self.channel, timeout: self.timeout, heard: now, id, is_over: false }
    }
}

/// What every transfer of a client has.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line {
    channel: Channel,
    timeout: Duration,
    heard: Instant,
    pub(super) id: EntryId,
    is_over: bool,
}

impl Line {
    /// The bytes of a frame of the server, as long as the transfer goes on.
    pub(super) fn hear(&mut self, frame: &Frame, now: Instant) -> Option<[u8; 8]> {
        if self.is_over || frame.id() != self.channel.answer {
            return None;
        }
        let bytes = *frame.all_eight()?;
        self.heard = now;
        Some(bytes)
    }

    pub(super) fn frame(&self, bytes: [u8; 8]) -> Frame {
        Frame::full(self.channel.request, bytes)
    }

    pub(super) fn send(&self, request: Request) -> Step {
        self.send_bytes(request.encode())
    }

    pub(super) fn send_bytes(&self, bytes: [u8; 8]) -> Step {
        Step { send: Some(self.frame(bytes)), outcome: None }
    }

    /// Sends what was not asked for: the time for an answer begins anew.
    #[cfg(feature = "sdo-block")]
    pub(super) fn send_unasked(&mut self, bytes: [u8; 8], now: Instant) -> Step {
        self.heard = now;
        self.send_bytes(bytes)
    }

    /// The server is informed that it is over.
    pub(super) fn abort(&self, code: AbortCode) -> Frame {
        self.frame(Aborted { id: self.id, code }.encode())
    }

    /// Ends the transfer; the frame is for the server.
    pub(super) fn cancel(&mut self, code: AbortCode) -> Frame {
        self.is_over = true;
        self.abort(code)
    }

    /// Remembers the end, if it is one.
    pub(super) fn close(&mut self, outcome: Result<Step, AbortCode>) -> Step {
        let step = outcome.unwrap_or_else(|code| Step {
            send: Some(self.abort(code)),
            outcome: Some(Err(Failure::Client(code))),
        });
        self.is_over |= step.outcome.is_some();
        step
    }

    /// The end, when there is no answer for too long.
    pub(super) fn wait(&mut self, now: Instant) -> Step {
        match self.deadline() {
            Some(deadline) if deadline <= now => self.close(Err(AbortCode::TIMEOUT)),
            Some(_) | None => Step::NOTHING,
        }
    }

    /// When the answer is too late.
    pub(super) fn deadline(&self) -> Option<Instant> {
        if self.is_over { None } else { Some(self.heard + self.timeout) }
    }

    #[cfg(feature = "sdo-block")]
    pub(super) const fn is_over(&self) -> bool {
        self.is_over
    }

    /// Whether an abort is about this transfer: it names its entry, or none.
    pub(super) fn is_ours(&self, aborted: Aborted) -> bool {
        aborted.id == self.id || aborted.id == NO_ENTRY
    }

    /// Whether an answer names another entry: it comes late, and belongs to a transfer that was given up.
    pub(super) fn is_foreign(&self, answer: &Answer) -> bool {
        match answer {
            Answer::Download { id }
            | Answer::UploadExpedited { id, .. }
            | Answer::Upload { id, .. }
            | Answer::BlockDownload { id, .. }
            | Answer::BlockUpload { id, .. } => *id != self.id,
            Answer::DownloadSegment { .. }
            | Answer::UploadSegment(_)
            | Answer::BlockDownloadReceived(_)
            | Answer::BlockDownloadEnd
            | Answer::BlockUploadEnd { .. } => false,
            Answer::Abort(aborted) => !self.is_ours(*aborted),
        }
    }
}

/// Of an abort by a server that knows of no transfer.
const NO_ENTRY: EntryId = EntryId { index: 0, sub: 0 };

/// Whether a server that refuses to begin with blocks may do without: what it says is about the protocol, not about the entry.
#[cfg(feature = "sdo-block")]
pub(super) fn is_about_blocks(code: AbortCode) -> bool {
    let protocol = code.0 >> 16 == 0x0504 && code != AbortCode::TIMEOUT;
    protocol || code == AbortCode::UNSUPPORTED_ACCESS
}
