//! What is written in a short form says the same as what is written in full: every output of the two is the same.

use od_formats::{eds, json};
use od_gen::rust;
use od_spec::diag::Diagnostics;
use od_spec::model::{Index, SubIndex, Value};

use crate::diagnostics::bytes_and_libraries::{LAMP, compiled_with};
use crate::diagnostics::human;

const HEAD: &str = "\
od-spec: 1
title: Lamp
uses: [cia301]
devices:
  lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer]}
  post: {name: Post, bit-rates: [125], features: [heartbeat producer]}
";

/// The dump, and what is made for each device.
fn outputs(body: &str, files: &'static [(&'static str, &'static [u8])]) -> Vec<String> {
    let (sources, compiled) = compiled_with(&format!("{HEAD}{body}"), files);
    assert_eq!(human(&compiled.diagnostics, &sources), "");
    let system = compiled.system.unwrap();
    let mut outputs = vec![String::from_utf8(json::dump(&system, &[])).unwrap()];
    for device in &system.devices {
        outputs.push(String::from_utf8(eds::write_eds(&system, device)).unwrap());
        let mut diagnostics = Diagnostics::new();
        let tokens = rust::tokens(&system, device, &mut diagnostics);
        assert_eq!(human(&diagnostics, &sources), "");
        outputs.push(tokens.unwrap().to_string());
    }
    outputs
}

/// Compares what is written in short with what is written in full.
fn same(short: &str, full: &str) {
    let (short, full) = (outputs(short, &[]), outputs(full, &[]));
    for (short, full) in short.iter().zip(&full) {
        let different = short.lines().zip(full.lines()).find(|(short, full)| short != full);
        assert_eq!(different, None);
        assert_eq!(short.len(), full.len());
    }
    assert_eq!(short.len(), full.len());
}

#[test]
fn an_object_that_is_like_another_is_that_in_full() {
    same(
        "objects:
  0x2000: {like: 0x2001, name: low, default: 10}
  0x2001: {like: 0x2002, name: middle, default: 50, about: half}
  0x2002: {name: high, identifier: top, type: unsigned8, access: rw, default: 90, max: 100, special: {255: flashing}, about: most}
  0x2003..0x2004: {like: 0x2005, name: 'hours {n}', access: ro}
  0x2005:
    name: hours
    array: {count: 3, name: 'lamp {n}', type: unsigned16, access: rw, writable-when: '0x2002 == 0', elements: {1: {default: 4}, 2: {name: spare, default: 5}, 3: {max: 9, default: 6}}}
  0x2006: {like: 0x2005, name: minutes, array: {count: 2, type: unsigned32, elements: {1: {name: main}}}}
  0x2007:
    devices: lamp
    name: colour
    record: {1: {name: red, type: unsigned8, access: rw, default: 1}, 2: {name: blue, type: unsigned8, access: rw, default: 2}}
  0x2008: {devices: lamp, like: 0x2007, name: sky, omit: [1], record: {2: {default: 9}, 3: {name: white, type: unsigned8, access: ro}}}
  0x2009: {like: 0x1017, name: beat of the lamp, default: 500, about: beats}
",
        "objects:
  0x2000: {name: low, type: unsigned8, access: rw, default: 10, max: 100, special: {255: flashing}, about: half}
  0x2001: {name: middle, type: unsigned8, access: rw, default: 50, max: 100, special: {255: flashing}, about: half}
  0x2002: {name: high, identifier: top, type: unsigned8, access: rw, default: 90, max: 100, special: {255: flashing}, about: most}
  0x2003: {name: hours 1, array: {count: 3, name: 'lamp {n}', type: unsigned16, access: ro, elements: {1: {default: 4}, 2: {name: spare, default: 5}, 3: {max: 9, default: 6}}}}
  0x2004: {name: hours 2, array: {count: 3, name: 'lamp {n}', type: unsigned16, access: ro, elements: {1: {default: 4}, 2: {name: spare, default: 5}, 3: {max: 9, default: 6}}}}
  0x2005:
    name: hours
    array: {count: 3, name: 'lamp {n}', type: unsigned16, access: rw, writable-when: '0x2002 == 0', elements: {1: {default: 4}, 2: {name: spare, default: 5}, 3: {max: 9, default: 6}}}
  0x2006:
    name: minutes
    array: {count: 2, name: 'lamp {n}', type: unsigned32, access: rw, writable-when: '0x2002 == 0', elements: {1: {name: main, default: 4}, 2: {name: spare, default: 5}}}
  0x2007:
    devices: lamp
    name: colour
    record: {1: {name: red, type: unsigned8, access: rw, default: 1}, 2: {name: blue, type: unsigned8, access: rw, default: 2}}
  0x2008:
    devices: lamp
    name: sky
    record: {2: {name: blue, type: unsigned8, access: rw, default: 9}, 3: {name: white, type: unsigned8, access: ro}}
  0x2009: {name: beat of the lamp, category: conditional, type: unsigned16, unit: millisecond, access: rw, default: 500, special: {0: heartbeat off}, about: beats}
",
    );
}

