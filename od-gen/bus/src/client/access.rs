//! SDO and NMT, one access after the other.

mod load;

use std::collections::BTreeSet;
use std::fmt;
use std::time::Duration;

use firmware_glue::frame::{CanId, Frame};
use firmware_glue::sdo::{Channel, Failure, SdoClient, Sink, Source, Step, Way};
use firmware_glue::{AbortCode, NodeId, clock};
use od_spec::model::{DataType, EntryId};

use super::{Bus, BusError};
use crate::restarts::{ERROR_CONTROL, Restart, Restarts};

/// No entry of a dictionary is longer; a node that sends more is not believed.
const LONGEST: usize = 16 << 20;
/// The longest time between two checks whether a transfer is late.
const NAP: Duration = Duration::from_millis(20);
/// A node that has not sent anything for so long has nothing more to say.
const QUIET: clock::Duration = clock::Duration::from_millis(20);
/// A lost frame is no reason to give up; more of them are.
const RETRIES: u8 = 1;
/// So many frames at most are taken from what has come already.
const LEFT: usize = 1024;

/// The master of a bus: one access at a time, to any node.
#[derive(Debug)]
pub struct Client<B> {
    bus: B,
    /// Time without an answer after which a node is given up.
    timeout: clock::Duration,
    /// So often a read is repeated.
    retries: u8,
    /// Writes that were begun.
    writes: usize,
    /// Reads that succeeded only when they were repeated.
    recovered: usize,
    restarts: Restarts,
    /// Nodes that do not send blocks.
    without_blocks: BTreeSet<u8>,
}

/// Why an access failed.
#[derive(Debug)]
#[non_exhaustive]
pub enum AccessError {
    /// The node refuses.
    Refused(AbortCode),
    /// The node says nothing, or nothing more.
    Silent,
    /// What the node sends is not an answer.
    Wrong(AbortCode),
    /// The node's answer has so many bytes, and not eight.
    Short(usize),
    /// Nothing goes over the bus.
    Bus(BusError),
}

impl AccessError {
    /// Whether it is about the entry, of which the same access would say the same. A node that refuses a transfer because of its frames
    /// says nothing about the entry; some of them were lost, or came twice.
    pub const fn is_of_entry(&self) -> bool {
        match self {
            Self::Silent | Self::Wrong(_) | Self::Short(_) | Self::Bus(_) => false,
            Self::Refused(_) => !self.is_of_frames(),
        }
    }

    /// Whether frames of a transfer were lost on their way, or came twice: what the entry holds is to be had on a better bus.
    pub const fn is_of_frames(&self) -> bool {
        matches!(
            self,
            Self::Refused(
                AbortCode::TOGGLE_BIT
                    | AbortCode::TIMEOUT
                    | AbortCode::COMMAND
                    | AbortCode::BLOCK_SIZE
                    | AbortCode::SEQUENCE
                    | AbortCode::CRC,
            ) | Self::Wrong(
                AbortCode::TOGGLE_BIT | AbortCode::BLOCK_SIZE | AbortCode::SEQUENCE | AbortCode::CRC
            )
        )
    }

    /// Whether nothing answers any more: another access is not worth a try.
    pub const fn is_of_node(&self) -> bool {
        matches!(self, Self::Silent | Self::Bus(_))
    }
}

