//! Marks on an axis, and the spans between them.

use super::{EntryId, Text};

/// An axis with its marks in order. It says what lies where and what is measured from where, and no lengths.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Axis {
    /// The marks, from the lowest value to the highest.
    pub marks: Vec<AxisMark>,
    /// The spans.
    pub spans: Vec<AxisSpan>,
}

/// A place on an [`Axis`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AxisMark {
    /// What is there.
    pub name: Text,
    /// Entries whose values it is; sub-index 0 of an object with several entries is the object as a whole.
    pub entries: Vec<EntryId>,
}

/// A part of an [`Axis`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AxisSpan {
    /// What it is.
    pub name: Text,
    /// Entries that say how long it is, or that act there.
    pub entries: Vec<EntryId>,
    /// Where it lies.
    pub reach: AxisReach,
    /// What holds there; may be empty.
    pub does: Text,
}

/// Where an [`AxisSpan`] lies; marks are positions in [`Axis::marks`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AxisReach {
    /// From a mark to a mark, in this direction.
    Between(usize, usize),
    /// Below a mark, without an end.
    Below(usize),
    /// Above a mark, without an end.
    Above(usize),
}

impl Axis {
    /// The entries of all marks and spans, in order.
    pub fn entries(&self) -> impl Iterator<Item = EntryId> {
        let marks = self.marks.iter().flat_map(|mark| &mark.entries);
        marks.chain(self.spans.iter().flat_map(|span| &span.entries)).copied()
    }
}
