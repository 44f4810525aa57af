//! Rules of changing the parameters of a PDO (CiA 301 9.6.3, 1400h to 1BFFh).

use crate::abort::AbortCode;
use crate::access::communication::Before;
use crate::access::communication::cob_id::{NO_REMOTE_FRAMES, NOT_VALID, check_cob_id};
use crate::table::mapping::{FRAME_BITS, MAPPING, Mapped, TRANSMIT, width};
use crate::table::stored::current;
use crate::table::{Flags, Found, Table};

/// Rules of 1400h to 15FFh and 1800h to 19FFh.
pub(crate) fn check_communication(
    table: &Table<'_>,
    image: &[u8],
    index: u16,
    sub: u8,
    new: u32,
    before: Before,
) -> Result<(), AbortCode> {
    let cob_id = cob_id(table, image, index, before);
    let is_valid = cob_id & NOT_VALID == 0;
    let refused = match sub {
        1 if index < TRANSMIT && new & NO_REMOTE_FRAMES != 0 => true,
        1 => return check_cob_id(cob_id, new),
        2 => matches!(new, 241..=251) || index < TRANSMIT && matches!(new, 252 | 253),
        3 => is_valid && current(table, image, index, 3) != Some(new),
        6 => new > 240 || is_valid && current(table, image, index, 6) != Some(new),
        _ => false,
    };
    if refused { Err(AbortCode::INVALID_VALUE) } else { Ok(()) }
}

/// Rules of 1600h to 17FFh and 1A00h to 1BFFh: the mapping changes only while the PDO does not exist; its entries, only
/// while their number is 0.
pub(crate) fn check_mapping(
    table: &Table<'_>,
    image: &[u8],
    index: u16,
    sub: u8,
    new: u32,
    before: Before,
) -> Result<(), AbortCode> {
    let is_used = match before {
        Before::Present => sub != 0 && current(table, image, index, 0).unwrap_or_default() != 0,
        Before::Nothing => false,
    };
    if cob_id(table, image, index - MAPPING, before) & NOT_VALID == 0 || is_used {
        return Err(AbortCode::UNSUPPORTED_ACCESS);
    }
    let direction = if index >= TRANSMIT { Flags::TRANSMIT } else { Flags::RECEIVE };
    if sub != 0 {
        // An entry of 0 maps nothing; it is refused when it is to be used.
        return if new == 0 { Ok(()) } else { check_mapped(table, direction, new).map(drop) };
    }
    let Ok(count @ 0..=64) = u8::try_from(new) else { return Err(AbortCode::PDO_LENGTH) };
    if current(table, image, index, count).is_none() {
        return Err(AbortCode::PDO_LENGTH);
    }
    let mut bits = 0;
    for sub in 1..=count {
        let parameter = current(table, image, index, sub).ok_or(AbortCode::PDO_LENGTH)?;
        bits += check_mapped(table, direction, parameter)?;
    }
    if bits > FRAME_BITS { Err(AbortCode::PDO_LENGTH) } else { Ok(()) }
}

/// The COB-ID of a PDO before a change.
fn cob_id(table: &Table<'_>, image: &[u8], index: u16, before: Before) -> u32 {
    match before {
        Before::Present => current(table, image, index, 1).unwrap_or(NOT_VALID),
        Before::Nothing => NOT_VALID,
    }
}

/// Whether a mapping parameter can be used in a direction; its bits.
fn check_mapped(table: &Table<'_>, direction: Flags, parameter: u32) -> Result<u32, AbortCode> {
    const DUMMY_BITS: [u32; 8] = [0, 1, 8, 16, 32, 8, 16, 32];
    let mapped = Mapped::of(parameter);
    let needed = if mapped.is_dummy() {
        if direction != Flags::RECEIVE || !table.parts().dummies.has(mapped.index) {
            return Err(AbortCode::NO_OBJECT);
        }
        DUMMY_BITS.get(usize::from(mapped.index)).copied().unwrap_or_default()
    } else {
        let Found { shared, .. } =
            table.search(mapped.index, mapped.sub).map_err(|_| AbortCode::NO_OBJECT)?;
        if !shared.flags.has(direction) {
            return Err(AbortCode::NOT_MAPPABLE);
        }
        width(shared)
    };
    let granularity = u32::from(table.parts().granularity);
    let in_step = granularity != 0 && mapped.bits.is_multiple_of(granularity);
    if mapped.bits == needed && in_step { Ok(mapped.bits) } else { Err(AbortCode::NOT_MAPPABLE) }
}
