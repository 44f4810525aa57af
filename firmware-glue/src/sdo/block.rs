//! Blocks of segments, as either side sends and takes them (CiA 301 7.2.4.2.9 to 7.2.4.2.16).

use super::codec::{BlockSegment, Piece, Received};
use super::crc::Crc;
use crate::abort::AbortCode;

/// Bytes of a segment.
const SEGMENT: u32 = 7;

/// Checks the number of segments that the other side takes in a block.
pub(crate) const fn check_block_size(size: u8) -> Result<u8, AbortCode> {
    if matches!(size, 1..=127) { Ok(size) } else { Err(AbortCode::BLOCK_SIZE) }
}

/// Blocks in a row of which nothing came, after which the sender gives up: the other side answers, so that no time runs out.
const HOPELESS: u8 = 8;

/// How a transfer in blocks ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct End {
    /// Bytes of the last segment that are padding.
    pub(crate) unused: u8,
    /// Checksum of all bytes.
    pub(crate) crc: u16,
}

/// Sends blocks.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sender {
    block_size: u8,
    /// Segments of this block that were sent.
    sent: u8,
    /// Where the block begins in the data.
    start: u32,
    /// Of the last segment, once it was sent in this block.
    unused: Option<u8>,
    crc: Crc,
    /// Bytes that are in the checksum: what is sent again is not summed again.
    summed: u32,
    /// Blocks in a row of which nothing came.
    in_vain: u8,
}

impl Sender {
    pub(crate) fn new(block_size: u8) -> Result<Self, AbortCode> {
        let block_size = check_block_size(block_size)?;
        Ok(Self { block_size, sent: 0, start: 0, unused: None, crc: Crc::default(), summed: 0, in_vain: 0 })
    }

    /// Where the next segment begins in the data, as long as the block has one.
    pub(crate) fn offset(&self) -> Option<u32> {
        let open = self.unused.is_none() && self.sent < self.block_size;
        if open { self.start.checked_add(SEGMENT * u32::from(self.sent)) } else { None }
    }

    /// Bytes that were sent, each counted once.
    pub(crate) const fn length(&self) -> u32 {
        self.summed
    }

    /// The next segment, with the data from [`offset`](Self::offset) on.
    pub(crate) fn segment(&mut self, piece: Piece) -> BlockSegment {
        if self.offset() == Some(self.summed) {
            self.crc.update(piece.bytes());
            self.summed = self.summed.saturating_add(SEGMENT - u32::from(piece.unused()));
        }
        self.sent += 1;
        if piece.last {
            self.unused = Some(piece.unused());
        }
        BlockSegment { sequence: self.sent, last: piece.last, bytes: piece.padded() }
    }

    /// Goes on with what did not come, or with the next block; the end, when all came.
    pub(crate) fn received(&mut self, received: Received) -> Result<Option<End>, AbortCode> {
        if received.sequence > self.sent {
            return Err(AbortCode::SEQUENCE);
        }
        if let (Some(unused), true) = (self.unused, received.sequence == self.sent) {
            return Ok(Some(End { unused, crc: self.crc.value() }));
        }
        let block_size = check_block_size(received.block_size)?;
        let in_vain = if received.sequence == 0 { self.in_vain + 1 } else { 0 };
        if in_vain >= HOPELESS {
            return Err(AbortCode::SEQUENCE);
        }
        let came = SEGMENT * u32::from(received.sequence);
        let start = self.start.checked_add(came).ok_or(AbortCode::TOO_LONG)?;
        *self = Self { block_size, sent: 0, start, unused: None, in_vain, ..*self };
        Ok(None)
    }
}

/// Takes blocks.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Receiver {
    block_size: u8,
    /// The last segment of this block up to which all came.
    good: u8,
    /// The last segment that came: it may be the last of all, of which not every byte counts.
    held: Option<[u8; 7]>,
    /// Whether it is.
    complete: bool,
    crc: Crc,
}

/// What came of a segment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Taken {
    /// Data that are settled.
    pub(crate) bytes: Option<[u8; 7]>,
    /// What the other side is sent at the end of a block.
    pub(crate) received: Option<Received>,
}

impl Receiver {
    /// For blocks of up to so many segments, 1 to 127.
    pub(crate) fn new(block_size: u8) -> Self {
        Self { block_size, good: 0, held: None, complete: false, crc: Crc::default() }
    }

    /// Whether the last segment came.
    pub(crate) const fn is_complete(&self) -> bool {
        self.complete
    }

