//! What can be chosen about a document.

use std::collections::BTreeMap;

use od_spec::model::{Devices, EntryId};
use od_spec::wording;

/// What a document shows.
#[derive(Debug, Clone, Default)]
pub struct Options {
    /// The devices.
    pub devices: Devices,
    /// Language of texts; that of the specification unless given.
    pub language: Option<String>,
    /// Language of fixed words; that of the texts unless given.
    pub words: Option<wording::Language>,
    /// Whether a printed manual shows where it differs from the issue that it takes the place of.
    pub errata: bool,
    /// Calls of the accessors in generated Rust, by key of the device, then by entry.
    pub accessors: BTreeMap<String, BTreeMap<EntryId, String>>,
}
