//! `odgen node`, against `odgen serve`.

use std::fs;
use std::process::{Output, Stdio};

use insta::assert_snapshot;

use crate::book::shows;
use crate::served::Served;
use crate::{Scratch, code, files, odgen, stderr, stdout};

/// A device with everything that a master meets: units, an enum, bits, a text, a lock, a view, conditions, stored parameters.
pub(crate) const HEATER: &str = "\
od-spec: 1
title: Heater
uses: [cia301]
vendor: {name: Makers of heaters, number: 0x1234}
devices:
  heater:
    name: Heater
    bit-rates: [125]
    product: 7
    product-revision: 0x00010002
    device-type: 0
    features: [device type, identity, device name, heartbeat producer, store parameters, restore defaults]
units:
  celsius: {symbol: \"°C\", scale: 0.1}
types:
  mode: {base: unsigned8, values: {0: off, 1: slow, 2: fast}}
  status: {base: unsigned8, bits: {0: hot, 1: dry, 2..7: reserved}}
objects:
  0x2000: {name: wanted temperature, type: integer16, unit: celsius, access: rw, default: 40.0 °C, min: 0.0 °C, max: 90.0 °C, stored: application}
  0x2001: {name: highest temperature, type: integer16, unit: celsius, access: rw, default: 60.0 °C, stored: application}
  0x2002: {name: way, type: mode, access: rw, default: slow}
  0x2003: {name: state, type: status, access: ro, default: [dry]}
  0x2004: {name: place, type: visible-string, access: rw, capacity: 20, default: at the window}
  0x2005: {name: calibration, type: unsigned16, access: rw locked, default: 1000}
  0x2006: {name: fan, type: unsigned8, access: rw, default: 0, writable-when: \"0x2002 == 2\"}
  0x2007: {name: secret, type: unsigned8, access: wo}
constraints:
  wanted below highest: {require: \"0x2000 < 0x2001\"}
";

/// A bus with a heater as node 5.
struct Bus {
    served: Served,
    scratch: Scratch,
}

impl Bus {
    fn new(name: &str) -> Self {
        Self::of(name, "heater.od.yaml", HEATER)
    }

    fn of(name: &str, file: &str, specification: &str) -> Self {
        let scratch = Scratch::new(name);
        scratch.file(file, specification);
        let served = Served::start(&scratch, &[file, "--node", "5"], Stdio::null());
        Self { served, scratch }
    }

    /// `odgen node` with node 5: what it says and how it ends, as a text.
    fn node(&self, command: &str, arguments: &[&str]) -> String {
        self.run(&[&[command, "heater.od.yaml", "--node", "5"], arguments].concat())
    }

    /// What a command says, without a terminal at which it could ask.
    fn output(&self, arguments: &[&str]) -> Output {
        odgen(&self.scratch.0, &[&["node"], arguments, &["--slcan", self.served.address()]].concat())
    }

    /// What a command says and how it ends; those that change a node are allowed to.
    fn run(&self, arguments: &[&str]) -> String {
        self.as_it_is(&allowed(arguments))
    }

    fn as_it_is(&self, arguments: &[&str]) -> String {
        let output = self.output(arguments);
        let shown: Vec<String> = arguments
            .iter()
            .map(
                |argument| {
                    if argument.contains(' ') { format!("\"{argument}\"") } else { (*argument).to_owned() }
                },
            )
            .collect();
        format!(
            "$ odgen node {}\n{}{}-> {}\n",
            shown.join(" "),
            stdout(&output),
            stderr(&output),
            code(&output)
        )
    }
}

/// A command that changes a node, with the word that lets it.
pub(crate) fn allowed<'a>(arguments: &[&'a str]) -> Vec<&'a str> {
    let changes = matches!(arguments.first(), Some(&("write" | "restore" | "store" | "load-defaults")));
    arguments.iter().copied().chain(changes.then_some("--yes")).collect()
}