#[test]
fn an_object_of_a_library_is_like_another_of_it() {
    const SHORT: &[(&str, &[u8])] = &[(
        "../lamps.od.yaml",
        b"od-spec: 1
title: Lamps
profile: lamps
features: {dimmer: {objects: [0x6001]}}
objects:
  0x6000: {like: 0x6001, name: colour, max: 9}
  0x6001: {name: brightness, type: unsigned8, access: rw, default: 1}
",
    )];
    const FULL: &[(&str, &[u8])] = &[(
        "../lamps.od.yaml",
        b"od-spec: 1
title: Lamps
profile: lamps
features: {dimmer: {objects: [0x6001]}}
objects:
  0x6000: {name: colour, max: 9, type: unsigned8, access: rw, default: 1}
  0x6001: {name: brightness, type: unsigned8, access: rw, default: 1}
",
    )];
    let dump = |files| {
        let text = format!("{LAMP}objects:\n  0x6000: {{from: lamps}}\n");
        let (sources, compiled) = compiled_with(&text, files);
        assert_eq!(human(&compiled.diagnostics, &sources), "");
        String::from_utf8(json::dump(&compiled.system.unwrap(), &[])).unwrap()
    };
    assert_eq!(dump(SHORT), dump(FULL));
}

#[test]
fn a_run_of_sub_indices_is_its_entries() {
    same(
        "objects:
  0x2000:
    devices: lamp
    name: cells
    type: unsigned8
    access: ro
    pdo: transmit
    record: {1: {name: total}, 2..4: {name: 'cell {n}', identifier: 'c{n}', about: a cell}}
  0x2001:
    devices: lamp
    name: outputs
    array: {count: 5, name: 'output {n}', type: unsigned8, access: rw, pdo: transmit, elements: {2..3: {max: 7}, 4..5: {name: 'spare {n}'}}}
pdos: {lamp: {transmit: {1: {map: [0x2000.2..4, 0x2001.1..2, 0x2001.5..5]}}}}
",
        "objects:
  0x2000:
    devices: lamp
    name: cells
    type: unsigned8
    access: ro
    pdo: transmit
    record:
      1: {name: total}
      2: {name: cell 1, identifier: c1, about: a cell}
      3: {name: cell 2, identifier: c2, about: a cell}
      4: {name: cell 3, identifier: c3, about: a cell}
  0x2001:
    devices: lamp
    name: outputs
    type: unsigned8
    access: rw
    pdo: transmit
    array: {count: 5, name: 'output {n}', elements: {2: {max: 7}, 3: {max: 7}, 4: {name: spare 4}, 5: {name: spare 5}}}
pdos: {lamp: {transmit: {1: {map: [0x2000.2, 0x2000.3, 0x2000.4, outputs.output 1, outputs.output 2, outputs.spare 5]}}}}
",
    );
}

#[test]
fn defaults_of_elements_and_devices_are_those_of_each() {
    same(
        "types:
  kind: {base: unsigned8, values: {0: lamp, 1: post}}
objects:
  0x2000: {name: first, devices: lamp, type: kind, access: rw, default: {lamp: post}}
  0x2001: {name: kinds, omit: [2], array: {count: 3, name: 'kind {n}', type: kind, access: rw, default: [lamp, post]}}
  0x2002: {name: steps, devices: lamp, array: {count: 2, name: 'step {n}', type: unsigned8, access: rw, default: {lamp: [1, 2]}}}
  0x2003: {name: ramps, devices: post, array: {count: 2, name: 'ramp {n}', type: unsigned8, access: rw, default: {post: 3}}}
",
        "types:
  kind: {base: unsigned8, values: {0: lamp, 1: post}}
objects:
  0x2000: {name: first, devices: lamp, type: kind, access: rw, default: 1}
  0x2001: {name: kinds, omit: [2], array: {count: 3, name: 'kind {n}', type: kind, access: rw, elements: {1: {default: 0}, 3: {default: 1}}}}
  0x2002: {name: steps, devices: lamp, array: {count: 2, name: 'step {n}', type: unsigned8, access: rw, elements: {1: {default: 1}, 2: {default: 2}}}}
  0x2003: {name: ramps, devices: post, array: {count: 2, name: 'ramp {n}', type: unsigned8, access: rw, default: 3}}
",
    );
}

