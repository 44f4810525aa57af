//! Writing to a server.

#[cfg(feature = "sdo-block")]
use super::block::Sender;
#[cfg(feature = "sdo-block")]
use super::client::is_about_blocks;
use super::client::{Failure, Line, SdoClient, Step, Way};
use super::codec::{Answer, Expedited, Request, Segment};
use super::data::Source;
use super::piece::gather;
use crate::abort::AbortCode;
use crate::frame::Frame;
use crate::id::EntryId;

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
    /// The server cannot do checksums and was told that blocks are not wanted; segments are next.
    #[cfg(feature = "sdo-block")]
    Again,
    Over,
}

impl SdoClient {
    /// Begins to write an entry, at a time in microseconds; gives the request to be sent. One to four bytes go in one frame.
    ///
    /// # Errors
    /// What the source says, or [`AbortCode::LENGTH`] if it has not as many bytes as it says.
    pub fn start_write<S: Source>(
        &self,
        id: EntryId,
        mut source: S,
        now: u32,
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
    /// Takes a frame that was received, at a time in microseconds. Frames that are not from the server are left alone.
    pub fn handle(&mut self, frame: &Frame, now: u32) -> Step {
        if matches!(self.state, State::Over) {
            return Step::NOTHING;
        }
        let Some(bytes) = self.line.hear(frame, now) else { return Step::NOTHING };
        let outcome = self.take(bytes);
        self.close(outcome)
    }

    /// Whether there is something to be done without an answer: the next segment of a block, or an end, because there is no
    /// answer for too long. Call it until it has nothing to send.
    pub fn poll(&mut self, now: u32) -> Step {
        match self.state {
            State::Over => return Step::NOTHING,
            #[cfg(feature = "sdo-block")]
            State::Again => {
                self.line.heard_at(now);
                return self.announce();
            }
            #[cfg(feature = "sdo-block")]
            State::Blocks(sender) if sender.offset().is_some() => {
                self.line.heard_at(now);
                let outcome = self.next_of_block(sender).map(|bytes| self.line.send_bytes(bytes));
                return self.close(outcome);
            }
            _ => {}
        }
        if self.line.is_late(now) { self.close(Err(AbortCode::TIMEOUT)) } else { Step::NOTHING }
    }

    /// Gives up; the frame is for the server.
    pub fn cancel(&mut self, code: AbortCode) -> Frame {
        self.state = State::Over;
        self.line.abort(code)
    }

    /// Remembers the end, if it is one.
    fn close(&mut self, outcome: Result<Step, AbortCode>) -> Step {
        let step = outcome.unwrap_or_else(|code| self.line.give_up(code));
        if step.outcome.is_some() {
            self.state = State::Over;
        }
        step
    }

    fn take(&mut self, bytes: [u8; 8]) -> Result<Step, AbortCode> {
        let answer = Answer::decode(bytes).ok_or(AbortCode::COMMAND)?;
        if self.line.is_foreign(&answer) {
            return Ok(Step::NOTHING);
        }
        match (self.state, answer) {
            #[cfg(feature = "sdo-block")]
            (State::BlocksAnnounced, Answer::Abort(aborted)) if is_about_blocks(aborted.code) => {
                Ok(self.announce())
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
    fn announce(&mut self) -> Step {
        self.state = State::Announced;
        self.line.send(Request::Download { id: self.line.id, size: self.source.size() })
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
