//! State machines and command codings.

use super::{Devices, EntryId, Text};

/// A state machine that a command entry drives and a status entry shows.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct StateMachine {
    /// Name.
    pub name: String,
    /// Devices that have it.
    pub devices: Devices,
    /// Entry that shows the state.
    pub status: EntryId,
    /// Entry that takes the commands.
    pub command: EntryId,
    /// States, in the order of the specification.
    pub states: Vec<State>,
    /// Transitions by number.
    pub transitions: Vec<Transition>,
    /// Commands, in the order of the specification.
    pub commands: Vec<Command>,
}

/// A state and how the status entry shows it.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct State {
    /// Name.
    pub name: String,
    /// Bits that show it.
    pub pattern: BitPattern,
    /// Meaning.
    pub about: Text,
}

/// A transition between states.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Transition {
    /// Number in the standard or the manual.
    pub number: u8,
    /// States it leaves; empty for the start.
    pub from: Vec<String>,
    /// State it enters.
    pub to: String,
    /// What causes it.
    pub event: Text,
    /// What the device does.
    pub action: Text,
    /// How the device makes it without a command.
    pub by_device: ByDevice,
}

/// How a device makes a transition that nobody commands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ByDevice {
    /// Only a command causes it, or the start.
    Never,
    /// Something happens to the device: a fault, an input.
    Event,
    /// What the device does in the state is done.
    Automatic,
}

impl ByDevice {
    /// The words of a specification.
    pub const WORDS: &'static [&'static str] = &["never", "event", "automatic"];

    /// The word that a specification uses.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Never => "never",
            Self::Event => "event",
            Self::Automatic => "automatic",
        }
    }

    /// The meaning of a word.
    pub fn from_word(word: &str) -> Option<Self> {
        [Self::Never, Self::Event, Self::Automatic].into_iter().find(|one| one.word() == word)
    }
}

/// A command and its coding in the command entry.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Command {
    /// Name.
    pub name: String,
    /// Bits that make it.
    pub pattern: BitPattern,
    /// A value that gives the command.
    pub send: Option<u32>,
    /// Transitions it causes.
    pub transitions: Vec<u8>,
    /// Meaning.
    pub about: Text,
}

/// Fixed, free and changing bits of a word, most significant bit first.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BitPattern(pub Vec<PatternBit>);

/// One place of a [`BitPattern`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PatternBit {
    /// 0.
    Zero,
    /// 1.
    One,
    /// Either.
    Any,
    /// A change from 0 to 1.
    Rising,
    /// A change from 1 to 0.
    Falling,
}

impl BitPattern {
    /// Mask of the bits that matter and their values (an edge counts as its final level).
    pub fn mask_and_value(&self) -> (u64, u64) {
        self.0.iter().fold((0, 0), |(mask, value), bit| {
            let (matters, level) = match bit {
                PatternBit::Zero | PatternBit::Falling => (1, 0),
                PatternBit::One | PatternBit::Rising => (1, 1),
                PatternBit::Any => (0, 0),
            };
            (mask << 1 | matters, value << 1 | level)
        })
    }

    /// Masks of the bits that have to rise and of those that have to fall.
    pub fn edges(&self) -> (u64, u64) {
        self.0.iter().fold((0, 0), |(rising, falling), bit| {
            let (rises, falls) = match bit {
                PatternBit::Rising => (1, 0),
                PatternBit::Falling => (0, 1),
                PatternBit::Zero | PatternBit::One | PatternBit::Any => (0, 0),
            };
            (rising << 1 | rises, falling << 1 | falls)
        })
    }
}
