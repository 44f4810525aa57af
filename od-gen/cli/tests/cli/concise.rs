//! `odgen dcf --concise` and `odgen concise`.

use std::fs;

use insta::assert_snapshot;
use serde_json::Value as Json;

use crate::{Scratch, code, files, odgen, stderr, stdout};

/// With an entry of each kind that a record can be wrong about.
const HEATER: &str = "\
od-spec: 1
title: Heater
uses: [cia301]
devices:
  heater: {name: Heater, bit-rates: [125], features: [heartbeat producer, emergency]}
units:
  decicelsius: {symbol: °C, scale: 1/10}
types:
  mode: {base: unsigned8, values: {0: off, 1: manual, 2: {name: automatic, supported: no}}}
  outputs:
    base: unsigned8
    bits: {0: fan, 1: coil, 2..3: {name: stage, values: {1: low, 2: high}}, 4..7: unused}
objects:
  0x2000: {name: mode of operation, type: mode, access: rw, default: off}
  0x2001:
    name: temperature
    type: integer16
    unit: decicelsius
    access: rw
    record:
      1: {name: target, default: 20.0 °C, min: 5.0 °C, max: 40.0 °C, special: {32767: no limit}}
      2: {name: measured, access: ro}
  0x2002: {name: calibration, type: unsigned24, access: rw locked, default: 100}
  0x2003: {name: outputs, type: outputs, access: rw, pdo: receive, default: 0}
  0x2004: {name: label, type: visible-string, access: rw, capacity: 8}
  0x2005: {name: running, type: boolean, access: rw}
  0x2006: {name: gain, type: real32, access: rw, default: 1.0, min: 0.0, max: 2.0}
  0x2007: {name: program, type: domain, access: rw}
pdos:
  heater: {receive: {1: {map: [outputs]}}}
";

/// A concise DCF by its records.
fn laid_out(records: &[(u16, u8, &[u8])]) -> Vec<u8> {
    let mut bytes = u32::try_from(records.len()).unwrap().to_le_bytes().to_vec();
    for (index, sub, value) in records {
        bytes.extend(index.to_le_bytes());
        bytes.push(*sub);
        bytes.extend(u32::try_from(value.len()).unwrap().to_le_bytes());
        bytes.extend(*value);
    }
    bytes
}

fn scratch(name: &str) -> Scratch {
    let scratch = Scratch::new(name);
    scratch.file("heater.od.yaml", HEATER);
    scratch
}

