//! Reading from a server.

use super::data::Sink;
#[cfg(feature = "sdo-block")]
use super::is_about_blocks;
use super::{Failure, Line, SdoClient, Step, Way};
use crate::abort::AbortCode;
use crate::bus::clock::Instant;
use crate::bus::frame::Frame;
#[cfg(feature = "sdo-block")]
use crate::sdo::block::{Receiver, check_block_size};
#[cfg(feature = "sdo-block")]
use crate::sdo::codec::BlockSegment;
use crate::sdo::codec::{Answer, Request, Segment};
use crate::table::entry::EntryId;

/// An entry that is being read.
#[derive(Debug)]
pub struct SdoRead<S> {
    line: Line,
    state: State,
    announced: Option<u32>,
    came: u32,
    sink: S,
}

#[derive(Debug, Clone, Copy)]
enum State {
    /// The first answer is missing.
    Asked,
    Segments {
        toggle: bool,
    },
    #[cfg(feature = "sdo-block")]
    BlocksAsked {
        block_size: u8,
    },
    #[cfg(feature = "sdo-block")]
    Blocks(Receiver),
    /// The server cannot do checksums and was informed that blocks are not wanted; segments are next.
    #[cfg(feature = "sdo-block")]
    Again,
}

impl SdoClient {
    /// Begins to read an entry, gives the request to be sent.
    ///
    /// A server that does not say how many of four bytes are the value is believed to mean all four.
    pub fn start_read<S: Sink>(&self, id: EntryId, sink: S, now: Instant) -> (SdoRead<S>, Frame) {
        let (state, request) = match self.way {
            Way::Segments => (State::Asked, Request::Upload { id }),
            #[cfg(feature = "sdo-block")]
            Way::Blocks => {
                let block_size = check_block_size(self.block_size).unwrap_or(crate::sdo::DEFAULT_BLOCK_SIZE);
                let request = Request::BlockUpload { id, crc: true, block_size, threshold: EXPEDITED };
                (State::BlocksAsked { block_size }, request)
            }
        };
        let line = self.line(id, now);
        let frame = line.frame(request.encode());
        (SdoRead { line, state, announced: None, came: 0, sink }, frame)
    }
}

/// Bytes that a server need not send in a block, as they fit into its first answer.
#[cfg(feature = "sdo-block")]
const EXPEDITED: u8 = 4;

impl<S: Sink> SdoRead<S> {
    /// Where the data go.
    pub const fn sink(&self) -> &S {
        &self.sink
    }

    /// The same, when the transfer is over.
    pub fn into_sink(self) -> S {
        self.sink
    }

    /// How the data travel: in segments also where the server refuses blocks.
    pub const fn way(&self) -> Way {
        match self.state {
            State::Asked | State::Segments { .. } => Way::Segments,
            #[cfg(feature = "sdo-block")]
            State::Again => Way::Segments,
            #[cfg(feature = "sdo-block")]
            State::BlocksAsked { .. } | State::Blocks(_) => Way::Blocks,
        }
    }

    /// Takes a frame that was received. Frames that are not from the server are left alone.
    pub fn handle(&mut self, frame: &Frame, now: Instant) -> Step {
        let Some(bytes) = self.line.hear(frame, now) else { return Step::NOTHING };
        let outcome = self.take(bytes);
        self.line.close(outcome)
    }

    /// Whether there is something to be done without an answer: an end, because there is none for too long.
    pub fn poll(&mut self, now: Instant) -> Step {
        #[cfg(feature = "sdo-block")]
        if self.is_to_send() {
            self.state = State::Asked;
            return self.line.send_unasked(Request::Upload { id: self.line.id }.encode(), now);
        }
        self.line.wait(now)
    }

    /// When [`poll`](Self::poll) has something to do, unless a frame comes before; `None` when the transfer is over.
    pub fn next_deadline(&self) -> Option<Instant> {
        #[cfg(feature = "sdo-block")]
        if self.is_to_send() {
            return Some(Instant::ZERO);
        }
        self.line.deadline()
    }

    /// Whether there is something to send at once.
    #[cfg(feature = "sdo-block")]
    fn is_to_send(&self) -> bool {
        !self.line.is_over() && matches!(self.state, State::Again)
    }

    /// Gives up; the frame is for the server.
    pub fn cancel(&mut self, code: AbortCode) -> Frame {
        self.line.cancel(code)
    }

