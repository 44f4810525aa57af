//! `odgen node scan --write-spec`, against `odgen serve`.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::net::TcpStream;
use std::path::Path;
use std::process::Stdio;
use std::time::Duration;

use od_bus::client::{Client, SlcanBus};
use od_spec::eds::Document;
use od_spec::model::{EntryId, Index, SubIndex};
use od_spec::source::SourceMap;

use crate::node::HEATER;
use crate::relay::Relay;
use crate::served::Served;
use crate::{PITCH, Scratch, code, odgen, stderr, stdout};

const FULLMO: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../od-spec/devices/fullmo-drive.od.yaml");
const NASTY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/shared/nasty.od.yaml");
const PDOS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/shared/pdos-in-full.od.yaml");

/// An EDS: the keys of its sections about objects, by section.
fn objects(text: &str) -> BTreeMap<String, BTreeMap<String, String>> {
    let mut sources = SourceMap::new();
    let file = sources.add("device.eds", text);
    let document = Document::scan(file, text);
    let is_object = |name: &str| {
        let index = name.split("sub").next().unwrap_or_default();
        index.len() == 4 && u16::from_str_radix(index, 16).is_ok()
    };
    let sections = document.sections().filter(|section| is_object(section.name()));
    let keys = |section: &od_spec::eds::SectionRef<'_, '_>| {
        let key = |line: &od_spec::eds::Line<'_>| Some((line.key()?.to_owned(), line.value()?.to_owned()));
        section.keys().filter_map(key).collect()
    };
    sections.map(|section| (section.name().to_owned(), keys(&section))).collect()
}

/// Bytes of a type of an EDS; `None` where it varies.
fn length(data_type: &str) -> Option<u16> {
    let code = u16::from_str_radix(data_type.trim_start_matches("0x"), 16).unwrap();
    od_spec::model::DataType::from_code(code).unwrap().bits().map(|bits| bits.div_ceil(8))
}

/// The EDS of a device that `odgen build` makes.
fn eds(scratch: &Scratch, specification: &str, key: &str) -> String {
    let built = odgen(&scratch.0, &["build", specification, "--out", "built"]);
    assert_eq!(code(&built), 0, "{}", stderr(&built));
    fs::read_to_string(scratch.0.join(format!("built/eds/{key}.eds"))).unwrap()
}

/// Makes a specification of a virtual node, and compares its EDS with that of the node's own.
fn is_described(name: &str, specification: &str, key: &str, ranges: &[&str]) {
    let scratch = Scratch::new(name);
    let served = Served::start(&scratch, &[specification, "--node", &format!("5={key}")], Stdio::null());
    let ranges: Vec<&str> = ranges.iter().flat_map(|range| ["--range", range]).collect();
    let scan = ["node", "scan", "--write-spec", "made.od.yaml", "--slcan", served.address()];
    let made = odgen(&scratch.0, &[&scan, ranges.as_slice()].concat());
    assert_eq!((code(&made), stderr(&made).as_str()), (0, ""), "{}", stdout(&made));
    let checked = odgen(&scratch.0, &["check", "made.od.yaml"]);
    assert_eq!(code(&checked), 0, "{}", stderr(&checked));
    let (own, made) =
        (objects(&eds(&scratch, specification, key)), objects(&eds(&scratch, "made.od.yaml", "made")));
    assert_eq!(made.keys().collect::<Vec<_>>(), own.keys().collect::<Vec<_>>());
    let checked = odgen(&scratch.0, &["check", "built/eds/made.eds"]);
    assert_eq!(code(&checked), 0, "{}", stderr(&checked));
    for (section, own) in &own {
        let made = &made[section];
        let (Some(data_type), Some(made_type)) = (own.get("DataType"), made.get("DataType")) else {
            // What has parts.
            assert!(own.contains_key("SubNumber") && made.contains_key("SubNumber"), "{section}");
            assert_eq!(own["SubNumber"], made["SubNumber"], "{section}");
            continue;
        };
        if let (Some(own), Some(made)) = (length(data_type), length(made_type)) {
            assert_eq!(made, own, "{section}: {data_type} {made_type}");
        }
        let access = |eds: &BTreeMap<String, String>| eds["AccessType"] == "wo";
        assert_eq!(access(made), access(own), "{section}");
        let index = u16::from_str_radix(&section[..4], 16).unwrap();
        if let (0x1400..0x1C00, Some(own)) = (index, own.get("DefaultValue")) {
            assert_eq!(made.get("DefaultValue"), Some(own), "{section}");
        }
    }
}

#[test]
fn a_specification_of_a_node_has_the_objects_of_its_own() {
    is_described("specify-pmc", PITCH, "pmc", &["2030h", "5040h..58FFh", "6007h..68F4h"]);
}

#[test]
fn a_drive_is_described_by_what_it_answers() {
    is_described("specify-fullmo", FULLMO, "fullmo", &["3402h..3519h", "6040h..60FFh"]);
}