impl fmt::Display for AccessError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Refused(code) => write!(f, "the node refuses: {code}"),
            Self::Silent => f.write_str("the node does not answer"),
            Self::Wrong(code) => write!(f, "the node's answer is malformed: {code}"),
            Self::Short(bytes) => write!(f, "the node's answer has {bytes} bytes, and an answer has 8"),
            Self::Bus(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for AccessError {}

impl From<BusError> for AccessError {
    fn from(error: BusError) -> Self {
        Self::Bus(error)
    }
}

impl From<Failure> for AccessError {
    fn from(failure: Failure) -> Self {
        match failure {
            Failure::Server(code) => Self::Refused(code),
            Failure::Client(AbortCode::TIMEOUT) => Self::Silent,
            Failure::Client(code) => Self::Wrong(code),
        }
    }
}

/// Grows with what is read.
#[derive(Debug, Default)]
struct Collected(Vec<u8>);

impl Sink for Collected {
    fn begin(&mut self, size: Option<u32>) -> Result<(), AbortCode> {
        self.0.clear();
        let fits = size.is_none_or(|size| usize::try_from(size).is_ok_and(|size| size <= LONGEST));
        if fits { Ok(()) } else { Err(AbortCode::OUT_OF_MEMORY) }
    }

    fn put(&mut self, _: u32, data: &[u8]) -> Result<(), AbortCode> {
        if self.0.len() + data.len() > LONGEST {
            return Err(AbortCode::OUT_OF_MEMORY);
        }
        self.0.extend(data);
        Ok(())
    }
}

/// What a transfer is: frames go in, and now and then nothing.
trait Transfer {
    fn handle(&mut self, frame: &Frame, now: clock::Instant) -> Step;
    fn poll(&mut self, now: clock::Instant) -> Step;
    fn cancel(&mut self, code: AbortCode) -> Frame;
}

impl<S: Sink> Transfer for firmware_glue::sdo::SdoRead<S> {
    fn handle(&mut self, frame: &Frame, now: clock::Instant) -> Step {
        self.handle(frame, now)
    }

    fn poll(&mut self, now: clock::Instant) -> Step {
        self.poll(now)
    }

    fn cancel(&mut self, code: AbortCode) -> Frame {
        self.cancel(code)
    }
}

impl<S: Source> Transfer for firmware_glue::sdo::SdoWrite<S> {
    fn handle(&mut self, frame: &Frame, now: clock::Instant) -> Step {
        self.handle(frame, now)
    }

    fn poll(&mut self, now: clock::Instant) -> Step {
        self.poll(now)
    }

    fn cancel(&mut self, code: AbortCode) -> Frame {
        self.cancel(code)
    }
}

impl<B: Bus> Client<B> {
    /// A client on a bus, which waits so long for an answer, and repeats a read once.
    pub fn new(bus: B, timeout: Duration) -> Self {
        Self {
            bus,
            timeout: micros(timeout),
            retries: RETRIES,
            writes: 0,
            recovered: 0,
            restarts: Restarts::default(),
            without_blocks: BTreeSet::new(),
        }
    }

    /// The same, which repeats a read so often when a frame was lost or broken.
    #[must_use]
    pub fn with_retries(self, retries: u8) -> Self {
        Self { retries, ..self }
    }

    /// So many writes were begun.
    pub const fn writes(&self) -> usize {
        self.writes
    }

    /// The number of reads that succeeded only when they were repeated.
    pub const fn recovered(&self) -> usize {
        self.recovered
    }

    /// The bus.
    pub const fn bus(&mut self) -> &mut B {
        &mut self.bus
    }

    fn sdo(&self, node: u8) -> Result<SdoClient, AccessError> {
        let node = NodeId::new(node).ok_or(AccessError::Wrong(AbortCode::NO_CONNECTION))?;
        let mut client = SdoClient::new(Channel::predefined(node));
        client.timeout = self.timeout;
        Ok(client)
    }

    /// Microseconds from any beginning.
    pub(super) fn micros(&self) -> u64 {
        self.bus.now()
    }

    /// The time, as SDO takes it.
    fn now(&self) -> clock::Instant {
        clock::Instant::from_micros(self.micros())
    }

    /// Reads an entry of a node, all bytes that come. It is repeated when a frame was lost or broken.
    ///
    /// # Errors
    /// [`AccessError`]: nothing is known of the value.
    pub fn read(&mut self, node: u8, id: EntryId) -> Result<Vec<u8>, AccessError> {
        self.read_whole(node, id, Way::Segments).map(|(bytes, _)| bytes)
    }

    /// Reads an entry of a type: an answer that does not say how many of its four bytes are the value is as long as the type. A DOMAIN,
    /// which may be long, is read in blocks if the node has them: a value of 64 bytes then takes 3 answers in place of 11.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn read_as(&mut self, node: u8, id: EntryId, data_type: DataType) -> Result<Vec<u8>, AccessError> {
        let way = match data_type {
            DataType::Domain if !self.without_blocks.contains(&node) => Way::Blocks,
            _ => Way::Segments,
        };
        let (mut bytes, last) = self.read_whole(node, id, way)?;
        if let Some(bits) = data_type.bits().filter(|_| last.is_some_and(|last| is_without_size(&last))) {
            bytes.truncate(usize::from(bits.div_ceil(8)));
        }
        Ok(bytes)
    }

    /// What was read, and the frame that ended it. What is repeated travels in segments.
    fn read_whole(
        &mut self,
        node: u8,
        id: EntryId,
        way: Way,
    ) -> Result<(Vec<u8>, Option<Frame>), AccessError> {
        let mut client = self.sdo(node)?;
        client.way = way;
        let mut retries = self.retries;
        // Answers that may still come, too late: for the next request they are wrong.
        let mut late = 0_u8;
        loop {
            let now = self.now();
            let (mut reading, request) = client.start_read(of_bus(id), Collected::default(), now);
            self.bus.send(&request)?;
            let ended = self.finish(client.channel, &mut reading);
            let is_refused = client.way == Way::Blocks && reading.way() == Way::Segments;
            match ended {
                Ok(last) => {
                    self.recovered += usize::from(retries < self.retries);
                    if is_refused {
                        self.without_blocks.insert(node);
                    }
                    return Ok((reading.into_sink().0, last));
                }
                Err(AccessError::Wrong(_)) if late > 0 => late -= 1,
                Err(error) if retries == 0 || error.is_of_entry() || matches!(error, AccessError::Bus(_)) => {
                    return Err(error);
                }
                Err(error) => {
                    retries -= 1;
                    late += u8::from(matches!(error, AccessError::Silent));
                }
            }
            client.way = Way::Segments;
        }
    }

    /// Writes an entry of a node, once.
    ///
    /// # Errors
    /// [`AccessError`]: refused by the node it has its old value; otherwise it is unknown which.
    pub fn write(&mut self, node: u8, id: EntryId, bytes: &[u8]) -> Result<(), AccessError> {
        let client = self.sdo(node)?;
        self.give(client, id, bytes)
    }

    /// Writes an entry as a client does it, once.
    fn give(&mut self, client: SdoClient, id: EntryId, source: impl Source) -> Result<(), AccessError> {
        let begun = client.start_write(of_bus(id), source, self.now());
        let (mut writing, request) = begun.map_err(AccessError::Wrong)?;
        self.writes += 1;
        self.restarts.hear(&request);
        self.bus.send(&request)?;
        self.finish(client.channel, &mut writing).map(|_| ())
    }

    /// Brings a transfer to its end; the frame that was the last.
    fn finish(
        &mut self,
        channel: Channel,
        transfer: &mut impl Transfer,
    ) -> Result<Option<Frame>, AccessError> {
        let ended = self.carry(channel, transfer);
        match &ended {
            Ok(_) | Err(AccessError::Silent | AccessError::Bus(_)) => {}
            Err(error) if error.is_of_entry() => {}
            Err(_) => self.settle(channel)?,
        }
        ended
    }

    fn carry(
        &mut self,
        channel: Channel,
        transfer: &mut impl Transfer,
    ) -> Result<Option<Frame>, AccessError> {
        let mut nap = NAP;
        loop {
            let heard = self.hear(nap)?;
            let now = self.now();
            let answer = heard.filter(|frame| frame.id() == channel.answer);
            if let Some(bytes) = answer.and_then(|frame| frame.bytes().map(<[u8]>::len))
                && bytes < 8
            {
                let reported = transfer.cancel(AbortCode::COMMAND);
                self.bus.send(&reported)?;
                return Err(AccessError::Short(bytes));
            }
            let step = match heard {
                Some(frame) => transfer.handle(&frame, now),
                None => Step { send: None, outcome: None },
            };
            if self.follow(step)? {
                return Ok(heard);
            }
            // Other nodes may talk all the time.
            let step = transfer.poll(self.now());
            // The segments of a block follow each other without an answer.
            nap = if step.send.is_some() { Duration::ZERO } else { NAP };
            if self.follow(step)? {
                return Ok(None);
            }
        }
    }

    /// Lets pass what a node still sends of a transfer that broke: for the next one it would be a wrong answer.
    fn settle(&mut self, channel: Channel) -> Result<(), BusError> {
        let begin = self.now();
        let mut last = begin;
        while self.now() < last + QUIET && self.now() < begin + self.timeout {
            if self.hear(NAP)?.is_some_and(|frame| frame.id() == channel.answer) {
                last = self.now();
            }
        }
        Ok(())
    }

    /// Sends what a step has to send; whether it was the last.
    fn follow(&mut self, step: Step) -> Result<bool, AccessError> {
        if let Some(frame) = step.send {
            self.bus.send(&frame)?;
        }
        match step.outcome {
            None => Ok(false),
            Some(Ok(_)) => Ok(true),
            Some(Err(failure)) => Err(failure.into()),
        }
    }

    /// The next frame that others sent; which node starts is noted.
    fn hear(&mut self, within: Duration) -> Result<Option<Frame>, BusError> {
        let heard = self.bus.receive(within)?;
        if let Some(frame) = &heard {
            self.restarts.hear(frame);
        }
        Ok(heard)
    }

    /// Whether a node has started since the client is there: what it had and did not store is lost.
    ///
    /// # Errors
    /// [`BusError`]: nothing comes any more.
    pub fn restarted(&mut self, node: u8) -> Result<Option<Restart>, BusError> {
        // What has come already; on a bus where others talk all the time that has an end, too.
        for _ in 0..LEFT {
            if self.hear(Duration::from_millis(1))?.is_none() {
                break;
            }
        }
        Ok(self.restarts.of(node))
    }

    /// Gives an NMT command to a node, or with node-ID 0 to all. Nodes do not answer.
    ///
    /// # Errors
    /// [`BusError`]: it was not sent.
    pub fn command(&mut self, command: u8, node: u8) -> Result<(), BusError> {
        let Some(frame) = CanId::new(0).and_then(|id| Frame::data(id, &[command, node])) else {
            return Ok(());
        };
        // A node that does as it is commanded does not start again.
        self.restarts.hear(&frame);
        self.bus.send(&frame)
    }

    /// Waits for the boot-up message of a node; whether it came in time.
    ///
    /// # Errors
    /// [`BusError`]: nothing comes any more.
    pub fn booted(&mut self, node: u8, within: Duration) -> Result<bool, BusError> {
        let begin = self.bus.now();
        let of_node = CanId::new(ERROR_CONTROL + u16::from(node));
        while u128::from(self.bus.now().saturating_sub(begin)) < within.as_micros() {
            let heard = self.hear(NAP)?;
            if heard.is_some_and(|frame| Some(frame.id()) == of_node && frame.bytes() == Some(&[0])) {
                return Ok(true);
            }
        }
        Ok(false)
    }
}

/// Whether an answer holds four bytes and does not say how many of them are the value (CiA 301: e = 1, s = 0).
fn is_without_size(answer: &Frame) -> bool {
    answer.bytes().and_then(<[u8]>::first).is_some_and(|command| command & 0b1110_0011 == 0b0100_0010)
}

fn micros(time: Duration) -> clock::Duration {
    clock::Duration::from_micros(u64::try_from(time.as_micros()).unwrap_or(u64::MAX))
}

const fn of_bus(id: EntryId) -> firmware_glue::EntryId {
    firmware_glue::EntryId { index: id.index.0, sub: id.sub.0 }
}
