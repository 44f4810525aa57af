//! The client.

use core::fmt;

use super::Channel;
use super::codec::{Aborted, Answer, Request};
use crate::abort::AbortCode;
use crate::frame::Frame;
use crate::id::EntryId;

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

/// A client on one SDO channel: how it reads and writes. What goes on is in [`SdoRead`](super::SdoRead) and
/// [`SdoWrite`](super::SdoWrite), which the methods begin; a channel has room for one at a time.
///
/// ```
/// use firmware_glue::EntryId;
/// use firmware_glue::frame::Frame;
/// use firmware_glue::sdo::{Channel, Filled, SdoClient};
///
/// let channel = Channel::predefined(5).ok_or("1 to 127")?;
/// let (mut buffer, entry) = ([0; 64], EntryId { index: 0x1000, sub: 0 });
/// let (mut reading, request) = SdoClient::new(channel).start_read(entry, Filled::new(&mut buffer), 0);
/// // Send the request. Then, for every frame that comes, and now and then with `poll`:
/// assert_eq!(request, Frame::full(channel.request, [0x40, 0x00, 0x10, 0, 0, 0, 0, 0]));
/// let answer = Frame::full(channel.answer, [0x43, 0x00, 0x10, 0, 0x92, 1, 2, 0]);
/// let step = reading.handle(&answer, 1_000);
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
    /// Microseconds without an answer after which a transfer is given up.
    pub timeout: u32,
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
    /// The client gave up, and tells the server: no answer in time, a wrong one, what the sink or the source says.
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

    pub(super) const fn line(self, id: EntryId, now: u32) -> Line {
        Line { channel: self.channel, timeout: self.timeout, heard: now, id }
    }
}

/// What every transfer of a client has.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line {
    channel: Channel,
    timeout: u32,
    heard: u32,
    pub(super) id: EntryId,
}

impl Line {
    /// The bytes of a frame of the server.
    pub(super) fn hear(&mut self, frame: &Frame, now: u32) -> Option<[u8; 8]> {
        if frame.id() != self.channel.answer {
            return None;
        }
        let bytes = frame.bytes()?.try_into().ok()?;
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

    /// The time for an answer begins anew, as something is sent without having been asked for.
    #[cfg(feature = "sdo-block")]
    pub(super) fn heard_at(&mut self, now: u32) {
        self.heard = now;
    }

    /// The server is told that it is over.
    pub(super) fn abort(&self, code: AbortCode) -> Frame {
        self.frame(Aborted { id: self.id, code }.encode())
    }

    pub(super) fn give_up(&self, code: AbortCode) -> Step {
        Step { send: Some(self.abort(code)), outcome: Some(Err(Failure::Client(code))) }
    }

    pub(super) fn is_late(&self, now: u32) -> bool {
        now.wrapping_sub(self.heard) >= self.timeout
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
            | Answer::BlockUploadEnd { .. }
            | Answer::Abort(_) => false,
        }
    }
}

/// Whether a server that refuses to begin with blocks may do without: what it says is about the protocol, not about the entry.
#[cfg(feature = "sdo-block")]
pub(super) fn is_about_blocks(code: AbortCode) -> bool {
    let protocol = code.0 >> 16 == 0x0504 && code != AbortCode::TIMEOUT;
    protocol || code == AbortCode::UNSUPPORTED_ACCESS
}