#[test]
fn names_that_are_hard_and_pdos_of_bits_are_no_matter() {
    is_described("specify-nasty", NASTY, "nasty", &["2000h..201Fh"]);
}

#[test]
fn all_parameters_of_pdos_are_found() {
    is_described("specify-pdos", PDOS, "odd", &["2000h..2010h"]);
}

/// A bus with a heater as node 5, and other nodes.
fn heaters(name: &str, nodes: &[&str]) -> (Scratch, Served) {
    let scratch = Scratch::new(name);
    scratch.file("heater.od.yaml", HEATER);
    let nodes: Vec<&str> = nodes.iter().flat_map(|node| ["--node", node]).collect();
    let served = Served::start(&scratch, &[&["heater.od.yaml"], nodes.as_slice()].concat(), Stdio::null());
    (scratch, served)
}

fn scan(scratch: &Scratch, address: &str, arguments: &[&str]) -> (i32, String, String) {
    let scan = ["node", "scan", "--write-spec", "made.od.yaml", "--slcan", address];
    let output = odgen(&scratch.0, &[&scan, arguments].concat());
    (code(&output), stdout(&output), stderr(&output))
}

#[test]
fn what_is_not_known_is_said() {
    let (scratch, served) = heaters("specify-heater", &["5"]);
    let range = ["--node", "5", "--range", "2000h..2010h", "--bit-rate", "125"];
    let (code, said, complained) = scan(&scratch, served.address(), &range);
    assert_eq!((code, complained.as_str()), (0, ""), "{said}");
    let made = fs::read_to_string(scratch.0.join("made.od.yaml")).unwrap();
    insta::assert_snapshot!(format!("{said}\n{made}"));
    // A file of the user is not replaced.
    let (code, _, complained) = scan(&scratch, served.address(), &range);
    assert_eq!(code, 1);
    assert!(complained.contains("it is there already"), "{complained}");
    let (code, _, complained) = scan(&scratch, served.address(), &[&range[..], &["--force"]].concat());
    assert_eq!((code, complained.as_str()), (0, ""));
}

#[test]
fn a_specification_is_of_one_node() {
    let (scratch, served) = heaters("specify-two", &["5", "6"]);
    let (code, _, complained) = scan(&scratch, served.address(), &["--range", "2000"]);
    assert_eq!(code, 2);
    assert!(complained.contains("a specification is of one node, and 2 answer"), "{complained}");
    let (code, _, complained) = scan(&scratch, served.address(), &["--node", "9", "--timeout", "200"]);
    assert_eq!(code, 1);
    assert!(complained.contains("node 9: cannot read"), "{complained}");
    assert!(!scratch.0.join("made.od.yaml").exists());
    let asked = odgen(&scratch.0, &["node", "scan", "--node", "5", "--slcan", served.address()]);
    assert_eq!(self::code(&asked), 2, "without `--write-spec` a scan is of all nodes");
    let (code, _, complained) = scan(&scratch, served.address(), &["--range", "5FFF..2000"]);
    assert_eq!(code, 2);
    assert!(complained.contains("2000h..5FFFh"), "{complained}");
}

/// A node dies while it is asked.
#[test]
fn a_node_that_falls_silent_gives_no_file() {
    let (scratch, served) = heaters("specify-silent", &["5"]);
    let lost = |line: &str| (!line.starts_with("t6058400A20")).then(|| line.to_owned());
    let relay = Relay::new(served.address(), Box::new(lost), Box::new(|line| Some(line.to_owned())));
    let arguments = ["--node", "5", "--range", "2000h..2010h", "--timeout", "200"];
    let (code, _, complained) = scan(&scratch, &relay.address, &arguments);
    assert_eq!(code, 1);
    assert!(complained.contains("node 5: cannot read 200Ah: the node does not answer"), "{complained}");
    assert!(!scratch.0.join("made.od.yaml").exists());
}

/// A device that has its EDS in it.
const KEEPER: &str = "\
od-spec: 1
title: Keeper
uses: [cia301]
devices:
  keeper: {name: Keeper, bit-rates: [125], features: [device type, identity, heartbeat producer]}
objects:
  0x1021: {name: store EDS, type: domain, access: rw}
  0x1022: {name: storage format, type: unsigned8, access: rw, default: 0}
  0x2000: {name: level, type: unsigned16, access: rw}
";

const fn id(index: u16) -> EntryId {
    EntryId { index: Index(index), sub: SubIndex(0) }
}

