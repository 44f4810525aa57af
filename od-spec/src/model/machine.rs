//! State machines and command codings.

use super::{Devices, EntryId, Text};
use crate::source::Span;

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
    /// Where its name is written.
    pub span: Span,
    /// Where the status entry is named, and where the command entry is.
    pub entry_places: (Span, Span),
}

impl StateMachine {
    /// Where something of the machine is written; its name, for what a library says.
    pub(crate) const fn place(&self, written: Span) -> Span {
        if written.file.is_one_with(self.span.file) { written } else { self.span }
    }
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
    /// Where it is written.
    pub span: Span,
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
    /// Where it is written.
    pub span: Span,
}

/// How a device makes a transition without a command.
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
    /// Where it is written.
    pub span: Span,
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

    /// What has the bits of both; `None` where a bit differs.
    pub(crate) fn joined(&self, other: &Self) -> Option<Self> {
        use PatternBit::{Any, Falling, One, Rising, Zero};
        let bits = self.0.iter().zip(&other.0).map(|pair| match pair {
            (Any, bit) | (bit, Any) => Some(*bit),
            (Zero | Falling, Zero | Falling) => Some(Zero),
            (One | Rising, One | Rising) => Some(One),
            (Zero | Falling, One | Rising) | (One | Rising, Zero | Falling) => None,
        });
        bits.collect::<Option<Vec<_>>>().map(Self)
    }

    /// The smallest number from `low` on that has the bits, where an entry has no more than 64 of them.
    pub(crate) fn smallest_from(&self, low: u64) -> Option<u64> {
        let (mask, value) = self.mask_and_value();
        if low & mask == value {
            return Some(low);
        }
        // The number is as `low` above one bit, which is 0 there and 1 here; below that bit it is as small as it can be.
        (0..self.0.len().min(64)).find_map(|bit| {
            let (one, upper) =
                (1_u64 << bit, u64::MAX.checked_shl(u32::try_from(bit).ok()? + 1).unwrap_or(0));
            let may_rise = low & one == 0 && (mask & one == 0 || value & one != 0);
            let is_as_low = (low ^ value) & mask & upper == 0;
            (may_rise && is_as_low).then_some(low & upper | one | value & (one - 1))
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Against trying every number.
    #[test]
    fn the_smallest_number_of_a_pattern_is_found() {
        let places = [PatternBit::Zero, PatternBit::One, PatternBit::Any];
        for code in 0..3_usize.pow(5) {
            let pattern = BitPattern((0..5).map(|at| places[code / 3_usize.pow(at) % 3]).collect());
            let (mask, value) = pattern.mask_and_value();
            for low in 0..32 {
                let expected = (low..32).find(|number| number & mask == value);
                let found = pattern.smallest_from(low).filter(|number| *number < 32);
                assert_eq!(found, expected, "{pattern:?} from {low}");
            }
        }
    }
}
