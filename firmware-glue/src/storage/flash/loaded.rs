//! What a store reports about what it has loaded.

use crate::storage::flash::groups::PerGroup;
use crate::table::Storage;
use crate::table::entry::EntryId;

/// In how many slots the newest record is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Copies {
    /// None: nothing was stored, or everything is lost.
    None,
    /// One; [`ParameterStore::repair`](super::ParameterStore::repair) makes it two.
    One,
    /// Both.
    Both,
}

/// What became of a storage group at loading.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Outcome {
    /// It has the factory's values, as none are stored: they never were, or "restore defaults" has taken them away; or it was not asked for.
    Defaults,
    /// It has its stored values.
    Restored,
    /// It has its stored values, except those that an entry cannot have, as the firmware that stored them had other
    /// limits: they have the factory's. This is the first of them.
    RestoredBut(EntryId),
    /// It has the factory's values, because the stored ones are of another layout.
    OtherLayout,
    /// It has the factory's values, because the stored ones follow another node-ID: with them, the node would use the identifiers of that node.
    OtherNode,
}

/// What was loaded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Loaded {
    /// Where the values were.
    pub copies: Copies,
    outcomes: PerGroup<Outcome>,
}

impl Loaded {
    /// Nothing, so far.
    pub(super) const fn new(copies: Copies) -> Self {
        Self { copies, outcomes: PerGroup::all(Outcome::Defaults) }
    }

    /// What became of a group.
    pub fn outcome(&self, storage: Storage) -> Outcome {
        self.outcomes.of(storage).unwrap_or(Outcome::Defaults)
    }

    pub(super) fn set(&mut self, storage: Storage, outcome: Outcome) {
        self.outcomes.set(storage, outcome);
    }
}
