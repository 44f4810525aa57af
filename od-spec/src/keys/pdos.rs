//! PDOs.

use super::shape::{Key, KeyKind, Keys, NumberedName, Shape, U8, U32};
use super::table::keys;

keys! {
    /// `pdos:` of a device.
    PDOS = "a device's PDOs" {
        "stored": Shape::Choice(&["communication", "no"]), "whether parameters that can be written are stored with the communication parameters; `no` also where it is unknown; unless given, `communication` if the device has 1010h (sub-index 1 or 2), otherwise `no`";
        "parameters": Shape::Map(&PDO_DIRECTIONS), "names and other facts of the parameter objects of all PDOs";
        "receive": Shape::MapOf(KeyKind::PdoNumber, &Shape::Map(&PDO)), "RPDOs by number", "{1: {map: [controlword]}}";
        "transmit": Shape::MapOf(KeyKind::PdoNumber, &Shape::Map(&PDO)), "TPDOs by number";
    }
}

keys! {
    /// `parameters:` of a device's PDOs.
    PDO_DIRECTIONS = "the parameters of all PDOs" {
        "receive": Shape::Map(&PDO_PARAMETERS), "of RPDOs", "{communication: {name: \"Receive PDO Parameter {pdo}\", cob-id: COB-ID}}";
        "transmit": Shape::Map(&PDO_PARAMETERS), "of TPDOs";
    }
}

const NAME: Shape = Shape::NumberedName(NumberedName::Parameter);
const ENTRY_NAME: Shape = Shape::NumberedName(NumberedName::MappedEntry);
const PARAMETER: Shape = Shape::ShortOr(&NAME, &PDO_PARAMETER);

macro_rules! pdo_parameters_keys {
    ($then:ident $($head:tt)*) => {
        $then! { $($head)* {
            "communication": Shape::Map(&PDO_COMMUNICATION) => communication: Option<PdoCommunicationDecl>, "the communication parameter objects (1400h, 1800h and following)", "{name: \"TPDO{pdo} Communication\", cob-id: COB-ID}";
            "mapping": Shape::Map(&PDO_MAPPING) => mapping: Option<PdoMappingDecl>, "the mapping parameter objects (1600h, 1A00h and following)", "{name: \"TPDO{pdo} Mapping\", entry: \"Mapping Entry {n}\"}";
        } }
    };
}
pub(crate) use pdo_parameters_keys;

pdo_parameters_keys! { keys
    /// `parameters:` of the PDOs of a direction, or of one PDO.
    PDO_PARAMETERS = "parameters of PDOs"
}

macro_rules! pdo_communication_keys {
    ($then:ident $($head:tt)*) => {
        $then! { $($head)* {
            "name": NAME => name: Option<Spanned<NamePattern>>, "name of the object", "\"Transmit PDO {pdo} Parameter\"";
            "identifier": NAME => identifier: Option<Spanned<NamePattern>>, "identifier of the object, where its name is not unique", "tpdo_{pdo}";
            "sub0": PARAMETER => sub0: Option<PdoParameterDecl>, "sub-index 0", "Number of Entries";
            "cob-id": PARAMETER => cob_id: Option<PdoParameterDecl>, "sub-index 1, the COB-ID", "COB-ID";
            "transmission": PARAMETER => transmission: Option<PdoParameterDecl>, "sub-index 2, the transmission type", "{name: Transmission Type, min: 0, max: 255}";
            "inhibit-time": PARAMETER => inhibit_time: Option<PdoParameterDecl>, "sub-index 3, the inhibit time, of PDOs that have one";
            "reserved": Shape::ShortOr(&NAME, &PDO_RESERVED) => reserved: Option<PdoParameterDecl>, "sub-index 4, which CiA 301 reserves, for a device that has it", "{name: Compatibility Entry, access: rw, default: 0}";
            "event-timer": PARAMETER => event_timer: Option<PdoParameterDecl>, "sub-index 5, the event timer, of PDOs that have one";
            "sync-start": PARAMETER => sync_start: Option<PdoParameterDecl>, "sub-index 6, the SYNC start value, of PDOs that have one";
        } }
    };
}
pub(crate) use pdo_communication_keys;

pdo_communication_keys! { keys
    /// `communication:` of parameters of PDOs.
    PDO_COMMUNICATION = "communication parameters of PDOs"
}

