//! Rules of single communication objects (CiA 301 9.6.3), beyond type and limits.

pub(crate) mod cob_id;
mod pdo;

use crate::abort::AbortCode;
use crate::access::command::Command;
use crate::access::communication::cob_id::{
    NOT_VALID, PRODUCER, check_client_cob_id, check_cob_id, check_produced,
};
use crate::table::entry::EntryId;
use crate::table::stored::current;
use crate::table::{Row, Table};
use crate::value::number::unsigned;

/// What a value replaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Before {
    /// The one of now: a client writes it, and some values change only while a message does not exist.
    Present,
    /// None: it comes from a memory.
    Nothing,
}

/// What becomes of a value that passed every check of the dictionary.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Effect {
    /// The entry takes it.
    Store,
    /// It is a command for the application; the entry keeps its value.
    Command(Command),
}

/// Checks a value of the right type and within its limits for the row of a communication object.
#[inline(never)]
pub(crate) fn check(
    table: &Table<'_>,
    image: &[u8],
    row: Row,
    data: &[u8],
    before: Before,
) -> Result<Effect, AbortCode> {
    let EntryId { index, sub } = table.id(row);
    // None of the objects below has more than 32 bits.
    let new = u32::try_from(unsigned(data)).unwrap_or(u32::MAX);
    let old = |nothing| match before {
        Before::Present => current(table, image, index, sub).unwrap_or(u32::MAX),
        Before::Nothing => nothing,
    };
    match (index, sub) {
        // What the device itself holds, and no client writes.
        (0x1003, 0) | (0x1010 | 0x1011, _) if before == Before::Nothing => {}
        (0x1003, 0) if new != 0 => return Err(AbortCode::INVALID_VALUE),
        // It would be unknown how often.
        (0x1005, 0) if new & !old(0) & PRODUCER != 0 && current(table, image, 0x1006, 0).is_none() => {
            return Err(AbortCode::INVALID_VALUE);
        }
        (0x1005 | 0x1012, 0) => check_produced(old(0), new)?,
        (0x1010 | 0x1011, 1..) => return Command::given(EntryId { index, sub }, new).map(Effect::Command),
        (0x1014, 0) | (0x1028, 1..) | (0x1200..0x1280, 1 | 2) => check_cob_id(old(NOT_VALID), new)?,
        (0x1280..0x1300, 1 | 2) => check_client_cob_id(sub, old(NOT_VALID), new)?,
        // The node-ID of the other side of an SDO channel, and reactions that CiA 301 reserves.
        (0x1201..0x1300, 3) if new > 127 => return Err(AbortCode::INVALID_VALUE),
        (0x1029, 1..) if matches!(new, 3..=127) => return Err(AbortCode::INVALID_VALUE),
        (0x1016, 1..) => check_heartbeat(table, image, sub, new)?,
        (0x1019, 0) => check_counter(table, image, new, before)?,
        (0x1400..0x1600 | 0x1800..0x1A00, _) => {
            pdo::check_communication(table, image, index, sub, new, before)?;
        }
        (0x1600..0x1800 | 0x1A00..0x1C00, _) => {
            pdo::check_mapping(table, image, index, sub, new, before)?;
        }
        _ => {}
    }
    Ok(Effect::Store)
}

/// 1016h: bits 16 to 23 node, bits 0 to 15 time in ms; a node is watched once.
fn check_heartbeat(table: &Table<'_>, image: &[u8], sub: u8, new: u32) -> Result<(), AbortCode> {
    let (node, time) = (new >> 16, new & 0xFFFF);
    if node > 127 {
        return Err(AbortCode::INVALID_VALUE);
    }
    if node == 0 || time == 0 {
        return Ok(());
    }
    let count = current(table, image, 0x1016, 0).unwrap_or_default();
    let twice =
        (1..=u8::try_from(count).unwrap_or(u8::MAX)).filter(|watched| *watched != sub).any(|watched| {
            current(table, image, 0x1016, watched)
                .is_some_and(|entry| entry >> 16 == node && entry & 0xFFFF != 0)
        });
    if twice { Err(AbortCode::INCOMPATIBLE) } else { Ok(()) }
}

/// 1019h: 0 or 2 to 240, and only while no SYNC is produced (1006h is 0).
fn check_counter(table: &Table<'_>, image: &[u8], new: u32, before: Before) -> Result<(), AbortCode> {
    if matches!(new, 1 | 241..) {
        Err(AbortCode::INVALID_VALUE)
    } else if before == Before::Present && current(table, image, 0x1006, 0).is_some_and(|period| period != 0)
    {
        Err(AbortCode::DEVICE_STATE)
    } else {
        Ok(())
    }
}

/// Refuses to read an entry of the error history (1003h) that holds no error.
pub(crate) fn history_has(table: &Table<'_>, image: &[u8], sub: u8) -> Result<(), AbortCode> {
    let filled = current(table, image, 0x1003, 0).unwrap_or_default();
    if u32::from(sub) <= filled { Ok(()) } else { Err(AbortCode::NO_DATA) }
}
