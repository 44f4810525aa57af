//! The shipped devices, and one with every data type and every object of the communication profile, come back as they were.

use od_spec::model::{Document, System};

use super::likeness::{difference, enriched};
use super::texts::{PITCH, in_one_file};
use super::{model, written};

/// A device, the specification that it is in, and where a library says more than that.
type Shipped = (&'static str, fn() -> String, &'static [&'static str]);

const DEVICES: [Shipped; 4] = [
    ("pmm", || PITCH.clone(), &["1003h.1: meaning"]),
    ("pmc", || PITCH.clone(), &["1003h.1: meaning", "6067h: special", "6865h: special"]),
    ("fullmo", || in_one_file("fullmo-drive"), &[]),
    ("everything", || include_str!("../../../../tests/readers/everything.od.yaml").to_owned(), &[]),
];

/// One device as an EDS could hold it: without the manual, state machines, constraints, and views of other entries.
fn stripped(mut system: System, key: &str) -> System {
    system.devices.retain(|device| device.key == key);
    system.document = Document::default();
    system.errors.clear();
    system.machines.clear();
    system.constraints.clear();
    system.errata.clear();
    for object in system.devices[0].objects.values_mut() {
        object.entries.iter_mut().for_each(|entry| entry.alias = None);
    }
    system
}

/// The EDS of the device, section by section, each with the comments above it. Whether the maker or the standard states a default
/// is not distinguished: what both say is written once, with the library.
fn sections(system: &System) -> Vec<String> {
    let eds = String::from_utf8(od_formats::eds::write_eds(system, &system.devices[0])).unwrap();
    let lines = eds.replace("\r\n;   ", " ").replace("default of the standard", "factory default");
    lines.split("\r\n\r\n").map(ToOwned::to_owned).collect()
}

/// `[1003sub1]` of `1003h.1: meaning`.
fn header(entry: &str) -> String {
    let id = entry.split(':').next().unwrap();
    match id.split_once("h.") {
        Some((index, sub)) => format!("[{index}sub{:X}]", sub.parse::<u8>().unwrap()),
        None => format!("[{}]", id.trim_end_matches('h')),
    }
}

#[test]
fn what_is_written_is_what_was_there() {
    for (key, text, more) in DEVICES {
        let original = stripped(model(&text()), key);
        let specification = written(&original);
        if let Ok(path) = std::env::var("WRITTEN") {
            std::fs::write(format!("{path}/{key}.od.yaml"), &specification.text).unwrap();
        }
        assert_eq!(specification.repairs, [], "{key}");
        assert_eq!(specification.left_out, [""; 0], "{key}");
        let again = model(&specification.text);
        assert_eq!(difference(&original, &again), None, "{key}");
        assert_eq!(enriched(&original, &again), more, "{key}");
        // Where a library says more, the section has a comment and another notation of the value.
        let richer = |section: &str| more.iter().any(|entry| section.contains(&header(entry)));
        let (sections, again_sections) = (sections(&original), sections(&again));
        assert_eq!(sections.len(), again_sections.len(), "{key}");
        for (section, again) in sections.iter().zip(&again_sections) {
            assert!(section == again || richer(section), "{key}:\n{section}\n{again}");
        }
        assert_eq!(written(&again).text, specification.text, "{key}");
    }
}
