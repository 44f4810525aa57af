//! SLCAN: CAN frames as lines of ASCII, the protocol of serial CAN adapters, in both directions.
//!
//! A line ends with a carriage return. The host opens (`O`) and closes (`C`) the channel, sets its bit rate (`S0` to `S8`, or `s` and
//! two registers) and sends frames: `t` with an identifier of three hexadecimal digits, the length, the bytes; `r` for a remote
//! frame; `T` and `R` with eight digits. The adapter answers with a carriage return alone, in front of it `z` or `Z` for a frame;
//! with a bell where it refuses. Frames from the bus come in the same form, on request (`Z1`) with a time stamp of four digits.

mod adapter;
mod host;

use std::fmt::Write as _;

use firmware_glue::frame::{CanId, Frame};

pub use self::adapter::{Adapter, Reply};
pub use self::host::{Heard, Host};

/// What ends a line.
pub const END: u8 = b'\r';
/// The answer to what is refused: a bell.
pub const REFUSED: &[u8] = b"\x07";
/// No command is longer: `T`, eight digits, length, eight bytes, time stamp.
pub const LONGEST: usize = 31;

/// A frame as CAN has it; CANopen uses the first kind alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CanFrame {
    /// With an identifier of 11 bits.
    Standard(Frame),
    /// With an identifier of 29 bits, with its length.
    Extended {
        /// The identifier.
        id: u32,
        /// Bytes that it carries or asks for.
        length: u8,
    },
}

/// A command of the host.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Command {
    /// `O`: open the channel.
    Open,
    /// `L`: open it to listen only.
    Listen,
    /// `C`: close it.
    Close,
    /// `S0` to `S8`: a bit rate from 10 to 1000 kbit/s.
    BitRate(u8),
    /// `s` with the registers of a controller.
    Registers,
    /// `Z0`, `Z1`: whether frames from the bus have a time stamp.
    TimeStamps(TimeStamps),
    /// `V`: versions of hardware and firmware.
    Version,
    /// `v`: version of the firmware.
    Firmware,
    /// `N`: serial number.
    SerialNumber,
    /// `F`: flags of the controller.
    Flags,
    /// `M` and `m` with eight digits: which identifiers are let through.
    Filter,
    /// `t`, `T`, `r`, `R`: a frame to be sent.
    Send(CanFrame),
}

/// Whether frames from the bus have a time stamp.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TimeStamps {
    /// They have none.
    Off,
    /// They have milliseconds within a minute.
    On,
}

/// Why a line is not a command or not a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fault {
    /// It begins with no letter of a command.
    Command,
    /// It has other digits than the command needs, or another number of them.
    Digits,
    /// The identifier has more bits than its kind.
    Identifier,
    /// The length is more than 8.
    Length,
}

impl Fault {
    /// What was expected, in words.
    pub const fn expected(self) -> &'static str {
        match self {
            Fault::Command => "a command of SLCAN, such as `t1810`",
            Fault::Digits => "as many hexadecimal digits as the command needs",
            Fault::Identifier => "an identifier up to 7FF, or after `T` and `R` up to 1FFFFFFF",
            Fault::Length => "a length from 0 to 8",
        }
    }
}

/// A command of the host, without its end.
///
/// # Errors
/// [`Fault`]: the adapter answers [`REFUSED`].
pub fn command(line: &str) -> Result<Command, Fault> {
    let digits = |count: usize| {
        let rest = line.get(1..).unwrap_or_default();
        let is_all = rest.len() == count && rest.bytes().all(|byte| byte.is_ascii_hexdigit());
        if is_all { Ok(rest) } else { Err(Fault::Digits) }
    };
    match line.as_bytes().first() {
        Some(b'O') => digits(0).map(|_| Command::Open),
        Some(b'L') => digits(0).map(|_| Command::Listen),
        Some(b'C') => digits(0).map(|_| Command::Close),
        Some(b'V') => digits(0).map(|_| Command::Version),
        Some(b'v') => digits(0).map(|_| Command::Firmware),
        Some(b'N') => digits(0).map(|_| Command::SerialNumber),
        Some(b'F') => digits(0).map(|_| Command::Flags),
        Some(b'M' | b'm') => digits(8).map(|_| Command::Filter),
        Some(b's') => digits(4).map(|_| Command::Registers),
        Some(b'S') => match digits(1)?.parse() {
            Ok(rate @ 0..=8) => Ok(Command::BitRate(rate)),
            _ => Err(Fault::Digits),
        },
        Some(b'Z') => match digits(1)? {
            "0" => Ok(Command::TimeStamps(TimeStamps::Off)),
            "1" => Ok(Command::TimeStamps(TimeStamps::On)),
            _ => Err(Fault::Digits),
        },
        Some(b't' | b'T' | b'r' | b'R') => match frame(line)? {
            (frame, None) => Ok(Command::Send(frame)),
            (_, Some(_)) => Err(Fault::Digits),
        },
        _ => Err(Fault::Command),
    }
}

