//! What entries are resolved against.

use super::scope::Scope;
use crate::model::Index;
use crate::source::FileId;

/// What entries are resolved against.
#[derive(Clone, Copy)]
pub(super) struct Surroundings<'a> {
    pub scope: &'a Scope,
    /// The specification's own file; other facts come from libraries.
    pub file: FileId,
    /// The object that the entries are of.
    pub index: Option<Index>,
    /// The key of the device; a library that is compiled by itself has none.
    pub device: Option<&'a str>,
    /// Which defaults the EDS withholds.
    pub eds: EdsDefaults,
}

/// Which defaults an EDS withholds (`eds-defaults`).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum EdsDefaults {
    /// Those of writable entries that are locked or stored.
    Safe,
    /// These, and those that only a library states.
    Own,
    /// None.
    All,
}

impl EdsDefaults {
    pub(super) fn of(word: Option<&str>) -> Self {
        match word {
            Some("all") => EdsDefaults::All,
            Some("own") => EdsDefaults::Own,
            _ => EdsDefaults::Safe,
        }
    }
}