    fn take(&mut self, bytes: [u8; 8]) -> Result<Step, AbortCode> {
        #[cfg(feature = "sdo-block")]
        if let State::Blocks(receiver) = &mut self.state
            && !receiver.is_complete()
        {
            let segment = match BlockSegment::decode(bytes) {
                Ok(segment) => segment,
                Err(aborted) if !self.line.is_ours(aborted) => return Ok(Step::NOTHING),
                Err(aborted) => return Ok(Step::failed(Failure::Server(aborted.code))),
            };
            let taken = receiver.take(segment)?;
            if let Some(bytes) = taken.bytes {
                self.put(&bytes)?;
            }
            return Ok(match taken.received {
                Some(received) => self.line.send(Request::BlockUploadReceived(received)),
                None => Step::NOTHING,
            });
        }
        let answer = Answer::decode(bytes).ok_or(AbortCode::COMMAND)?;
        if self.line.is_foreign(&answer) {
            return Ok(Step::NOTHING);
        }
        match (self.state, answer) {
            #[cfg(feature = "sdo-block")]
            (State::BlocksAsked { .. }, Answer::Abort(aborted)) if is_about_blocks(aborted.code) => {
                self.state = State::Asked;
                Ok(self.line.send(Request::Upload { id: self.line.id }))
            }
            (_, Answer::Abort(aborted)) => Ok(Step::failed(Failure::Server(aborted.code))),
            (state, Answer::UploadExpedited { value, .. }) if is_first(state) => {
                self.begin(value.length().map(u32::from))?;
                self.put(value.bytes())?;
                self.end()
            }
            (state, Answer::Upload { size, .. }) if is_first(state) => {
                self.begin(size)?;
                self.state = State::Segments { toggle: false };
                Ok(self.line.send(Request::UploadSegment { toggle: false }))
            }
            (State::Segments { toggle: asked }, Answer::UploadSegment(segment)) => {
                self.segment(asked, segment)
            }
            #[cfg(feature = "sdo-block")]
            (State::BlocksAsked { block_size }, Answer::BlockUpload { crc, size, .. }) => {
                if !crc {
                    self.state = State::Again;
                    return Ok(Step { send: Some(self.line.abort(AbortCode::GENERAL)), outcome: None });
                }
                self.begin(size)?;
                self.state = State::Blocks(Receiver::new(block_size));
                Ok(self.line.send(Request::BlockUploadStart))
            }
            #[cfg(feature = "sdo-block")]
            (State::Blocks(receiver), Answer::BlockUploadEnd { unused, crc }) => {
                let piece = receiver.finish(unused, Some(crc))?;
                self.put(piece.bytes())?;
                let end = self.end()?;
                Ok(Step { send: self.line.send(Request::BlockUploadEnd).send, ..end })
            }
            // What was sent before the server heard that blocks are not wanted.
            #[cfg(feature = "sdo-block")]
            (State::Again, _) => Ok(Step::NOTHING),
            _ => Err(AbortCode::COMMAND),
        }
    }

    fn segment(&mut self, asked: bool, Segment { toggle, piece }: Segment) -> Result<Step, AbortCode> {
        if toggle != asked {
            return Err(AbortCode::TOGGLE_BIT);
        }
        self.put(piece.bytes())?;
        if piece.last {
            return self.end();
        }
        self.state = State::Segments { toggle: !asked };
        Ok(self.line.send(Request::UploadSegment { toggle: !asked }))
    }

    fn begin(&mut self, size: Option<u32>) -> Result<(), AbortCode> {
        self.announced = size;
        self.sink.begin(size)
    }

    fn put(&mut self, data: &[u8]) -> Result<(), AbortCode> {
        let length = u32::try_from(data.len()).map_err(|_| AbortCode::INTERNAL)?;
        let came = self.came.checked_add(length).ok_or(AbortCode::TOO_LONG)?;
        if self.announced.is_some_and(|announced| came > announced) {
            return Err(AbortCode::TOO_LONG);
        }
        self.sink.put(self.came, data)?;
        self.came = came;
        Ok(())
    }

    fn end(&self) -> Result<Step, AbortCode> {
        match self.announced {
            Some(announced) if announced != self.came => Err(AbortCode::TOO_SHORT),
            _ => Ok(Step::done(self.came)),
        }
    }
}

/// Whether the answer to the first request is missing.
fn is_first(state: State) -> bool {
    match state {
        State::Asked => true,
        #[cfg(feature = "sdo-block")]
        State::BlocksAsked { .. } => true,
        #[cfg(feature = "sdo-block")]
        State::Blocks(_) | State::Again => false,
        State::Segments { .. } => false,
    }
}
