//! SLCAN: CAN frames as lines of text. On a board, the driver of the CAN controller takes the place of this file.

use std::io::{self, ErrorKind, Read as _, Write as _};
use std::net::TcpStream;
use std::time::Duration;

use firmware_glue::frame::{CanId, Frame};

/// The adapter's side of a connection.
#[derive(Debug)]
pub(crate) struct Slcan {
    stream: TcpStream,
    line: String,
    /// Frames reach the client only after it has opened the channel.
    is_open: bool,
}

impl Slcan {
    /// A connection whose [`receive`](Self::receive) waits so long for a byte.
    pub(crate) fn new(stream: TcpStream, wait: Duration) -> io::Result<Self> {
        stream.set_read_timeout(Some(wait))?;
        stream.set_nodelay(true)?;
        Ok(Self { stream, line: String::new(), is_open: false })
    }

    /// Sends a frame: `t`, the identifier, the length and the bytes; `r` for a remote frame.
    pub(crate) fn send(&mut self, frame: &Frame) -> io::Result<()> {
        if !self.is_open {
            return Ok(());
        }
        let kind = if frame.bytes().is_some() { 't' } else { 'r' };
        let mut line = format!("{kind}{:03X}{}", frame.id().get(), frame.length());
        line.extend(frame.bytes().unwrap_or_default().iter().map(|byte| format!("{byte:02X}")));
        line.push('\r');
        self.stream.write_all(line.as_bytes())
    }

    /// The next frame of the client; `None` if a command was answered instead, or if nothing came in time.
    pub(crate) fn receive(&mut self) -> io::Result<Option<Frame>> {
        let mut byte = [0];
        loop {
            match self.stream.read(&mut byte) {
                Ok(0) => return Err(ErrorKind::ConnectionAborted.into()),
                Ok(_) if byte == *b"\r" => {
                    let line = std::mem::take(&mut self.line);
                    let frame = frame(&line);
                    self.answer(&line, frame.is_some())?;
                    return Ok(frame);
                }
                // No command is longer.
                Ok(_) if self.line.len() > 30 => return Err(ErrorKind::InvalidData.into()),
                Ok(_) => self.line.push(char::from(byte[0])),
                Err(error) if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => {
                    return Ok(None);
                }
                Err(error) => return Err(error),
            }
        }
    }

    /// Confirms a command. There are no wires, so every bit rate and every filter is accepted.
    fn answer(&mut self, line: &str, is_frame: bool) -> io::Result<()> {
        let answer: &[u8] = match line.as_bytes() {
            _ if is_frame => b"z\r",
            [b'O', ..] => {
                self.is_open = true;
                b"\r"
            }
            [b'C', ..] => {
                self.is_open = false;
                b"\r"
            }
            [b'V', ..] => b"V1010\r",
            [b'S' | b's' | b'L' | b'Z' | b'M' | b'm', ..] | [] => b"\r",
            _ => b"\x07",
        };
        self.stream.write_all(answer)
    }
}

/// The frame of a line; `None` if it is another command.
fn frame(line: &str) -> Option<Frame> {
    let id = CanId::new(u16::from_str_radix(line.get(1..4)?, 16).ok()?)?;
    let length: u8 = line.get(4..5)?.parse().ok()?;
    match line.get(..1)? {
        "t" => {
            let byte = |at: usize| u8::from_str_radix(line.get(5 + 2 * at..7 + 2 * at)?, 16).ok();
            let bytes: Vec<u8> = (0..usize::from(length)).map(byte).collect::<Option<_>>()?;
            Frame::data(id, &bytes)
        }
        "r" => Frame::remote(id, length),
        _ => None,
    }
}
