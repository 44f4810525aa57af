//! Units, enums and bit fields.

use super::shape::{Key, KeyKind, Keys, NameOf, PHRASES, Shape};
use super::table::keys;

macro_rules! unit_keys {
    ($then:ident $($head:tt)*) => {
        $then! { $($head)* {
            "symbol" required: Shape::Text => symbol: Option<Name>, "symbol, such as `°C`", "mV";
            "scale": Shape::Ratio => scale: Option<Spanned<Ratio>>, "one raw step in `symbol`; 1 unless given", "1/10";
            "offset": Shape::SignedRatio => offset: Option<Spanned<Offset>>, "physical value of the raw value 0, in `symbol`; 0 unless given", "-40";
            "base": Shape::Base => base: Option<Spanned<BaseDecl>>, "one `symbol` in a more basic one, such as `1/1000 V`; units of one base convert into each other", "1/1000 V";
            "formula": Shape::Formula => formula: Option<Spanned<Formula>>, "how one raw step follows from other entries, for the documentation", "0x6092.1 / 0x6092.2 / 65536";
            "about": Shape::Words => about: Words, "meaning";
        } }
    };
}
pub(crate) use unit_keys;

unit_keys! { keys
    /// A unit.
    UNIT = "a unit"
}

keys! {
    /// A named type.
    TYPE = "a type" needs [One(["values", "bits"])] {
        "base" required: Shape::NameOf(NameOf::DataType), "data type on the bus", "unsigned8";
        "about": Shape::Words, "meaning";
        "gap": Shape::Words, "what the printed manual leaves open about it";
        "values": Shape::MapOf(KeyKind::Integer, &Shape::ShortOr(&Shape::Text, &ENUM_VALUE)), "makes it an enum: names by value", "{0: off, 1: on}";
        "bits": Shape::MapOf(KeyKind::Bits, &Shape::ShortOr(&Shape::Text, &BIT)), "makes it a bit field: names by bit or bits; the short forms `reserved` and `unused` mark bits without meaning", "{0: ready, 1..3: mode, 4..7: reserved}";
        "rest": Shape::Choice(&["reserved", "unused"]), "what the bits are that are not listed";
    }
}

keys! {
    /// A value of an enum.
    ENUM_VALUE = "an enum value" {
        "name" required: Shape::Text, "name";
        "supported": Shape::YesNo, "whether the device takes or sends it; yes unless given";
        "about": Shape::Words, "meaning";
        "gap": Shape::Words, "what the printed manual leaves open about it";
        "search": PHRASES, "words and phrases by which readers look for it, by language, where its name and texts have others", "{en: home without index pulse}";
    }
}

keys! {
    /// A bit or a run of bits.
    BIT = "a bit" needs [Any(["name", "reserved", "unused", "modes"])] {
        "name": Shape::Text, "name";
        "about": Shape::Words, "meaning";
        "gap": Shape::Words, "what the printed manual leaves open about it";
        "search": PHRASES, "words and phrases by which readers look for it, by language, where its name and texts have others", "{en: clear fault, de: Störung quittieren}";
        "error": Shape::OneOrMore(&Shape::ErrorCode), "error codes that the bit shows", "0x2250";
        "mnemonic": Shape::Text, "short name, as in the register pictures and tables of commands of the manual", "rtso";
        "clamp": Shape::Text, "terminal of the signal", "X13.10";
        "active": Shape::Integer(0, 1), "level that means \"active\"; 1 unless given";
        "edge": Shape::Choice(&["rising", "falling", "both"]), "change that triggers the function";
        "priority": Shape::Text, "priority of the error, as the manual classifies it", "A";
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
        "gap": Shape::Words, "what the printed manual leaves open about it";
    }
}
