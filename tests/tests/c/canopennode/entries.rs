//! What every entry is, worked out from the JSON dump: kind of object, attributes, length and bytes.

use std::collections::BTreeMap;

use od_tests::root;
use serde_json::Value as Json;

use crate::canopennode::project::{Project, of_text, of_workspace};

#[test]
fn every_entry_of_the_shipped_devices_is_what_the_dump_says() {
    for (stem, least) in [("pitch-control-system", 150), ("fullmo-drive", 150)] {
        for project in of_workspace(&format!("od-spec/devices/{stem}.od.yaml")) {
            compare(&project, least);
        }
    }
}

#[test]
fn every_entry_of_a_device_with_every_type_is_what_the_dump_says() {
    for stem in ["everything", "limits"] {
        for project in of_workspace(&format!("tests/readers/{stem}.od.yaml")) {
            compare(&project, 40);
        }
    }
}

#[test]
fn every_entry_of_an_eds_is_what_the_dump_says() {
    for key in ["pmc", "pmm", "fullmo"] {
        let text = std::fs::read_to_string(root().join(format!("generated/eds/{key}.eds"))).unwrap();
        compare(&of_text(&format!("{key}.eds"), &text), 150);
    }
}

/// Compares what the dictionary in C has with the dump.
fn compare(project: &Project, least: usize) {
    let found = project.run("list_entries.c", &[]);
    let expected = expected(&project.device);
    let found: BTreeMap<&str, &str> = found.lines().map(split).collect();
    let expected: BTreeMap<&str, &str> = expected.iter().map(|line| split(line)).collect();
    for (what, facts) in &expected {
        assert_eq!(found.get(what), Some(facts), "{}: {what}", project.key());
    }
    assert_eq!(found.len(), expected.len(), "{}: more than the dump has", project.key());
    assert!(expected.len() >= least, "{} lines only", expected.len());
}

/// `entry 1018 1`, and the rest.
fn split(line: &str) -> (&str, &str) {
    let words = if line.starts_with("entry") { 3 } else { 2 };
    let at = line.match_indices(' ').nth(words - 1).map_or(line.len(), |(at, _)| at);
    (&line[..at], line[at..].trim_start())
}

/// The lines that `list_entries.c` has to print.
fn expected(device: &Json) -> Vec<String> {
    let mut lines = Vec::new();
    for object in device["objects"].as_array().unwrap() {
        let index = object["index"].as_str().unwrap().trim_start_matches("0x").to_owned();
        let entries = object["entries"].as_array().unwrap();
        lines.push(format!("object {index} {} {}", kind(object, entries), entries.len()));
        for entry in entries {
            let is_command = command(device, &index, entry);
            let bytes = bytes(&index, entry).map(|bytes| if is_command { vec![1, 0, 0, 0] } else { bytes });
            lines.push(format!(
                "entry {index} {} {:02X} {} {}",
                entry["sub"],
                attributes(entry),
                length(entry),
                bytes.map_or("-".to_owned(), |bytes| hex(&bytes))
            ));
        }
    }
    lines
}

/// Whether an entry is a command that stores or restores something, and the dictionary has no value that says so.
fn command(device: &Json, index: &str, entry: &Json) -> bool {
    let groups: &[&str] = match entry["sub"].as_u64().unwrap() {
        1 => &["communication", "application", "manufacturer"],
        2 => &["communication"],
        3 => &["application"],
        4 => &["manufacturer"],
        _ => &[],
    };
    let objects = device["objects"].as_array().unwrap();
    let mut entries = objects.iter().flat_map(|object| object["entries"].as_array().unwrap());
    ["1010", "1011"].contains(&index)
        && entry["default"].is_null()
        && entries.any(|entry| groups.contains(&text(entry, "stored")))
}

/// VAR 1, ARRAY 2, RECORD 3: an ARRAY has equal elements without a gap, which lie together.
fn kind(object: &Json, entries: &[Json]) -> u8 {
    let facts = |entry: &Json| {
        ["type", "access", "pdo", "stored"].map(|fact| entry[fact].to_string()).join(" ")
            + &length(entry).to_string()
    };
    match object["kind"].as_str().unwrap() {
        "array" => {
            let subs = entries.iter().map(|entry| entry["sub"].as_u64().unwrap());
            let are_alike = entries
                .get(1)
                .is_some_and(|first| entries[1..].iter().all(|entry| facts(entry) == facts(first)));
            let are_values = entries.iter().all(|entry| entry.get("alias").is_none());
            if are_alike && are_values && subs.eq(0..entries.len() as u64) { 2 } else { 3 }
        }
        "record" => 3,
        _ => 1,
    }
}