    /// Takes a segment that is the next, and leaves out every other: it comes again after the block.
    pub(crate) fn take(&mut self, segment: BlockSegment) -> Result<Taken, AbortCode> {
        if segment.sequence == 0 || segment.sequence > self.block_size {
            return Err(AbortCode::SEQUENCE);
        }
        let mut bytes = None;
        if segment.sequence == self.good + 1 {
            self.good = segment.sequence;
            self.complete = segment.last;
            bytes = self.held.replace(segment.bytes);
            if let Some(bytes) = &bytes {
                self.crc.update(bytes);
            }
        }
        let ends = segment.last || segment.sequence == self.block_size;
        let received = ends.then_some(Received { sequence: self.good, block_size: self.block_size });
        if ends {
            self.good = 0;
        }
        Ok(Taken { bytes, received })
    }

    /// The last segment, when its bytes are counted and the checksum, where there is one, is right.
    pub(crate) fn finish(mut self, unused: u8, crc: Option<u16>) -> Result<Piece, AbortCode> {
        let (Some(held), true) = (self.held, self.complete) else { return Err(AbortCode::COMMAND) };
        let length = 7_usize.saturating_sub(usize::from(unused));
        let bytes = held.get(..length).unwrap_or_default();
        self.crc.update(bytes);
        if crc.is_some_and(|crc| crc != self.crc.value()) {
            return Err(AbortCode::CRC);
        }
        Ok(Piece::first_of(bytes))
    }
}

#[cfg(test)]
mod tests {
    use super::{BlockSegment, End, HOPELESS, Piece, Received, Receiver, Sender};
    use crate::abort::AbortCode;

    fn segment(sequence: u8, last: bool) -> BlockSegment {
        BlockSegment { sequence, last, bytes: [sequence; 7] }
    }

    #[test]
    fn a_segment_that_is_missing_is_asked_for_at_the_end_of_the_block() {
        let mut receiver = Receiver::new(3);
        assert_eq!(receiver.take(segment(1, false)).expect("in the block").received, None);
        let taken = receiver.take(segment(3, false)).expect("in the block");
        assert_eq!((taken.bytes, taken.received), (None, Some(Received { sequence: 1, block_size: 3 })));
        // Numbers start anew.
        let taken = receiver.take(segment(1, true)).expect("in the block");
        let received = Some(Received { sequence: 1, block_size: 3 });
        assert_eq!((taken.bytes, taken.received), (Some([1; 7]), received));
        assert!(receiver.is_complete());
    }

    #[test]
    fn a_number_outside_the_block_is_wrong() {
        let mut receiver = Receiver::new(3);
        assert_eq!(receiver.take(segment(0, false)), Err(AbortCode::SEQUENCE));
        assert_eq!(receiver.take(segment(4, false)), Err(AbortCode::SEQUENCE));
    }

    #[test]
    fn the_checksum_does_not_count_what_is_sent_again() {
        let data = b"123456789";
        let mut sender = Sender::new(2).expect("1 to 127");
        let mut send = |received| {
            while let Some(offset) = sender.offset() {
                let rest = usize::try_from(offset).ok().and_then(|at| data.get(at..)).expect("in the data");
                sender.segment(Piece::first_of(rest));
            }
            sender.received(Received { sequence: received, block_size: 2 })
        };
        assert_eq!(send(0), Ok(None));
        assert_eq!(send(1), Ok(None));
        assert_eq!(send(1), Ok(Some(End { unused: 5, crc: 0x31C3 })));
        assert_eq!(Sender::new(0).map(|_| ()), Err(AbortCode::BLOCK_SIZE));
        assert_eq!(Sender::new(128).map(|_| ()), Err(AbortCode::BLOCK_SIZE));
    }

    #[test]
    fn who_takes_nothing_for_ever_is_left() {
        let mut sender = Sender::new(2).expect("1 to 127");
        let mut block = |came| {
            while sender.offset().is_some() {
                sender.segment(Piece::first_of(&[0; 100]));
            }
            sender.received(Received { sequence: came, block_size: 2 })
        };
        // What comes in between is a hope.
        for _ in 0..3 {
            assert!((1..HOPELESS).all(|_| block(0) == Ok(None)));
            assert_eq!(block(1), Ok(None));
        }
        assert!((1..HOPELESS).all(|_| block(0) == Ok(None)));
        assert_eq!(block(0), Err(AbortCode::SEQUENCE));
    }

    #[test]
    fn more_cannot_have_come_than_was_sent() {
        let mut sender = Sender::new(2).expect("1 to 127");
        assert_eq!(sender.received(Received { sequence: 1, block_size: 2 }), Err(AbortCode::SEQUENCE));
        assert_eq!(sender.received(Received { sequence: 0, block_size: 0 }), Err(AbortCode::BLOCK_SIZE));
    }
}
