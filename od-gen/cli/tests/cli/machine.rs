//! `odgen node` with the nodes of a machine of a plant, against `odgen serve`.

use std::fs;
use std::process::Stdio;

use insta::assert_snapshot;

use crate::node::{HEATER, allowed};
use crate::served::Served;
use crate::{Scratch, code, files, odgen, stderr, stdout};

/// Two machines with a heater in each room, of which the hall is warmer.
const HOUSE: &str = "\
od-plant: 1
title: House
devices:
  heater: heater.od.yaml
  warm: {from: heater.od.yaml, device: heater}
types:
  flat:
    bit-rate: 125
    positions:
      bath: {heater: 5}
      hall: {warm: 6}
    parameters: {warm: {wanted temperature: 50.0 °C}}
sites:
  North:
    type: flat
    machines: {1..2: {}, cellar: {positions: {bath: {heater: 7}}}}
";

/// A folder with the plant, and a bus with nodes.
struct House {
    served: Served,
    scratch: Scratch,
}

impl House {
    fn new(name: &str, served: &[&str]) -> Self {
        let scratch = Scratch::new(name);
        scratch.file("heater.od.yaml", HEATER);
        scratch.file("house.yaml", HOUSE);
        let served = Served::start(&scratch, served, Stdio::null());
        Self { served, scratch }
    }

    /// `odgen node`: what it says and how it ends, as a text.
    fn node(&self, arguments: &[&str]) -> String {
        self.unasked(&allowed(arguments))
    }

    fn unasked(&self, arguments: &[&str]) -> String {
        let address = ["--timeout", "500", "--slcan", self.served.address()];
        let output = odgen(&self.scratch.0, &[&["node"], arguments, &address].concat());
        let (said, failed) = (stdout(&output), stderr(&output));
        format!("$ odgen node {}\n{said}{failed}-> {}\n", arguments.join(" "), code(&output))
    }
}

const FLAT: [&str; 3] = ["house.yaml", "--machine", "2"];

#[test]
fn a_machine_is_kept_compared_and_given_back() {
    let house = House::new("machine-keep", &FLAT);
    let with = |command: &str, more: &[&str]| house.node(&[&[command], &FLAT[..], more].concat());
    let said = [
        with("backup", &["--out", "kept"]),
        with("compare", &["kept"]),
        with("read", &["--node", "6", "2000", "place"]),
        with("write", &["--node", "6", "2000=55.0 °C", "place=under the window"]),
        with("write", &["--device", "heater", "2000=20.0 °C"]),
        // What is there is not replaced unasked.
        with("backup", &["--out", "kept"]),
        with("compare", &["kept"]),
        with("compare", &["--node", "6", "kept"]),
        with("restore", &["--device", "heater", "kept"]),
        // A single file says itself whose it is.
        with("compare", &["kept/hall-warm.yaml"]),
        with("restore", &["kept"]),
        with("compare", &["kept"]),
    ];
    assert_snapshot!("machine-keep", said.concat());
    assert_eq!(fs::read_dir(house.scratch.0.join("kept")).unwrap().count(), 2);
    let kept = fs::read_to_string(house.scratch.0.join("kept/hall-warm.yaml")).unwrap();
    assert!(kept.contains("device: heater\nnode: 6\n") && kept.contains("wanted temperature: 50.0 °C\n"));
}

#[test]
fn a_node_that_is_silent_or_another_device_stops_backup_and_restore_of_all() {
    let house = House::new("machine-silent", &["heater.od.yaml", "--node", "5"]);
    house.scratch.file("other.od.yaml", HEATER.replace("product: 7", "product: 8"));
    house.scratch.file("others.yaml", HOUSE.replace("heater: heater.od", "heater: other.od"));
    let file = |name: &str, node: u8, value: &str| {
        let text = format!(
            "od-parameters: 1\ndevice: heater\nnode: {node}\nparameters: {{wanted temperature: {value}}}\n"
        );
        house.scratch.file(name, text);
    };
    fs::create_dir(house.scratch.0.join("kept")).unwrap();
    file("kept/bath-heater.yaml", 5, "30.0 °C");
    file("kept/hall-warm.yaml", 6, "31.0 °C");
    let said = [
        house.node(&[&["backup"], &FLAT[..], &["--out", "none"]].concat()),
        house.node(&[&["backup"], &FLAT[..], &["--node", "5", "--out", "bath.yaml"]].concat()),
        // A node that differs and one that is silent: the error counts.
        house.node(&[&["compare"], &FLAT[..], &["kept"]].concat()),
        house.node(&[&["restore"], &FLAT[..], &["kept"]].concat()),
        house.node(&[&["compare"], &FLAT[..], &["--node", "5", "kept"]].concat()),
        house.node(&["backup", "others.yaml", "--machine", "2", "--device", "heater", "--out", "none"]),
    ];
    assert_snapshot!("machine-silent", said.concat());
    assert!(files(&house.scratch.0).iter().all(|name| !name.starts_with("none")), "no half of a backup");
}

