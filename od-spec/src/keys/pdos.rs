//! PDOs.

use super::shape::{Key, KeyKind, Keys, Shape, U8, U16};
use super::table::keys;

keys! {
    /// `pdos:` of a device.
    PDOS = "a device's PDOs" {
        "receive": Shape::MapOf(KeyKind::PdoNumber, &Shape::Map(&PDO)), "RPDOs by number", "{1: {map: [controlword]}}";
        "transmit": Shape::MapOf(KeyKind::PdoNumber, &Shape::Map(&PDO)), "TPDOs by number";
    }
}

macro_rules! pdo_keys {
    ($then:ident $($head:tt)*) => {
        $then! { $($head)* {
            "cob-id": Shape::Value => cob_id: Option<Name>, "COB-ID without flag bits; the predefined connection set's unless given, which ends at PDO 4", "$NODEID + 0x200";
            "valid": Shape::YesNo => valid: Option<Spanned<bool>>, "whether the PDO exists after start-up; yes unless given";
            "no-rtr": Shape::YesNo => no_rtr: Option<Spanned<bool>>, "TPDO: remote frames are not answered (bit 30); no unless given";
            "transmission": U8 => transmission: Option<Spanned<i128>>, "transmission type; 255 unless given";
            "inhibit-time": U16 => inhibit_time: Option<Spanned<i128>>, "inhibit time in multiples of 100 µs; the device has no such entry unless given";
            "event-timer": U16 => event_timer: Option<Spanned<i128>>, "event timer in ms; the device has no such entry unless given";
            "sync-start": Shape::Integer(0, 240) => sync_start: Option<Spanned<i128>>, "SYNC start value; the device has no such entry unless given";
            "mapping": Shape::Choice(&["variable", "fixed"]) => mapping: Option<Spanned<MappingKind>>, "whether the mapping can be changed over the bus; variable unless given";
            "capacity": Shape::Integer(1, 64) => capacity: Option<Spanned<i128>>, "mapping entries the device offers; 64 / granularity unless given (granularity 0 counts as 1); of no effect where the mapping is fixed";
            "map" required: Shape::List(&Shape::Entry) => map: Vec<Name>, "mapped entries in order, by index or name, or data types as placeholders", "[statusword, 0x6064, drive data.error mask]";
            "about": Shape::Words => about: Words, "meaning";
        } }
    };
}
pub(crate) use pdo_keys;

pdo_keys! { keys
    /// A PDO.
    PDO = "a PDO"
}
