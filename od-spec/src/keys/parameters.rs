//! The keys of a parameter file: what is set for one node, in addition to the specification of its device.

use super::shape::{Key, KeyKind, Keys, NameOf, Shape, U32};
use super::table::keys;

/// The key that a parameter file begins with.
pub const PARAMETERS_VERSION: &str = "od-parameters";

keys! {
    /// Top level of a parameter file.
    PARAMETER_FILE = "a parameter file" {
        "od-parameters" required: Shape::Version, "version of the language; `1`";
        "spec": Shape::Text, "specification, EDS or DCF of the device, relative to this file: an editor checks the values with it and offers names from it", "pitch.od.yaml";
        "device": Shape::NameOf(NameOf::Device), "key of the device in its specification; a command for another device reports an error", "pmc";
        "title": Shape::Text, "purpose of the values", "blade A";
        "about": Shape::Words, "more about it";
        "node": Shape::Integer(1, 127), "node-ID";
        "bit-rate": Shape::Integer(1, 1000), "bit rate in kbit/s, one that the device supports", "500";
        "node-name": Shape::HeaderText, "name of the node";
        "net-number": U32, "number of the network";
        "net-name": Shape::HeaderText, "name of the network";
        "serial-number": U32, "serial number by which LSS finds the node; that of 1018h.4 unless given", "0x0000_1A2B";
        "parameters": Shape::MapOf(KeyKind::Name, &Shape::Setting), "values by entry: by name, index, or object with its entries below", "{set pressure: 2.5 bar}";
        "unlock": Shape::List(&Shape::Text), "locked entries that may be set, by name or index", "[calibration]";
    }
}
