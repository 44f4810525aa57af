//! The keys of a plant file: the nodes of many machines, and what each of them is set to.

use super::shape::{Key, KeyKind, Keys, NameOf, Shape, U32};
use super::table::keys;

/// The key that a plant file begins with.
pub const PLANT_VERSION: &str = "od-plant";

/// Highest COB-ID of a data frame with 29 bits.
const HIGHEST_COB_ID: i128 = 0x1FFF_FFFF;

const PARAMETERS: Shape = Shape::MapOf(KeyKind::DeviceKey, &Shape::MapOf(KeyKind::Name, &Shape::Setting));
const UNLOCK: Shape = Shape::MapOf(KeyKind::DeviceKey, &Shape::List(&Shape::Text));
const POSITIONS: Shape = Shape::MapOf(
    KeyKind::Place,
    &Shape::MapOf(KeyKind::DeviceKey, &Shape::ShortOr(&Shape::Integer(1, 127), &PLANT_NODE)),
);

keys! {
    /// Top level of a plant file.
    PLANT = "a plant" {
        "od-plant" required: Shape::Version, "version of the language; `1`";
        "title" required: Shape::Text, "name of the plant", "Nordfeld wind farm";
        "about": Shape::Words, "more about it";
        "devices" required: Shape::MapOf(KeyKind::DeviceKey, &Shape::ShortOr(&Shape::Text, &PLANT_DEVICE)), "the devices, by the key that this file has for them: a file, or the file and the device in it", "{pmc: {from: pitch.od.yaml}}";
        "types" required: Shape::MapOf(KeyKind::Place, &Shape::Map(&PLANT_TYPE)), "types of machines, by name";
        "sites" required: Shape::MapOf(KeyKind::Place, &Shape::Map(&SITE)), "places of machines, by name";
    }
}

keys! {
    /// A device of a plant.
    PLANT_DEVICE = "a device of a plant" {
        "from" required: Shape::Text, "its specification, EDS or DCF, relative to this file", "pitch.od.yaml";
        "device": Shape::NameOf(NameOf::Device), "its key in the specification, where it differs", "pmc";
    }
}

keys! {
    /// A type of machines.
    PLANT_TYPE = "a type of machines" {
        "about": Shape::Words, "what it is";
        "bit-rate" required: Shape::Integer(1, 1000), "bit rate of the bus in kbit/s, one that every device supports", "500";
        "master": Shape::Map(&MASTER), "the master of the bus, which is not a node of the machine; unless given, PDOs without another end are not reported";
        "positions" required: POSITIONS, "positions of the machine, each with its devices and their node-IDs", "{A: {pmm: 1, pmc: 11}}";
        "parameters": PARAMETERS, "values by device and entry, as in a parameter file", "{pmc: {set pressure: 2.5 bar}}";
        "unlock": UNLOCK, "locked entries, by device, that these parameters may set", "{pmc: [calibration]}";
    }
}

keys! {
    /// The master of a bus.
    MASTER = "the master of a bus" {
        "node": Shape::Integer(1, 127), "its node-ID, if it has one";
        "sends": Shape::List(&Shape::Integer(1, HIGHEST_COB_ID)), "COB-IDs of the PDOs that it sends", "[0x20B, 0x20C]";
        "receives": Shape::List(&Shape::Integer(1, HIGHEST_COB_ID)), "COB-IDs of the PDOs that it receives", "[0x18B]";
    }
}

keys! {
    /// A site.
    SITE = "a site" {
        "title": Shape::Text, "name of the site";
        "comment": Shape::Text, "a remark for the overview";
        "type": Shape::Text, "type of its machines that have none of their own", "OAT-2";
        "machines" required: Shape::MapOf(KeyKind::Machines, &Shape::Map(&PLANT_MACHINE)), "the machines, each with a bus of its own: names, numbers, or runs of numbers; a smaller run overrides a larger one", "{1..200: {}, 17: {serial: \"2031-17\"}}";
        "positions": POSITIONS, "settings of single positions on every machine of the site";
        "parameters": PARAMETERS, "values that override those of the type";
        "unlock": UNLOCK, "locked entries, by device, that these parameters may set";
    }
}

keys! {
    /// A machine, or a run of them.
    PLANT_MACHINE = "a machine" {
        "type" inherited: Shape::Text, "its type; that of the site unless given";
        "serial": Shape::Text, "its serial number, as on the plate", "\"2031-17\"";
        "comment": Shape::Text, "a remark for the overview", "gearbox exchanged in 2026";
        "bit-rate": Shape::Integer(1, 1000), "bit rate in kbit/s; that of the type unless given";
        "net-number": U32, "number of its network";
        "net-name": Shape::HeaderText, "name of its network; that of site and machine unless given", "WEC 17";
        "positions": POSITIONS, "settings of single positions", "{B: {pmc: {node: 22}}}";
        "parameters": PARAMETERS, "values that override those of type and site";
        "unlock": UNLOCK, "locked entries, by device, that these parameters may set";
    }
}

keys! {
    /// A device at a position.
    PLANT_NODE = "a node" {
        "node" inherited: Shape::Integer(1, 127), "node-ID";
        "node-name": Shape::HeaderText, "name of the node; product and position unless given";
        "serial": U32, "serial number of the device (1018h.4)", "4711";
        "comment": Shape::Text, "a remark for the overview", "exchanged in 2026";
        "parameters": Shape::MapOf(KeyKind::Name, &Shape::Setting), "values that override those of the same level for every position", "{set pressure: 2.5 bar}";
        "unlock": Shape::List(&Shape::Text), "locked entries that these parameters may set", "[calibration]";
    }
}
