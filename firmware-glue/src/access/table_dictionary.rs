//! A dictionary for a table that was made at run time.

use core::fmt;

use crate::abort::AbortCode;
use crate::access::application::Entries;
use crate::access::dictionary::{Dictionary, hold};
use crate::table::entry::EntryId;
use crate::table::stored::value_of;
use crate::table::{Row, Table};
use crate::value::Value;

/// A table, and values in bytes of any kind (`Vec<u8>`, `[u8; N]`, `&mut [u8]`): what a host program serves for a device that
/// it knows from a file. Entries are named by index and sub-index.
///
/// Write conditions are code, which a table does not have: an entry with one cannot be written
/// ([`AbortCode::DEVICE_STATE`](crate::AbortCode::DEVICE_STATE)). A program that knows them implements [`Dictionary`] for a
/// type of its own.
#[derive(Debug, Clone)]
pub struct TableDictionary<'t, I> {
    table: &'t Table<'t>,
    image: I,
}

/// The bytes for the values are not as many as the table says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct WrongSize {
    /// Bytes that there are.
    pub found: usize,
    /// Bytes that the values need: the length of [`Parts::factory`](crate::table::Parts::factory).
    pub expected: usize,
}

impl fmt::Display for WrongSize {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} bytes for values that need {}", self.found, self.expected)
    }
}

impl core::error::Error for WrongSize {}

impl<'t, I: AsRef<[u8]> + AsMut<[u8]>> TableDictionary<'t, I> {
    /// A dictionary with the values after a factory reset, for a node-ID from 1 to 127.
    ///
    /// # Errors
    /// [`WrongSize`] when the image has another length than the values.
    pub fn new(table: &'t Table<'t>, image: I, node_id: u8) -> Result<Self, WrongSize> {
        let (found, expected) = (image.as_ref().len(), table.parts().factory.len());
        if found != expected {
            return Err(WrongSize { found, expected });
        }
        let mut dictionary = Self { table, image };
        dictionary.reset(node_id);
        Ok(dictionary)
    }

    /// The value in a row, whatever its access: what conditions between entries are about.
    ///
    /// # Errors
    /// [`AbortCode::UNSUPPORTED_ACCESS`] for a DOMAIN and a row that nothing has, what an alias says about a value that it
    /// cannot show.
    pub fn held(&self, row: Row) -> Result<Value<'_>, AbortCode> {
        value_of(self.table, self.image.as_ref(), self.table.found(row))
    }

    /// Puts a value into a row as the device itself does, whatever its access, its lock and its condition; of an alias, into its
    /// target. It has to be one that the entry can have.
    ///
    /// # Errors
    /// What a client would get for the value; [`AbortCode::READ_ONLY`] for what is constant,
    /// [`AbortCode::UNSUPPORTED_ACCESS`] for a DOMAIN.
    pub fn hold(&mut self, row: Row, data: &[u8]) -> Result<(), AbortCode> {
        hold(self.table, self.image.as_mut(), self.table.found(row), data)
    }
}

impl<I> Entries for TableDictionary<'_, I> {
    type Entry = EntryId;
}

impl<'t, I: AsRef<[u8]> + AsMut<[u8]>> Dictionary<'t> for TableDictionary<'t, I> {
    fn table(&self) -> &'t Table<'t> {
        self.table
    }

    fn entry(&self, row: Row) -> Option<EntryId> {
        (usize::from(row) < self.table.parts().entries.len()).then(|| self.table.id(row))
    }

    fn row(&self, entry: EntryId) -> Row {
        self.table.find(entry.index, entry.sub).unwrap_or(Row::MAX)
    }

    fn image(&self) -> &[u8] {
        self.image.as_ref()
    }

    fn image_mut(&mut self) -> &mut [u8] {
        self.image.as_mut()
    }

    fn condition(&self, _: u16) -> bool {
        false
    }
}
