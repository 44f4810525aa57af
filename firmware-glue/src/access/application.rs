//! What a dictionary asks the application.

use core::fmt::Debug;

use crate::abort::AbortCode;
use crate::access::command::Command;

/// Something whose entries have names: a dictionary, as its application sees it.
pub trait Entries: Sized {
    /// Every entry, by name; an enumeration in generated code.
    type Entry: Copy + Eq + Debug + 'static;
}

/// The application's part in accesses over the bus. Every method has a default, so that `&mut ()` is an application that
/// agrees to every value that the dictionary allows, carries out no command, and never unlocks.
pub trait Application<D: Entries> {
    /// Whether the device is unlocked for service, so that locked entries can be written. Never unless overridden.
    fn is_unlocked(&self) -> bool {
        false
    }

    /// Called before an entry is read by `Dictionary::upload` or packed into a PDO: the moment to bring values up to date
    /// that are not kept current all the time. Of an alias, the entry is its target.
    fn refresh(&mut self, dictionary: &mut D, entry: D::Entry) {
        let _ = (dictionary, entry);
    }

    /// The application's veto, after every check of the dictionary has passed. `value` has the length of the entry's type.
    ///
    /// # Errors
    /// The abort code for the client; the entry keeps its value then.
    fn accept(&mut self, dictionary: &mut D, entry: D::Entry, value: &[u8]) -> Result<(), AbortCode> {
        let _ = (dictionary, entry, value);
        Ok(())
    }

    /// Carries out a command, "store parameters" (1010h) or "restore defaults" (1011h). Its signature was checked, and the
    /// client is answered when it is done; a failure is an abort code such as [`AbortCode::HARDWARE`].
    ///
    /// # Errors
    /// The abort code for the client; [`AbortCode::NOT_STORED`] unless overridden.
    fn command(&mut self, dictionary: &mut D, command: Command) -> Result<(), AbortCode> {
        let _ = (dictionary, command);
        Err(AbortCode::NOT_STORED)
    }

    /// Called after an entry got a value over the bus. Of an alias, the entry is its target.
    fn changed(&mut self, dictionary: &mut D, entry: D::Entry) {
        let _ = (dictionary, entry);
    }

    /// Reads a DOMAIN from an offset in bytes on; returns the number of bytes, 0 at its end.
    ///
    /// # Errors
    /// The abort code for the client; [`AbortCode::NO_DATA`] unless overridden.
    fn read_domain(
        &mut self,
        dictionary: &mut D,
        entry: D::Entry,
        offset: u32,
        buffer: &mut [u8],
    ) -> Result<usize, AbortCode> {
        let _ = (dictionary, entry, offset, buffer);
        Err(AbortCode::NO_DATA)
    }

    /// Takes a part of a DOMAIN from an offset in bytes on; `last` says that it is complete.
    ///
    /// # Errors
    /// The abort code for the client; [`AbortCode::NOT_STORED`] unless overridden.
    fn write_domain(
        &mut self,
        dictionary: &mut D,
        entry: D::Entry,
        offset: u32,
        data: &[u8],
        last: bool,
    ) -> Result<(), AbortCode> {
        let _ = (dictionary, entry, offset, data, last);
        Err(AbortCode::NOT_STORED)
    }
}

impl<D: Entries> Application<D> for () {}
