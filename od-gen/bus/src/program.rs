//! Programs that are loaded into a node: the objects of CiA 302-3 and what their values mean.

use std::fmt;

/// 1F50h, program data: writing sub-index N loads program N.
pub const DATA: u16 = 0x1F50;
/// 1F51h, program control: commands, and what a program does.
pub const CONTROL: u16 = 0x1F51;
/// 1F56h, program software identification: which program is loaded.
pub const IDENTIFICATION: u16 = 0x1F56;
/// 1F57h, flash status identification: whether the last program was written.
pub const FLASH: u16 = 0x1F57;

/// A command of 1F51h.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Command {
    /// Stop the program.
    Stop,
    /// Start it.
    Start,
    /// Start it anew.
    Reset,
    /// Delete it.
    Clear,
}

impl Command {
    const ALL: [Self; 4] = [Self::Stop, Self::Start, Self::Reset, Self::Clear];

    /// The value that is written.
    pub const fn code(self) -> u8 {
        match self {
            Self::Stop => 0,
            Self::Start => 1,
            Self::Reset => 2,
            Self::Clear => 3,
        }
    }

    /// The command with a value.
    pub fn of(code: u8) -> Option<Self> {
        Self::ALL.into_iter().find(|command| command.code() == code)
    }
}

/// What 1F51h is read as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum State {
    /// The program does not run.
    Stopped,
    /// It runs.
    Started,
    /// There is none.
    Missing,
    /// A value that is not defined, or belongs to the manufacturer.
    Other(u8),
}

impl State {
    /// The state with a value. After a reset, a program that was not started again is stopped.
    pub const fn of(code: u8) -> Self {
        match code {
            0 | 2 => Self::Stopped,
            1 => Self::Started,
            3 => Self::Missing,
            other => Self::Other(other),
        }
    }

    /// The value that is read.
    pub const fn code(self) -> u8 {
        match self {
            Self::Stopped => 0,
            Self::Started => 1,
            Self::Missing => 3,
            Self::Other(other) => other,
        }
    }
}

impl fmt::Display for State {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Stopped => f.write_str("stopped"),
            Self::Started => f.write_str("started"),
            Self::Missing => f.write_str("no program"),
            Self::Other(other) => write!(f, "value {other}"),
        }
    }
}

/// What 1F57h is read as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FlashStatus(pub u32);

impl FlashStatus {
    /// Nothing is wrong.
    pub const GOOD: Self = Self(0);
    /// There is no program.
    pub const NO_PROGRAM: Self = Self(1 << 1);

    /// Whether the memory is being written; the other bits say nothing then.
    pub const fn is_busy(self) -> bool {
        self.0 & 1 != 0
    }

    /// What is wrong, as a number: 0 is nothing.
    pub const fn fault(self) -> u32 {
        self.0 >> 1 & 0x7F
    }
}

impl fmt::Display for FlashStatus {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_busy() {
            return f.write_str("busy");
        }
        let text = match self.fault() {
            0 => return f.write_str("no error"),
            1 => "no valid program",
            2 => "unknown data format",
            3 => "wrong data format or checksum",
            4 => "flash memory was not cleared",
            5 => "flash memory cannot be written",
            6 => "wrong address",
            7 => "flash memory is protected",
            63 => "unspecified error",
            64.. => "error of the manufacturer",
            _ => "reserved error",
        };
        write!(f, "{text} (0x{:08X})", self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands_and_states_have_their_values() {
        assert!(Command::ALL.into_iter().all(|command| Command::of(command.code()) == Some(command)));
        assert_eq!(Command::of(4), None);
        assert_eq!([0, 1, 2, 3].map(State::of).map(State::code), [0, 1, 0, 3]);
        assert_eq!(State::of(0x80).to_string(), "value 128");
    }

    #[test]
    fn a_flash_status_is_put_into_words() {
        let words = [0, 1, 3, 2, 8 << 1, 63 << 1, 0x0001_0080].map(|raw| FlashStatus(raw).to_string());
        assert_eq!(
            words,
            [
                "no error",
                "busy",
                "busy",
                "no valid program (0x00000002)",
                "reserved error (0x00000010)",
                "unspecified error (0x0000007E)",
                "error of the manufacturer (0x00010080)"
            ]
        );
        assert_eq!(FlashStatus::NO_PROGRAM.fault(), 1);
    }
}