macro_rules! pdo_mapping_keys {
    ($then:ident $($head:tt)*) => {
        $then! { $($head)* {
            "name": NAME => name: Option<Spanned<NamePattern>>, "name of the object", "\"Transmit PDO {pdo} Mapping\"";
            "identifier": NAME => identifier: Option<Spanned<NamePattern>>, "identifier of the object, where its name is not unique", "tpdo_mapping_{pdo}";
            "sub0": PARAMETER => sub0: Option<PdoParameterDecl>, "sub-index 0, the number of mapped entries", "Number of Entries";
            "entry": Shape::ShortOr(&ENTRY_NAME, &PDO_MAPPED_ENTRY) => entry: Option<PdoParameterDecl>, "every other sub-index, a mapped entry", "\"Mapping Entry {n}\"";
            "entries": Shape::MapOf(KeyKind::SubIndex, &ENTRY_NAME) => entries: BTreeMap<u8, Spanned<NamePattern>>, "names of single mapped entries, by sub-index", "{1: First mapped object}";
        } }
    };
}
pub(crate) use pdo_mapping_keys;

pdo_mapping_keys! { keys
    /// `mapping:` of parameters of PDOs.
    PDO_MAPPING = "mapping parameters of PDOs"
}

/// The words of `access:` of a parameter.
const ACCESS: Shape = Shape::Choice(&["ro", "rw", "const"]);

keys! {
    /// An entry of the parameter objects of PDOs.
    PDO_PARAMETER = "a parameter of PDOs" {
        "name": NAME, "name", "Transmission Type";
        "identifier": NAME, "identifier, where the name is not unique", "transmission_type";
        "access": ACCESS, "access; unless given, `ro` for sub-index 0 of communication parameters and for a fixed mapping, otherwise `rw`";
        "min": U32, "smallest allowed value";
        "max": U32, "largest allowed value";
    }
}

keys! {
    /// Sub-index 4 of communication parameters.
    PDO_RESERVED = "a reserved parameter of PDOs" {
        "name": NAME, "name; `reserved` unless given", "Compatibility Entry";
        "identifier": NAME, "identifier, where the name is not unique", "compatibility_entry";
        "access": ACCESS, "access; `ro` unless given";
        "default": U8, "its value; none unless given";
        "min": U32, "smallest allowed value";
        "max": U32, "largest allowed value";
    }
}

keys! {
    /// The mapped entries of mapping parameters.
    PDO_MAPPED_ENTRY = "a mapped entry of PDOs" {
        "name": ENTRY_NAME, "name", "\"Mapping Entry {n}\"";
        "identifier": ENTRY_NAME, "identifier, where several entries share a name", "\"mapping_entry_{n}\"";
        "access": ACCESS, "access; unless given, `ro` where the mapping is fixed, otherwise `rw`";
        "min": U32, "smallest allowed value";
        "max": U32, "largest allowed value";
    }
}

macro_rules! pdo_keys {
    ($then:ident $($head:tt)*) => {
        $then! { $($head)* {
            "cob-id": Shape::Value => cob_id: Option<Name>, "COB-ID without flag bits; unless given, that of the predefined connection set, which ends at PDO 4", "$NODEID + 0x200";
            "valid": Shape::YesNo => valid: Option<Spanned<bool>>, "whether the PDO exists after start-up; yes unless given";
            "no-rtr": Shape::YesNo => no_rtr: Option<Spanned<bool>>, "TPDO: remote frames are not answered (bit 30); no unless given";
            "transmission": U8 => transmission: Option<Spanned<i128>>, "transmission type; 255 unless given";
            "inhibit-time": Shape::Time => inhibit_time: Option<Name>, "inhibit time, as a number in multiples of 100 µs; the device has no such entry unless given", "10 ms";
            "event-timer": Shape::Time => event_timer: Option<Name>, "event timer, as a number in ms; the device has no such entry unless given", "100 ms";
            "sync-start": Shape::Integer(0, 240) => sync_start: Option<Spanned<i128>>, "SYNC start value; the device has no such entry unless given";
            "mapping": Shape::Choice(&["variable", "fixed"]) => mapping: Option<Spanned<MappingKind>>, "whether the mapping can be changed over the bus; `variable` unless given";
            "capacity": Shape::Integer(0, 64) => capacity: Option<Spanned<i128>>, "mapping entries that the device offers, where the mapping is variable; 64 / granularity unless given (granularity 0 counts as 1)";
            "map" required: Shape::List(&Shape::Entries) => map: Vec<Name>, "mapped entries in order, by index or name, or data types as placeholders; `0x2021.1..4` is four of one object", "[statusword, 0x6064, 0x2021.1..4, drive data.error mask]";
            "parameters": Shape::Map(&PDO_PARAMETERS) => parameters: Option<Box<PdoParametersDecl>>, "facts of its parameter objects that differ from those of the other PDOs";
            "about": Shape::Words => about: Words, "meaning";
            "gap": Shape::Words => gap: Words, "what the printed manual leaves open about it";
        } }
    };
}
pub(crate) use pdo_keys;

pdo_keys! { keys
    /// A PDO.
    PDO = "a PDO"
}
