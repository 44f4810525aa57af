//! Entries.

use super::shape::{Key, KeyKind, Keys, NameOf, PHRASES, Shape};
use super::table::{joined, key_list, keys};
use crate::model::{Access, Category, PdoMapping, Storage};

/// The keys of an entry, one line each:
///
/// `"key": shape => field: type, fact, reach, "meaning", "example", sub0 "meaning at sub-index 0";`
///
/// - The field is one of `EntryDecl`; its type says how the value is read (`FromNode` in `decode`).
/// - The fact is what the key states, a variant of `Fact`.
/// - The reach is that of a key at an object with elements or members, a variant of `Reach`.
/// - The example may be left out. With `sub0`, the key may also be at `sub0:`, with a meaning of its own.
///
/// The keys under `values` may be at elements, members, objects and arrays; those under `names` not at arrays.
macro_rules! entry_keys {
    ($then:ident) => {
        $then! {
            names {
                "name" inherited: Shape::Text => name: String, Name, Object, "name, as the manual spells it", "actual position", sub0 "name; `number of elements` unless given";
                "identifier": Shape::Text => identifier: String, Identifier, Object, "name in references and in generated code, where `name` does not fit or is not unique", "speed_limit_2", sub0 "name in references and in generated code";
            }
            values {
                "type" inherited: Shape::Type => type_name: String, Type, Entries, "data type, or a named type", "unsigned16";
                "unit": Shape::NameOf(NameOf::Unit) => unit: String, Unit, Entries, "physical unit, by name", "decicelsius";
                "access" inherited: Shape::Access => access: AccessRight, Access, Entries, "`ro`, `wo`, `rw`, `rwr`, `rww` or `const`; `rw locked`: writable only when unlocked for service", "rw locked", sub0 "access; `ro` unless given";
                "pdo": Shape::Choice(PdoMapping::WORDS) => pdo: PdoMapping, Mapping, Entries, "PDOs that it may be mapped into; none unless given", sub0 "PDOs that it may be mapped into; none unless given";
                "default": Shape::Default => default: DefaultDecl, Default, Value, "value after a factory reset; under `array:` also a list with one value for each element; a map by device where they differ", "50.0 °C", sub0 "value; the highest sub-index unless given";
                "min": Shape::Value => min: String, LowLimit, Value, "smallest allowed value", "-40.0 °C", sub0 "smallest allowed value";
                "max": Shape::Value => max: String, HighLimit, Value, "largest allowed value", "85.0 °C", sub0 "largest allowed value";
                "special": Shape::MapOf(KeyKind::Integer, &SPECIAL_VALUE) => special: Vec<SpecialDecl>, Special, Value, "raw values with a meaning of their own, also outside the limits", "{-32768: short circuit, 32767: wire break}";
                "stored": Shape::Choice(Storage::WORDS) => stored: Storage, Storage, Entries, "which \"store parameters\" command saves it; `remanent`: the device keeps it by itself; `no` unless given", sub0 "which command saves it; `no` unless given";
                "category": Shape::Choice(Category::WORDS) => category: Category, Category, Object, "whether a standard requires it";
                "since": Shape::Text => since: String, Since, Object, "first issue of the manual that describes it", "\"1.04\"";
                "writable-when": Shape::Condition => writable_when: ConditionDecl, WriteCondition, Entries, "condition under which a write is accepted", "bit(0x6041, 2) == 0";
                "bit-errors": Shape::MapOf(KeyKind::Bits, &Shape::OneOrMore(&Shape::ErrorCode)) => bit_errors: Vec<BitErrorDecl>, BitErrors, Value, "error codes of the type's bits, where several entries share the type", "{0: 0x4420, 4: [0x4410, 0x4411]}";
                "capacity": Shape::Integer(1, 65_535) => capacity: i128, Capacity, Value, "number of bytes that the device can hold of a string; in a UNICODE_STRING, each character takes two or four", "16";
                "eds": Shape::Map(&ENTRY_EDS_KEYS) => eds: EdsDecl, Eds, Entries, "what the EDS shows, where the policy of the device does not fit", "{flags: [no-write]}", sub0 "what the EDS shows";
                "warning": Shape::Words => warning: Text, Warning, Object, "danger for persons, machine or data that comes from it", "The drive moves at once.";
                "about": Shape::Words => about: Text, About, Object, "meaning", sub0 "meaning";
                "gap": Shape::Words => gap: Text, Gap, Object, "what the printed manual leaves open about it", "Whether 0 switches it off is not stated.";
                "search": PHRASES => search: Phrases, Search, Object, "words and phrases by which readers look for it, by language, where its name and texts have others", "{en: [pitch angle, blade angle], de: Blattwinkel}";
            }
        }
    };
}
pub(crate) use entry_keys;

macro_rules! places {
    ($($group:ident {
        $($key:literal $($need:ident)?: $shape:expr => $field:ident: $type:ty, $fact:ident, $reach:ident, $about:literal
            $(, $example:literal)? $(, sub0 $sub0:literal)?;)+
    })+) => {
        $(places! { @group $group key_list! { $($key $($need)?: $shape, $about $(, $example)?;)+ } })+

        /// Keys of entries that are also allowed at `sub0:`.
        pub(super) const SUB0_KEYS: &[Key] = key_list! { $($($($key: $shape, $sub0;)?)+)+ };
    };
    (@group names $list:expr) => {
        /// Keys by which an entry or an object is called.
        pub(super) const NAME_KEYS: &[Key] = $list;
    };
    (@group values $list:expr) => {
        /// Keys of entries that are allowed at objects and arrays as well.
        pub(super) const VALUE_KEYS: &[Key] = $list;
    };
}
entry_keys!(places);

/// An element or member.
pub static ENTRY: Keys = Keys {
    name: "an entry",
    keys: &joined::<{ NAME_KEYS.len() + VALUE_KEYS.len() }>(&[NAME_KEYS, VALUE_KEYS]),
    choices: &[],
};

const SPECIAL_VALUE: Shape = Shape::ShortOr(&Shape::Text, &SPECIAL);

keys! {
    /// A special value.
    SPECIAL = "a special value" {
        "name" required: Shape::Text, "its meaning, in a few words";
        "about": Shape::Words, "more about it";
    }
}

keys! {
    /// `eds:` of an entry.
    ENTRY_EDS_KEYS = "an entry's EDS policy" {
        "default": Shape::Choice(&["written", "withheld"]), "whether `DefaultValue` is written";
        "access": Shape::Choice(Access::WORDS), "access type in the EDS, where it differs";
        "flags": Shape::List(&Shape::Choice(&["no-write", "no-scan"])), "`no-write`: tools must not write it on download; `no-scan`: tools must not read it on scan", "[no-write, no-scan]";
    }
}

keys! {
    /// The value of an entry of 1016h.
    CONSUMER = "a heartbeat consumer" {
        "node" required: Shape::Integer(1, 127), "node-ID of the device that is watched", "5";
        "time" required: Shape::Time, "time in ms without a heartbeat after which the device is missing, at least 1 ms", "3000 ms";
    }
}
