//! Block diagrams: what takes part, and what goes from one to another.

use super::{EntryId, NamedBits, Text};

/// Blocks, and the way from the first to the last of them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Flow {
    /// The blocks; each takes from earlier ones only.
    pub blocks: Vec<Block>,
}

/// A block of a [`Flow`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Block {
    /// What it is.
    pub name: Text,
    /// Entries whose values it has or that set it up; sub-index 0 of an object with several entries is the object as a whole.
    pub entries: Vec<EntryId>,
    /// Bits that it is or that act on it.
    pub bits: Option<NamedBits>,
    /// What it does; may be empty.
    pub does: Text,
    /// What it takes from others, in order.
    pub from: Vec<Inflow>,
}

/// What a [`Block`] takes from an earlier one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Inflow {
    /// Position of the earlier block.
    pub block: usize,
    /// What comes from there; may be empty.
    pub carries: Text,
}

impl Flow {
    /// The entries of all blocks, in order.
    pub fn entries(&self) -> impl Iterator<Item = EntryId> {
        self.blocks.iter().flat_map(|block| block.entries.iter().copied())
    }
}
