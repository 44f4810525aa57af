//! The examples about parameter files, plants and XDDs as whole texts, and the devices that they are about.

use super::Example;

impl Example {
    /// The name under which examples name the specification of their devices.
    pub const DEVICES_FILE: &str = "example.od.yaml";

    /// The specification that examples of parameter files and plants are about: a supply, and a drive with a PDO in each direction.
    pub const DEVICES: &str = "od-spec: 1
title: Example
uses: [cia301]
devices:
  supply: {name: Supply, bit-rates: [125], features: [heartbeat producer, emergency]}
  drive: {name: Drive, bit-rates: [125], features: [heartbeat producer, heartbeat consumer]}
objects:
  0x1016: {from: cia301, devices: [drive], array: {count: 2, default: 0}}
  0x2000: {name: calibration, devices: drive, type: unsigned16, access: rw locked, default: 100}
  0x2001: {name: lowest voltage, devices: drive, type: unsigned16, access: rw, default: 400}
  0x2002: {name: speed, devices: drive, type: integer16, access: ro, pdo: transmit}
  0x2003: {name: set speed, identifier: speed_set_point, devices: drive, type: integer16, access: rw, pdo: receive, default: 0}
  0x2004:
    name: ramps
    devices: drive
    type: unsigned16
    access: rw
    record: {1: {name: up, default: 5}, 2: {name: down, default: 5}}
pdos:
  drive: {receive: {1: {map: [set speed]}}, transmit: {1: {map: [speed]}}}
";
}

/// A parameter file with its version.
pub(super) fn parameters(text: &str) -> String {
    format!("od-parameters: 1\n{text}\n")
}

/// A plant with version, title and devices, and with machines where the text has none.
pub(super) fn plant(text: &str) -> String {
    let has = |key: &str| text.lines().any(|line| line.starts_with(key));
    let file = Example::DEVICES_FILE;
    let mut whole =
        format!("od-plant: 1\ntitle: Example\ndevices: {{supply: {file}, drive: {file}}}\n{text}\n");
    if !has("types:") {
        whole.push_str("types: {P1: {bit-rate: 125, positions: {left: {supply: 1, drive: 11}}}}\n");
    }
    if !has("sites:") {
        whole.push_str("sites: {Hall: {type: P1, machines: {1..3: {}}}}\n");
    }
    whole
}

/// A text with the list of objects inside the elements that every XDD has around it.
pub(super) fn xdd(text: &str) -> String {
    if !text.contains("<CANopenObjectList") || text.starts_with("<!") {
        return format!("{text}\n");
    }
    let (head, tail) = ["ISO15745ProfileContainer", "ISO15745Profile", "ProfileBody"]
        .iter()
        .fold((String::new(), String::new()), |(head, tail), name| {
            (format!("{head}<{name}>\n"), format!("</{name}>\n{tail}"))
        });
    format!("{head}{text}\n{tail}")
}
