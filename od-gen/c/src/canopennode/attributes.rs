//! Attributes of an entry, as the stack's SDO server and PDOs ask for them.

use od_spec::model::{Direction, Entry, EntryId, Family, Object};

use super::cell::Cell;
use super::srdos::Srdos;

/// The bits, in the order of the stack's names.
const READ: u8 = 0x01;
const WRITE: u8 = 0x02;
const TPDO: u8 = 0x04;
const RPDO: u8 = 0x08;
const TSRDO: u8 = 0x10;
const RSRDO: u8 = 0x20;
const MULTI_BYTE: u8 = 0x40;
const STRING: u8 = 0x80;

/// Attributes of an entry.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Attributes(u8);

impl Attributes {
    /// Of an entry. A locked entry can be written: the lock is kept where values are checked.
    pub(super) fn of(object: &Object, entry: &Entry, srdos: &Srdos) -> Self {
        let noted = object.editor.as_ref().and_then(|notes| notes.srdos.get(&entry.sub));
        let id = EntryId { index: object.index, sub: entry.sub };
        let in_srdos =
            |direction| noted.is_some_and(|mapping| mapping.allows(direction)) || srdos.carry(id, direction);
        let mut bits = 0;
        let mut set = |bit: u8, is_set: bool| bits |= if is_set { bit } else { 0 };
        set(READ, entry.access.is_readable());
        set(WRITE, entry.access.is_writable());
        set(TPDO, entry.pdo.allows(Direction::Transmit));
        set(RPDO, entry.pdo.allows(Direction::Receive));
        set(TSRDO, in_srdos(Direction::Transmit));
        set(RSRDO, in_srdos(Direction::Receive));
        set(MULTI_BYTE, is_multi_byte(entry));
        // A text to the stack ends at its first byte of 0, which a UNICODE_STRING has in nearly every character.
        set(STRING, entry.data_type.family() == Family::VisibleString);
        Self(bits)
    }

    /// The stack's expression: `ODA_SDO_RW | ODA_TPDO | ODA_MB`.
    pub(super) fn expression(self) -> String {
        let has = |bits: u8| self.0 & bits == bits;
        let access = match (has(READ), has(WRITE)) {
            (true, true) => Some("ODA_SDO_RW"),
            (true, false) => Some("ODA_SDO_R"),
            (false, true) => Some("ODA_SDO_W"),
            (false, false) => None,
        };
        let mapping = match (has(TPDO), has(RPDO)) {
            (true, true) => Some("ODA_TRPDO"),
            (true, false) => Some("ODA_TPDO"),
            (false, true) => Some("ODA_RPDO"),
            (false, false) => None,
        };
        let safety = match (has(TSRDO), has(RSRDO)) {
            (true, true) => Some("ODA_TRSRDO"),
            (true, false) => Some("ODA_TSRDO"),
            (false, true) => Some("ODA_RSRDO"),
            (false, false) => None,
        };
        let multi_byte = has(MULTI_BYTE).then_some("ODA_MB");
        let string = has(STRING).then_some("ODA_STR");
        let names: Vec<&str> = [access, mapping, safety, multi_byte, string].into_iter().flatten().collect();
        if names.is_empty() { "0U".to_owned() } else { names.join(" | ") }
    }
}

/// Whether the value is a number whose bytes a processor may have in another order than the bus.
fn is_multi_byte(entry: &Entry) -> bool {
    match Cell::of(entry) {
        Some(Cell::Integer(integer)) => integer.bits > 8,
        Some(Cell::Real32 | Cell::Real64) => true,
        Some(Cell::Boolean | Cell::Bytes(_) | Cell::Characters(_) | Cell::WideCharacters(_)) | None => false,
    }
}