#[test]
fn every_device_has_its_own_default() {
    let body = "objects:
  0x1017: {from: cia301, default: {lamp: 500, post: 1000 ms}}
  0x2000: {name: steps, array: {count: 2, name: 'step {n}', type: unsigned8, access: rw, default: {lamp: [1, 2], post: 7}}}
";
    let (sources, compiled) = compiled_with(&format!("{HEAD}{body}"), &[]);
    assert_eq!(human(&compiled.diagnostics, &sources), "");
    let system = compiled.system.unwrap();
    let defaults: Vec<_> = system
        .devices
        .iter()
        .flat_map(|device| [(0x1017, 0), (0x2000, 1), (0x2000, 2)].map(|(index, sub)| (device, index, sub)))
        .map(|(device, index, sub)| {
            device.objects[&Index(index)].entry(SubIndex(sub)).unwrap().default.clone()
        })
        .collect();
    let expected = [500, 1, 2, 1000, 7, 7].map(|raw| Some(Value::Integer(raw)));
    assert_eq!(defaults, expected);
}

#[test]
fn different_objects_at_one_index_are_those_of_their_devices() {
    const BODY: &str = "objects:
  0x2000:
    - {devices: lamp, name: brightness, type: unsigned8, access: rw, pdo: receive, default: 5}
    - {devices: post, name: heights, array: {count: 2, name: 'height {n}', type: integer16, access: rw, pdo: receive, default: 7}}
pdos:
  lamp: {receive: {1: {map: [0x2000]}}}
  post: {receive: {1: {map: [0x2000.1..2]}}}
constraints:
  bright: {devices: lamp, require: '0x2000 <= 100'}
errata:
  - {at: 0x2000, devices: post, kind: name, place: page 1, prints: a, reads: b, because: c}
";
    // A file for each device has the same EDS and the same code.
    let lamp = "objects:
  0x2000: {devices: lamp, name: brightness, type: unsigned8, access: rw, pdo: receive, default: 5}
pdos: {lamp: {receive: {1: {map: [0x2000]}}}}
constraints: {bright: {devices: lamp, require: '0x2000 <= 100'}}
";
    let post = "objects:
  0x2000: {devices: post, name: heights, array: {count: 2, name: 'height {n}', type: integer16, access: rw, pdo: receive, default: 7}}
pdos: {post: {receive: {1: {map: [0x2000.1, 0x2000.2]}}}}
";
    let [_, lamp_eds, lamp_code, post_eds, post_code] = <[String; 5]>::try_from(outputs(BODY, &[])).unwrap();
    let alone = outputs(lamp, &[]);
    assert_eq!((&alone[1], &alone[2]), (&lamp_eds, &lamp_code));
    let alone = outputs(post, &[]);
    assert_eq!((&alone[3], &alone[4]), (&post_eds, &post_code));
    assert!(lamp_eds.contains("brightness") && post_eds.contains("heights"));
}

#[test]
fn a_heartbeat_consumer_is_its_raw_value() {
    same(
        "objects:
  0x1016: {name: watched, array: {count: 3, name: 'node {n}', type: unsigned32, access: rw, default: [{node: 5, time: 3000 ms}, {node: 127, time: 65.535 s}, 0]}}
",
        "objects:
  0x1016: {name: watched, array: {count: 3, name: 'node {n}', type: unsigned32, access: rw, elements: {1: {default: 0x00050BB8}, 2: {default: 0x007FFFFF}, 3: {default: 0}}}}
",
    );
}

#[test]
fn what_a_library_cannot_say_is_reported_at_its_place() {
    const WRONG: &[(&str, &[u8])] = &[(
        "../lamps.od.yaml",
        b"od-spec: 1
profile: lamps
title: Lamps
features: {dimmer: {objects: [0x6000]}}
objects:
  0x6000: {name: brightness, type: unsigned8, access: rw}
  0x6001: {name: colour, like: 0x6002}
  0x6003: {name: shade, like: 0x6003}
  0x6004: [{devices: lamp, name: height, type: unsigned8, access: rw}, {devices: post, name: width, type: unsigned8, access: rw}]
",
    )];
    let (sources, compiled) = compiled_with(LAMP, WRONG);
    insta::assert_snapshot!(human(&compiled.diagnostics, &sources), @r#"
        error[OD0310]: the library has no object 6002h that 6001h could be like
         --> plant/../lamps.od.yaml:7:32
          |
        7 |   0x6001: {name: colour, like: 0x6002}
          |                                ^^^^^^
          |
        help: name an object of the library

        error[OD0324]: 6003h is like itself
         --> plant/../lamps.od.yaml:8:31
          |
        8 |   0x6003: {name: shade, like: 0x6003}
          |   ------ the object           ^^^^^^
          |
        help: name another object, or describe this one in full

        error[OD0208]: several objects at 6004h of a library
         --> plant/../lamps.od.yaml:9:3
          |
        9 |   0x6004: [{devices: lamp, name: height, type: unsigned8, access: rw}, {devices: post, name: width, type: unsigned8, access: rw}]
          |   ^^^^^^
          |
        help: describe one; a library knows no devices that could have different ones
        "#);
}
