//! The table of a dictionary: what every entry is and where its value lies.

#![expect(
    clippy::inline_always,
    reason = "only where it is inlined, the compiler finds an entry of a constant index by itself"
)]

mod checked;
mod directory;
pub(crate) mod entry;
mod fault;
mod flags;
pub(crate) mod mapping;
mod rows;
pub(crate) mod stored;
pub(crate) mod view;

use core::ops::Range;

pub use directory::{Block, Directory};
pub use entry::Found;
pub use fault::{Fault, TableError};
pub use flags::{Dummies, Flags};
pub use rows::{
    Alias, Attributes, EntryRow, Limits, NONE, Parts, Pdo, Place, Region, Row, SparseObject, Storage, entries,
};

use crate::abort::AbortCode;
use crate::table::entry::EntryId;
use crate::value::data_type::DataType;

/// Everything about a dictionary but the values in RAM, of which every part fits the others. Of generated code, it is
/// constant and lies in flash (`Table<'static>`); [`checked`](Self::checked) makes one at run time.
#[derive(Debug, Clone, Copy)]
pub struct Table<'t>(Parts<'t>);

/// What a row outside the table is: nothing that could be read or written.
static NOTHING: Attributes = Attributes {
    data_type: DataType::Domain,
    flags: Flags::NONE,
    place: Place::Application,
    storage: Storage::No,
    page: 0,
    size: 0,
    limits: NONE,
    values: NONE,
    condition: NONE,
};

impl<'t> Table<'t> {
    /// A table of parts that the generator has made, and that nothing checks any more. A program that makes parts by itself
    /// calls [`checked`](Self::checked): what does not fit together gives wrong values here.
    pub const fn generated(parts: Parts<'t>) -> Self {
        Self(parts)
    }

