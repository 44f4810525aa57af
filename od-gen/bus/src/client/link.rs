//! A bus reached through a CAN adapter that speaks SLCAN.

use std::collections::VecDeque;
use std::fmt;
use std::io::ErrorKind;
use std::net::TcpStream;
use std::time::{Duration, Instant};

use firmware_glue::frame::Frame;

use super::port::{Manner, Port};
use super::{Bus, BusError};
use crate::slcan::{CanFrame, Heard, Host, line};

/// An adapter answers a command within this time.
const PATIENCE: Duration = Duration::from_secs(2);

/// One that answers at all has answered its first command by then.
const FIRST: Duration = Duration::from_millis(500);

/// So long at most an adapter is heard after the end.
const FAREWELL: Duration = Duration::from_millis(300);

/// What a port says in the end has come when it says nothing for so long.
const QUIET: Duration = Duration::from_millis(30);

/// Bit rates in kbit/s, by the digit of their command.
const BIT_RATES: [u16; 9] = [10, 20, 50, 100, 125, 250, 500, 800, 1000];

/// A bus reached through an adapter, whose channel is open for as long as it lives.
#[derive(Debug)]
pub struct SlcanBus<P: Port = TcpStream> {
    stream: P,
    host: Host,
    /// Bytes that came and were not looked at.
    bytes: VecDeque<u8>,
    /// Frames that came while an answer was waited for.
    waiting: VecDeque<Frame>,
    start: Instant,
    /// Whether commands have answers.
    manner: Manner,
}

/// Why a channel is not open.
#[derive(Debug)]
#[non_exhaustive]
pub enum OpenError {
    /// The connection to the adapter broke.
    Bus(BusError),
    /// What is at the address does not answer as an adapter does.
    Silent,
    /// The adapter refuses the bit rate.
    BitRate(u16),
    /// SLCAN has no command for the bit rate.
    NoSuchBitRate(u16),
    /// The adapter refuses to open the channel.
    Refused,
}

impl fmt::Display for OpenError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bus(error) => error.fmt(f),
            Self::Silent => f.write_str("what is there does not answer as an adapter with SLCAN does"),
            Self::BitRate(rate) => write!(f, "the adapter refuses {rate} kbit/s"),
            Self::NoSuchBitRate(rate) => {
                write!(f, "SLCAN has no {rate} kbit/s, but")?;
                BIT_RATES.iter().try_for_each(|rate| write!(f, " {rate}"))
            }
            Self::Refused => f.write_str("the adapter does not open its channel"),
        }
    }
}

impl std::error::Error for OpenError {}

impl From<BusError> for OpenError {
    fn from(error: BusError) -> Self {
        Self::Bus(error)
    }
}

fn broken(error: std::io::Error) -> BusError {
    BusError::Connection(error)
}

impl<P: Port> SlcanBus<P> {
    /// Opens the channel of an adapter, at a bit rate in kbit/s, or at that which the adapter has.
    ///
    /// # Errors
    /// [`OpenError`]: it is not open then.
    pub fn open(mut stream: P, bit_rate: Option<u16>) -> Result<Self, OpenError> {
        stream.prepare(PATIENCE).map_err(broken)?;
        let mut bus = Self {
            stream,
            host: Host::new(),
            bytes: VecDeque::new(),
            waiting: VecDeque::new(),
            start: Instant::now(),
            manner: Manner::Answers,
        };
        // An earlier client may have left it open; one that is closed may refuse.
        let patience = match bus.stream.manner() {
            Manner::Answers => PATIENCE,
            Manner::MayBeSilent => FIRST,
        };
        match (bus.asked("C\r", patience)?, bus.stream.manner()) {
            (Some(_), _) => {}
            (None, Manner::Answers) => return Err(OpenError::Silent),
            (None, Manner::MayBeSilent) => bus.manner = Manner::MayBeSilent,
        }
        if let Some(rate) = bit_rate {
            let digit = BIT_RATES.iter().position(|known| *known == rate);
            let digit = digit.ok_or(OpenError::NoSuchBitRate(rate))?;
            if bus.command(&format!("S{digit}\r"))? == Heard::Refused {
                return Err(OpenError::BitRate(rate));
            }
        }
        match bus.command("O\r")? {
            Heard::Refused => Err(OpenError::Refused),
            Heard::Done | Heard::Frame(_) | Heard::Other => Ok(bus),
        }
    }