#[test]
fn entries_are_read_with_their_words() {
    let bus = Bus::new("node-read");
    let said = [
        bus.node("read", &["2000", "way", "state", "place", "1018.4", "1018"]),
        bus.node("read", &["2007", "secret", "2001"]),
        bus.node("read", &["wanted temprature", "2000"]),
    ];
    assert_snapshot!("node-read", said.concat());
}

#[test]
fn entries_are_written_after_a_check() {
    let bus = Bus::new("node-write");
    let said = [
        bus.node("write", &["wanted temperature=55.0 °C", "way=fast", "2006=3", "place=on the roof"]),
        bus.node("read", &["2000", "2002", "2006", "2004"]),
        // Limits, types, names, access.
        bus.node("write", &["2000=90.1 °C"]),
        bus.node("write", &["2000=hot"]),
        bus.node("write", &["2003=1"]),
        bus.node("write", &["2009=1"]),
        // By its default the highest would be 60 °C: what the node has counts.
        bus.node("write", &["2001=80.0 °C"]),
        bus.node("write", &["2000=70.0 °C"]),
        bus.node("write", &["2001=60.0 °C"]),
        bus.node("write", &["2001=60.0 °C", "way=off", "--force"]),
        bus.node("write", &["2005=999"]),
        bus.node("write", &["2005=999", "--unlock", "2005"]),
        bus.node("write", &["1010.1=0x65766173"]),
    ];
    assert_snapshot!("node-write", said.concat());
}

#[test]
fn silence_is_reported() {
    let bus = Bus::new("node-nobody");
    let said = [
        bus.run(&["read", "heater.od.yaml", "--node", "9", "--timeout", "50", "2000", "2001"]),
        bus.run(&["write", "heater.od.yaml", "--node", "9", "--timeout", "50", "2004=roof"]),
        bus.run(&["read", "heater.od.yaml", "2000"]),
        bus.run(&["read", "heater.od.yaml", "--node", "5", "--bit-rate", "333", "2000"]),
    ];
    let said = said.concat().replace(bus.served.address(), "tcp:ADDRESS");
    assert_snapshot!("node-nobody", said.replace(bus.served.address().trim_start_matches("tcp:"), "ADDRESS"));
    assert_eq!(files(&bus.scratch.0), ["heater.od.yaml"]);
}

#[test]
fn parameters_are_kept_compared_and_given_back() {
    let bus = Bus::new("node-keep");
    let written = ["2000=55.0 °C", "2002=fast", "2004=roof", "2006=7", "1017=500"];
    let mut said = vec![
        bus.node("write", &written),
        bus.node("backup", &["--out", "heater.yaml"]),
        bus.node("backup", &["--out", "heater.yaml"]),
    ];
    let kept = fs::read_to_string(bus.scratch.0.join("heater.yaml")).unwrap();
    assert_snapshot!("node-backup", kept);
    said.extend([
        bus.node("compare", &["heater.yaml"]),
        bus.node("write", &["2001=85.0 °C", "2000=80.0 °C", "2006=0", "2002=slow"]),
        bus.node("compare", &["heater.yaml"]),
        // 2000h first, as it has to stay below 2001h; 2002h before 2006h, which depends on it.
        bus.node("restore", &["heater.yaml"]),
        bus.node("restore", &["heater.yaml"]),
        bus.node("compare", &["heater.yaml"]),
    ]);
    assert_snapshot!("node-keep", said.concat());
}

