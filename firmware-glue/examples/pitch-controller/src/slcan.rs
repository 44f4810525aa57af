//! SLCAN: a CAN driver whose bus is a host at the other end of a serial line.
//!
//! A line of text ends with a carriage return. The host opens (`O`) and closes (`C`) the channel, chooses a bit rate (`S6`), and sends
//! frames: `t` with an identifier of three hexadecimal digits, the length, the bytes; `r` for a remote frame. What is done is answered
//! with a carriage return, after a `z` for a frame; what is not, with a bell. Frames of the node go to the host in the
//! same form.
//!
//! To the rest of the firmware it is a driver like any other, by the traits of `embedded-can`.

use core::convert::Infallible;

use embedded_can::{Id, StandardId, nb::Can};
use firmware_glue::frame::{CanId, Frame};

/// A serial line.
pub trait Wire {
    /// A byte that has come.
    fn receive(&mut self) -> Option<u8>;

    /// Sends a byte, if there is room for it.
    ///
    /// # Errors
    /// [`nb::Error::WouldBlock`] if there is none.
    fn send(&mut self, byte: u8) -> nb::Result<(), Infallible>;
}

/// A frame as the driver has it: CANopen's own kind, and no identifiers of 29 bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Message(Frame);

/// The driver.
#[derive(Debug)]
pub struct Slcan<W> {
    wire: W,
    channel: Channel,
    line: Line,
    waiting: Queue,
}

/// Whether frames pass.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Channel {
    Closed,
    Open,
}

/// What a host says with a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Command {
    /// An empty line: hosts begin with some.
    Nothing,
    Open,
    Close,
    BitRate,
    Version,
    SerialNumber,
    Send(Frame),
    /// What this adapter does not know.
    Unknown,
}

const END: u8 = b'\r';
const DONE: &[u8] = b"\r";
const SENT: &[u8] = b"z\r";
const REFUSED: &[u8] = b"\x07";
const VERSION: &[u8] = b"V1010\r";
const SERIAL_NUMBER: &[u8] = b"NDEMO\r";
/// The longest line: letter, identifier, length, eight bytes, end.
const LONGEST: usize = 22;
/// The longest answer.
const ANSWER: usize = 6;

impl<W: Wire> Slcan<W> {
    /// A driver whose channel the host has yet to open.
    pub fn new(wire: W) -> Self {
        Self { wire, channel: Channel::Closed, line: Line::new(), waiting: Queue::new() }
    }

    /// Gives the wire what it has room for.
    fn flush(&mut self) {
        while let Some(byte) = self.waiting.first() {
            if self.wire.send(byte).is_err() {
                return;
            }
            self.waiting.drop_first();
        }
    }

    /// Carries out a line; the frame that is in it.
    fn carry_out(&mut self, command: Command) -> Option<Frame> {
        let (answer, frame) = match (command, self.channel) {
            (Command::Nothing | Command::Close | Command::Open, _) | (Command::BitRate, Channel::Closed) => {
                (DONE, None)
            }
            (Command::Version, _) => (VERSION, None),
            (Command::SerialNumber, _) => (SERIAL_NUMBER, None),
            (Command::Send(frame), Channel::Open) => (SENT, Some(frame)),
            (Command::Unknown, _)
            | (Command::BitRate, Channel::Open)
            | (Command::Send(_), Channel::Closed) => (REFUSED, None),
        };
        match command {
            Command::Open => self.channel = Channel::Open,
            Command::Close => self.channel = Channel::Closed,
            _ => {}
        }
        self.waiting.push(answer);
        frame
    }
}

impl<W: Wire> Can for Slcan<W> {
    type Frame = Message;
    type Error = Infallible;

    fn transmit(&mut self, message: &Message) -> nb::Result<Option<Message>, Infallible> {
        self.flush();
        match self.channel {
            // It is not heard.
            Channel::Closed => Ok(None),
            Channel::Open if self.waiting.room() < LONGEST => Err(nb::Error::WouldBlock),
            Channel::Open => {
                let (text, length) = line(&message.0);
                self.waiting.push(text.get(..length).unwrap_or_default());
                self.flush();
                Ok(None)
            }
        }
    }

    fn receive(&mut self) -> nb::Result<Message, Infallible> {
        loop {
            self.flush();
            // A host that takes no answers is asked nothing more.
            if self.waiting.room() < ANSWER {
                return Err(nb::Error::WouldBlock);
            }
            let byte = self.wire.receive().ok_or(nb::Error::WouldBlock)?;
            if let Some(command) = self.line.take(byte)
                && let Some(frame) = self.carry_out(command)
            {
                self.flush();
                return Ok(Message(frame));
            }
        }
    }
}

impl embedded_can::Frame for Message {
    fn new(id: impl Into<Id>, data: &[u8]) -> Option<Self> {
        Frame::data(can_id(id.into())?, data).map(Self)
    }

    fn new_remote(id: impl Into<Id>, length: usize) -> Option<Self> {
        Frame::remote(can_id(id.into())?, u8::try_from(length).ok()?).map(Self)
    }

    fn is_extended(&self) -> bool {
        false
    }

