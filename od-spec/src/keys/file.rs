//! The top level of a file.

use super::constraints::CONSTRAINT;
use super::devices::DEVICE;
use super::errors::ERROR;
use super::libraries::{AXES, FEATURE};
use super::machines::MACHINE;
use super::manual::{ERRATUM, SECTION};
use super::objects::OBJECT;
use super::pdos::PDOS;
use super::shape::{Key, KeyKind, Keys, NameOf, Shape, U32};
use super::table::{joined, key_list, keys};
use super::types::{TYPE, UNIT};

/// The first key of a specification, of its parts and of a library.
pub const SPEC_VERSION: &str = "od-spec";
/// The key that names the parts of a specification.
pub const PARTS: &str = "parts";
/// The key by which a part names its specification.
pub const PART_OF: &str = "part-of";

/// What only the main file of a specification has.
const MAIN_KEYS: &[Key] = key_list! {
    "od-spec" required: Shape::Version, "version of the language; `1`";
    "title" required: Shape::Text, "title of the product or product family";
    "profile": Shape::Text, "makes the file a library; the name by which `from:` refers to it", "cia4xx";
    "languages": Shape::List(&Shape::Text), "language codes of the descriptions; the first is the default (`en`)", "[en, de]";
    "source": Shape::Map(&SOURCE), "the printed manual that the specification replaces";
    "revision": Shape::Map(&REVISION), "the issue of the manual that the specification corresponds to";
    "vendor": Shape::Map(&VENDOR), "maker of the devices; `unknown` in an EDS unless given";
    "uses": Shape::List(&Shape::NameOf(NameOf::LibraryFile)), "libraries of standard objects: `cia301`, `cia302`, `cia401`, `cia402`, or the path of a library file", "[cia301, cia402]";
    "parts": Shape::List(&Shape::NameOf(NameOf::File)), "files with more of the sections below, each a part of the specification", "[errata.od.yaml]";
    "axes": Shape::Map(&AXES), "objects of a library that repeat for every axis", "{first: 0x6000, last: 0x67FF, count: 8}";
};

/// Sections: maps and lists, which may be in parts.
const SECTION_KEYS: &[Key] = key_list! {
    "history": Shape::List(&Shape::Map(&REVISION)), "issues of the manual, oldest first";
    "allow": Shape::MapOf(KeyKind::Name, &Shape::ShortOr(&Shape::Text, &ALLOWED)), "rules that the device may break, by code, with the reason: their findings become notes", "{OD0510: the drive counts errors of the factory test}";
    "glossary": Shape::MapOf(KeyKind::Name, &Shape::Words), "abbreviations and their meaning", "{PDO: process data object}";
    "devices": Shape::MapOf(KeyKind::DeviceKey, &Shape::Map(&DEVICE)), "the devices, by a short key; a file without `profile:` has at least one";
    "units": Shape::MapOf(KeyKind::Name, &Shape::Map(&UNIT)), "physical units, by name";
    "types": Shape::MapOf(KeyKind::Name, &Shape::Map(&TYPE)), "enums and bit fields, by name";
    "features": Shape::MapOf(KeyKind::Name, &Shape::Map(&FEATURE)), "groups of objects that a library offers to devices";
    "objects": Shape::MapOf(KeyKind::Indices, &Shape::OneOrMore(&Shape::Map(&OBJECT))), "the objects, by index or indices; a list where devices have different ones";
    "pdos": Shape::MapOf(KeyKind::Device, &Shape::Map(&PDOS)), "the PDOs of each device, by the device's key";
    "errors": Shape::MapOf(KeyKind::ErrorCodes, &Shape::Map(&ERROR)), "error codes (603Fh, 1003h)";
    "state-machines": Shape::MapOf(KeyKind::Name, &Shape::Map(&MACHINE)), "state machines with their commands, by name";
    "constraints": Shape::MapOf(KeyKind::Name, &Shape::Map(&CONSTRAINT)), "conditions between entries, by name";
    "errata": Shape::List(&Shape::Map(&ERRATUM)), "where the printed manual differs, or states nothing";
    "document": Shape::List(&Shape::Map(&SECTION)), "the manual's sections and tables, in order";
};

/// The first keys of a part.
const PART_KEYS: &[Key] = key_list! {
    "od-spec" required: Shape::Version, "version of the language; `1`";
    "part-of" required: Shape::NameOf(NameOf::File), "file of the specification, relative to this one", "pitch.od.yaml";
};

/// Top level of a specification.
pub static SPEC: Keys = Keys {
    name: "a specification",
    keys: &joined::<{ MAIN_KEYS.len() + SECTION_KEYS.len() }>(&[MAIN_KEYS, SECTION_KEYS]),
    choices: &[],
};

/// Top level of a part.
pub static PART: Keys = Keys {
    name: "a part",
    keys: &joined::<{ PART_KEYS.len() + SECTION_KEYS.len() }>(&[PART_KEYS, SECTION_KEYS]),
    choices: &[],
};

keys! {
    /// A code under `allow:`.
    ALLOWED = "an allowed rule" {
        "at": Shape::OneOrMore(&Shape::Index), "the objects that may break the rule; all unless given", "[0x2000, 0x2101]";
        "about" required: Shape::Words, "the reason", "the first series has it";
    }
}

macro_rules! source_keys {
    ($then:ident $($head:tt)*) => {
        $then! { $($head)* {
            "title" required: Shape::Text => title: Option<Name>, "title of the manual";
            "edition": Shape::Text => edition: Option<Name>, "edition, as printed", "\"issue 1.09, English\"";
            "subtitle": Shape::Words => subtitle: Words, "what it is about, below the title on the cover", "Programming and parameters";
            "address": Shape::Words => address: Words, "the maker's address on the cover; each line of the value is one", "\"Main Street 1, Springfield\"";
            "about": Shape::Words => about: Words, "more about it";
        } }
    };
}
pub(crate) use source_keys;

source_keys! { keys
    /// `source:`.
    SOURCE = "a source"
}

macro_rules! revision_keys {
    ($then:ident $($head:tt)*) => {
        $then! { $($head)* {
            "number" required: Shape::Text => number: Option<Name>, "number of the issue, as printed", "\"1.09\"";
            "date" required: Shape::Date => date: Option<Spanned<Date>>, "its date", "2009-05-27";
            "about": Shape::Words => about: Words, "what changed";
        } }
    };
}
pub(crate) use revision_keys;

revision_keys! { keys
    /// An issue of the manual.
    REVISION = "a revision"
}

macro_rules! vendor_keys {
    ($then:ident $($head:tt)*) => {
        $then! { $($head)* {
            "name" required: Shape::HeaderText => name: Option<Name>, "company name";
            "number": U32 => number: Option<Spanned<i128>>, "vendor-ID assigned by CiA (1018h.1); 0 unless given", "0x0000_0123";
        } }
    };
}
pub(crate) use vendor_keys;

vendor_keys! { keys
    /// `vendor:`.
    VENDOR = "a vendor"
}