#[test]
fn what_cannot_be_given_back_is_reported() {
    let bus = Bus::new("node-restore");
    let file = |name: &str, text: &str| {
        bus.scratch.file(name, format!("od-parameters: 1\ndevice: heater\n{text}"));
    };
    file("limits.yaml", "parameters: {wanted temperature: 95.0 °C}\n");
    file("order.yaml", "node: 6\nparameters: {wanted temperature: 50.0 °C}\n");
    file("locked.yaml", "parameters: {calibration: 999, place: roof}\nunlock: [calibration]\n");
    file("condition.yaml", "parameters: {fan: 3, place: cellar}\n");
    bus.scratch.file("other.yaml", "od-parameters: 1\ndevice: boiler\nparameters: {place: roof}\n");
    let said = [
        bus.node("restore", &["limits.yaml"]),
        bus.node("restore", &["other.yaml"]),
        bus.node("write", &["2000=10.0 °C", "2001=20.0 °C"]),
        // By the defaults it would be right; the node has another limit.
        bus.node("restore", &["order.yaml"]),
        bus.node("restore", &["locked.yaml"]),
        bus.node("restore", &["condition.yaml"]),
        bus.node("compare", &["condition.yaml"]),
        bus.run(&["restore", "heater.od.yaml", "condition.yaml", "--node", "9", "--timeout", "50"]),
        bus.run(&["backup", "heater.od.yaml", "--out", "none.yaml", "--node", "9", "--timeout", "50"]),
    ];
    assert_snapshot!("node-restore", said.concat());
    assert!(!bus.scratch.0.join("none.yaml").exists(), "no half of a backup");
}

#[test]
fn a_node_that_is_another_device_is_left_alone() {
    let bus = Bus::new("node-other");
    bus.scratch.file("other.od.yaml", HEATER.replace("product: 7", "product: 8"));
    bus.scratch.file("unknown.od.yaml", HEATER.replace("product: 7", "product: 0"));
    bus.scratch.file("place.yaml", "od-parameters: 1\nparameters: {place: roof}\n");
    let said = [
        bus.run(&["read", "other.od.yaml", "--node", "5", "2004"]),
        bus.run(&["write", "other.od.yaml", "--node", "5", "2004=cellar"]),
        bus.run(&["write", "other.od.yaml", "--node", "5", "2004=cellar", "--force"]),
        bus.run(&["backup", "other.od.yaml", "--node", "5", "--out", "none.yaml"]),
        bus.run(&["compare", "other.od.yaml", "--node", "5", "place.yaml"]),
        bus.run(&["restore", "other.od.yaml", "--node", "5", "place.yaml"]),
        // Nothing has come.
        bus.node("read", &["2004"]),
        bus.run(&["write", "other.od.yaml", "--node", "5", "2004=cellar", "--any-device"]),
        // 0 is not a product: it is unknown.
        bus.run(&["read", "unknown.od.yaml", "--node", "5", "2004"]),
        bus.run(&["scan", "other.od.yaml", "unknown.od.yaml", "--timeout", "100"]),
    ];
    assert_snapshot!("node-other", said.concat());
    assert!(!bus.scratch.0.join("none.yaml").exists());
}

#[test]
fn what_belongs_with_a_refused_value_is_held_back() {
    let more = "  0x2008: {name: top calibration, type: unsigned16, access: rw, default: 2000}\n\
                constraints:\n  calibration below top: {require: \"0x2005 < 0x2008\"}\n";
    let bus = Bus::of("node-held-back", "heater.od.yaml", &HEATER.replace("constraints:\n", more));
    bus.scratch.file(
        "low.yaml",
        "od-parameters: 1\nparameters: {calibration: 100, top calibration: 500, place: roof}\nunlock: [calibration]\n",
    );
    // 500 without the 100 would leave the node with 1000 below 500.
    let said = [bus.node("restore", &["low.yaml"]), bus.node("read", &["2005", "2008", "2004"])];
    assert_snapshot!("node-held-back", said.concat());
}

