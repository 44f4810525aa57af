//! A specification in several files says what it says in one, and what is wrong with its parts is said where it is.

use od_formats::json;
use od_spec::diag::Diagnostics;

use crate::diagnostics::bytes_and_libraries::compiled_with;
use crate::diagnostics::human;

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
  - {at: 0x2000, kind: type, place: {en: page 1, de: Seite 1}, prints: {en: UNSIGNED16, de: UNSIGNED16}, reads: {en: UNSIGNED8, de: UNSIGNED8}, because: {en: it has two values, de: zwei Werte}}
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
  - {at: 0x2000, kind: type, place: {en: page 1, de: Seite 1}, prints: {en: UNSIGNED16, de: UNSIGNED16}, reads: {en: UNSIGNED8, de: UNSIGNED8}, because: {en: it has two values, de: zwei Werte}}
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
    insta::assert_snapshot!(said(MAIN, WRONG), @r##"
        error[OD0201]: a part has no key `title`
         --> plant/rest.od.yaml:3:1
          |
        3 | title: Lamp
          | ^^^^^ unknown
          |
        help: its keys are `od-spec`, `part-of`, `history`, `allow`, `glossary`, `devices`, `units`, `types`, `features`, `objects`, `pdos`, `errors`, `state-machines`, `constraints`, `errata`, `document`

        error[OD0201]: a part has no key `parts`
         --> plant/rest.od.yaml:4:1
          |
        4 | parts: []
          | ^^^^^ unknown
          |
        help: its keys are `od-spec`, `part-of`, `history`, `allow`, `glossary`, `devices`, `units`, `types`, `features`, `objects`, `pdos`, `errors`, `state-machines`, `constraints`, `errata`, `document`

        error[OD0202]: found a list, expected a map whose keys are names
         --> plant/rest.od.yaml:5:8
          |
        5 | units: [volt]
          |        ^^^^^^
          |
        help: write a map whose keys are names

        error[OD0105]: key `lamp` is written twice in this map
         --> plant/rest.od.yaml:7:3
          |
        7 |   lamp: {transmit: {1: {map: [0x2001]}}}
          |   ^^^^ again here
          |
         ::: plant/lamp.od.yaml:9:3
          |
        9 |   lamp: {receive: {1: {map: [brightness]}}}
          |   ---- first here
          |
        help: remove one of the two, or join their values

        error[OD0105]: key `0x2000` is written twice in this map
          --> plant/rest.od.yaml:9:3
           |
         9 |   0x2000: {name: current, type: unsigned16, access: ro}
           |   ^^^^^^ again here
           |
          ::: plant/lamp.od.yaml:12:3
           |
        12 |   0x2000: {name: brightness, type: level, access: rw, pdo: receive}
           |   ------ first here
           |
        help: remove one of the two, or join their values

        error[OD0609]: there is no type `unsigned33`
          --> plant/rest.od.yaml:10:31
           |
        10 |   0x2001: {name: hours, type: unsigned33, access: ro, about: {fr: temps}}
           |                               ^^^^^^^^^^
           |
        help: did you mean `unsigned32`?

        error[OD0311]: `languages:` does not list `fr`
          --> plant/rest.od.yaml:10:63
           |
        10 |   0x2001: {name: hours, type: unsigned33, access: ro, about: {fr: temps}}
           |                                                               ^^
           |
        help: add the language to `languages:` at the top of the file

        error[OD0112]: found the key `8192`, expected indices such as `0x6040`, 0001h to FFFFh, or runs such as `0x3511..0x3519`
          --> plant/rest.od.yaml:11:3
           |
        11 |   8192: {name: voltage, type: unsigned16, access: ro}
           |   ^^^^
           |
        help: write `0x8192`
        "##);
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
    insta::assert_snapshot!(said(MAIN, NO_PART), @r##"
        error[OD0118]: `rest.od.yaml` does not say that it is a part
         --> plant/lamp.od.yaml:5:24
          |
        5 | parts: [types.od.yaml, rest.od.yaml]
          |                        ^^^^^^^^^^^^
          |
        help: write `part-of: lamp.od.yaml` at its top; a library is named under `uses:`
        "##);
    insta::assert_snapshot!(said(MAIN, OF_ANOTHER), @r##"
        error[OD0203]: a part needs the key `od-spec`
         --> plant/rest.od.yaml:1:1
          |
        1 | part-of: torch.od.yaml
          | ^^^^^^^
          |
        help: add `od-spec:` (version of the language; `1`)

        error[OD0118]: this part says that it belongs to `torch.od.yaml`
         --> plant/rest.od.yaml:1:10
          |
        1 | part-of: torch.od.yaml
          |          ^^^^^^^^^^^^^
          |
         ::: plant/lamp.od.yaml:5:24
          |
        5 | parts: [types.od.yaml, rest.od.yaml]
          |                        ------------ it is read for this file
          |
        help: write `part-of: lamp.od.yaml`
        "##);
    insta::assert_snapshot!(said(MAIN, MISSING), @r##"
        error[OD0117]: cannot read the part `rest.od.yaml`: no such file
         --> plant/lamp.od.yaml:5:24
          |
        5 | parts: [types.od.yaml, rest.od.yaml]
          |                        ^^^^^^^^^^^^
          |
        help: name a file relative to this one
        "##);
    insta::assert_snapshot!(said(&MAIN.replace("rest.od", "types.od"), PARTS), @r##"
        error[OD0303]: part `types.od.yaml` is used twice
         --> plant/lamp.od.yaml:5:24
          |
        5 | parts: [types.od.yaml, types.od.yaml]
          |         -------------  ^^^^^^^^^^^^^ again here
          |         |
          |         first here
          |
        help: remove one of the two
        "##);
    insta::assert_snapshot!(said(MAIN, LIST), @r##"
        error[OD0118]: `rest.od.yaml` does not say that it is a part
         --> plant/lamp.od.yaml:5:24
          |
        5 | parts: [types.od.yaml, rest.od.yaml]
          |                        ^^^^^^^^^^^^
          |
        help: write `part-of: lamp.od.yaml` at its top; a library is named under `uses:`
        "##);
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