#[test]
fn no_node_is_written_to_when_a_file_is_wrong() {
    let house = House::new("machine-wrong", &FLAT);
    fs::create_dir(house.scratch.0.join("kept")).unwrap();
    let text = "od-parameters: 1\nparameters: {wanted temperature: 30.0 °C}\n";
    house.scratch.file("kept/bath-heater.yaml", text);
    let restore = [&["restore"], &FLAT[..], &["kept"]].concat();
    let mut said = vec![house.node(&restore)];
    house.scratch.file("kept/hall-warm.yaml", text.replace("30.0", "95.0"));
    house.scratch.file("kept/attic-heater.yaml", text);
    said.push(house.node(&restore));
    said.push(house.node(&[&["read"], &FLAT[..], &["--node", "5", "2000"]].concat()));
    house.scratch.file("kept/hall-warm.yaml", text);
    said.push(house.node(&restore));
    assert_snapshot!("machine-wrong", said.concat());
}

/// A turbine in a mixture is worse than one that was left as it was.
#[test]
fn no_node_is_written_to_before_all_can_be() {
    let house = House::new("machine-judged", &FLAT);
    house.scratch.file("other.od.yaml", HEATER.replace("product: 7", "product: 8"));
    let other =
        HOUSE.replace("{from: heater.od.yaml, device: heater}", "{from: other.od.yaml, device: heater}");
    house.scratch.file("other.yaml", other);
    fs::create_dir(house.scratch.0.join("kept")).unwrap();
    let file = |name: &str, value: &str| {
        let text = format!("od-parameters: 1\nparameters: {{wanted temperature: {value}}}\n");
        house.scratch.file(name, text);
    };
    file("kept/bath-heater.yaml", "30.0 °C");
    file("kept/hall-warm.yaml", "31.0 °C");
    let both = |house: &House| house.node(&[&["read"], &FLAT[..], &["--node", "5", "2000"]].concat());
    let of_other = ["other.yaml", "--machine", "2", "kept"];
    let mut said = vec![
        // The second node is another device.
        house.node(&[&["restore"], &of_other[..]].concat()),
        both(&house),
        // It has a limit below the value of its file.
        house.node(&[&["write"], &FLAT[..], &["--node", "6", "2000=10.0 °C", "2001=20.0 °C"]].concat()),
        house.node(&[&["restore"], &FLAT[..], &["kept"]].concat()),
        both(&house),
        house.node(&[&["restore"], &FLAT[..], &["kept", "--skip", "6"]].concat()),
        both(&house),
        house.node(&[&["compare"], &FLAT[..], &["kept", "--skip", "9"]].concat()),
        house.node(&[&["compare"], &FLAT[..], &["kept", "--skip", "5", "--skip", "6"]].concat()),
        house.node(&[&["backup"], &of_other[..3], &["--out", "rest", "--skip", "6"]].concat()),
        house.node(&["backup", "heater.od.yaml", "--out", "one.yaml", "--skip", "6"]),
    ];
    // One question for all.
    house.node(&[&["write"], &FLAT[..], &["--node", "6", "2001=60.0 °C"]].concat());
    file("kept/bath-heater.yaml", "20.0 °C");
    said.push(house.unasked(&[&["restore"], &FLAT[..], &["kept"]].concat()));
    said.push(house.unasked(&[&["restore"], &FLAT[..], &["kept", "--dry-run"]].concat()));
    assert_snapshot!("machine-judged", said.concat());
}

#[test]
fn the_node_that_is_meant_is_asked_for() {
    let house = House::new("machine-which", &FLAT);
    let said = [
        house.node(&["read", "house.yaml", "2000"]),
        house.node(&["read", "house.yaml", "--machine", "2", "2000"]),
        house.node(&["read", "house.yaml", "--machine", "3", "2000"]),
        house.node(&["read", "house.yaml", "--machine", "2", "--node", "9", "2000"]),
        house.node(&["read", "house.yaml", "--machine", "2", "--node", "6", "--device", "heater", "2000"]),
        house.node(&["read", "house.yaml", "--machine", "cellar", "--device", "heater", "2000"]),
        house.node(&["compare", "house.yaml", "--machine", "2", "--node", "9", "."]),
        house.node(&["read", "heater.od.yaml", "--node", "5", "--machine", "2", "2000"]),
    ];
    assert_snapshot!("machine-which", said.concat());
}
