//! Numbers whose range the key tables have checked.

/// A number that its key table limits to 32 bits.
pub(super) fn to_u32(value: i128) -> u32 {
    u32::try_from(value).unwrap_or_default()
}

/// A number that its key table limits to 16 bits.
pub(super) fn to_u16(value: i128) -> u16 {
    u16::try_from(value).unwrap_or_default()
}

/// A number that its key table limits to 8 bits.
pub(super) fn to_u8(value: i128) -> u8 {
    u8::try_from(value).unwrap_or_default()
}
