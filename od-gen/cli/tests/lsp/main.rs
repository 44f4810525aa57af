//! `odgen lsp` as editors meet it: sessions over standard input and output.

#![expect(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]

mod actions;
mod client;
mod diagnostics;
mod endurance;
mod foreign;
mod layout;
mod names;
mod nodes;
mod protocol;
mod random;
mod structure;

const PITCH: &str = include_str!("../../../../od-spec/devices/pitch-control-system.od.yaml");

/// A lamp, with a sign that is two bytes and one unit of UTF-16, and one that is four and two.
const LAMP: &str = "\
od-spec: 1
title: Lamp 🌀
uses: [cia301]
devices:
  lamp: {name: Lamp, bit-rates: [125, 500], features: [heartbeat producer]}
units:
  celsius: {symbol: °C, about: \"🌀\"}
objects:
  0x2000: {name: brightness, type: unsigned8, access: rw, pdo: receive, default: 80, max: 100}
  0x2001: {name: temperature °, type: integer8, unit: celsius, access: ro}
pdos:
  lamp:
    receive: {1: {map: [brightness]}}
";

/// A diagnostic in short: code, and where it begins and ends.
fn short(diagnostic: &serde_json::Value) -> String {
    let range = &diagnostic["range"];
    format!(
        "{} {}:{}-{}:{}",
        diagnostic["code"].as_str().unwrap(),
        range["start"]["line"],
        range["start"]["character"],
        range["end"]["line"],
        range["end"]["character"]
    )
}
