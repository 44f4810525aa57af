//! Sequences of events: what signals do, step by step.

use super::{EntryId, Text, Value};

/// A sequence of events with the levels of its signals.
#[derive(Debug, Clone, PartialEq)]
pub struct Timing {
    /// What changes, from the top.
    pub signals: Vec<Signal>,
    /// What happens, one after the other.
    pub steps: Vec<TimingStep>,
}

/// Something that changes in a [`Timing`].
#[derive(Debug, Clone, PartialEq)]
pub struct Signal {
    /// What it is.
    pub carrier: SignalCarrier,
    /// Its levels: before the first step, then after each step.
    pub levels: Vec<Level>,
}

impl Signal {
    /// Whether the level changes at a step, counted from 1. It is unknown where any level may be before or after the
    /// step.
    pub fn changes_at(&self, step: usize) -> bool {
        let before = step.checked_sub(1).and_then(|before| self.levels.get(before));
        before
            .zip(self.levels.get(step))
            .is_some_and(|(before, behind)| before != behind && ![before, behind].contains(&&Level::Any))
    }
}

/// What a [`Signal`] shows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SignalCarrier {
    /// Bits of a named type.
    Bits(NamedBits),
    /// The value of an entry.
    Entry(EntryId),
}

/// A bit or a run of bits of a named type.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NamedBits {
    /// The type.
    pub named_type: String,
    /// Lowest bit.
    pub first: u8,
    /// Highest bit.
    pub last: u8,
    /// What the bits are called, perhaps in one mode of operation only; empty where they have no name.
    pub name: String,
}

/// The level of a [`Signal`] between two steps.
#[derive(Debug, Clone, PartialEq)]
pub enum Level {
    /// Any: it does not matter, or is unknown.
    Any,
    /// Some value that has a letter, to distinguish it from others.
    Letter(char),
    /// This value.
    Value(Value),
}

/// An event of a [`Timing`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TimingStep {
    /// What happens.
    pub event: Text,
    /// The step that it answers, counted from 1.
    pub cause: Option<usize>,
}