#[test]
fn a_concise_dcf_is_written_with_the_dcf_or_neither() {
    let scratch = scratch("concise");
    let dcf = |more: &[&str]| {
        let start = ["dcf", "heater.od.yaml", "--node", "5", "--concise", "--set", "1400.2=1"];
        let settings =
            ["--set", "temperature.target=21.5 °C", "--set", "outputs=0x06", "--set", "label=north"];
        odgen(&scratch.0, &[&start[..], &settings, more].concat())
    };
    let output = dcf(&[]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert_snapshot!("written", stdout(&output));
    assert_eq!(files(&scratch.0), [".odgen-files", "heater-5.bin", "heater-5.dcf", "heater.od.yaml"]);
    let expected = laid_out(&[
        (0x1400, 1, &[5, 2, 0, 0x80]),
        (0x1400, 2, &[1]),
        (0x2001, 1, &[215, 0]),
        (0x2003, 0, &[6]),
        (0x2004, 0, b"north"),
        (0x1400, 1, &[5, 2, 0, 0]),
    ]);
    assert_eq!(fs::read(scratch.0.join("heater-5.bin")).unwrap(), expected);
    // Again over its own files, and under another name.
    assert_eq!(code(&dcf(&[])), 0);
    assert_eq!(code(&dcf(&["--out", "plant/north.dcf"])), 0);
    assert_eq!(fs::read(scratch.0.join("plant/north.bin")).unwrap(), expected);
    // One that is there and not ours keeps both away.
    scratch.file("mine.bin", "mine");
    let output = dcf(&["--out", "mine.dcf"]);
    assert_eq!(code(&output), 1);
    assert!(stderr(&output).contains("mine.bin: it is there, and nothing in it says that odgen made it"));
    assert!(!scratch.0.join("mine.dcf").exists());
    // It takes the place of no file that it is made from.
    scratch.file("set.bin", "2005=1\n");
    let output = dcf(&["--set-file", "set.bin", "--out", "set.dcf", "--force"]);
    assert!(
        stderr(&output).contains("cannot write `set.bin`: the DCF is made from this file"),
        "{}",
        stderr(&output)
    );
}

#[test]
fn records_are_shown_with_what_the_device_refuses() {
    let scratch = scratch("concise-show");
    let show = |more: &[&str]| {
        odgen(&scratch.0, &[&["concise", "show", "node.bin", "heater.od.yaml"], more].concat())
    };
    scratch.file(
        "node.bin",
        laid_out(&[
            (0x1400, 1, &[5, 2, 0, 0x80]),
            (0x2000, 0, &[1]),
            (0x2001, 1, &[215, 0]),
            (0x2003, 0, &[0x0B]),
            (0x2004, 0, b"north"),
            (0x2005, 0, &[1]),
            (0x2006, 0, &0.1f32.to_le_bytes()),
            (0x2007, 0, &[7; 20]),
            (0x1400, 1, &[5, 2, 0, 0]),
        ]),
    );
    let output = show(&["--node", "5"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert_snapshot!("taken", stdout(&output));
    assert_snapshot!("settings", stdout(&show(&["--format", "settings"])));
    // What is shown as settings makes the same values again.
    scratch.file("settings.txt", &show(&["--format", "settings"]).stdout);
    let again = ["dcf", "heater.od.yaml", "--node", "5", "--set-file", "settings.txt", "--concise"];
    let output = odgen(&scratch.0, &again);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let again =
        odgen(&scratch.0, &["concise", "show", "heater-5.bin", "heater.od.yaml", "--format", "settings"]);
    let values = |text: &str| {
        text.lines().filter(|line| !line.starts_with('#')).map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(values(&stdout(&again)), values(&fs::read_to_string(scratch.0.join("settings.txt")).unwrap()));
    scratch.file(
        "node.bin",
        laid_out(&[
            (0x2000, 0, &[2]),
            (0x2000, 0, &[3]),
            (0x2001, 1, &[0xFF, 0x7F]),
            (0x2001, 1, &[0x91, 1]),
            (0x2001, 2, &[0, 0]),
            (0x2001, 3, &[0, 0]),
            (0x2002, 0, &[100, 0, 0, 0]),
            (0x2004, 0, b"much too long"),
            (0x2004, 0, &[0xE9]),
            (0x2005, 0, &[2]),
            (0x2006, 0, &f32::NAN.to_le_bytes()),
            (0x2006, 0, &2.5f32.to_le_bytes()),
            (0x3000, 0, &[]),
        ]),
    );
    let output = show(&[]);
    assert_eq!(code(&output), 1);
    assert_snapshot!("refused", stdout(&output));
    let json: Json = serde_json::from_slice(&show(&["--format", "json"]).stdout).unwrap();
    let kinds: Vec<&str> = json["records"]
        .as_array()
        .unwrap()
        .iter()
        .flat_map(|record| record["remarks"].as_array().unwrap())
        .map(|remark| remark["kind"].as_str().unwrap())
        .collect();
    let expected = [
        "not-supported",
        "not-in-enum",
        "outside-limits",
        "not-writable",
        "no-entry",
        "locked",
        "length",
        "too-long",
        "no-value",
        "no-value",
        "no-value",
        "outside-limits",
        "no-object",
    ];
    assert_eq!(kinds, expected);
    assert_eq!(json["records"][2]["text"], "32767 (no limit)");
    assert_eq!((&json["fault"], &json["stated"]), (&Json::Null, &Json::from(13)));
}

#[test]
fn what_can_be_read_of_a_broken_file_is_shown() {
    let scratch = scratch("concise-broken");
    let whole = laid_out(&[(0x2000, 0, &[1]), (0x2001, 1, &[215, 0])]);
    scratch.file("node.bin", &whole[..whole.len() - 1]);
    let show = |more: &[&str]| {
        odgen(&scratch.0, &[&["concise", "show", "node.bin", "heater.od.yaml"], more].concat())
    };
    let output = show(&[]);
    assert_eq!(code(&output), 1);
    assert_snapshot!("broken", stdout(&output) + &stderr(&output));
    let json: Json = serde_json::from_slice(&show(&["--format", "json"]).stdout).unwrap();
    assert_eq!((&json["fault"]["offset"], &json["fault"]["code"]), (&Json::from(12), &Json::from("OD0712")));
    let missing = odgen(&scratch.0, &["concise", "show", "none.bin", "heater.od.yaml"]);
    assert!(stderr(&missing).starts_with("error[OD0101]: cannot read none.bin: no such file"));
    // An EDS or DCF is as good as a specification.
    scratch.file("node.bin", &whole);
    assert_eq!(code(&odgen(&scratch.0, &["dcf", "heater.od.yaml", "--node", "5"])), 0);
    let by_dcf = odgen(&scratch.0, &["concise", "show", "node.bin", "heater-5.dcf"]);
    assert_eq!(code(&by_dcf), 0, "{}", stderr(&by_dcf));
    assert!(stdout(&by_dcf).contains("temperature: target  D7 00  21.5 °C"), "{}", stdout(&by_dcf));
}