fn attributes(entry: &Json) -> u8 {
    let (access, mapping, name) = (text(entry, "access"), text(entry, "pdo"), text(entry, "type"));
    let read = u8::from(access != "wo");
    let write = if matches!(access, "ro" | "const") { 0 } else { 0x02 };
    let mapping = match mapping {
        "transmit" => 0x04,
        "receive" => 0x08,
        "both" => 0x0C,
        _ => 0,
    };
    // Numbers whose bytes a processor may have in another order.
    let multi_byte = ["16", "32", "64"].iter().any(|bits| name.ends_with(bits));
    // A text to the stack ends at its first byte of 0.
    let string = name == "visible-string";
    read | write | mapping | if multi_byte { 0x40 } else { 0 } | if string { 0x80 } else { 0 }
}

/// Bytes on the bus; of a string, how many there may be.
fn length(entry: &Json) -> usize {
    let name = text(entry, "type");
    let digits: String = name.chars().filter(char::is_ascii_digit).collect();
    let default = default(entry).map_or(0, |bytes| bytes.len());
    match name {
        "boolean" => 1,
        "time-of-day" | "time-difference" => 6,
        "domain" => 0,
        "visible-string" | "octet-string" | "unicode-string" => {
            let capacity = entry["capacity"].as_u64().and_then(|bytes| usize::try_from(bytes).ok());
            match (text(entry, "access"), capacity) {
                ("const", _) if !entry["default"].is_null() => {
                    default.max(usize::from(name != "octet-string"))
                }
                (_, Some(capacity)) => capacity,
                // An EDS says no capacity: a text gets room for 32 bytes, bytes stay as many as there are.
                (_, None) if name == "octet-string" && default > 0 => default,
                (_, None) => default.max(32),
            }
        }
        _ => digits.parse::<usize>().unwrap() / 8,
    }
}

/// The bytes in memory; none of what lies nowhere.
fn bytes(index: &str, entry: &Json) -> Option<Vec<u8>> {
    if entry.get("alias").is_some() || index == "1003" || length(entry) == 0 {
        return None;
    }
    let is_cob_id = (index.starts_with("14")
        || index.starts_with("15")
        || index.starts_with("18")
        || index.starts_with("19"))
        && entry["sub"] == 1;
    // A PDO for whose COB-ID no value is stated does not exist.
    let without = if is_cob_id { vec![0, 0, 0, 0x80] } else { Vec::new() };
    let mut bytes = default(entry).unwrap_or(without);
    bytes.resize(length(entry), 0);
    Some(bytes)
}

/// The default on the bus, without the node-ID.
fn default(entry: &Json) -> Option<Vec<u8>> {
    let (default, name) = (&entry["default"], text(entry, "type"));
    if default.is_null() {
        return None;
    }
    let raw = &default["raw"];
    let said = default["text"].as_str();
    Some(match name {
        "visible-string" => said?.bytes().collect(),
        "unicode-string" => said?.encode_utf16().flat_map(u16::to_le_bytes).collect(),
        "octet-string" => {
            let digits: Vec<char> = said?.chars().filter(char::is_ascii_hexdigit).collect();
            digits
                .chunks(2)
                .map(|pair| u8::from_str_radix(&pair.iter().collect::<String>(), 16).unwrap())
                .collect()
        }
        "real32" => default["text"].as_str()?.parse::<f32>().ok()?.to_le_bytes().to_vec(),
        "real64" => default["text"].as_str()?.parse::<f64>().ok()?.to_le_bytes().to_vec(),
        _ => {
            let number = raw.as_i64().map(i128::from).or_else(|| raw.as_u64().map(i128::from));
            let number = number.or_else(|| raw.as_str()?.parse().ok())?;
            let digits: String = name.chars().filter(char::is_ascii_digit).collect();
            let width = digits.parse::<usize>().map_or(1, |bits| bits / 8);
            number.to_le_bytes()[..width].to_vec()
        }
    })
}

fn text<'j>(entry: &'j Json, fact: &str) -> &'j str {
    entry[fact].as_str().unwrap_or_default()
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02X}")).collect::<Vec<_>>().join(" ")
}
