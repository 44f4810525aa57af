//! The keys of the language: one table decodes specifications, suggests corrections, and prints the
//! JSON Schema and the language reference.

use crate::model::{Access, Category, Direction, ErratumKind, Outside, PdoMapping, Rounding, Storage};

/// The keys of one kind of map.
#[derive(Debug)]
pub struct Keys {
    /// What such a map describes, with its article: `an object`.
    pub name: &'static str,
    /// The keys, in the order the reference shows them.
    pub keys: &'static [Key],
}

/// One key.
#[derive(Debug)]
pub struct Key {
    /// The key as written.
    pub name: &'static str,
    /// What its value looks like.
    pub shape: Shape,
    /// Whether it must be there.
    pub required: bool,
    /// What it means.
    pub about: &'static str,
    /// A value as it may be written, where the shape alone does not show it.
    pub example: Option<&'static str>,
}

/// What a value looks like.
#[derive(Debug, Clone, Copy)]
pub enum Shape {
    /// Any text.
    Text,
    /// A text, or a map from language code to text.
    Words,
    /// One of these words.
    Choice(&'static [&'static str]),
    /// `yes` or `no`.
    YesNo,
    /// An integer in a range.
    Integer(i128, i128),
    /// `2009-05-27`.
    Date,
    /// `2009-05-27 09:00`.
    DateTime,
    /// An index: `0x6040`.
    Index,
    /// An entry: `0x30FA.3`, or by name.
    Entry,
    /// An access type, `locked` may follow.
    Access,
    /// A data type or a named type.
    Type,
    /// A value of an entry: number, physical value, enum name, text or `$NODEID` formula.
    Value,
    /// A fraction: `1/10`.
    Ratio,
    /// A fraction and a symbol: `1/1000 V`.
    Base,
    /// A condition between entries.
    Condition,
    /// A term of a condition: `0x6092.1 / 0x6092.2`.
    Formula,
    /// Bits, most significant first: `xxxx xxxx x01x 0001`.
    Pattern,
    /// A map with fixed keys.
    Map(&'static Keys),
    /// A map whose keys are data.
    MapOf(KeyKind, &'static Shape),
    /// A list.
    List(&'static Shape),
    /// One value, or a list of them.
    OneOrMore(&'static Shape),
    /// A short form (a scalar) or a map.
    ShortOr(&'static Shape, &'static Keys),
}

/// What the keys of a map are that carries data in its keys.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum KeyKind {
    /// A name.
    Name,
    /// A short key of lower-case letters, digits and `-`, which also names the device's files.
    DeviceKey,
    /// A language code.
    Language,
    /// An index, or a run of them: `0x3511..0x3519`.
    Indices,
    /// A sub-index from 1 to 254.
    SubIndex,
    /// A bit, or bits `0..3`.
    Bits,
    /// An integer.
    Integer,
    /// A 16-bit error code, or a range `0x3281..0x3288`.
    ErrorCodes,
    /// A number from 1 to 512.
    PdoNumber,
    /// A number from 0 to 255.
    Number,
}

macro_rules! keys {
    ($(#[$meta:meta])* $name:ident = $title:literal {
        $($key:literal $($required:ident)?: $shape:expr, $about:literal $(, $example:literal)?;)+
    }) => {
        $(#[$meta])*
        pub static $name: Keys = Keys {
            name: $title,
            keys: &[$(Key {
                name: $key,
                shape: $shape,
                required: keys!(@required $($required)?),
                about: $about,
                example: keys!(@example $($example)?),
            },)+],
        };
    };
    (@required required) => { true };
    (@required) => { false };
    (@example $example:literal) => { Some($example) };
    (@example) => { None };
}

/// A key of entries, which objects and arrays share.
const fn entry_key(
    name: &'static str,
    shape: Shape,
    about: &'static str,
    example: Option<&'static str>,
) -> Key {
    Key { name, shape, required: false, about, example }
}

const U8: Shape = Shape::Integer(0, 0xFF);
const U16: Shape = Shape::Integer(0, 0xFFFF);
const U32: Shape = Shape::Integer(0, 0xFFFF_FFFF);
const NAMES: Shape = Shape::OneOrMore(&Shape::Text);
const INDICES: Shape = Shape::List(&Shape::Index);

keys! {
    /// Top level of a specification.
    SPEC = "a specification" {
        "od-spec" required: Shape::Integer(1, 1), "version of the language; `1`";
        "title" required: Shape::Text, "title of the product or product family";
        "profile": Shape::Text, "makes the file a library; the name by which `from:` refers to it", "cia4xx";
        "languages": Shape::List(&Shape::Text), "language codes of the descriptions; the first is the default (`en`)", "[en, de]";
        "source": Shape::Map(&SOURCE), "the printed manual that the specification stands for";
        "revision": Shape::Map(&REVISION), "the issue of the manual that the specification holds";
        "history": Shape::List(&Shape::Map(&REVISION)), "issues of the manual, oldest first";
        "vendor": Shape::Map(&VENDOR), "maker of the devices; an EDS says `unknown` without";
        "uses": Shape::List(&Shape::Text), "libraries of standard objects: `cia301`, `cia402`, or the path of a library file", "[cia301, cia402]";
        "glossary": Shape::MapOf(KeyKind::Name, &Shape::Words), "abbreviations and what they mean", "{PDO: process data object}";
        "devices": Shape::MapOf(KeyKind::DeviceKey, &Shape::Map(&DEVICE)), "the devices, by a short key; a file without `profile:` has at least one";
        "units": Shape::MapOf(KeyKind::Name, &Shape::Map(&UNIT)), "physical units, by name";
        "types": Shape::MapOf(KeyKind::Name, &Shape::Map(&TYPE)), "enums and bit fields, by name";
        "axes": Shape::Map(&AXES), "objects of the library that repeat for every axis; only libraries have them", "{first: 0x6000, last: 0x67FF, count: 8}";
        "features": Shape::MapOf(KeyKind::Name, &Shape::Map(&FEATURE)), "groups of objects that the library offers to devices; only libraries have them";
        "objects": Shape::MapOf(KeyKind::Indices, &Shape::Map(&OBJECT)), "the objects, by index or indices";
        "pdos": Shape::MapOf(KeyKind::Name, &Shape::Map(&PDOS)), "the PDOs of each device, by the device's key";
        "errors": Shape::MapOf(KeyKind::ErrorCodes, &Shape::Map(&ERROR)), "error codes (603Fh, 1003h)";
        "state-machines": Shape::MapOf(KeyKind::Name, &Shape::Map(&MACHINE)), "state machines with their commands, by name";
        "constraints": Shape::MapOf(KeyKind::Name, &Shape::Map(&CONSTRAINT)), "conditions between entries, by name";
        "errata": Shape::List(&Shape::Map(&ERRATUM)), "where the printed manual says something else, or nothing";
        "document": Shape::List(&Shape::Map(&SECTION)), "the manual's sections and tables, in order";
    }
}

keys! {
    /// `axes:`.
    AXES = "axes" {
        "first" required: Shape::Index, "first index of axis 1", "0x6000";
        "last" required: Shape::Index, "last index of axis 1; axis 2 begins behind it", "0x67FF";
        "count" required: Shape::Integer(2, 16), "number of axes";
    }
}

keys! {
    /// `source:`.
    SOURCE = "a source" {
        "title" required: Shape::Text, "title of the manual";
        "edition": Shape::Text, "edition, as printed", "\"issue 1.09, English\"";
        "about": Shape::Words, "more about it";
    }
}

keys! {
    /// An issue of the manual.
    REVISION = "a revision" {
        "number" required: Shape::Text, "number of the issue, as printed", "\"1.09\"";
        "date" required: Shape::Date, "its date", "2009-05-27";
        "about": Shape::Words, "what changed";
    }
}

keys! {
    /// `vendor:`.
    VENDOR = "a vendor" {
        "name" required: Shape::Text, "company name";
        "number": U32, "vendor-ID assigned by CiA (1018h.1); 0 when it is not known", "0x0000_0123";
    }
}

keys! {
    /// A device.
    DEVICE = "a device" {
        "name" required: Shape::Text, "full name";
        "about": Shape::Words, "what the device does";
        "product-name": Shape::Text, "product name in the EDS; the device's name unless given";
        "product": U32, "product code (1018h.2)";
        "product-revision": U32, "product revision (1018h.3): upper half major, lower half minor", "0x0001_0002";
        "order-code": Shape::Text, "order code; the product name unless given";
        "bit-rates": Shape::List(&Shape::Integer(10, 1000)), "supported bit rates in kbit/s: 10, 20, 50, 125, 250, 500, 800, 1000", "[125, 250, 500, 1000]";
        "device-type": U32, "device type (1000h): low word profile number, high word additional information", "0x0002_0192";
        "granularity": Shape::Integer(0, 64), "smallest step of PDO mapping in bits; 8 unless given, 0 when no mapping can be changed";
        "boot-up-master": Shape::YesNo, "simple boot-up master; no unless given";
        "boot-up-slave": Shape::YesNo, "simple boot-up slave; yes unless given";
        "group-messaging": Shape::YesNo, "multiplexed PDOs; no unless given";
        "lss": Shape::YesNo, "LSS slave; no unless given";
        "dummies": Shape::List(&Shape::Text), "data types that may stand in an RPDO as placeholders", "[unsigned8, unsigned16]";
        "features": Shape::List(&Shape::Text), "features of the used libraries that the device has", "[heartbeat producer, emergency]";
        "eds": Shape::Map(&FILE), "what the EDS says about itself";
        "eds-defaults": Shape::Choice(&["safe", "own", "all"]), "`safe` withholds the defaults of writable entries that are locked or stored (other than as communication parameters) from the EDS; `own` withholds also those that only a library states; `all` writes every default; safe unless given";
    }
}

keys! {
    /// `eds:` of a device.
    FILE = "an EDS header" {
        "description": Shape::Text, "description of the file; the device's name unless given";
        "created" required: Shape::DateTime, "when the file was first made", "2009-05-27 09:00";
        "created-by": Shape::Text, "who made it; the vendor unless given";
        "modified": Shape::DateTime, "when it was last changed; `created` unless given";
        "modified-by": Shape::Text, "who changed it; `created-by` unless given";
        "file-version": U8, "version of the file; 1 unless given";
        "file-revision": U8, "revision of the file; 0 unless given";
    }
}

keys! {
    /// A unit.
    UNIT = "a unit" {
        "symbol" required: Shape::Text, "symbol, such as `°C`", "mV";
        "scale": Shape::Ratio, "one raw step in `symbol`; 1 unless given", "1/10";
        "base": Shape::Base, "one `symbol` in a more basic one, such as `1/1000 V`; units of one base convert into each other", "1/1000 V";
        "formula": Shape::Formula, "what other entries make of one raw step, for the documentation", "0x6092.1 / 0x6092.2 / 65536";
        "about": Shape::Words, "meaning";
    }
}

keys! {
    /// A named type.
    TYPE = "a type" {
        "base" required: Shape::Text, "data type on the bus", "unsigned8";
        "about": Shape::Words, "meaning";
        "values": Shape::MapOf(KeyKind::Integer, &Shape::ShortOr(&Shape::Text, &ENUM_VALUE)), "makes it an enum: names by value", "{0: off, 1: on}";
        "bits": Shape::MapOf(KeyKind::Bits, &Shape::ShortOr(&Shape::Text, &BIT)), "makes it a bit field: names by bit or bits; the short forms `reserved` and `unused` mark bits without meaning", "{0: ready, 1..3: mode, 4..7: reserved}";
        "rest": Shape::Choice(&["reserved", "unused"]), "what bits are that are not listed";
    }
}

keys! {
    /// A value of an enum.
    ENUM_VALUE = "an enum value" {
        "name" required: Shape::Text, "name";
        "supported": Shape::YesNo, "whether the device takes or sends it; yes unless given";
        "about": Shape::Words, "meaning";
    }
}

keys! {
    /// A bit or a run of bits.
    BIT = "a bit" {
        "name": Shape::Text, "name; needed unless the bit is `reserved`, `unused` or has `modes`";
        "about": Shape::Words, "meaning";
        "error": Shape::OneOrMore(&U16), "error codes that come with the bit", "0x2250";
        "clamp": Shape::Text, "terminal at which the signal is found", "X13.10";
        "active": Shape::Integer(0, 1), "level that means \"active\"; 1 unless given";
        "edge": Shape::Choice(&["rising", "falling", "both"]), "change that triggers the function";
        "priority": Shape::Text, "priority of the error, as the manual classes it", "A";
        "values": Shape::MapOf(KeyKind::Integer, &Shape::ShortOr(&Shape::Text, &ENUM_VALUE)), "named values of a run of bits";
        "modes": Shape::MapOf(KeyKind::Name, &Shape::ShortOr(&Shape::Text, &MODE_BIT)), "meanings in single modes of operation", "{homing mode: homing attained}";
        "reserved": Shape::YesNo, "reserved: written as 0, ignored when read";
        "unused": Shape::YesNo, "free, without function";
    }
}

keys! {
    /// A bit's meaning in one mode.
    MODE_BIT = "a mode-specific bit" {
        "name" required: Shape::Text, "name";
        "about": Shape::Words, "meaning";
    }
}

keys! {
    /// A feature of a library.
    FEATURE = "a feature" {
        "about": Shape::Words, "what the device can do with it";
        "implied": Shape::YesNo, "every device has it; no unless given";
        "objects" required: INDICES, "objects it brings", "[0x1003]";
        "needs": Shape::List(&Shape::Text), "features it cannot be without", "[emergency]";
    }
}

const ENTRY_TYPE: Key = entry_key("type", Shape::Type, "data type, or a named type", Some("unsigned16"));
const ENTRY_ACCESS: Key = entry_key(
    "access",
    Shape::Access,
    "`ro`, `wo`, `rw`, `rwr`, `rww` or `const`; `rw locked`: writable only when unlocked for service",
    Some("rw locked"),
);
const ENTRY_PDO: Key =
    entry_key("pdo", Shape::Choice(PdoMapping::WORDS), "PDOs it may be mapped into; none unless given", None);
const ENTRY_DEFAULT: Key = entry_key("default", Shape::Value, "value after factory reset", Some("50.0 °C"));
const ENTRY_MIN: Key = entry_key("min", Shape::Value, "smallest allowed value", Some("-40.0 °C"));
const ENTRY_MAX: Key = entry_key("max", Shape::Value, "largest allowed value", Some("85.0 °C"));
const ENTRY_UNIT: Key = entry_key("unit", Shape::Text, "physical unit, by name", Some("decicelsius"));
const SPECIAL_VALUE: Shape = Shape::ShortOr(&Shape::Text, &SPECIAL);
const ENTRY_SPECIAL: Key = entry_key(
    "special",
    Shape::MapOf(KeyKind::Integer, &SPECIAL_VALUE),
    "raw values with a meaning of their own, allowed even outside the limits",
    Some("{-32768: short circuit, 32767: wire break}"),
);
const ENTRY_STORED: Key = entry_key(
    "stored",
    Shape::Choice(Storage::WORDS),
    "which \"store parameters\" command saves it; `remanent`: the device keeps it by itself; no unless given",
    None,
);
const ENTRY_CATEGORY: Key =
    entry_key("category", Shape::Choice(Category::WORDS), "whether a standard demands it", None);
const ENTRY_SINCE: Key =
    entry_key("since", Shape::Text, "issue of the manual that brought it", Some("\"1.04\""));
const ENTRY_ABOUT: Key = entry_key("about", Shape::Words, "meaning", None);
const ENTRY_WHEN: Key = entry_key(
    "writable-when",
    Shape::Condition,
    "condition under which a write is accepted",
    Some("bit(0x6041, 2) == 0"),
);
const ENTRY_BIT_ERRORS: Key = entry_key(
    "bit-errors",
    Shape::MapOf(KeyKind::Bits, &Shape::OneOrMore(&U16)),
    "error codes of the type's bits, where several entries share the type",
    Some("{0: 0x4420, 4: [0x4410, 0x4411]}"),
);
const ENTRY_EDS: Key = entry_key(
    "eds",
    Shape::Map(&ENTRY_EDS_KEYS),
    "what the EDS shows, where the device's policy does not fit",
    Some("{flags: [no-write]}"),
);
const ENTRY_CAPACITY: Key = entry_key(
    "capacity",
    Shape::Integer(1, 65_535),
    "most bytes of a string that the device can hold; in a UNICODE_STRING, each character takes two or four",
    Some("16"),
);
const ENTRY_IDENTIFIER: Key = entry_key(
    "identifier",
    Shape::Text,
    "name in generated code, where the one made from `name` will not do",
    Some("speed_limit_2"),
);
const ENTRY_NAME: Key =
    entry_key("name", Shape::Text, "name, as the manual spells it", Some("actual position"));

/// An element or member.
pub static ENTRY: Keys = Keys {
    name: "an entry",
    keys: &[
        ENTRY_NAME,
        ENTRY_IDENTIFIER,
        ENTRY_TYPE,
        ENTRY_UNIT,
        ENTRY_ACCESS,
        ENTRY_PDO,
        ENTRY_DEFAULT,
        ENTRY_MIN,
        ENTRY_MAX,
        ENTRY_SPECIAL,
        ENTRY_STORED,
        ENTRY_CATEGORY,
        ENTRY_SINCE,
        ENTRY_WHEN,
        ENTRY_BIT_ERRORS,
        ENTRY_CAPACITY,
        ENTRY_EDS,
        ENTRY_ABOUT,
    ],
};

/// An object.
pub static OBJECT: Keys = Keys {
    name: "an object",
    keys: &[
        ENTRY_NAME,
        ENTRY_IDENTIFIER,
        Key {
            name: "on",
            shape: NAMES,
            required: false,
            about: "devices that have the object; all unless given",
            example: Some("[pmm, pmc]"),
        },
        Key {
            name: "from",
            shape: Shape::Text,
            required: false,
            about: "library that defines the object; the other keys say what differs",
            example: Some("cia301"),
        },
        Key {
            name: "alias",
            shape: Shape::Entry,
            required: false,
            about: "makes it a view of another entry, in a narrower type or another unit, without storage of its own",
            example: Some("0x6064"),
        },
        Key {
            name: "outside",
            shape: Shape::Choice(Outside::WORDS),
            required: false,
            about: "what an alias gives outside its range; saturate unless given",
            example: None,
        },
        Key {
            name: "rounding",
            shape: Shape::Choice(Rounding::WORDS),
            required: false,
            about: "how a rescaling alias rounds; down unless given",
            example: None,
        },
        Key {
            name: "array",
            shape: Shape::Map(&ARRAY),
            required: false,
            about: "makes it an ARRAY",
            example: Some("{count: 8, name: \"block {n}\", type: integer16, access: ro}"),
        },
        Key {
            name: "record",
            shape: Shape::MapOf(KeyKind::SubIndex, &Shape::Map(&ENTRY)),
            required: false,
            about: "makes it a RECORD: members by sub-index",
            example: Some("{1: {name: type, type: unsigned8, access: ro}}"),
        },
        Key {
            name: "sub0",
            shape: Shape::Map(&SUB0),
            required: false,
            about: "name and access of sub-index 0, where they are not the usual ones",
            example: Some("{access: rw}"),
        },
        Key {
            name: "omit",
            shape: Shape::List(&Shape::Integer(1, 254)),
            required: false,
            about: "with `from:`: sub-indices that the device does not have",
            example: Some("[4]"),
        },
        ENTRY_TYPE,
        ENTRY_UNIT,
        ENTRY_ACCESS,
        ENTRY_PDO,
        ENTRY_DEFAULT,
        ENTRY_MIN,
        ENTRY_MAX,
        ENTRY_SPECIAL,
        ENTRY_STORED,
        ENTRY_CATEGORY,
        ENTRY_SINCE,
        ENTRY_WHEN,
        ENTRY_BIT_ERRORS,
        ENTRY_CAPACITY,
        ENTRY_EDS,
        ENTRY_ABOUT,
    ],
};

/// `array:`.
pub static ARRAY: Keys = Keys {
    name: "an array",
    keys: &[
        Key {
            name: "count",
            shape: Shape::Integer(1, 254),
            required: false,
            about: "number of elements; the highest of `elements` unless given",
            example: None,
        },
        Key {
            name: "name",
            shape: Shape::Text,
            required: false,
            about: "name of the elements; `{n}` stands for the sub-index",
            example: Some("\"block {n}\""),
        },
        Key {
            name: "elements",
            shape: Shape::MapOf(KeyKind::SubIndex, &Shape::Map(&ENTRY)),
            required: false,
            about: "what single elements have of their own",
            example: Some("{1: {name: nominal value, default: 560 V}}"),
        },
        ENTRY_TYPE,
        ENTRY_UNIT,
        ENTRY_ACCESS,
        ENTRY_PDO,
        ENTRY_DEFAULT,
        ENTRY_MIN,
        ENTRY_MAX,
        ENTRY_SPECIAL,
        ENTRY_STORED,
        ENTRY_CATEGORY,
        ENTRY_SINCE,
        ENTRY_WHEN,
        ENTRY_BIT_ERRORS,
        ENTRY_CAPACITY,
        ENTRY_EDS,
        ENTRY_ABOUT,
    ],
};

keys! {
    /// `sub0:`.
    SUB0 = "sub-index 0" {
        "name": Shape::Text, "name; `number of elements` unless given";
        "access": Shape::Access, "access; `ro` unless given";
        "default": Shape::Value, "value; the highest sub-index unless given";
        "min": Shape::Value, "smallest allowed value";
        "max": Shape::Value, "largest allowed value";
        "eds": Shape::Map(&ENTRY_EDS_KEYS), "what the EDS shows";
        "about": Shape::Words, "meaning";
    }
}

keys! {
    /// A special value.
    SPECIAL = "a special value" {
        "name" required: Shape::Text, "what it means, in a few words";
        "about": Shape::Words, "more about it";
    }
}

keys! {
    /// `eds:` of an entry.
    ENTRY_EDS_KEYS = "an entry's EDS policy" {
        "default": Shape::Choice(&["written", "withheld"]), "whether `DefaultValue` is written";
        "access": Shape::Choice(Access::WORDS), "access type written, where it differs";
        "flags": Shape::List(&Shape::Choice(&["no-write", "no-scan"])), "`no-write`: tools must not write it on download; `no-scan`: tools must not read it on scan", "[no-write, no-scan]";
    }
}

keys! {
    /// `pdos:` of a device.
    PDOS = "a device's PDOs" {
        "receive": Shape::MapOf(KeyKind::PdoNumber, &Shape::Map(&PDO)), "RPDOs by number", "{1: {map: [controlword]}}";
        "transmit": Shape::MapOf(KeyKind::PdoNumber, &Shape::Map(&PDO)), "TPDOs by number";
    }
}

keys! {
    /// A PDO.
    PDO = "a PDO" {
        "cob-id": Shape::Value, "COB-ID without flag bits; the predefined connection set's unless given, which ends at PDO 4", "$NODEID + 0x200";
        "valid": Shape::YesNo, "whether the PDO exists after start-up; yes unless given";
        "no-rtr": Shape::YesNo, "TPDO: remote frames are not answered (bit 30); no unless given";
        "transmission": U8, "transmission type; 255 unless given";
        "inhibit-time": U16, "inhibit time in multiples of 100 µs; the device has no such entry unless given";
        "event-timer": U16, "event timer in ms; the device has no such entry unless given";
        "sync-start": Shape::Integer(0, 240), "SYNC start value; the device has no such entry unless given";
        "mapping": Shape::Choice(&["variable", "fixed"]), "whether the mapping can be changed over the bus; variable unless given";
        "capacity": Shape::Integer(1, 64), "mapping entries the device offers; 64 / granularity unless given (granularity 0 counts as 1); of no effect where the mapping is fixed";
        "map" required: Shape::List(&Shape::Entry), "mapped entries in order, by index or name, or data types as placeholders", "[statusword, 0x6064, drive data.error mask]";
        "about": Shape::Words, "meaning";
    }
}

keys! {
    /// An error code.
    ERROR = "an error code" {
        "name": Shape::Text, "name; `{n}` counts through a range from 1; needed without `from`", "\"Voltage at battery block {n} too low\"";
        "from": Shape::Text, "library that defines the code; the other keys go before it", "cia402";
        "on": NAMES, "devices that report it; all unless given";
        "priority": Shape::Text, "priority, as the manual classes it";
        "reaction": Shape::Words, "what the device does";
        "about": Shape::Words, "more about it";
    }
}

keys! {
    /// A state machine.
    MACHINE = "a state machine" {
        "from": Shape::Text, "library that defines a machine of this name; states, transitions and commands of one name or number go before the library's", "cia402";
        "on": NAMES, "devices that have it; all unless given";
        "status": Shape::Entry, "entry that shows the state; needed without `from`", "0x6041";
        "command": Shape::Entry, "entry that takes the commands; needed without `from`", "controlword";
        "states": Shape::MapOf(KeyKind::Name, &Shape::Map(&STATE)), "states by name";
        "transitions": Shape::MapOf(KeyKind::Number, &Shape::Map(&TRANSITION)), "transitions by number";
        "commands": Shape::MapOf(KeyKind::Name, &Shape::Map(&COMMAND)), "commands by name";
    }
}

keys! {
    /// A state.
    STATE = "a state" {
        "pattern": Shape::Pattern, "bits of the status entry, most significant first; `x` either", "\"xxxx xxxx x01x 0001\"";
        "about": Shape::Words, "meaning";
    }
}

keys! {
    /// A transition.
    TRANSITION = "a transition" {
        "from": Shape::OneOrMore(&Shape::Text), "states it leaves; `start` after power-on, `any` for every state", "[Switched-on, Operation enabled]";
        "to": Shape::Text, "state it enters";
        "event": Shape::Words, "what causes it";
        "action": Shape::Words, "what the device does";
    }
}

keys! {
    /// A command.
    COMMAND = "a command" {
        "pattern": Shape::Pattern, "bits of the command entry, most significant first; `x` either, `r` rising, `f` falling edge", "\"xxxx xxxx 0xxx x110\"";
        "send": U32, "a value that gives the command", "0x0006";
        "transitions": Shape::List(&U8), "transitions it causes", "[2, 6, 8]";
        "about": Shape::Words, "meaning";
    }
}

keys! {
    /// A constraint.
    CONSTRAINT = "a constraint" {
        "on": NAMES, "devices it is for; all whose entries it names unless given";
        "require" required: Shape::Condition, "the condition", "\"pmc:0x6510.4 < 0x30FA.3 <= 750\"";
        "when": Shape::Condition, "the condition counts only while this one holds", "\"0x606A == 0\"";
        "about": Shape::Words, "why";
    }
}

keys! {
    /// An erratum.
    ERRATUM = "an erratum" {
        "at": Shape::OneOrMore(&Shape::Entry), "objects or entries it is about", "[0x3004, 0x30FA.3]";
        "on": NAMES, "devices it is about; all unless given";
        "kind" required: Shape::Choice(ErratumKind::WORDS), "what kind of fact";
        "place" required: Shape::Words, "where the manual prints it", "\"4.1.1.5, detail table\"";
        "prints" required: Shape::Words, "what it prints", "3003h";
        "reads" required: Shape::Words, "what the specification says", "3004h";
        "because" required: Shape::Words, "why";
    }
}

keys! {
    /// A section of the manual.
    SECTION = "a section" {
        "section": Shape::Text, "number, as printed; parts such as the imprint have none", "\"4.1.1\"";
        "title" required: Shape::Words, "heading";
        "tables": Shape::List(&Shape::Map(&TABLE)), "tables in it, in order";
    }
}

keys! {
    /// A table of the manual.
    TABLE = "a table" {
        "number": Shape::Integer(1, 9999), "number, as printed";
        "title": Shape::Words, "caption";
        "overview": INDICES, "one row per object", "[0x3000, 0x3001]";
        "objects": INDICES, "the objects' entries in detail";
        "bits": Shape::Text, "bits of a named type";
        "values": Shape::Text, "values of a named type";
        "errors": Shape::OneOrMore(&Shape::Text), "error codes, or `all`", "[0x2210, 0x3281..0x3288]";
        "reactions": Shape::OneOrMore(&Shape::Text), "error codes with the device's reactions, or `all`";
        "states": Shape::Text, "states of a state machine";
        "transitions": Shape::Text, "transitions of a state machine";
        "commands": Shape::Text, "commands of a state machine";
        "ladder": Shape::Text, "entries of an ordering constraint with their defaults";
        "pdos": Shape::Map(&TABLE_PDOS), "default PDOs of a device", "{device: pmc, direction: receive}";
        "rows": Shape::Map(&TABLE_ROWS), "rows of text", "{columns: [Index, Use], rows: [[0000h, not used]]}";
        "glossary": Shape::YesNo, "abbreviations";
        "history": Shape::YesNo, "issues of the manual";
    }
}

keys! {
    /// `pdos:` of a table.
    TABLE_PDOS = "a PDO table" {
        "device" required: Shape::Text, "key of the device";
        "direction" required: Shape::Choice(Direction::WORDS), "direction, seen from the device";
    }
}

keys! {
    /// `rows:` of a table.
    TABLE_ROWS = "a table of text" {
        "columns" required: Shape::List(&Shape::Words), "column headings";
        "rows" required: Shape::List(&Shape::List(&Shape::Words)), "cells";
    }
}