/// A keeper as node 5, which holds these bytes.
fn keeper(name: &str, bytes: &[u8], format: u8) -> (Scratch, Served) {
    let scratch = Scratch::new(name);
    scratch.file("keeper.od.yaml", KEEPER);
    let served = Served::start(&scratch, &["keeper.od.yaml", "--node", "5"], Stdio::null());
    let stream = TcpStream::connect(served.address().trim_start_matches("tcp:")).unwrap();
    let mut client = Client::new(SlcanBus::open(stream, None).unwrap(), Duration::from_secs(60));
    client.write(5, id(0x1021), bytes).unwrap();
    client.write(5, id(0x1022), &[format]).unwrap();
    drop(client);
    (scratch, served)
}

fn keepers_eds() -> String {
    let scratch = Scratch::new("specify-eds");
    scratch.file("keeper.od.yaml", KEEPER);
    eds(&scratch, "keeper.od.yaml", "keeper")
}

#[test]
fn a_stored_eds_is_taken_first() {
    let (scratch, served) = keeper("specify-stored", keepers_eds().as_bytes(), 0);
    let (code, said, complained) = scan(&scratch, served.address(), &[]);
    assert_eq!((code, complained.as_str()), (0, ""));
    assert!(said.contains("of node 5, from the EDS that it has stored"), "{said}");
    let made = fs::read_to_string(scratch.0.join("made.od.yaml")).unwrap();
    assert!(made.contains("level"), "{made}");
    let names = |text: &str| objects(text).into_keys().collect::<BTreeSet<_>>();
    assert_eq!(names(&eds(&scratch, "made.od.yaml", "made")), names(&keepers_eds()));
    // A range is asked for all the same.
    let (code, said, _) = scan(&scratch, served.address(), &["--range", "2000h", "--force"]);
    assert_eq!(code, 0);
    assert!(said.contains("from the objects that answer"), "{said}");
    assert!(!fs::read_to_string(Path::new(&scratch.0).join("made.od.yaml")).unwrap().contains("level"));
}

#[test]
fn an_eds_in_another_form_is_left_alone() {
    let (scratch, served) = keeper("specify-packed", b"\x1F\x8B packed", 0x80);
    let (code, said, complained) = scan(&scratch, served.address(), &[]);
    assert_eq!(code, 0, "{complained}");
    assert!(complained.contains("stores its EDS in a form of its own (1022h = 0x80)"), "{complained}");
    assert!(said.contains("from the objects that answer"), "{said}");
}

#[test]
fn a_stored_eds_that_is_not_one_or_of_another_device_is_reported() {
    let (scratch, served) = keeper("specify-broken", b"no EDS at all", 0);
    let (code, _, complained) = scan(&scratch, served.address(), &[]);
    assert_eq!(code, 1);
    assert!(complained.contains("the EDS that it has stored cannot be used"), "{complained}");
    assert!(complained.contains("`--range 2000h..9FFFh` asks for its objects instead"), "{complained}");
    assert!(!scratch.0.join("made.od.yaml").exists());
    let other = keepers_eds().replacen("DefaultValue=0x00000000", "DefaultValue=0x00000192", 1);
    let (scratch, served) = keeper("specify-other", other.as_bytes(), 0);
    let (code, _, complained) = scan(&scratch, served.address(), &[]);
    assert_eq!(code, 0);
    assert!(
        complained.contains("is of another device: 1000h is 0x00000000 in the node, 0x00000192"),
        "{complained}"
    );
}

/// The longest array that there can be.
const LONG: &str = "\
od-spec: 1
title: Long
uses: [cia301]
devices:
  long: {name: Long, bit-rates: [125], features: [heartbeat producer]}
objects:
  0x2000: {name: list, array: {count: 254, name: \"element {n}\", type: unsigned16, access: rw}}
";

#[test]
fn the_longest_array_is_described_whole() {
    let scratch = Scratch::new("specify-long");
    scratch.file("long.od.yaml", LONG);
    let file = scratch.0.join("long.od.yaml");
    is_described("specify-longest", file.to_str().unwrap(), "long", &["2000h"]);
}

/// A maker's EDS: a mapping of nothing, and parameters of a PDO with a reserved entry.
const COUPLER: &str = include_str!("eds/coupler.eds");

#[test]
fn a_mapping_of_nothing_is_a_record_and_what_follows_a_reserved_entry_is_found() {
    let scratch = Scratch::new("specify-coupler");
    scratch.file("coupler.eds", COUPLER);
    let served = Served::start(&scratch, &["coupler.eds", "--node", "5"], Stdio::null());
    let (code, said, complained) = scan(&scratch, served.address(), &["--range", "2000h"]);
    assert_eq!((code, complained.as_str()), (0, ""), "{said}");
    let checked = odgen(&scratch.0, &["check", "made.od.yaml"]);
    assert_eq!(self::code(&checked), 0, "{}", stderr(&checked));
    let made = objects(&eds(&scratch, "made.od.yaml", "made"));
    let own = objects(COUPLER);
    assert_eq!(made.keys().collect::<Vec<_>>(), own.keys().collect::<Vec<_>>());
    assert_eq!(made["1A00"]["ObjectType"], "0x9");
}