#[test]
fn a_bus_is_scanned_and_commanded() {
    let bus = Bus::new("node-network");
    bus.scratch.file("lamp.od.yaml", crate::LAMP);
    let said = [
        bus.run(&["scan", "heater.od.yaml", "lamp.od.yaml", "--timeout", "100"]),
        bus.run(&["scan", "lamp.od.yaml", "--timeout", "100"]),
        bus.run(&["scan", "--timeout", "100"]),
        bus.node("write", &["2000=55.0 °C"]),
        bus.run(&["store", "--node", "5"]),
        bus.run(&["nmt", "reset-node", "--node", "5"]),
        bus.node("read", &["2000"]),
        bus.run(&["load-defaults", "--node", "5"]),
        bus.node("read", &["2000"]),
        bus.run(&["nmt", "reset-communication", "--node", "5"]),
        bus.run(&["nmt", "reset-node", "--node", "5"]),
        bus.node("read", &["2000"]),
        bus.run(&["store", "--node", "5", "--group", "9"]),
        bus.run(&["store", "--node", "9", "--timeout", "50"]),
        bus.run(&["nmt", "start", "--node", "0"]),
        bus.run(&["nmt", "stop", "--node", "all"]),
        bus.node("read", &["2000", "--timeout", "50"]),
        bus.run(&["scan", "--timeout", "50"]),
        bus.run(&["nmt", "start", "--node", "5"]),
        bus.node("read", &["2000"]),
    ];
    assert_snapshot!("node-network", said.concat());
}

/// A device whose mappings can be changed.
pub(crate) const SENSOR: &str = "\
od-spec: 1
title: Sensor
uses: [cia301]
vendor: {name: Makers of sensors, number: 0x1234}
devices:
  sensor: {name: Sensor, bit-rates: [125], product: 7, device-type: 0, features: [device type, identity, heartbeat producer]}
objects:
  0x2000: {name: pressure, type: unsigned16, access: rw, pdo: transmit}
  0x2001: {name: flow, type: unsigned16, access: rw, pdo: transmit, warning: Valves move.}
pdos:
  sensor:
    transmit:
      1: {map: [pressure], mapping: variable, capacity: 4, transmission: 255}
      2: {map: [flow], mapping: variable, capacity: 4, transmission: 255}
";

/// CiA 301 changes a mapping in steps, each of which is right with what the node has by then.
#[test]
fn mappings_and_cob_ids_are_changed_step_by_step() {
    let bus = Bus::of("node-remap", "heater.od.yaml", SENSOR);
    let said = [
        bus.node("write", &["1800.1=0x80000185"]),
        bus.node("write", &["1A00=0"]),
        bus.node("write", &["1A00.1=0x20010010"]),
        bus.node("write", &["1A00=1"]),
        // The node has no second entry.
        bus.node("write", &["1A00=2"]),
        bus.node("write", &["1800.1=0x456"]),
        // What the first one had is free, what it has now is taken.
        bus.node("write", &["1801.1=0x80000185"]),
        bus.node("write", &["1801.1=0x456"]),
        bus.node("write", &["1801.1=0x185"]),
        // All of it at once, in the order that is given.
        bus.node("write", &["1800.1=0x80000456", "1A00=0", "1A00.1=0x20000010", "1A00=1", "1800.1=0x456"]),
        bus.node("read", &["1A00", "1800.1"]),
    ];
    assert_snapshot!("node-remap", said.concat());
}

/// A lock stays lifted for all settings of a command, also where an entry is set twice before.
#[test]
fn a_lifted_lock_holds_for_the_whole_command() {
    let bus = Bus::new("node-unlocked");
    let said = bus.node("write", &["way=fast", "way=slow", "2005=999", "--unlock", "2005"]);
    // It is sent; the virtual node refuses it, as it is not in service.
    assert!(said.contains("note: LOCKED 2005h calibration"), "{said}");
    assert!(said.contains("0800 0022h") && !said.contains("OD0704"), "{said}");
}

