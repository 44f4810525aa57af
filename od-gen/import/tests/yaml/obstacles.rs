//! Obstacles to a short text are known before it is written: next to each of them, the others stay short.
//!
//! An obstacle that is not foreseen would make the whole text plain, because no third text is compiled.

use super::{model, written};

/// An object, or several, and what is written for it.
type Obstacle = (&'static str, &'static str, &'static str);

const OBSTACLES: &[Obstacle] = &[
    (
        "a default of the library that has a name there",
        "0x1029:
    name: Error behaviour
    array: {count: 1, name: Communication error, type: unsigned8, access: rw, default: 0}",
        "0x1029: {from: cia301",
    ),
    (
        "one default where each element of the library has its own",
        "0x607B:
    name: Position range limit
    sub0: {name: Highest sub-index supported}
    array:
      count: 2
      type: integer32
      access: rw
      pdo: receive
      default: 0
      elements: {1: {name: Min position range limit}, 2: {name: Max position range limit}}",
        "from: cia402",
    ),
    (
        "elements that the library does not have",
        "0x1010:
    name: Store parameters
    sub0: {name: Highest sub-index supported}
    array:
      count: 5
      name: Save layer
      type: unsigned32
      access: rw
      elements:
        1: {name: Save all parameters, default: 1}
        2: {name: Save communication parameters, default: 1}
        3: {name: Save application parameters, default: 1}
        4: {name: Save manufacturer defined parameters, default: 3}",
        "0x1010:",
    ),
    (
        "a special value that the type does not hold",
        "0x6065: {name: Following error window, type: integer32, access: rw, default: 5}",
        "0x6065: {name: Following error window, type: integer32, access: rw, default: 5}",
    ),
    (
        "a broken rule about what the library says, too",
        "0x6064: {name: Position actual value, type: visible-string, access: ro, pdo: transmit, default: '0'}",
        "0x6064: {from: cia402, type: visible-string, pdo: transmit",
    ),
    (
        "names of mapped entries that readers misread",
        "0x1800:
    name: communication
    record:
      1: {name: id, type: unsigned32, access: rw, default: $NODEID + 0x180}
      2: {name: type, type: unsigned8, access: rw, default: 255}
  0x1A00:
    name: mapping
    sub0: {name: count, access: rw, default: 1}
    record: {1: {name: 'entry #1', type: unsigned32, access: rw, default: 0x2000_0008}}",
        "TPDO 1 in full, not under `pdos:`: they have what no key says",
    ),
    (
        "mapped entries that can change while their number cannot",
        "0x1800:
    name: communication
    record:
      1: {name: id, type: unsigned32, access: rw, default: $NODEID + 0x180}
      2: {name: type, type: unsigned8, access: rw, default: 255}
  0x1A00:
    name: mapping
    sub0: {name: count, access: const, default: 1}
    record: {1: {name: entry, type: unsigned32, access: rw, default: 0x2000_0008}}",
        "TPDO 1 in full, not under `pdos:`: they have what no key says",
    ),
    (
        "parameters of which only some are stored",
        "0x1800:
    name: communication
    record:
      1: {name: id, type: unsigned32, access: rw, default: $NODEID + 0x180, stored: communication}
      2: {name: type, type: unsigned8, access: rw, default: 255}
  0x1A00:
    name: mapping
    sub0: {name: count, access: rw, default: 1}
    record: {1: {name: entry, type: unsigned32, access: rw, default: 0x2000_0008}}",
        "TPDO 1 in full, not under `pdos:`: they have what no key says",
    ),
];

fn device(objects: &str) -> String {
    format!(
        "
od-spec: 1
title: Lamp
uses: [cia301, cia402]
allow: {{OD0318: they are so, OD0416: they are so, OD0509: they are so, OD0512: they are so}}
devices: {{lamp: {{name: Lamp, bit-rates: [125], features: [heartbeat producer]}}}}
objects:
  0x2000: {{name: level, type: unsigned8, access: rw, pdo: both, default: 4}}
  {objects}
"
    )
}

#[test]
fn the_text_stays_short_next_to_each_obstacle() {
    for (what, objects, expected) in OBSTACLES {
        let system = model(&device(objects));
        let text = written(&system).text;
        assert!(text.contains("features: [heartbeat producer]"), "{what}:\n{text}");
        assert!(text.contains(expected), "{what}:\n{text}");
    }
}

#[test]
fn a_count_of_another_type_is_reported_and_the_text_stays_short() {
    let mut system = model(&device(
        "0x2001: {name: steps, array: {count: 2, name: 'step {n}', type: unsigned8, access: rw}}",
    ));
    let object = system.devices[0].objects.get_mut(&od_spec::model::Index(0x2001)).unwrap();
    object.entries[0].data_type = od_spec::model::DataType::VisibleString;
    object.entries[0].default = Some(od_spec::model::Value::Text("two".to_owned()));
    let text = written(&system).text;
    let comment = "original: default: two; left out: sub-index 0 is no VISIBLE_STRING, but an UNSIGNED8";
    assert!(text.contains("features: [heartbeat producer]") && text.contains(comment), "{text}");
}
