//! What comes in addition to the model.

use std::collections::BTreeMap;

use od_spec::model::{EntryId, Index};

/// What a specification is to say in addition to the facts of the model.
#[derive(Debug, Clone, Default)]
pub struct Options {
    /// Comment lines at the top.
    pub head: Vec<String>,
    /// Comment lines at the end: what has no place in a specification.
    pub foot: Vec<String>,
    /// Comment lines above an object or entry.
    pub comments: BTreeMap<Place, Vec<String>>,
}

/// What a comment or a repair is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Place {
    /// The device.
    Device,
    /// An object.
    Object(Index),
    /// An entry; of a VAR, the object is meant.
    Entry(EntryId),
}