#[test]
fn nothing_is_changed_before_it_is_allowed() {
    let bus = Bus::of("node-allowed", "heater.od.yaml", SENSOR);
    bus.scratch.file("flow.yaml", "od-parameters: 1\nparameters: {flow: 7}\n");
    let of_node =
        |command, more: &[&'static str]| [&[command, "heater.od.yaml", "--node", "5"], more].concat();
    let said = [
        bus.as_it_is(&of_node("write", &["flow=7"])),
        bus.as_it_is(&of_node("write", &["flow=7", "--dry-run"])),
        bus.as_it_is(&of_node("restore", &["flow.yaml"])),
        bus.as_it_is(&of_node("restore", &["flow.yaml", "--dry-run"])),
        bus.as_it_is(&["store", "--node", "5"]),
        bus.as_it_is(&["load-defaults", "--node", "5", "--dry-run"]),
        bus.node("read", &["flow"]),
        bus.node("write", &["flow=7"]),
        // Nothing to change, and nothing to allow.
        bus.as_it_is(&of_node("restore", &["flow.yaml"])),
    ];
    assert_snapshot!("node-allowed", said.concat());
}

#[test]
fn a_node_is_talked_to_as_the_book_shows() {
    let valve = include_str!("../../../../tests/book/valve.od.yaml");
    let bus = Bus::of("node-book", "valve.od.yaml", valve);
    let mut lines = Vec::new();
    for (command, rest) in [
        ("read", &["set pressure", "1018.1"][..]),
        ("write", &["set pressure=6.0 bar"]),
        ("write", &["set pressure=16.5 bar"]),
        ("backup", &["--out", "kept.yaml"]),
        ("write", &["set pressure=3.0 bar"]),
        ("compare", &["kept.yaml"]),
        ("restore", &["kept.yaml"]),
    ] {
        let rest = allowed(&[&[command], rest].concat()).split_off(1);
        let output = bus.output(&[&[command, "valve.od.yaml", "--node", "5"], &rest[..]].concat());
        let rest: Vec<String> = rest
            .iter()
            .map(|word| if word.contains(' ') { format!("\"{word}\"") } else { (*word).to_owned() })
            .collect();
        lines.push(format!("$ odgen node {command} valve.od.yaml --node 5 {}", rest.join(" ")));
        lines.extend(stdout(&output).lines().map(str::to_owned));
        // The place is the command line.
        lines.extend(stderr(&output).lines().take_while(|line| !line.contains("-->")).map(str::to_owned));
    }
    shows("guides/operator.md", "node", lines.iter().map(String::as_str));
}

/// In which state an entry is accepted matters only where its value is to be written.
#[test]
fn what_a_node_has_already_is_no_warning() {
    let bus = Bus::new("node-not-now");
    let said = [
        bus.node("backup", &["--out", "heater.yaml"]),
        bus.node("restore", &["heater.yaml"]),
        bus.node("write", &["way=fast", "fan=3"]),
        bus.node("write", &["way=slow"]),
        bus.node("restore", &["heater.yaml"]),
    ];
    assert_snapshot!("node-not-now", said.concat());
}

/// What a line of a DCF cannot hold, a bus carries.
#[test]
fn a_text_that_no_dcf_holds_is_kept_and_given_back() {
    let wide = HEATER.replace("capacity: 20", "capacity: 400");
    let bus = Bus::of("node-texts", "heater.od.yaml", &wide);
    let long = format!("place=a; b = c # {}", "d".repeat(300));
    let said = [
        bus.node("write", &[&long]),
        bus.node("backup", &["--out", "heater.yaml"]),
        bus.node("write", &["place=roof"]),
        bus.node("restore", &["heater.yaml"]),
        bus.node("compare", &["heater.yaml"]),
    ];
    assert_snapshot!("node-texts", said.concat());
}

/// Devices of one kind are distinguished by their serial numbers: a backup knows whose it is.
#[test]
fn a_node_with_another_serial_number_or_revision_is_left_alone() {
    let with = |number: u32| {
        let allow = if number == 0 { "" } else { "allow: {OD0890: one node}\n" };
        let serial =
            format!("{allow}objects:\n  0x1018: {{from: cia301, record: {{4: {{default: {number}}}}}}}\n");
        HEATER.replace("objects:\n", &serial)
    };
    let first = Bus::of("node-serial", "heater.od.yaml", &with(4711));
    let second = Bus::of("node-serial-2", "heater.od.yaml", &with(4712));
    let none = Bus::of("node-serial-0", "heater.od.yaml", &with(0));
    let mut said = vec![first.node("backup", &["--out", "kept.yaml"])];
    let kept = fs::read_to_string(first.scratch.0.join("kept.yaml")).unwrap();
    assert!(kept.contains("serial-number: 0x0000_1267\n"), "{kept}");
    said.push(first.node("restore", &["kept.yaml"]));
    for bus in [&second, &none] {
        bus.scratch.file("kept.yaml", &kept);
        said.push(bus.node("restore", &["kept.yaml"]));
    }
    said.push(second.node("compare", &["kept.yaml", "--any-device"]));
    // A spare part: all but the serial number is still compared.
    said.push(second.node("restore", &["kept.yaml", "--any-serial"]));
    second.scratch.file("other.od.yaml", HEATER.replace("product: 7", "product: 8"));
    let of_other = ["other.od.yaml", "--node", "5", "kept.yaml", "--any-serial", "--any-revision"];
    said.push(second.run(&[&["restore"], &of_other[..]].concat()));
    assert_snapshot!("node-serial", said.concat());
}

/// CiA 301, 1018h.3: with another major revision (upper 16 bits) a device behaves otherwise; a higher minor one adds something.
#[test]
fn a_node_has_the_same_major_revision_and_no_lower_minor() {
    let bus = Bus::new("node-revision");
    let read = |revision: &str, more: &[&'static str]| {
        bus.scratch.file("revision.od.yaml", HEATER.replace("0x00010002", revision));
        bus.run(&[&["read", "revision.od.yaml", "--node", "5", "2004"], more].concat())
    };
    let said = [
        read("0x00010002", &[]),
        read("0x00010001", &[]),
        read("0x00010003", &[]),
        read("0x00020001", &[]),
        read("0x00000002", &[]),
        read("0x00020001", &["--any-serial"]),
        read("0x00020001", &["--any-revision"]),
        read("0x00000000", &[]),
    ];
    assert_snapshot!("node-revision", said.concat());
}

/// A stored value outlasts the mistake.
#[test]
fn storing_asks_first_who_is_there() {
    let serial =
        "allow: {OD0890: one node}\nobjects:\n  0x1018: {from: cia301, record: {4: {default: 4711}}}\n";
    let bus = Bus::of("node-store", "heater.od.yaml", &HEATER.replace("objects:\n", serial));
    bus.scratch.file("other.od.yaml", HEATER.replace("product: 7", "product: 8"));
    bus.scratch.file(
        "plant.yaml",
        "od-plant: 1\ntitle: House\ndevices: {heater: heater.od.yaml}\n\
         types: {flat: {bit-rate: 125, positions: {bath: {heater: 5}}}}\n\
         sites: {North: {type: flat, machines: {1: {positions: {bath: {heater: {serial: 4712}}}}}}}\n",
    );
    let said = [
        bus.run(&["store", "heater.od.yaml", "--node", "5"]),
        bus.run(&["load-defaults", "heater.od.yaml", "--node", "5"]),
        bus.run(&["store", "other.od.yaml", "--node", "5"]),
        bus.run(&["load-defaults", "other.od.yaml", "--node", "5"]),
        bus.run(&["store", "other.od.yaml", "--node", "5", "--any-device"]),
        bus.run(&["store", "plant.yaml", "--node", "5"]),
        bus.run(&["store", "plant.yaml", "--any-serial"]),
        bus.run(&["store", "heater.od.yaml"]),
        bus.run(&["store"]),
        // Its kind was not stated: it is shown.
        bus.as_it_is(&["store", "--node", "5", "--dry-run"]),
        bus.run(&["store", "--node", "5", "--any-device"]),
    ];
    assert_snapshot!("node-store", said.concat());
}