    fn is_remote_frame(&self) -> bool {
        self.0.bytes().is_none()
    }

    fn id(&self) -> Id {
        Id::Standard(StandardId::new(self.0.id().get()).unwrap_or(StandardId::MAX))
    }

    fn dlc(&self) -> usize {
        self.0.length().into()
    }

    fn data(&self) -> &[u8] {
        self.0.bytes().unwrap_or_default()
    }
}

fn can_id(id: Id) -> Option<CanId> {
    match id {
        Id::Standard(id) => CanId::new(id.as_raw()),
        Id::Extended(_) => None,
    }
}

/// What has come of a line.
#[derive(Debug)]
struct Line {
    bytes: [u8; LONGEST],
    length: usize,
}

impl Line {
    const fn new() -> Self {
        Self { bytes: [0; LONGEST], length: 0 }
    }

    /// Takes a byte; the command of a line that is whole.
    fn take(&mut self, byte: u8) -> Option<Command> {
        if byte == END {
            // A line that was too long has a length that there is not.
            let command = self.bytes.get(..self.length).map_or(Command::Unknown, command);
            self.length = 0;
            return Some(command);
        }
        if let Some(place) = self.bytes.get_mut(self.length) {
            *place = byte;
            self.length = self.length.saturating_add(1);
        } else {
            self.length = usize::MAX;
        }
        None
    }
}

/// The command of a line.
fn command(line: &[u8]) -> Command {
    match line {
        [] => Command::Nothing,
        b"O" => Command::Open,
        b"C" => Command::Close,
        [b'S', b'0'..=b'8'] => Command::BitRate,
        b"V" => Command::Version,
        b"N" => Command::SerialNumber,
        [b't' | b'r', ..] => frame(line).map_or(Command::Unknown, Command::Send),
        _ => Command::Unknown,
    }
}

/// The frame of a line.
fn frame(line: &[u8]) -> Option<Frame> {
    let (kind, rest) = line.split_first()?;
    let (id, rest) = rest.split_at_checked(3)?;
    let id = CanId::new(number(id)?)?;
    let (length, digits) = rest.split_first()?;
    let length = digit(*length)?;
    let mut bytes = [0; 8];
    let bytes = bytes.get_mut(..length.into())?;
    match kind {
        b'r' => digits.is_empty().then(|| Frame::remote(id, length))?,
        _ if digits.len() != bytes.len().saturating_mul(2) => None,
        _ => {
            for (byte, pair) in bytes.iter_mut().zip(digits.chunks_exact(2)) {
                *byte = u8::try_from(number(pair)?).ok()?;
            }
            Frame::data(id, bytes)
        }
    }
}

fn number(digits: &[u8]) -> Option<u16> {
    digits.iter().try_fold(0_u16, |number, next| Some(number << 4 | u16::from(digit(*next)?)))
}

fn digit(letter: u8) -> Option<u8> {
    let value = char::from(letter).to_digit(16)?;
    u8::try_from(value).ok()
}

/// The line of a frame, and its length.
fn line(frame: &Frame) -> ([u8; LONGEST], usize) {
    let mut text = [0; LONGEST];
    let [high, low] = frame.id().get().to_be_bytes();
    let kind = if frame.bytes().is_some() { b't' } else { b'r' };
    let head = [kind, letter(high), letter(low >> 4), letter(low), letter(frame.length())];
    let bytes = frame.bytes().unwrap_or_default().iter().flat_map(|byte| [letter(byte >> 4), letter(*byte)]);
    let mut length: usize = 0;
    for (place, letter) in text.iter_mut().zip(head.into_iter().chain(bytes).chain([END])) {
        *place = letter;
        length = length.saturating_add(1);
    }
    (text, length)
}

/// The digit of the low half of a byte.
const fn letter(byte: u8) -> u8 {
    match byte & 0xF {
        digit @ 0..=9 => b'0' | digit,
        digit => b'A'.wrapping_add(digit).wrapping_sub(10),
    }
}

/// Bytes that wait for the wire: a ring.
#[derive(Debug)]
struct Queue {
    bytes: [u8; Queue::SIZE],
    start: usize,
    length: usize,
}

impl Queue {
    const SIZE: usize = 256;

    const fn new() -> Self {
        Self { bytes: [0; Self::SIZE], start: 0, length: 0 }
    }

    fn room(&self) -> usize {
        Self::SIZE.saturating_sub(self.length)
    }

    /// Puts bytes at the end, for which there is room.
    fn push(&mut self, bytes: &[u8]) {
        for byte in bytes {
            let end = self.start.wrapping_add(self.length) % Self::SIZE;
            if let Some(place) = self.bytes.get_mut(end) {
                *place = *byte;
                self.length = self.length.saturating_add(1).min(Self::SIZE);
            }
        }
    }

    fn first(&self) -> Option<u8> {
        if self.length == 0 { None } else { self.bytes.get(self.start).copied() }
    }

    fn drop_first(&mut self) {
        self.start = self.start.wrapping_add(1) % Self::SIZE;
        self.length = self.length.saturating_sub(1);
    }
}
