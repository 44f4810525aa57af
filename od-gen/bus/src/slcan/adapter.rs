//! The adapter's side of SLCAN: what it answers, and what it puts on the bus.

use std::fmt::Write as _;

use firmware_glue::frame::Frame;

use super::{CanFrame, Command, END, REFUSED, TimeStamps, command, line};

/// An adapter that a host talks to, without the wires: lines go in, answers and frames come out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Adapter {
    channel: Channel,
    time_stamps: TimeStamps,
}

/// The state of the channel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Channel {
    Closed,
    Open,
    /// Open, and nothing may be sent.
    Listening,
}

/// What comes of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Reply {
    /// What the host is answered.
    pub answer: &'static [u8],
    /// What goes on the bus.
    pub send: Option<CanFrame>,
}

impl Reply {
    const DONE: Self = Self { answer: b"\r", send: None };
    const NOT_DONE: Self = Self { answer: REFUSED, send: None };
}

impl Default for Adapter {
    fn default() -> Self {
        Self::new()
    }
}

impl Adapter {
    /// One that is switched on: its channel is closed.
    pub const fn new() -> Self {
        Self { channel: Channel::Closed, time_stamps: TimeStamps::Off }
    }

    /// Whether frames from the bus reach the host.
    pub fn is_open(&self) -> bool {
        self.channel != Channel::Closed
    }

    /// Takes a line of the host, without its end.
    pub fn take(&mut self, line: &str) -> Reply {
        // Hosts send empty lines to begin anew.
        if line.is_empty() {
            return Reply::DONE;
        }
        let Ok(command) = command(line) else { return Reply::NOT_DONE };
        match (command, self.channel) {
            (Command::Open, Channel::Closed) => self.enter(Channel::Open),
            (Command::Listen, Channel::Closed) => self.enter(Channel::Listening),
            // A host that closes to be sure does no harm.
            (Command::Close, _) => self.enter(Channel::Closed),
            // There are no wires, so that every bit rate and every filter is as good as another.
            (Command::BitRate(_) | Command::Registers | Command::Filter, Channel::Closed) => Reply::DONE,
            (Command::TimeStamps(time_stamps), Channel::Closed) => {
                self.time_stamps = time_stamps;
                Reply::DONE
            }
            (Command::Version, _) => Reply { answer: b"V1010\r", send: None },
            (Command::Firmware, _) => Reply { answer: b"v1010\r", send: None },
            (Command::SerialNumber, _) => Reply { answer: b"NODGE\r", send: None },
            (Command::Flags, Channel::Open | Channel::Listening) => Reply { answer: b"F00\r", send: None },
            (Command::Send(frame), Channel::Open) => {
                let answer: &[u8] = match frame {
                    CanFrame::Standard(_) => b"z\r",
                    CanFrame::Extended { .. } => b"Z\r",
                };
                Reply { answer, send: Some(frame) }
            }
            (
                Command::Open
                | Command::Listen
                | Command::BitRate(_)
                | Command::Registers
                | Command::Filter
                | Command::TimeStamps(_),
                Channel::Open | Channel::Listening,
            )
            | (Command::Flags, Channel::Closed)
            | (Command::Send(_), Channel::Closed | Channel::Listening) => Reply::NOT_DONE,
        }
    }

    fn enter(&mut self, channel: Channel) -> Reply {
        self.channel = channel;
        Reply::DONE
    }

    /// What the host gets to see of a frame on the bus, at a time in milliseconds.
    pub fn show(&self, frame: &Frame, milliseconds: u64) -> Option<String> {
        if self.channel == Channel::Closed {
            return None;
        }
        let mut text = line(frame);
        if self.time_stamps == TimeStamps::On {
            text.pop();
            let _ = write!(text, "{:04X}{}", milliseconds % 60_000, char::from(END));
        }
        Some(text)
    }
}

#[cfg(test)]
mod tests {
    use firmware_glue::frame::CanId;

    use super::*;

    fn frame() -> Frame {
        CanId::new(0x181).and_then(|id| Frame::data(id, &[1])).expect("a frame")
    }

    #[test]
    fn frames_pass_while_the_channel_is_open() {
        let mut adapter = Adapter::new();
        assert_eq!(adapter.take("t0000"), Reply::NOT_DONE);
        assert_eq!(adapter.show(&frame(), 0), None);
        assert_eq!(
            (adapter.take("S6"), adapter.take(""), adapter.take("O")),
            (Reply::DONE, Reply::DONE, Reply::DONE)
        );
        assert_eq!((adapter.take("O"), adapter.take("S6")), (Reply::NOT_DONE, Reply::NOT_DONE));
        let sent = adapter.take("t181101");
        assert_eq!((sent.answer, sent.send), (&b"z\r"[..], Some(CanFrame::Standard(frame()))));
        assert_eq!(adapter.show(&frame(), 0).as_deref(), Some("t181101\r"));
        assert_eq!(adapter.take("C"), Reply::DONE);
        assert_eq!(adapter.take("t181101"), Reply::NOT_DONE);
        assert_eq!((adapter.take("L"), adapter.take("t181101")), (Reply::DONE, Reply::NOT_DONE));
        assert!(adapter.show(&frame(), 0).is_some());
    }

    #[test]
    fn a_time_stamp_counts_the_milliseconds_of_a_minute() {
        let mut adapter = Adapter::new();
        assert_eq!((adapter.take("Z1"), adapter.take("O")), (Reply::DONE, Reply::DONE));
        assert_eq!(adapter.show(&frame(), 60_255).as_deref(), Some("t18110100FF\r"));
        assert_eq!(adapter.take("x"), Reply::NOT_DONE);
        assert_eq!(adapter.take("V").answer, b"V1010\r");
    }
}
