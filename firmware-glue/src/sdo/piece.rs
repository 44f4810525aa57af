//! Pieces of data that another owner has.

use super::codec::Piece;
use crate::abort::AbortCode;

/// The piece from an offset on. `read` gives the number of bytes that it put, 0 at the end. One byte more than a piece takes is
/// asked for, because that shows whether it is the last.
pub(super) fn gather(
    offset: u32,
    mut read: impl FnMut(u32, &mut [u8]) -> Result<usize, AbortCode>,
) -> Result<Piece, AbortCode> {
    let mut data = [0; 8];
    let mut length = 0;
    while let Some(room) = data.get_mut(length..).filter(|room| !room.is_empty()) {
        let from = u32::try_from(length).ok().and_then(|length| offset.checked_add(length));
        let Some(from) = from else { break };
        let most = room.len();
        match read(from, room)? {
            0 => break,
            read => length += read.min(most),
        }
    }
    Ok(Piece::first_of(data.get(..length).unwrap_or_default()))
}
