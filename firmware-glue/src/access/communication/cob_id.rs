//! COB-IDs in communication objects (CiA 301 9.6.3).

use crate::abort::AbortCode;
use crate::bus::frame::CanId;

/// Bit 31 of COB-ID entries: the message does not exist.
pub(crate) const NOT_VALID: u32 = 1 << 31;
/// Bit 30 of a TPDO's COB-ID: no remote frames; reserved in an RPDO's.
pub(crate) const NO_REMOTE_FRAMES: u32 = 1 << 30;
/// Bit 30 of 1005h and 1012h: the device sends the message itself.
pub(crate) const PRODUCER: u32 = 1 << 30;
/// Bit 29 chooses identifiers of 29 bits, which the dictionary does not support; bits 11 to 28 belong to such.
const EXTENDED: u32 = 0x3FFF_F800;
const CAN_ID: u32 = 0x7FF;
/// Frame and identifier: what cannot change while the message exists.
const FRAME: u32 = 0x3FFF_FFFF;

/// A COB-ID of a message that bit 31 switches off: while it exists, its frame does not change.
pub(crate) fn check_cob_id(old: u32, new: u32) -> Result<(), AbortCode> {
    if new & NOT_VALID != 0 {
        return if new & EXTENDED == 0 { Ok(()) } else { Err(AbortCode::INVALID_VALUE) };
    }
    if old & NOT_VALID == 0 && (old ^ new) & FRAME != 0 {
        return Err(AbortCode::INVALID_VALUE);
    }
    // What does not change may stay: the SDO channel, for one, has a restricted identifier by right.
    if old & NOT_VALID == 0 { Ok(()) } else { check_usable(new) }
}

/// A COB-ID of a channel to the SDO server of another node: the first channel of that node has identifiers that are kept for it, for
/// requests to it (sub-index 1) and answers of it (2).
pub(crate) fn check_client_cob_id(sub: u8, old: u32, new: u32) -> Result<(), AbortCode> {
    let is_first_channel =
        new & EXTENDED == 0 && matches!((sub, new & CAN_ID), (1, 0x601..=0x67F) | (2, 0x581..=0x5FF));
    if is_first_channel && old & NOT_VALID != 0 { Ok(()) } else { check_cob_id(old, new) }
}

/// A COB-ID of a message that the device sends while bit 30 is set: its frame does not change as long as it is.
pub(crate) fn check_produced(old: u32, new: u32) -> Result<(), AbortCode> {
    if old & PRODUCER != 0 && new & PRODUCER != 0 && (old ^ new) & FRAME != 0 {
        return Err(AbortCode::INVALID_VALUE);
    }
    check_usable(new)
}

/// An identifier of 11 bits that CiA 301 does not keep for another service (table 35, and 002h to 07Fh since 4.2).
fn check_usable(cob_id: u32) -> Result<(), AbortCode> {
    let restricted = matches!(
        cob_id & CAN_ID,
        0x000..=0x07F | 0x101..=0x180 | 0x581..=0x5FF | 0x601..=0x67F | 0x6E0 | 0x701..=0x77F | 0x780..=0x7FF
    );
    if cob_id & EXTENDED != 0 || restricted { Err(AbortCode::INVALID_VALUE) } else { Ok(()) }
}

/// The identifier in a COB-ID, whatever else it says; `None` of one with 29 bits, which the services do not use.
pub(crate) fn can_id(cob_id: u32) -> Option<CanId> {
    if cob_id & EXTENDED != 0 {
        return None;
    }
    CanId::new(u16::try_from(cob_id & CAN_ID).ok()?)
}

/// The identifier of a message that bit 31 does not switch off.
pub(crate) fn valid_id(cob_id: u32) -> Option<CanId> {
    if cob_id & NOT_VALID == 0 { can_id(cob_id) } else { None }
}
