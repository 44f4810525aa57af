//! Rules of single communication objects (CiA 301 9.6.3), beyond type and limits.

use crate::abort::AbortCode;
use crate::dictionary::value_of;
use crate::image::unsigned;
use crate::pdo;
use crate::table::{Found, Place, Row, Table};

/// Bit 31 of COB-ID entries: the message does not exist.
pub(crate) const NOT_VALID: u32 = 1 << 31;
const PRODUCER: u32 = 1 << 30;
/// Bit 29 chooses identifiers of 29 bits, which the dictionary does not support; bits 11 to 28 belong to such.
const EXTENDED: u32 = 0x3FFF_F800;
const CAN_ID: u32 = 0x7FF;
/// Frame and identifier: what cannot change while the message exists.
const FRAME: u32 = 0x3FFF_FFFF;

/// "save", the signature of 1010h.
const SAVE: u32 = u32::from_le_bytes(*b"save");
/// "load", the signature of 1011h.
const LOAD: u32 = u32::from_le_bytes(*b"load");

/// [`check`] for a row of the communication area.
#[inline(never)]
pub(crate) fn check_row(
    table: &'static Table,
    image: &[u8],
    row: Row,
    data: &[u8],
) -> Result<bool, AbortCode> {
    let (index, sub) = table.id(row);
    check(table, image, index, sub, data)
}

/// Checks a value of the right type and within its limits for a communication object; `false` when it is a command that is
/// not stored.
pub(crate) fn check(
    table: &'static Table,
    image: &[u8],
    index: u16,
    sub: u8,
    data: &[u8],
) -> Result<bool, AbortCode> {
    // None of the objects below has more than 32 bits.
    let new = u32::try_from(unsigned(data)).unwrap_or(u32::MAX);
    let old = || current(table, image, index, sub).unwrap_or(u32::MAX);
    match (index, sub) {
        (0x1003, 0) if new != 0 => Err(AbortCode::INVALID_VALUE),
        (0x1005 | 0x1012, 0) => {
            if old() & PRODUCER != 0 && new & PRODUCER != 0 && (old() ^ new) & FRAME != 0 {
                return Err(AbortCode::INVALID_VALUE);
            }
            usable(new)
        }
        (0x1010, 1..) => {
            if new == SAVE {
                Ok(false)
            } else {
                Err(AbortCode::NOT_STORED)
            }
        }
        (0x1011, 1..) => {
            if new == LOAD {
                Ok(false)
            } else {
                Err(AbortCode::NOT_STORED)
            }
        }
        (0x1014, 0) | (0x1028, 1..) | (0x1200..0x1300, 1 | 2) => check_cob_id(old(), new),
        (0x1016, 1..) => check_heartbeat(table, image, sub, new),
        (0x1019, 0) => {
            if matches!(new, 1 | 241..) {
                Err(AbortCode::INVALID_VALUE)
            } else if current(table, image, 0x1006, 0).is_some_and(|period| period != 0) {
                Err(AbortCode::DEVICE_STATE)
            } else {
                Ok(true)
            }
        }
        (0x1400..0x1600 | 0x1800..0x1A00, _) => pdo::check_communication(table, image, index, sub, new),
        (0x1600..0x1800 | 0x1A00..0x1C00, _) => pdo::check_mapping(table, image, index, sub, new),
        _ => Ok(true),
    }
}

/// The present number of an entry, where it exists.
pub(crate) fn current(table: &'static Table, image: &[u8], index: u16, sub: u8) -> Option<u32> {
    at_row(table, image, table.lookup(index, sub).ok()?)
}

/// The present number of an entry.
#[expect(clippy::inline_always, reason = "see `pdo`")]
#[inline(always)]
pub(crate) fn at_row(table: &'static Table, image: &[u8], found: Found) -> Option<u32> {
    let bytes = match found.shared.place {
        Place::Image => image,
        Place::Constant => table.constants,
        _ => return slow_row(table, image, found),
    };
    let bytes = bytes.get(found.offset()..)?;
    match found.shared.size {
        4 => bytes.first_chunk().map(|bytes| u32::from_le_bytes(*bytes)),
        2 => bytes.first_chunk().map(|bytes| u16::from_le_bytes(*bytes).into()),
        1 => bytes.first().copied().map(u32::from),
        _ => slow_row(table, image, found),
    }
}

#[inline(never)]
fn slow_row(table: &'static Table, image: &[u8], found: Found) -> Option<u32> {
    u32::try_from(unsigned(&value_of(table, image, found).ok()?)).ok()
}

/// Refuses to read an entry of the error history that holds no error.
pub(crate) fn history_has(table: &'static Table, image: &[u8], sub: u8) -> Result<(), AbortCode> {
    let filled = current(table, image, 0x1003, 0).unwrap_or_default();
    if u32::from(sub) <= filled { Ok(()) } else { Err(AbortCode::NO_DATA) }
}

/// A COB-ID of a message that bit 31 switches off: while it exists, its frame does not change.
pub(crate) fn check_cob_id(old: u32, new: u32) -> Result<bool, AbortCode> {
    if new & NOT_VALID != 0 {
        return if new & EXTENDED == 0 { Ok(true) } else { Err(AbortCode::INVALID_VALUE) };
    }
    if old & NOT_VALID == 0 && (old ^ new) & FRAME != 0 {
        return Err(AbortCode::INVALID_VALUE);
    }
    // What is not changed is fine as it is: the SDO channel, for one, has a restricted identifier by right.
    if old & NOT_VALID == 0 { Ok(true) } else { usable(new) }
}

/// An identifier of 11 bits that CiA 301 does not keep for another service (table 35, and 002h to 07Fh since 4.2).
fn usable(cob_id: u32) -> Result<bool, AbortCode> {
    let restricted = matches!(
        cob_id & CAN_ID,
        0x000..=0x07F | 0x101..=0x180 | 0x581..=0x5FF | 0x601..=0x67F | 0x6E0 | 0x701..=0x77F | 0x780..=0x7FF
    );
    if cob_id & EXTENDED != 0 || restricted { Err(AbortCode::INVALID_VALUE) } else { Ok(true) }
}

/// 1016h: bits 16 to 23 node, bits 0 to 15 time in ms; a node is watched once.
fn check_heartbeat(table: &'static Table, image: &[u8], sub: u8, new: u32) -> Result<bool, AbortCode> {
    let (node, time) = (new >> 16, new & 0xFFFF);
    if node > 127 {
        return Err(AbortCode::INVALID_VALUE);
    }
    if node == 0 || time == 0 {
        return Ok(true);
    }
    let count = current(table, image, 0x1016, 0).unwrap_or_default();
    let twice = (1..=u8::try_from(count).unwrap_or(u8::MAX)).filter(|other| *other != sub).any(|other| {
        current(table, image, 0x1016, other).is_some_and(|entry| entry >> 16 == node && entry & 0xFFFF != 0)
    });
    if twice { Err(AbortCode::INCOMPATIBLE) } else { Ok(true) }
}
