//! Where the server takes what it sends.

use crate::abort::AbortCode;
use crate::access::application::Application;
use crate::access::dictionary::{Dictionary, value};
use crate::sdo::codec::{Expedited, Piece};
use crate::sdo::piece::gather;
use crate::table::entry::EntryId;
use crate::table::{Flags, Found, Place, Table};

/// Data that are read piece by piece.
#[derive(Debug, Clone, Copy)]
pub(super) struct Upload {
    pub(super) id: EntryId,
    from: From,
}

#[derive(Debug, Clone, Copy)]
enum From {
    /// A value, of which the buffer has a copy: pieces of two values are never mixed.
    Buffer { length: usize },
    /// A DOMAIN, which the application has.
    Application,
}

impl Upload {
    /// Copies a value into the buffer; of a DOMAIN, asks for the first bytes, so that a refusal comes at once.
    pub(super) fn begin<'t, D: Dictionary<'t>, A: Application<D>>(
        id: EntryId,
        found: Found<'t>,
        buffer: &mut [u8],
        dictionary: &mut D,
        application: &mut A,
    ) -> Result<Self, AbortCode> {
        if found.shared.place == Place::Application {
            domain_piece(id, 0, dictionary, application)?;
            return Ok(Self { id, from: From::Application });
        }
        let value = value(dictionary, found)?;
        let length = value.len();
        buffer.get_mut(..length).ok_or(AbortCode::OUT_OF_MEMORY)?.copy_from_slice(&value);
        Ok(Self { id, from: From::Buffer { length } })
    }

    /// How many bytes there are, where that is known.
    pub(super) fn size(&self) -> Option<u32> {
        match self.from {
            From::Buffer { length } => u32::try_from(length).ok(),
            From::Application => None,
        }
    }

    /// The piece from an offset on.
    pub(super) fn piece<'t, D: Dictionary<'t>, A: Application<D>>(
        &self,
        offset: u32,
        buffer: &[u8],
        dictionary: &mut D,
        application: &mut A,
    ) -> Result<Piece, AbortCode> {
        match self.from {
            From::Buffer { length } => {
                let at = usize::try_from(offset).map_err(|_| AbortCode::INTERNAL)?;
                Ok(Piece::first_of(buffer.get(at..length).unwrap_or_default()))
            }
            From::Application => domain_piece(self.id, offset, dictionary, application),
        }
    }
}

/// An entry that a client may read, and whose value lies ready in one to four bytes: a number, as almost all that is read. Of what
/// it leaves out, the rest of the server knows what to say.
#[inline]
pub(super) fn find_short<'t>(table: &Table<'t>, EntryId { index, sub }: EntryId) -> Option<Found<'t>> {
    let found = table.look_quickly(index, sub, Flags::READ)?;
    let is_value = match found.shared.place {
        Place::Image => !found.shared.data_type.is_string(),
        Place::Constant => true,
        Place::Alias | Place::Application => false,
    };
    // The error history has entries that are not filled.
    if is_value && matches!(found.shared.size, 1..=4) && index != 0x1003 { Some(found) } else { None }
}

/// The value of an entry that is [short](find_short).
#[inline]
pub(super) fn short_value(table: &Table<'_>, image: &[u8], found: Found<'_>) -> Option<Expedited> {
    let (at, size) = (found.offset(), found.shared.size);
    match found.shared.place {
        Place::Image => Expedited::first_of(image.get(at..)?, size),
        Place::Constant => Expedited::first_of(table.parts().constants.get(at..)?, size),
        Place::Alias | Place::Application => None,
    }
}

/// A piece of a DOMAIN.
fn domain_piece<'t, D: Dictionary<'t>, A: Application<D>>(
    EntryId { index, sub }: EntryId,
    offset: u32,
    dictionary: &mut D,
    application: &mut A,
) -> Result<Piece, AbortCode> {
    gather(offset, |from, room| dictionary.upload_domain(index, sub, from, room, application))
}
