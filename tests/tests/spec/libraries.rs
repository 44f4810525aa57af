//! The libraries hold together: every feature alone, and everything of a library in one device.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::BTreeSet;
use std::fmt::Write as _;

use od_spec::model::{Fact, Index, System};
use od_spec::source::SourceMap;
use od_spec::{Compiled, LIBRARIES, NoFiles, compile};

fn library(name: &str) -> &'static str {
    LIBRARIES.iter().find(|(known, _)| *known == name).unwrap().1
}

/// The keys of one of a library's maps, as they are at the margin of the map.
fn keys(text: &str, map: &str) -> Vec<String> {
    let start = text.find(&format!("\n{map}:\n")).unwrap() + map.len() + 3;
    let lines = text[start..].lines().take_while(|line| line.is_empty() || line.starts_with(' '));
    let keys = lines.filter_map(|line| line.strip_prefix("  ").filter(|line| !line.starts_with([' ', '#'])));
    keys.filter_map(|line| line.split_once(':')).map(|(key, _)| key.trim().to_owned()).collect()
}

/// The indices that a feature lists.
fn objects_of(text: &str, feature: &str) -> Vec<u16> {
    let start = text.find(&format!("\n  {feature}:")).unwrap();
    let list = &text[start + text[start..].find("objects: [").unwrap()..];
    let list = &list["objects: [".len()..list.find(']').unwrap()];
    list.split(", ").map(|index| u16::from_str_radix(index.trim_start_matches("0x"), 16).unwrap()).collect()
}

/// Warnings that a feature without its companions deserves: nothing that a mandatory feature would bring, objects for PDOs without
/// PDOs, guarding together with a heartbeat, constants without the device's value, nothing to store, and a choice that
/// the device has to make.
const USEFUL_WITH_MORE: [&str; 7] = ["OD0801", "OD0802", "OD0803", "OD0805", "OD0809", "OD0837", "OD0885"];

/// The system, and the messages one per line.
fn compiled(text: &str) -> (Option<System>, String) {
    let mut sources = SourceMap::new();
    let root = sources.add("drive.od.yaml", text);
    let Compiled { system, diagnostics, .. } = compile(&mut sources, root, &mut NoFiles);
    let mut messages = String::new();
    for one in &diagnostics {
        writeln!(messages, "{}: {}", one.code, one.message).unwrap();
    }
    (system, messages)
}

/// What only the device can say: capacities of texts, and the supported modes.
const DEVICE_OBJECTS: &str = "
  0x6403: {from: cia402, capacity: 40}
  0x6404: {from: cia402, capacity: 40}
  0x6405: {from: cia402, capacity: 40}
  0x6503: {from: cia402, capacity: 40}
  0x6504: {from: cia402, capacity: 40}
  0x6505: {from: cia402, capacity: 40}
  0x6502: {from: cia402, default: 0x3EF}
  0x60D0: {from: cia402, array: {elements: {1: {default: 1}, 2: {default: 1}}}}
  0x68D0: {from: cia402, array: {elements: {1: {default: 1}, 2: {default: 1}}}}
";

fn head(library: &str, features: &str) -> String {
    let library = if library == "cia301" { "cia402" } else { library };
    format!(
        "od-spec: 1\ntitle: Drive\nuses: [cia301, {library}]\ndevices:\n  drive: {{name: Drive, bit-rates: [125], features: [{features}]}}\n"
    )
}

/// A feature with what has to be stated for it: the number of its channels, or of those of another one.
fn selected(text: &str, feature: &str) -> String {
    let of = |key: &str| {
        let (_, features) = text.split_once("\nfeatures:").unwrap();
        let (_, line) = features.split_once(&format!("\n  {feature}:")).unwrap();
        let (_, value) = line.lines().next().unwrap().split_once(&format!(" {key}: "))?;
        value.split([',', '}']).next()
    };
    match (of("channels-of"), of("channels")) {
        (Some(other), _) => format!("{other}: 20, {feature}"),
        (None, Some(_)) => format!("{feature}: 20"),
        (None, None) => feature.to_owned(),
    }
}

#[test]
fn every_feature_can_be_taken_alone() {
    for (name, text) in LIBRARIES {
        let features = keys(text, "features");
        assert!(features.len() > 15, "{features:?}");
        for feature in features {
            let selected = selected(text, &feature);
            let heartbeat = if selected == "heartbeat producer" { "" } else { "heartbeat producer, " };
            let (system, messages) = compiled(&head(name, &format!("{heartbeat}{selected}")));
            let device = &system.unwrap_or_else(|| panic!("{feature}: {messages}")).devices[0];
            for index in objects_of(library(name), &feature) {
                assert!(device.objects.contains_key(&Index(index)), "{feature}: {index:04X}h");
            }
            // A device whose feature is there for others may lack what makes it useful; nothing else is to be said.
            for line in messages.lines() {
                assert!(USEFUL_WITH_MORE.iter().any(|code| line.starts_with(code)), "{feature}: {line}");
            }
        }
    }
}

