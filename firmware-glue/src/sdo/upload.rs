//! Where the server takes what it sends.

use super::codec::Piece;
use super::download::is_domain;
use crate::abort::AbortCode;
use crate::application::Application;
use crate::dictionary::Dictionary;
use crate::id::EntryId;

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
    /// Copies a value into the buffer.
    pub(super) fn of_value(id: EntryId, value: &[u8], buffer: &mut [u8]) -> Result<Self, AbortCode> {
        let length = value.len();
        buffer.get_mut(..length).ok_or(AbortCode::OUT_OF_MEMORY)?.copy_from_slice(value);
        Ok(Self { id, from: From::Buffer { length } })
    }

    /// Begins with an entry whose value was refused: a DOMAIN has none, but the application may have its data. Its first bytes are
    /// asked for, so that a refusal comes at once.
    #[inline(never)]
    pub(super) fn of_refused<'t, D: Dictionary<'t>, A: Application<D>>(
        id: EntryId,
        refusal: AbortCode,
        dictionary: &mut D,
        application: &mut A,
    ) -> Result<Self, AbortCode> {
        if refusal != AbortCode::UNSUPPORTED_ACCESS || !is_domain(dictionary, id) {
            return Err(refusal);
        }
        domain_piece(id, 0, dictionary, application)?;
        Ok(Self { id, from: From::Application })
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

/// A piece of a DOMAIN. One byte more than it takes is asked for, as that tells whether it is the last.
fn domain_piece<'t, D: Dictionary<'t>, A: Application<D>>(
    EntryId { index, sub }: EntryId,
    offset: u32,
    dictionary: &mut D,
    application: &mut A,
) -> Result<Piece, AbortCode> {
    let mut data = [0; 8];
    let mut length = 0;
    while let Some(room) = data.get_mut(length..).filter(|room| !room.is_empty()) {
        let from = u32::try_from(length).ok().and_then(|length| offset.checked_add(length));
        let Some(from) = from else { break };
        let most = room.len();
        match dictionary.upload_domain(index, sub, from, room, application)? {
            0 => break,
            read => length += read.min(most),
        }
    }
    Ok(Piece::first_of(data.get(..length).unwrap_or_default()))
}