    /// What the adapter does with commands.
    pub const fn manner(&self) -> Manner {
        self.manner
    }

    /// Gives a command and waits for its answer; one that never answers is taken to have done it.
    fn command(&mut self, text: &str) -> Result<Heard, OpenError> {
        match self.manner {
            Manner::Answers => self.asked(text, PATIENCE)?.ok_or(OpenError::Silent),
            Manner::MayBeSilent => {
                self.stream.write_all(text.as_bytes()).map_err(broken)?;
                Ok(Heard::Done)
            }
        }
    }

    /// The answer to a command, until a time.
    fn asked(&mut self, text: &str, patience: Duration) -> Result<Option<Heard>, BusError> {
        self.stream.write_all(text.as_bytes()).map_err(broken)?;
        let until = Instant::now() + patience;
        loop {
            match self.hear(until)? {
                answer @ (Some(Heard::Done | Heard::Refused) | None) => return Ok(answer),
                Some(Heard::Frame(CanFrame::Standard(frame))) => self.waiting.push_back(frame),
                Some(Heard::Frame(CanFrame::Extended { .. }) | Heard::Other) => {}
            }
        }
    }

    /// The next thing that the adapter says, until a time.
    fn hear(&mut self, until: Instant) -> Result<Option<Heard>, BusError> {
        loop {
            while let Some(byte) = self.bytes.pop_front() {
                if let Some(heard) = self.host.take(byte) {
                    return Ok(Some(heard));
                }
            }
            let left = until.saturating_duration_since(Instant::now());
            if left.is_zero() {
                return Ok(None);
            }
            self.stream.wait_at_most(left).map_err(broken)?;
            let mut buffer = [0; 512];
            match self.stream.read(&mut buffer) {
                Ok(0) => return Err(BusError::Closed),
                Ok(count) => self.bytes.extend(buffer.iter().take(count)),
                Err(error) if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => {
                    return Ok(None);
                }
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => return Err(broken(error)),
            }
        }
    }
}

impl<P: Port> Bus for SlcanBus<P> {
    fn send(&mut self, frame: &Frame) -> Result<(), BusError> {
        self.stream.write_all(line(frame).as_bytes()).map_err(broken)
    }

    fn receive(&mut self, within: Duration) -> Result<Option<Frame>, BusError> {
        if let Some(frame) = self.waiting.pop_front() {
            return Ok(Some(frame));
        }
        let until = Instant::now() + within;
        loop {
            match self.hear(until)? {
                Some(Heard::Frame(CanFrame::Standard(frame))) => return Ok(Some(frame)),
                Some(Heard::Refused) => return Err(BusError::Refused),
                // The answer to a frame that was sent, and what is no CANopen.
                Some(Heard::Done | Heard::Other | Heard::Frame(CanFrame::Extended { .. })) => {}
                None => return Ok(None),
            }
        }
    }

    fn now(&self) -> u64 {
        u64::try_from(self.start.elapsed().as_micros()).unwrap_or(u64::MAX)
    }
}

impl<P: Port> Drop for SlcanBus<P> {
    fn drop(&mut self) {
        // A client that is gone cannot report this any more. A connection that is closed with answers unread is reset,
        // and the adapter may lose what was sent last: it is closed, and its last frames are read.
        let until = Instant::now() + FAREWELL;
        let _ = self.stream.write_all(b"C\r").and_then(|()| self.stream.finish());
        while Instant::now() < until {
            // A serial port has no end to be heard: it is quiet then.
            let until = match self.stream.manner() {
                Manner::Answers => until,
                Manner::MayBeSilent => Instant::now() + QUIET,
            };
            if !self.hear(until).is_ok_and(|heard| heard.is_some()) {
                return;
            }
        }
    }
}