#[test]
fn everything_of_cia402_on_two_axes_in_one_device() {
    let text = library("cia402");
    let features = keys(text, "features");
    let both = features.iter().cloned().chain(features.iter().map(|feature| format!("{feature} axis 2")));
    let both: Vec<String> = both.collect();
    let mut spec = head("cia402", &format!("heartbeat producer, emergency, {}", both.join(", ")));
    spec = spec.replace("{name: Drive, ", "{name: Drive, device-type: 0x0002_0192, ");
    spec.push_str("objects:");
    spec.push_str(DEVICE_OBJECTS);
    let objects = keys(text, "objects");
    assert!(objects.len() > 150, "{}", objects.len());
    for index in objects.iter().filter(|index| !DEVICE_OBJECTS.contains(*index)) {
        writeln!(spec, "  {index}: {{from: cia402}}").unwrap();
    }
    let pdos = "{receive: {1: {map: [Controlword]}}, transmit: {1: {map: [Statusword]}}}";
    write!(spec, "pdos:\n  drive: {pdos}\nerrors:\n").unwrap();
    let errors = keys(text, "errors");
    assert!(errors.len() > 100, "{}", errors.len());
    for code in &errors {
        writeln!(spec, "  {code}: {{from: cia402}}").unwrap();
    }
    spec.push_str("state-machines:\n  power drive system: {from: cia402}\n");
    let (system, messages) = compiled(&spec);
    assert_eq!(messages, "");
    let system = system.unwrap();
    let of = |range: std::ops::RangeInclusive<u16>| {
        system.devices[0].objects.keys().filter(|index| range.contains(&index.0)).count()
    };
    assert_eq!(of(0x6000..=0x67FF), objects.len());
    assert!(of(0x6800..=0x6FFF) > 130, "{}", of(0x6800..=0x6FFF));
    // Runs of codes count one by one.
    assert!(system.errors.len() >= errors.len());
    assert_eq!(system.machines["power drive system"].transitions.len(), 17);
    // Type and access of every value come from the library.
    for (id, object, entry) in system.devices[0].entries().filter(|(id, ..)| id.index.0 >= 0x6000) {
        if object.is_structured() && id.sub.0 == 0 {
            continue;
        }
        assert!(
            entry.is_only_standard(Fact::Type) && entry.is_only_standard(Fact::Access),
            "{id}: {:?}",
            entry.facts
        );
    }
}

/// The devices of the other two libraries with everything that these have.
#[test]
fn everything_of_cia302_and_cia401_in_one_device() {
    for (name, profile) in [("cia302", 0), ("cia401", 0x000F_0191)] {
        let text = library(name);
        let features: BTreeSet<String> = keys(text, "features")
            .iter()
            .flat_map(|feature| selected(text, feature).split(", ").map(str::to_owned).collect::<Vec<_>>())
            .collect();
        let features: Vec<String> = features.into_iter().collect();
        let mut spec = head(name, &format!("heartbeat producer, {}", features.join(", ")));
        spec = spec.replace("{name: Drive, ", &format!("{{name: Drive, device-type: {profile}, "));
        let pdos = "{receive: {1: {map: [0x6200.1]}}, transmit: {1: {map: [0x6000.1]}}}";
        if name == "cia401" {
            write!(spec, "pdos:\n  drive: {pdos}\n").unwrap();
        }
        let (system, messages) = compiled(&spec);
        assert_eq!(messages, "", "{name}");
        let device = &system.unwrap().devices[0];
        let own =
            device.objects.values().filter(|object| object.index.0 >= 0x1F00 && object.index.0 < 0xA000);
        assert_eq!(own.count(), keys(text, "objects").len(), "{name}");
    }
}

/// Of 20 channels in elements of 8, 16 and 32.
#[test]
fn channels_fill_elements() {
    let features = [
        ("digital inputs 8-bit: 20, digital input polarity 8-bit", [0x6000, 0x6002], 3),
        ("digital inputs 16-bit: 20, digital input filter 16-bit", [0x6100, 0x6103], 2),
        ("digital outputs 32-bit: 20, digital output polarity 32-bit", [0x6320, 0x6322], 1),
        ("analogue inputs 16-bit: 20, analogue input SI unit", [0x6401, 0x6430], 20),
        ("analogue inputs 16-bit: 33, analogue input interrupt source", [0x6422, 0x6422], 2),
    ];
    for (features, indices, count) in features {
        let (system, messages) = compiled(&head("cia401", &format!("heartbeat producer, {features}")));
        let device = &system.unwrap_or_else(|| panic!("{messages}")).devices[0];
        for index in indices {
            assert_eq!(device.objects[&Index(index)].entries.len(), count + 1, "{features}: {index:04X}h");
        }
    }
}
