//! Communication objects as the services of CANopen read and set them.

use crate::access::dictionary::Dictionary;
use crate::table::stored::{current, put};
use crate::table::{Place, Table};

/// A dictionary, as far as a service reads it: the same code for every type of dictionary. The methods are inlined, so that the compiler
/// sees that a firmware has one table, and leaves out what this table does not need (a division for aliases, for one).
#[derive(Clone, Copy)]
pub(crate) struct Parameters<'t, 'v> {
    table: &'t Table<'t>,
    image: &'v [u8],
}

impl<'t, 'v> Parameters<'t, 'v> {
    #[inline]
    pub(crate) fn of<D: Dictionary<'t>>(dictionary: &'v D) -> Self {
        Self { table: dictionary.table(), image: dictionary.image() }
    }

    /// The number at an index and sub-index, where there is one.
    #[inline]
    pub(crate) fn number(self, index: u16, sub: u8) -> Option<u32> {
        current(self.table, self.image, index, sub)
    }

    /// A number of 8 bits; 0 where there is none.
    #[inline]
    pub(crate) fn byte(self, index: u16, sub: u8) -> u8 {
        self.number(index, sub).and_then(|number| u8::try_from(number).ok()).unwrap_or_default()
    }

    /// A number of 16 bits; 0 where there is none.
    #[inline]
    pub(crate) fn word(self, index: u16, sub: u8) -> u16 {
        self.number(index, sub).and_then(|number| u16::try_from(number).ok()).unwrap_or_default()
    }
}

/// Sets a number of up to 32 bits where the dictionary holds it in its image; elsewhere, nothing happens.
pub(crate) fn set<'t, D: Dictionary<'t>>(dictionary: &mut D, index: u16, sub: u8, number: u32) {
    let Ok(found) = dictionary.table().search(index, sub) else { return };
    let bytes = number.to_le_bytes();
    if let (Place::Image, Some(value)) = (found.shared.place, bytes.get(..usize::from(found.shared.size))) {
        // A place outside the image does not occur: the table was checked, or made by the generator.
        let _ = put(dictionary.image_mut(), found, value);
    }
}
