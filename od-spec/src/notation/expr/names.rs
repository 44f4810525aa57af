//! Names in conditions, and what resolves them.

use std::ops::Range;

use crate::model::{EntryId, EntryRef, Index, Ratio, SubIndex};

/// A name in a condition.
#[derive(Debug, Clone)]
pub(crate) struct Named<'a> {
    /// The device in front of it.
    pub device: Option<&'a str>,
    pub text: &'a str,
    /// Where it is in the condition.
    pub range: Range<usize>,
}

/// What a name means where a number or an entry may be.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Operand {
    Entry(EntryId),
    Number(Ratio),
}

/// Who knows the names of conditions. `None` for a name that nothing has, which is reported.
pub(crate) trait Lookup {
    /// The entry of a name.
    fn entry(&mut self, name: &Named<'_>) -> Option<EntryId>;
    /// What a name means that an entry is compared with: one of the entry's values, or another entry.
    fn operand(&mut self, compared: &EntryRef, name: &Named<'_>) -> Option<Operand>;
    /// The bit of an entry.
    fn bit(&mut self, of: &EntryRef, name: &Named<'_>) -> Option<u8>;
    /// An entry is written there by index, with its device in front of it where one does.
    fn numbered(&mut self, _entry: &EntryRef, _range: Range<usize>) {}
}

/// Every name is one; for those who ask how a condition is written, and not what it says.
pub(crate) struct AnyName;

impl Lookup for AnyName {
    fn entry(&mut self, _: &Named<'_>) -> Option<EntryId> {
        Some(NO_ENTRY)
    }

    fn operand(&mut self, _: &EntryRef, _: &Named<'_>) -> Option<Operand> {
        Some(Operand::Entry(NO_ENTRY))
    }

    fn bit(&mut self, _: &EntryRef, _: &Named<'_>) -> Option<u8> {
        Some(0)
    }
}

/// What represents an unknown entry.
pub(super) const NO_ENTRY: EntryId = EntryId { index: Index(0), sub: SubIndex(0) };

/// What represents the number of a constraint that is written once for several.
pub(crate) const PLACEHOLDER: &str = "{n}";
