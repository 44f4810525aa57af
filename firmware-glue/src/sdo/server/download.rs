//! Where the server puts what it gets.

use core::cmp::Ordering;

use crate::abort::AbortCode;
use crate::access::application::Application;
use crate::access::dictionary::{Dictionary, check_lock, put_free, writable, write_row};
use crate::table::entry::EntryId;
use crate::table::{Attributes, Place};

use crate::sdo::codec::Expedited;

/// Data that are written piece by piece.
#[derive(Debug, Clone, Copy)]
pub(super) struct Download {
    pub(super) id: EntryId,
    into: Into,
    /// How many bytes the client said that there are.
    announced: Option<u32>,
    /// How many came.
    came: u32,
}

#[derive(Debug, Clone, Copy)]
enum Into {
    /// A value: it is gathered in the buffer and written when it is whole.
    Buffer { largest: u16 },
    /// A DOMAIN: the application gets every piece.
    Application,
}

impl Download {
    /// Begins, if the entry can be written, is not locked and takes so many bytes.
    pub(super) fn begin<'t, D: Dictionary<'t>, A: Application<D>>(
        id: EntryId,
        announced: Option<u32>,
        buffer: &[u8],
        dictionary: &D,
        application: &A,
    ) -> Result<Self, AbortCode> {
        let shared = writable(dictionary.table(), id.index, id.sub)?.shared;
        check_lock::<D, A>(shared, application)?;
        let into = if shared.place == Place::Application {
            Into::Application
        } else {
            if let Some(announced) = announced {
                check_size(shared, announced)?;
                if usize::try_from(announced).map_or(true, |announced| announced > buffer.len()) {
                    return Err(AbortCode::OUT_OF_MEMORY);
                }
            }
            Into::Buffer { largest: shared.size }
        };
        Ok(Self { id, into, announced, came: 0 })
    }

    /// Takes the next piece. With the last one, the value is written, or the DOMAIN is complete.
    pub(super) fn put<'t, D: Dictionary<'t>, A: Application<D>>(
        &mut self,
        data: &[u8],
        last: bool,
        buffer: &mut [u8],
        dictionary: &mut D,
        application: &mut A,
    ) -> Result<(), AbortCode> {
        let EntryId { index, sub } = self.id;
        let come = u32::try_from(data.len()).ok().and_then(|length| self.came.checked_add(length));
        let come = come.ok_or(AbortCode::TOO_LONG)?;
        if let Some(announced) = self.announced {
            match come.cmp(&announced) {
                Ordering::Greater => return Err(AbortCode::TOO_LONG),
                Ordering::Less if last => return Err(AbortCode::TOO_SHORT),
                Ordering::Less | Ordering::Equal => {}
            }
        }
        match self.into {
            Into::Application => {
                dictionary.download_domain(index, sub, self.came, data, last, application)?;
            }
            Into::Buffer { largest } => {
                if come > u32::from(largest) {
                    return Err(AbortCode::TOO_LONG);
                }
                let (from, to) = (usize::try_from(self.came), usize::try_from(come));
                let (Ok(from), Ok(to)) = (from, to) else { return Err(AbortCode::INTERNAL) };
                buffer.get_mut(from..to).ok_or(AbortCode::OUT_OF_MEMORY)?.copy_from_slice(data);
                if last {
                    let value = buffer.get(..to).ok_or(AbortCode::INTERNAL)?;
                    let found = writable(dictionary.table(), index, sub)?;
                    write_row(dictionary, found, value, application)?;
                }
            }
        }
        self.came = come;
        Ok(())
    }
}

/// Writes up to four bytes at once.
pub(super) fn write_expedited<'t, D: Dictionary<'t>, A: Application<D>>(
    id: EntryId,
    value: Expedited,
    dictionary: &mut D,
    application: &mut A,
) -> Result<(), AbortCode> {
    let EntryId { index, sub } = id;
    let found = writable(dictionary.table(), index, sub)?;
    // Almost every value that is written is a number without rules.
    if dictionary.table().is_free(found) {
        let (row, place, four) = (found.row, found.offset(), value.four());
        let [a, b, ..] = four;
        match (value.length(), found.shared.size) {
            (Some(4), 4) => return put_free(dictionary, row, place, four, application),
            (Some(2), 2) => return put_free(dictionary, row, place, [a, b], application),
            (Some(1), 1) => return put_free(dictionary, row, place, [a], application),
            _ => {}
        }
    }
    let data = match value.length() {
        Some(_) => value.bytes(),
        None => unsized_value(found.shared, &value)?,
    };
    match found.shared.place {
        Place::Application => dictionary.download_domain(index, sub, 0, data, true, application),
        Place::Image | Place::Constant | Place::Alias => {
            write_row(dictionary, found, data, application).map(|_| ())
        }
    }
}

/// Of four bytes that may all be the value or not, as many as the type has. How long a string is, is unknown.
fn unsized_value<'v>(shared: &Attributes, value: &'v Expedited) -> Result<&'v [u8], AbortCode> {
    let size = shared.data_type.size().ok_or(AbortCode::LENGTH)?;
    value.bytes().get(..usize::from(size)).ok_or(AbortCode::TOO_SHORT)
}

/// Whether a value can have so many bytes: what the dictionary would say of the whole value, before it comes.
fn check_size(shared: &Attributes, announced: u32) -> Result<(), AbortCode> {
    match announced.cmp(&u32::from(shared.size)) {
        Ordering::Greater => Err(AbortCode::TOO_LONG),
        Ordering::Less if !shared.data_type.is_string() => Err(AbortCode::TOO_SHORT),
        Ordering::Less | Ordering::Equal => Ok(()),
    }
}
