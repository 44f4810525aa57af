//! A device of another maker, as its EDS describes it: no units, no meanings, parameter objects of its own kind.

use std::collections::BTreeMap;

use od_import::yaml::{Options, Place};
use od_spec::model::{EntryId, Index, SubIndex, Value};

use super::likeness::difference;
use super::{model, written, written_with};

const DEVICE: &str = r#"
od-spec: 1
title: DX-40
vendor: {name: Example Drives Ltd, number: 0x0000_0123}
devices:
  dx-40:
    name: DX-40
    product: 40
    product-revision: 0x0001_0002
    bit-rates: [125, 250, 500, 1000]
    device-type: 0x0002_0192
    eds: {description: EDS of the DX-40, created: 2019-05-27 09:00, created-by: J. Doe, modified: 2021-01-02 10:30, file-revision: 4}
    eds-defaults: all
objects:
  0x1000: {name: Device Type, type: unsigned32, access: ro}
  0x1001: {name: Error Register, type: unsigned8, access: ro, pdo: transmit}
  0x1003:
    name: Pre-defined error field
    sub0: {name: Number of errors, access: rw, default: 0}
    array: {count: 4, name: "Standard error field {n}", type: unsigned32, access: ro}
  0x1008: {name: Manufacturer device name, type: visible-string, access: const}
  0x1010:
    name: Store parameters
    sub0: {name: Highest sub-index supported}
    array: {count: 1, elements: {1: {name: Save all parameters, type: unsigned32, access: rw}}}
  0x1014: {name: COB-ID EMCY, type: unsigned32, access: rw, default: $NODEID + 0x80}
  0x1017: {name: Producer heartbeat time, type: unsigned16, access: rw, default: 0}
  0x1018:
    name: Identity Object
    sub0: {name: number of entries}
    record:
      1: {name: Vendor-ID, type: unsigned32, access: ro}
      2: {name: Product code, type: unsigned32, access: ro}
      3: {name: Revision number, type: unsigned32, access: ro}
  0x1400: &rpdo
    name: RPDO 1 communication parameter
    sub0: {name: highest sub-index supported}
    record:
      1: {name: COB-ID, type: unsigned32, access: rw, default: $NODEID + 0x200}
      2: {name: Transmission type, type: unsigned8, access: rw, default: 254}
  0x1401:
    name: RPDO 2
    sub0: {access: const}
    record:
      1: {name: COB-ID, type: unsigned32, access: rw, default: 0x8000_0300}
      2: {name: Transmission type, type: unsigned8, access: rw, default: 254}
      4: {name: Reserved, type: unsigned8, access: rw, default: 0}
  0x1600:
    name: RPDO 1 mapping parameter
    sub0: {name: number of mapped entries, access: rw, default: 2}
    type: unsigned32
    access: rw
    record:
      1: {name: Entry 1, default: 0x6040_0010}
      2: {name: Entry 2, default: 0x60FF_0020}
      3: {name: Entry 3, default: 0}
      4: {name: Entry 4, default: 0}
      5: {name: Entry 5, default: 0}
      6: {name: Entry 6, default: 0}
      7: {name: Entry 7, default: 0}
      8: {name: Entry 8, default: 0}
  0x1601:
    name: RPDO 2 mapping
    sub0: {access: const, default: 1}
    record:
      1: {name: Entry 1, type: unsigned32, access: const, default: 0x2100_0108}
  0x1402:
    name: RPDO 3
    sub0: {access: const}
    record:
      1: {name: COB-ID, type: unsigned32, access: rw, default: 0x8000_0400}
      2: {name: Transmission type, type: unsigned8, access: rw, default: 254}
      3: {name: Inhibit time, type: unsigned16, access: rw}
  0x1602:
    name: RPDO 3 mapping
    sub0: {access: const, default: 1}
    record:
      1: {name: Entry 1, type: unsigned32, access: const, default: 0x2100_0208}
  0x2000: {name: Axis 1, type: unsigned16, access: rw, default: 1}
  0x2001: {name: Axis 2, type: unsigned16, access: rw, default: 1}
  0x2002: {name: Axis 3, type: unsigned16, access: rw, default: 1}
  0x2003: {name: Axis 4, type: unsigned16, access: rw, default: 2}
  0x2100:
    name: Digital outputs 8-bit
    array: {count: 4, name: "Output {n}", type: unsigned8, access: rww, pdo: receive, default: 0, elements: {3: {access: rw, pdo: none}}}
  0x2200:
    name: Limits
    links: [0x2000, 0x60FF]
    record:
      1: {name: Lower limit, type: integer32, access: rw, default: -1000, min: -5000, max: 0}
      2: {name: Upper limit, type: integer32, access: rw, default: 1000, min: 0, max: 5000}
      3: {name: Mode, type: unsigned8, access: rw}
  0x2201: {name: "yes", type: boolean, access: rw, default: no, eds: {flags: [no-write]}}
  0x6040: {name: Controlword, type: unsigned16, access: rww, pdo: receive}
  0x6041: {name: Statusword, type: unsigned16, access: ro, links: [0x6040]}
  0x6502: {name: Supported drive modes, type: unsigned32, access: ro, default: 0x3AD}
  0x60FF: {name: Target velocity, type: integer32, access: rww, pdo: receive, default: 0}
"#;

#[test]
fn it_reads_as_if_a_person_had_written_it() {
    let mut system = model(DEVICE);
    let object = |index: u16| Place::Object(Index(index));
    let entry = |index: u16, sub: u8| Place::Entry(EntryId { index: Index(index), sub: SubIndex(sub) });
    let comments = BTreeMap::from([
        (object(0x1003), vec!["[1003sub0] had no AccessType".to_owned()]),
        (entry(0x2100, 2), vec!["; was 16 bits wide in version 1".to_owned()]),
        (entry(0x2200, 1), vec!["[2200sub1] LowLimit=-0x1388".to_owned()]),
        (entry(0x1400, 2), vec!["DefaultValue=0xFE".to_owned()]),
    ]);
    let limits = system.devices[0].objects.get_mut(&Index(0x2200)).unwrap();
    limits.entries[2].default = Some(Value::Integer(6000));
    limits.entries[3].name = "Upper limit".to_owned();
    let options = Options {
        head: vec!["Made from dx40.eds.".to_owned()],
        foot: vec!["Not kept of dx40.eds:".to_owned(), "[Tools] ApplicationName=Setup".to_owned()],
        comments,
    };
    let specification = written_with(&system, &options);
    model(&specification.text);
    insta::assert_snapshot!(specification.text);
}

#[test]
fn what_its_eds_says_comes_back() {
    let original = model(DEVICE);
    let specification = written(&original);
    assert_eq!(specification.repairs, []);
    let again = model(&specification.text);
    assert_eq!(difference(&original, &again), None, "{}", specification.text);
    assert_eq!(written(&again).text, specification.text);
}

#[test]
fn other_readers_of_yaml_read_it() {
    let text = written(&model(DEVICE)).text;
    let read: serde_yaml::Value =
        serde_yaml::from_str(&text).unwrap_or_else(|error| panic!("{error}: {text}"));
    assert_eq!(read["title"], serde_yaml::Value::from("DX-40"));
    assert_eq!(read["devices"]["dx-40"]["name"], serde_yaml::Value::from("DX-40"));
    assert_eq!(
        read["objects"]
            .as_mapping()
            .map(|map| map.values().any(|object| object["name"].as_str() == Some("yes"))),
        Some(true)
    );
}