/// A frame as a line, without its end, and the time stamp after it: milliseconds within a minute.
///
/// # Errors
/// [`Fault`]: it is not a frame.
pub fn frame(line: &str) -> Result<(CanFrame, Option<u16>), Fault> {
    let Some((kind, rest)) = line.split_at_checked(1) else { return Err(Fault::Command) };
    let (id_digits, highest, is_remote) = match kind {
        "t" => (3, 0x7FF, false),
        "r" => (3, 0x7FF, true),
        "T" => (8, 0x1FFF_FFFF, false),
        "R" => (8, 0x1FFF_FFFF, true),
        _ => return Err(Fault::Command),
    };
    let (id, rest) = rest.split_at_checked(id_digits).ok_or(Fault::Digits)?;
    let id = hexadecimal(id)?;
    if id > highest {
        return Err(Fault::Identifier);
    }
    let (length, mut rest) = rest.split_at_checked(1).ok_or(Fault::Digits)?;
    let length =
        u8::try_from(hexadecimal(length)?).ok().filter(|length| *length <= 8).ok_or(Fault::Length)?;
    let mut bytes = [0; 8];
    let count = if is_remote { 0 } else { usize::from(length) };
    for byte in bytes.iter_mut().take(count) {
        let (digits, behind) = rest.split_at_checked(2).ok_or(Fault::Digits)?;
        *byte = u8::try_from(hexadecimal(digits)?).map_err(|_| Fault::Digits)?;
        rest = behind;
    }
    let time = match rest.len() {
        0 => None,
        4 => Some(u16::try_from(hexadecimal(rest)?).map_err(|_| Fault::Digits)?),
        _ => return Err(Fault::Digits),
    };
    let standard = || {
        let id = CanId::new(u16::try_from(id).ok()?)?;
        if is_remote { Frame::remote(id, length) } else { Frame::data(id, bytes.get(..count)?) }
    };
    let frame = match kind {
        "T" | "R" => CanFrame::Extended { id, length },
        _ => CanFrame::Standard(standard().ok_or(Fault::Identifier)?),
    };
    Ok((frame, time))
}

fn hexadecimal(digits: &str) -> Result<u32, Fault> {
    // `from_str_radix` would take a sign.
    let is_all = digits.bytes().all(|byte| byte.is_ascii_hexdigit());
    u32::from_str_radix(digits, 16).ok().filter(|_| is_all).ok_or(Fault::Digits)
}

/// A frame as a line, with its end.
pub fn line(frame: &Frame) -> String {
    let (id, length) = (frame.id().get(), frame.length());
    let mut line = match frame.bytes() {
        Some(_) => format!("t{id:03X}{length}"),
        None => format!("r{id:03X}{length}"),
    };
    for byte in frame.bytes().unwrap_or_default() {
        let _ = write!(line, "{byte:02X}");
    }
    line.push(char::from(END));
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    fn standard(line: &str) -> Frame {
        match frame(line) {
            Ok((CanFrame::Standard(frame), None)) => frame,
            other => panic!("{line}: {other:?}"),
        }
    }

    #[test]
    fn a_frame_goes_there_and_back() {
        for line in ["t0000", "t7FF8000102030405060F", "r6013", "t18121234"] {
            assert_eq!(super::line(&standard(line)), format!("{line}\r"));
        }
        assert_eq!(frame("t1811AAEA5F").map(|(_, time)| time), Ok(Some(0xEA5F)));
        assert_eq!(frame("T1FFFFFFF0"), Ok((CanFrame::Extended { id: 0x1FFF_FFFF, length: 0 }, None)));
    }

    #[test]
    fn what_is_none_says_why() {
        for (line, fault) in [
            ("", Fault::Command),
            ("x", Fault::Command),
            ("t8000", Fault::Identifier),
            ("T200000000", Fault::Identifier),
            ("t1819", Fault::Length),
            ("t18", Fault::Digits),
            ("t1812AA", Fault::Digits),
            ("t1811+1", Fault::Digits),
            ("t+180", Fault::Digits),
            ("t1811AABBB", Fault::Digits),
            ("t1€", Fault::Digits),
        ] {
            assert_eq!(frame(line), Err(fault), "{line}");
        }
    }

    #[test]
    fn commands_are_distinguished() {
        for (line, expected) in [
            ("O", Ok(Command::Open)),
            ("L", Ok(Command::Listen)),
            ("C", Ok(Command::Close)),
            ("S6", Ok(Command::BitRate(6))),
            ("S9", Err(Fault::Digits)),
            ("s031C", Ok(Command::Registers)),
            ("Z1", Ok(Command::TimeStamps(TimeStamps::On))),
            ("Z2", Err(Fault::Digits)),
            ("V", Ok(Command::Version)),
            ("v", Ok(Command::Firmware)),
            ("N", Ok(Command::SerialNumber)),
            ("F", Ok(Command::Flags)),
            ("M00000000", Ok(Command::Filter)),
            ("O1", Err(Fault::Digits)),
            ("t18110102", Err(Fault::Digits)),
            ("?", Err(Fault::Command)),
        ] {
            assert_eq!(command(line), expected, "{line}");
        }
        assert!(
            matches!(command("r6010"), Ok(Command::Send(CanFrame::Standard(frame))) if frame.bytes().is_none())
        );
    }
}
