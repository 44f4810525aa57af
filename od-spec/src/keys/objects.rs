//! Objects and their shapes.

use super::entry::{ENTRY, NAME_KEYS, SUB0_KEYS, VALUE_KEYS};
use super::shape::{Choice, DEVICES, INDICES, Key, KeyKind, Keys, NameOf, Shape};
use super::table::{joined, key_list};
use crate::model::{Outside, Rounding};

/// Keys that only objects have.
const OBJECT_KEYS: &[Key] = key_list! {
    "devices": DEVICES, "devices that have the object; all unless given", "[pmm, pmc]";
    "from": Shape::NameOf(NameOf::Library), "library that defines the object; the other keys state what differs", "cia301";
    "like": Shape::Index, "object of the same devices that this one is like; the other keys state what differs", "0x3202";
    "alias": Shape::Entry, "makes it a view of another entry, in a narrower type or another unit, without storage of its own", "0x6064";
    "outside": Shape::Choice(Outside::WORDS), "what an alias gives outside its range; `saturate` unless given";
    "rounding": Shape::Choice(Rounding::WORDS), "how a rescaling alias rounds; `down` unless given";
    "array": Shape::Map(&ARRAY), "makes it an ARRAY", "{count: 8, name: \"block {n}\", type: integer16, access: ro}";
    "record": Shape::MapOf(KeyKind::SubIndices, &Shape::Map(&ENTRY)), "makes it a RECORD: members by sub-index, or runs of them such as `1..4`", "{1: {name: type, type: unsigned8, access: ro}}";
    "sub0": Shape::Map(&SUB0), "name and access of sub-index 0, where they are not the default ones", "{access: rw}";
    "omit": Shape::List(&Shape::Integer(1, 254)), "with `from:`, `like:` or `array:`: sub-indices that the device does not have", "[4]";
    "links": INDICES, "objects that belong together with this one, by index", "[0x2001, 0x2002]";
};

/// An object.
pub static OBJECT: Keys = Keys {
    name: "an object",
    keys: &joined::<{ NAME_KEYS.len() + OBJECT_KEYS.len() + VALUE_KEYS.len() }>(&[
        NAME_KEYS,
        OBJECT_KEYS,
        VALUE_KEYS,
    ]),
    choices: &[],
};

/// Keys that only arrays have.
const ARRAY_KEYS: &[Key] = key_list! {
    "count": Shape::Integer(0, 254), "number of elements; the highest of `elements` unless given";
    "name": Shape::Text, "name of the elements; `{n}` is the sub-index", "\"block {n}\"";
    "identifier": Shape::Text, "identifier of the elements; `{n}` is the sub-index", "\"block_{n}\"";
    "elements": Shape::MapOf(KeyKind::SubIndices, &Shape::Map(&ENTRY)), "keys of single elements, or runs of them such as `1..4`", "{1: {name: nominal value, default: 560 V}}";
};

/// `array:`.
pub static ARRAY: Keys = Keys {
    name: "an array",
    keys: &joined::<{ ARRAY_KEYS.len() + VALUE_KEYS.len() }>(&[ARRAY_KEYS, VALUE_KEYS]),
    choices: &[Choice::AnyInherited(&["count", "elements"])],
};

/// `sub0:`.
pub static SUB0: Keys = Keys { name: "sub-index 0", keys: SUB0_KEYS, choices: &[] };
