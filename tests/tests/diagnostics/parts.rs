//! A specification in several files says what it says in one, and what is wrong with its parts is said where it is.

use od_gen::json;
use od_spec::diag::Diagnostics;

use crate::bytes_and_libraries::compiled_with;
use crate::human;

type Files = &'static [(&'static str, &'static [u8])];

const MAIN: &str = "\
od-spec: 1
title: Lamp
languages: [en, de]
uses: [cia301]
parts: [types.od.yaml, rest.od.yaml]
devices:
  lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer]}
pdos:
  lamp: {receive: {1: {map: [brightness]}}}
errata: []
objects:
  0x2000: {name: brightness, type: level, access: rw, pdo: receive}
";

const PARTS: Files = &[
    (
        "types.od.yaml",
        b"od-spec: 1
part-of: lamp.od.yaml
types:
  level: {base: unsigned8, values: {0: off, 1: on}}
",
    ),
    (
        "rest.od.yaml",
        b"od-spec: 1
part-of: ../plant/lamp.od.yaml
objects:
  0x2001: {name: hours, type: unsigned32, access: ro, about: {en: time of use, de: Nutzungsdauer}}
errata:
  - {at: 0x2000, kind: type, place: page 1, prints: UNSIGNED16, reads: UNSIGNED8, because: it has two values}
",
    ),
];

/// The same in one file.
const WHOLE: &str = "\
od-spec: 1
title: Lamp
languages: [en, de]
uses: [cia301]
devices:
  lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer]}
pdos:
  lamp: {receive: {1: {map: [brightness]}}}
types:
  level: {base: unsigned8, values: {0: off, 1: on}}
objects:
  0x2000: {name: brightness, type: level, access: rw, pdo: receive}
  0x2001: {name: hours, type: unsigned32, access: ro, about: {en: time of use, de: Nutzungsdauer}}
errata:
  - {at: 0x2000, kind: type, place: page 1, prints: UNSIGNED16, reads: UNSIGNED8, because: it has two values}
";

fn said(text: &str, files: Files) -> String {
    let (sources, compiled) = compiled_with(text, files);
    human(&compiled.diagnostics, &sources)
}

#[test]
fn a_specification_in_parts_is_the_same_as_in_one_file() {
    let dump = |text: &str, files: Files| {
        let (sources, compiled) = compiled_with(text, files);
        assert_eq!(human(&compiled.diagnostics, &sources), "");
        String::from_utf8(json::dump(&compiled.system.unwrap(), &[])).unwrap()
    };
    let (parts, whole) = (dump(MAIN, PARTS), dump(WHOLE, &[]));
    assert!(parts.contains("Nutzungsdauer"));
    let different = parts.lines().zip(whole.lines()).find(|(parts, whole)| parts != whole);
    assert_eq!(different, None);
    assert_eq!(parts.len(), whole.len());
}

#[test]
fn what_is_wrong_in_a_part_is_shown_there() {
    const WRONG: Files = &[
        PARTS[0],
        (
            "rest.od.yaml",
            b"od-spec: 1
part-of: lamp.od.yaml
title: Lamp
parts: []
units: [volt]
pdos:
  lamp: {transmit: {1: {map: [0x2001]}}}
objects:
  0x2000: {name: current, type: unsigned16, access: ro}
  0x2001: {name: hours, type: unsigned33, access: ro, about: {fr: temps}}
  8192: {name: voltage, type: unsigned16, access: ro}
",
        ),
    ];
    insta::assert_snapshot!("wrong_in_a_part", said(MAIN, WRONG));
}

const NO_PART: Files = &[PARTS[0], ("rest.od.yaml", b"od-spec: 1\nprofile: rest\ntitle: Rest\n")];

pub(crate) fn a_file_that_is_no_part() -> Diagnostics {
    compiled_with(MAIN, NO_PART).1.diagnostics
}

#[test]
fn a_file_has_to_say_that_it_is_a_part() {
    const OF_ANOTHER: Files = &[PARTS[0], ("rest.od.yaml", b"part-of: torch.od.yaml\nobjects:\n")];
    const MISSING: Files = &[PARTS[0]];
    const LIST: Files = &[PARTS[0], ("rest.od.yaml", b"- 1\n")];
    insta::assert_snapshot!("no_part", said(MAIN, NO_PART));
    insta::assert_snapshot!("part_of_another", said(MAIN, OF_ANOTHER));
    insta::assert_snapshot!("missing_part", said(MAIN, MISSING));
    insta::assert_snapshot!("part_twice", said(&MAIN.replace("rest.od", "types.od"), PARTS));
    insta::assert_snapshot!("part_is_a_list", said(MAIN, LIST));
}

#[test]
fn a_library_may_have_parts() {
    const FILES: Files = &[
        ("../lamps.od.yaml", b"od-spec: 1\ntitle: Lamps\nprofile: lamps\nparts: [more.od.yaml]\nfeatures:\n  dim: {objects: [0x2000]}\n"),
        ("more.od.yaml", b"od-spec: 1\npart-of: lamps.od.yaml\nobjects:\n  0x2000: {name: level, type: unsigned8, access: rw}\n"),
    ];
    let main = "od-spec: 1\ntitle: Lamp\nuses: [../lamps.od.yaml]\ndevices:\n  lamp: {name: Lamp, bit-rates: [125], features: [dim]}\n";
    let (_, compiled) = compiled_with(main, FILES);
    assert!(compiled.system.unwrap().devices[0].objects.contains_key(&od_spec::model::Index(0x2000)));
}
