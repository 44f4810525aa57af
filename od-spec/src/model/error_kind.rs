//! Kinds of errors: the bits of the error register.

/// A kind of error: a bit of the error register (1001h).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ErrorKind {
    /// Any error; set with every other.
    Generic,
    /// Current.
    Current,
    /// Voltage.
    Voltage,
    /// Temperature.
    Temperature,
    /// Communication.
    Communication,
    /// What the device profile says.
    Profile,
    /// What the manufacturer says.
    Manufacturer,
}

impl ErrorKind {
    /// The words of a specification.
    pub const WORDS: &'static [&'static str] =
        &["generic", "current", "voltage", "temperature", "communication", "profile", "manufacturer"];

    const ALL: [Self; 7] = [
        Self::Generic,
        Self::Current,
        Self::Voltage,
        Self::Temperature,
        Self::Communication,
        Self::Profile,
        Self::Manufacturer,
    ];

    /// The word that a specification uses.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Generic => "generic",
            Self::Current => "current",
            Self::Voltage => "voltage",
            Self::Temperature => "temperature",
            Self::Communication => "communication",
            Self::Profile => "profile",
            Self::Manufacturer => "manufacturer",
        }
    }

    /// The kind of a word.
    pub fn from_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.word() == word)
    }

    /// Its bit in the error register (CiA 301 table 48).
    pub const fn bit(self) -> u8 {
        match self {
            Self::Generic => 0,
            Self::Current => 1,
            Self::Voltage => 2,
            Self::Temperature => 3,
            Self::Communication => 4,
            Self::Profile => 5,
            Self::Manufacturer => 7,
        }
    }

    /// The kind that an error code is of by its class (CiA 301 table 21), where there is a bit for it.
    pub const fn of_code(code: u16) -> Option<Self> {
        match code >> 8 {
            0x20..=0x2F => Some(Self::Current),
            0x30..=0x3F => Some(Self::Voltage),
            0x40..=0x4F => Some(Self::Temperature),
            0x81..=0x82 => Some(Self::Communication),
            0xFF => Some(Self::Manufacturer),
            _ => None,
        }
    }
}
