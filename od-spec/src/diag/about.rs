//! What a message is about, for programs: they never read its words.

use crate::model::{EntryId, Fact, Index, SubIndex};

/// The object or the entry that a message is about, with the fact where it is one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum About {
    /// An object as a whole.
    Object(Index, Option<Fact>),
    /// An entry; that of a VAR has sub-index 0.
    Entry(EntryId, Option<Fact>),
}

impl About {
    /// The object.
    pub const fn index(self) -> Index {
        match self {
            About::Object(index, _) => index,
            About::Entry(id, _) => id.index,
        }
    }

    /// The entry; of an object, the one at sub-index 0.
    pub const fn entry(self) -> EntryId {
        match self {
            About::Object(index, _) => EntryId { index, sub: SubIndex(0) },
            About::Entry(id, _) => id,
        }
    }

    /// The fact.
    pub const fn fact(self) -> Option<Fact> {
        match self {
            About::Object(_, fact) | About::Entry(_, fact) => fact,
        }
    }
}

impl From<Index> for About {
    fn from(index: Index) -> Self {
        About::Object(index, None)
    }
}

impl From<EntryId> for About {
    fn from(id: EntryId) -> Self {
        About::Entry(id, None)
    }
}

impl From<(Index, Fact)> for About {
    fn from((index, fact): (Index, Fact)) -> Self {
        About::Object(index, Some(fact))
    }
}

impl From<(EntryId, Fact)> for About {
    fn from((id, fact): (EntryId, Fact)) -> Self {
        About::Entry(id, Some(fact))
    }
}
