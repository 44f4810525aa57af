//! Writing to a server.

use super::data::Source;
#[cfg(feature = "sdo-block")]
use super::is_about_blocks;
use super::{Failure, Line, SdoClient, Step, Way};
use crate::abort::AbortCode;
use crate::bus::clock::Instant;
use crate::bus::frame::Frame;
#[cfg(feature = "sdo-block")]
use crate::sdo::block::Sender;
use crate::sdo::codec::{Answer, Expedited, Request, Segment};
use crate::sdo::piece::gather;
use crate::table::entry::EntryId;

/// An entry that is being written.
#[derive(Debug)]
pub struct SdoWrite<S> {
    line: Line,
    state: State,
    /// Bytes that were sent, in blocks: that are known to have come.
    sent: u32,
    source: S,
}

#[derive(Debug, Clone, Copy)]
enum State {
    /// The one answer to a short value is missing.
    Whole,
    /// The answer to the announcement is missing.
    Announced,
    Segments {
        toggle: bool,
        last: bool,
    },
    #[cfg(feature = "sdo-block")]
    BlocksAnnounced,
    #[cfg(feature = "sdo-block")]
    Blocks(Sender),
    /// Everything came, and the server has to say what it thinks of it.
    #[cfg(feature = "sdo-block")]
    Ended,
    /// The server cannot do checksums and was informed that blocks are not wanted; segments are next.
    #[cfg(feature = "sdo-block")]
    Again,
}

/// What is sent without having been asked for.
#[cfg(feature = "sdo-block")]
#[derive(Debug, Clone, Copy)]
enum Unasked {
    /// The transfer begins again, in segments.
    Announcement,
    /// The next segment of a block.
    Segment(Sender),
}

impl SdoClient {
    /// Begins to write an entry, gives the request to be sent. One to four bytes go in one frame.
    ///
    /// # Errors
    /// What the source says, or [`AbortCode::LENGTH`] if it has not as many bytes as it says.
    pub fn start_write<S: Source>(
        &self,
        id: EntryId,
        mut source: S,
        now: Instant,
    ) -> Result<(SdoWrite<S>, Frame), AbortCode> {
        let size = source.size();
        let (state, request, sent) = if let Some(size @ 1..=4) = size {
            let piece = gather(0, |from, room| source.copy(from, room))?;
            let value = Expedited::new(piece.bytes()).ok_or(AbortCode::LENGTH)?;
            if value.length().map(u32::from) != Some(size) {
                return Err(AbortCode::LENGTH);
            }
            (State::Whole, Request::DownloadExpedited { id, value }, size)
        } else {
            match self.way {
                Way::Segments => (State::Announced, Request::Download { id, size }, 0),
                #[cfg(feature = "sdo-block")]
                Way::Blocks => (State::BlocksAnnounced, Request::BlockDownload { id, crc: true, size }, 0),
            }
        };
        let line = self.line(id, now);
        let frame = line.frame(request.encode());
        Ok((SdoWrite { line, state, sent, source }, frame))
    }
}

impl<S: Source> SdoWrite<S> {
    /// Takes a frame that was received. Frames that are not from the server are left alone.
    pub fn handle(&mut self, frame: &Frame, now: Instant) -> Step {
        let Some(bytes) = self.line.hear(frame, now) else { return Step::NOTHING };
        let outcome = self.take(bytes);
        self.line.close(outcome)
    }

    /// Whether there is something to be done without an answer: the next segment of a block, or an end, because there is no
    /// answer for too long. Call it until it has nothing to send.
    pub fn poll(&mut self, now: Instant) -> Step {
        #[cfg(feature = "sdo-block")]
        if let Some(next) = self.unasked() {
            let outcome = match next {
                Unasked::Announcement => Ok(self.announce()),
                Unasked::Segment(sender) => self.next_of_block(sender),
            };
            let outcome = outcome.map(|bytes| self.line.send_unasked(bytes, now));
            return self.line.close(outcome);
        }
        self.line.wait(now)
    }

    /// When [`poll`](Self::poll) has something to do, unless a frame comes before; `None` when the transfer is over.
    pub fn next_deadline(&self) -> Option<Instant> {
        #[cfg(feature = "sdo-block")]
        if self.unasked().is_some() {
            return Some(Instant::ZERO);
        }
        self.line.deadline()
    }

