//! The host's side of SLCAN: what an adapter says, byte by byte.

use super::{CanFrame, END, LONGEST, REFUSED, frame};

/// What an adapter has said.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Heard {
    /// A frame was on the bus.
    Frame(CanFrame),
    /// The command was carried out.
    Done,
    /// The command was refused.
    Refused,
    /// A version, a serial number, or what is not a line of SLCAN.
    Other,
}

/// Makes lines of what an adapter sends.
#[derive(Debug, Clone, Default)]
pub struct Host {
    line: String,
    is_too_long: bool,
}

impl Host {
    /// At the beginning of a line.
    pub const fn new() -> Self {
        Self { line: String::new(), is_too_long: false }
    }

    /// Takes a byte; returns what it completes.
    pub fn take(&mut self, byte: u8) -> Option<Heard> {
        if REFUSED.contains(&byte) {
            self.begin();
            return Some(Heard::Refused);
        }
        match byte {
            END => {
                let heard = if self.is_too_long { Heard::Other } else { heard(&self.line) };
                self.begin();
                Some(heard)
            }
            // Some send it after the end of a line.
            b'\n' => None,
            _ if self.line.len() >= LONGEST => {
                self.is_too_long = true;
                None
            }
            byte => {
                self.line.push(char::from(byte));
                None
            }
        }
    }

    fn begin(&mut self) {
        self.line.clear();
        self.is_too_long = false;
    }
}

/// What a whole line says.
fn heard(line: &str) -> Heard {
    match line {
        "" | "z" | "Z" => Heard::Done,
        line => frame(line).map_or(Heard::Other, |(frame, _)| Heard::Frame(frame)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use firmware_glue::frame::{CanId, Frame};

    fn all(bytes: &[u8]) -> Vec<Heard> {
        let mut host = Host::new();
        bytes.iter().filter_map(|byte| host.take(*byte)).collect()
    }

    #[test]
    fn answers_and_frames_are_distinguished() {
        let frame = CanId::new(0x705).and_then(|id| Frame::data(id, &[0])).map(CanFrame::Standard).unwrap();
        assert_eq!(
            all(b"\rz\r\x07t705100\rV1010\r\nZ\rt70510012AB\r"),
            [
                Heard::Done,
                Heard::Done,
                Heard::Refused,
                Heard::Frame(frame),
                Heard::Other,
                Heard::Done,
                Heard::Frame(frame)
            ]
        );
    }

    #[test]
    fn noise_is_no_frame_and_ends_with_its_line() {
        let noise = [&[b'0'; 100][..], b"\rt70\rt7\x07\r"].concat();
        assert_eq!(all(&noise), [Heard::Other, Heard::Other, Heard::Refused, Heard::Done]);
    }
}