    /// What it is made of.
    #[inline]
    pub const fn parts(&self) -> &Parts<'t> {
        &self.0
    }

    /// Bytes of the largest value that is read or written as a whole, DOMAINs left out: what a server's buffer has to hold.
    /// A longer value fits no entry.
    pub const fn largest_value(&self) -> usize {
        let (mut largest, mut at) = (0, 0);
        while at < self.0.attributes.len() {
            let size = self.0.attributes[at].size as usize;
            if size > largest {
                largest = size;
            }
            at += 1;
        }
        largest
    }

    /// The row of an entry.
    ///
    /// # Errors
    /// [`AbortCode::NO_OBJECT`], [`AbortCode::NO_SUB_INDEX`].
    #[inline]
    pub fn find(&self, index: u16, sub: u8) -> Result<Row, AbortCode> {
        self.lookup(index, sub).map(|found| found.row)
    }

    /// [`object`](Self::object) of an index that is not constant: one function for all that call it.
    #[inline(never)]
    pub(crate) fn search_object(&self, index: u16) -> Result<Range<Row>, AbortCode> {
        self.object(index)
    }

    /// The rows of an object.
    #[inline(always)]
    pub(crate) fn object(&self, index: u16) -> Result<Range<Row>, AbortCode> {
        let object = self.0.directory.position(index).ok_or(AbortCode::NO_OBJECT)?;
        match self.0.objects.get(object..).and_then(<[Row]>::first_chunk::<2>) {
            Some([first, end]) => Ok(*first..*end),
            None => Err(AbortCode::NO_OBJECT),
        }
    }

    /// An entry.
    ///
    /// # Errors
    /// [`AbortCode::NO_OBJECT`], [`AbortCode::NO_SUB_INDEX`].
    #[inline]
    pub fn lookup(&self, index: u16, sub: u8) -> Result<Found<'t>, AbortCode> {
        self.lookup_in(self.object(index)?, sub)
    }

    /// An entry of an object with these rows.
    #[inline(always)]
    pub(crate) fn lookup_in(
        &self,
        Range { start: first, end }: Range<Row>,
        sub: u8,
    ) -> Result<Found<'t>, AbortCode> {
        let row = first.saturating_add(u16::from(sub));
        if row < end {
            let found = self.found(row);
            if !found.shared.flags.has(Flags::SPARSE) {
                return Ok(found);
            }
        }
        self.find_sparse(first, sub)
    }

    /// [`lookup`](Self::lookup) where it need not be fast: one function for all that call it.
    #[inline(never)]
    pub(crate) fn search(&self, index: u16, sub: u8) -> Result<Found<'t>, AbortCode> {
        self.lookup(index, sub)
    }

    /// [`lookup`](Self::lookup) of an entry that has some flags and is in an object without gaps, as almost every one is. Why another
    /// entry is not found is left to `lookup`.
    #[inline]
    pub(crate) fn look_quickly(&self, index: u16, sub: u8, flags: Flags) -> Option<Found<'t>> {
        let Range { start: first, end } = self.object(index).ok()?;
        let row = first.saturating_add(u16::from(sub));
        if row >= end {
            return None;
        }
        let EntryRow { attributes, place } = *self.0.entries.get(usize::from(row))?;
        let shared = self.0.attributes.get(usize::from(attributes))?;
        if shared.flags.of(flags.with(Flags::SPARSE)) == flags {
            Some(Found::new(row, place, shared))
        } else {
            None
        }
    }

    /// What is in a row.
    #[inline]
    pub(crate) fn found(&self, row: Row) -> Found<'t> {
        let EntryRow { attributes, place } = self.row(row);
        Found::new(row, place, self.0.attributes.get(usize::from(attributes)).unwrap_or(&NOTHING))
    }

    #[cold]
    fn find_sparse(&self, first: Row, sub: u8) -> Result<Found<'t>, AbortCode> {
        let object = self.0.sparse.binary_search_by_key(&first, |object| object.first);
        let subs = object.ok().and_then(|at| self.0.sparse.get(at)).map_or(&[][..], |object| object.subs);
        match subs.binary_search(&sub) {
            Ok(at) => Ok(self.found(first + u16::try_from(at).unwrap_or_default())),
            Err(_) => Err(AbortCode::NO_SUB_INDEX),
        }
    }

    /// Index and sub-index of a row; 0000h.0 for a row that nothing has.
    pub fn id(&self, row: Row) -> EntryId {
        const NOBODY: EntryId = EntryId { index: 0, sub: 0 };
        let after = self.0.objects.partition_point(|first| *first <= row);
        let Some((at, first)) = after.checked_sub(1).and_then(|at| Some((at, *self.0.objects.get(at)?)))
        else {
            return NOBODY;
        };
        let Some(index) = self.0.directory.index(at) else { return NOBODY };
        // The end of the list represents rows that nothing has.
        if self.0.entries.get(usize::from(row)).is_none() {
            return NOBODY;
        }
        let distance = row - first;
        let sub = if self.attributes(row).flags.has(Flags::SPARSE) {
            let sparse = self.0.sparse.binary_search_by_key(&first, |object| object.first);
            let subs = sparse.ok().and_then(|at| self.0.sparse.get(at)).map(|object| object.subs);
            subs.and_then(|subs| subs.get(usize::from(distance))).copied().unwrap_or_default()
        } else {
            u8::try_from(distance).unwrap_or_default()
        };
        EntryId { index, sub }
    }

    /// What an entry is; of a row that nothing has, a DOMAIN without access.
    #[inline]
    pub fn attributes(&self, row: Row) -> &'t Attributes {
        self.found(row).shared
    }

    #[inline]
    fn row(&self, row: Row) -> EntryRow {
        self.0.entries.get(usize::from(row)).copied().unwrap_or(EntryRow { attributes: NONE, place: 0 })
    }

    /// Whether an entry is a number in the image that takes every value of its length, whenever it is written.
    #[inline]
    pub(crate) fn is_free(&self, found: Found<'_>) -> bool {
        let shared = found.shared;
        // All bits of `NONE` are set.
        shared.limits & shared.values & shared.condition == NONE
            && shared.place == Place::Image
            && !shared.flags.has(Flags::LOCKED)
            && shared.data_type != DataType::Boolean
            && !shared.data_type.is_string()
            && found.row >= self.0.first_application_row
    }

    /// The alias that an entry is.
    pub(crate) fn alias(&self, row: Row) -> Option<&'t Alias> {
        self.0.aliases.get(usize::from(self.row(row).place))
    }

    /// The row that holds the value: of an alias, its target's.
    pub(crate) fn holder(&self, row: Row) -> Row {
        match self.attributes(row).place {
            Place::Alias => self.alias(row).map_or(row, |alias| alias.target),
            Place::Image | Place::Constant | Place::Application => row,
        }
    }

    /// The part of the image that is stored together.
    pub fn region(&self, storage: Storage) -> Option<&'t Region> {
        self.0.regions.iter().find(|region| region.storage == storage)
    }
}