    /// What there is to send without an answer.
    #[cfg(feature = "sdo-block")]
    fn unasked(&self) -> Option<Unasked> {
        match self.state {
            _ if self.line.is_over() => None,
            State::Again => Some(Unasked::Announcement),
            State::Blocks(sender) if sender.offset().is_some() => Some(Unasked::Segment(sender)),
            _ => None,
        }
    }

    /// Gives up; the frame is for the server.
    pub fn cancel(&mut self, code: AbortCode) -> Frame {
        self.line.cancel(code)
    }

    fn take(&mut self, bytes: [u8; 8]) -> Result<Step, AbortCode> {
        let answer = Answer::decode(bytes).ok_or(AbortCode::COMMAND)?;
        if self.line.is_foreign(&answer) {
            return Ok(Step::NOTHING);
        }
        match (self.state, answer) {
            #[cfg(feature = "sdo-block")]
            (State::BlocksAnnounced, Answer::Abort(aborted)) if is_about_blocks(aborted.code) => {
                let bytes = self.announce();
                Ok(self.line.send_bytes(bytes))
            }
            (_, Answer::Abort(aborted)) => Ok(Step::failed(Failure::Server(aborted.code))),
            (State::Whole, Answer::Download { .. }) => Ok(Step::done(self.sent)),
            (State::Announced, Answer::Download { .. }) => self.segment(false),
            (State::Segments { toggle, last }, Answer::DownloadSegment { toggle: taken }) => {
                if taken != toggle {
                    return Err(AbortCode::TOGGLE_BIT);
                }
                if last { Ok(Step::done(self.sent)) } else { self.segment(!toggle) }
            }
            #[cfg(feature = "sdo-block")]
            (State::BlocksAnnounced, Answer::BlockDownload { crc, block_size, .. }) => {
                if !crc {
                    self.state = State::Again;
                    return Ok(Step { send: Some(self.line.abort(AbortCode::GENERAL)), outcome: None });
                }
                let bytes = self.next_of_block(Sender::new(block_size)?)?;
                Ok(self.line.send_bytes(bytes))
            }
            #[cfg(feature = "sdo-block")]
            (State::Blocks(mut sender), Answer::BlockDownloadReceived(received)) => {
                if sender.offset().is_some() {
                    // It says nothing about a block that is not yet sent.
                    return Ok(Step::NOTHING);
                }
                match sender.received(received)? {
                    Some(end) => {
                        self.state = State::Ended;
                        self.sent = sender.length();
                        Ok(self.line.send(Request::BlockDownloadEnd { unused: end.unused, crc: end.crc }))
                    }
                    None => {
                        let bytes = self.next_of_block(sender)?;
                        Ok(self.line.send_bytes(bytes))
                    }
                }
            }
            #[cfg(feature = "sdo-block")]
            (State::Ended, Answer::BlockDownloadEnd) => Ok(Step::done(self.sent)),
            #[cfg(feature = "sdo-block")]
            (State::Again, _) => Ok(Step::NOTHING),
            _ => Err(AbortCode::COMMAND),
        }
    }

    /// Begins with segments, where blocks are not possible.
    #[cfg(feature = "sdo-block")]
    fn announce(&mut self) -> [u8; 8] {
        self.state = State::Announced;
        Request::Download { id: self.line.id, size: self.source.size() }.encode()
    }

    fn segment(&mut self, toggle: bool) -> Result<Step, AbortCode> {
        let piece = gather(self.sent, |from, room| self.source.copy(from, room))?;
        let sent = self.sent.checked_add(u32::from(7 - piece.unused()));
        self.sent = sent.ok_or(AbortCode::TOO_LONG)?;
        self.state = State::Segments { toggle, last: piece.last };
        Ok(self.line.send(Request::DownloadSegment(Segment { toggle, piece })))
    }

    /// The next segment of a block.
    #[cfg(feature = "sdo-block")]
    fn next_of_block(&mut self, mut sender: Sender) -> Result<[u8; 8], AbortCode> {
        let offset = sender.offset().ok_or(AbortCode::TOO_LONG)?;
        let piece = gather(offset, |from, room| self.source.copy(from, room))?;
        let segment = sender.segment(piece);
        self.state = State::Blocks(sender);
        Ok(segment.encode())
    }
}
