//! Communication objects as the services of CANopen read and set them.
//!
//! What is `inline(always)` here is asked for objects that the source names. Of a generated dictionary, whose table is constant, the
//! compiler then finds the place of the value by itself: a look becomes a load, and what a service would do with an object that
//! the device does not have is left out of the firmware.

#![expect(clippy::inline_always, reason = "not inlined, nothing is known of the object that is asked for")]

use crate::access::dictionary::Dictionary;
use crate::table::stored::{at_row, current, put};
use crate::table::{Found, Place, Table};

/// A dictionary, as far as a service reads it: the same code for every type of dictionary.
#[derive(Clone, Copy)]
pub(crate) struct Parameters<'t, 'v> {
    table: &'t Table<'t>,
    image: &'v [u8],
}

impl<'t, 'v> Parameters<'t, 'v> {
    #[inline(always)]
    pub(crate) fn of<D: Dictionary<'t>>(dictionary: &'v D) -> Self {
        Self { table: dictionary.table(), image: dictionary.image() }
    }

    /// Whether there is an object of a constant index.
    #[inline(always)]
    pub(crate) fn has(self, index: u16) -> bool {
        self.table.object(index).is_ok()
    }

    /// The number at a constant index and sub-index, where there is one.
    #[inline(always)]
    pub(crate) fn number(self, index: u16, sub: u8) -> Option<u32> {
        at_row(self.table, self.image, self.table.lookup_in(self.table.object(index).ok()?, sub).ok()?)
    }

    /// The same with 8 bits; 0 where there is none.
    #[inline(always)]
    pub(crate) fn byte(self, index: u16, sub: u8) -> u8 {
        self.number(index, sub).and_then(|number| u8::try_from(number).ok()).unwrap_or_default()
    }

    /// The same with 16 bits; 0 where there is none.
    #[inline(always)]
    pub(crate) fn word(self, index: u16, sub: u8) -> u16 {
        self.number(index, sub).and_then(|number| u16::try_from(number).ok()).unwrap_or_default()
    }

    /// The number at an index and sub-index of which one is not constant, where there is one.
    pub(crate) fn searched(self, index: u16, sub: u8) -> Option<u32> {
        current(self.table, self.image, index, sub)
    }
}

/// Sets a number of up to 32 bits at a constant index and sub-index, where the dictionary holds it in its image; elsewhere, nothing happens.
#[inline(always)]
pub(crate) fn set<'t, D: Dictionary<'t>>(dictionary: &mut D, index: u16, sub: u8, number: u32) {
    let table = dictionary.table();
    if let Ok(found) = table.object(index).and_then(|rows| table.lookup_in(rows, sub)) {
        set_at(dictionary.image_mut(), found, number);
    }
}

/// Sets a number of up to 32 bits of an entry.
#[inline(always)]
pub(crate) fn set_at(image: &mut [u8], found: Found<'_>, number: u32) {
    let bytes = number.to_le_bytes();
    if let (Place::Image, Some(value)) = (found.shared.place, bytes.get(..usize::from(found.shared.size))) {
        // A place outside the image does not occur: the table was checked, or made by the generator.
        let _ = put(image, found, value);
    }
}
