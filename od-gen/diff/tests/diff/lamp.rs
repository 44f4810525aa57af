//! What the pitch control system does not have, on a small device.

use od_diff::{Advice, Class, Difference, Scope, Unknown, short};

use crate::{Case, difference, system};

pub(crate) const LAMP: &str = "\
od-spec: 1
title: Lamp
uses: [cia301]
devices:
  lamp:
    name: Lamp
    bit-rates: [125]
    features: [heartbeat producer]
    eds: {created: 2026-01-01 08:00, file-version: 1, file-revision: 9}
units:
  percent: {symbol: \"%\"}
  hour: {symbol: h}
types:
  mode: {base: unsigned8, values: {0: steady, 1: blinking}}
  spare: {base: unsigned8, values: {0: none}}
objects:
  0x2000: {name: brightness, type: unsigned8, unit: percent, access: rw, pdo: receive, default: 80 %, max: 100 %, stored: application}
  0x2001: {name: place, type: visible-string, capacity: 16, access: rw, stored: application}
  0x2002: {name: levels, stored: application, array: {count: 3, name: \"level {n}\", type: unsigned8, access: rw}}
  0x2003: {name: mode, type: mode, access: rw}
pdos:
  lamp:
    receive: {1: {map: [brightness]}}
";

const CASES: &[Case] = &[
    Case {
        name: "longer strings",
        at: "0x2001",
        find: "capacity: 16",
        replace: "capacity: 32",
        expected: &["lamp: ~ 2001h place: capacity: 16 bytes -> 32 bytes [stored, addition]"],
    },
    Case {
        name: "shorter strings",
        at: "0x2001",
        find: "capacity: 16",
        replace: "capacity: 8",
        expected: &["lamp: ~ 2001h place: capacity: 16 bytes -> 8 bytes [plc, stored]"],
    },
    Case {
        name: "a stored element goes",
        at: "0x2002",
        find: "count: 3",
        replace: "count: 2",
        expected: &["lamp: - 2002h.3 levels.level 3: unsigned8 rw [plc, stored, firmware]"],
    },
    Case {
        name: "a stored object goes",
        at: "objects:",
        find: "  0x2002: {name: levels, stored: application, array: {count: 3, name: \"level {n}\", type: unsigned8, access: rw}}\n",
        replace: "",
        expected: &["lamp: - 2002h levels: ARRAY with 4 entries [plc, stored, firmware]"],
    },
    Case {
        name: "elements that are not alike any more have other accessors",
        at: "0x2002",
        find: "access: rw}",
        replace: "access: rw, elements: {3: {unit: percent}}}",
        expected: &[
            "lamp: ~ 2002h levels: identifier: levels(1) -> levels().level_1() [firmware]",
            "lamp: ~ 2002h.3 levels.level 3: unit: none -> 1 % [firmware]",
        ],
    },
    Case {
        name: "a value becomes a constant",
        at: "0x2003",
        find: "access: rw",
        replace: "access: const, default: 0",
        expected: &[
            "lamp: ~ 2003h mode: access: rw -> const [plc, firmware]",
            "lamp: ~ 2003h mode: default: none -> 0: steady [firmware, behaviour]",
        ],
    },
    Case {
        name: "any value instead of those of an enum",
        at: "0x2003",
        find: "type: mode",
        replace: "type: unsigned8",
        expected: &["lamp: ~ 2003h mode: meaning: mode -> none [firmware, addition]"],
    },
    Case {
        name: "a type that no entry uses",
        at: "types:",
        find: "{0: none}",
        replace: "{0: nothing}",
        expected: &["*: ~ type `spare`, value 0: meaning: none -> nothing [documents]"],
    },
    Case {
        name: "a unit that no entry uses",
        at: "units:",
        find: "  hour: {symbol: h}\n",
        replace: "",
        expected: &["*: - unit `hour`: not used [documents]"],
    },
    Case {
        name: "one device has one counterpart, whatever it is called",
        at: "devices:",
        find: "  lamp:\n    name: Lamp",
        replace: "  lamp:\n    name: Desk lamp",
        expected: &[
            "lamp: ~ device: name: Lamp -> Desk lamp [documents]",
            "lamp: ~ device, description: eds: Lamp -> Desk lamp [documents]",
            "lamp: ~ device, name: product: Lamp -> Desk lamp [documents]",
            "lamp: ~ device, order code: product: Lamp -> Desk lamp [documents]",
        ],
    },
];

#[test]
fn small_changes() {
    let old = system(LAMP);
    for case in CASES {
        let found = difference(&old, &system(&case.applied(LAMP)), Scope::Everything);
        let lines = short(&found);
        assert_eq!(lines.lines().collect::<Vec<_>>(), case.expected, "{}", case.name);
    }
}

fn changed(find: &str, replace: &str) -> Difference {
    assert!(LAMP.contains(find), "{find}");
    difference(&system(LAMP), &system(&LAMP.replace(find, replace)), Scope::Everything)
}

#[test]
fn another_key_is_another_name_in_firmware() {
    let found = changed("  lamp:\n", "  light:\n");
    assert_eq!(short(&found), "light: ~ device light: identifier: Lamp -> Light [firmware]\n");
}

#[test]
fn devices_come_and_go() {
    let second = "  torch: {name: Torch, bit-rates: [125], features: [heartbeat producer]}\n";
    let two =
        LAMP.replace("units:\n", &format!("{second}units:\n")).replace("{name: ", "{devices: lamp, name: ");
    let two = two.replace("torch: {devices: lamp, name: Torch", "torch: {name: Torch");
    let (one, two) = (system(LAMP), system(&two));
    let lines = short(&difference(&one, &two, Scope::Everything));
    assert_eq!(lines, "*: + device torch: Torch [addition]\n");
    let lines = short(&difference(&two, &one, Scope::Everything));
    assert_eq!(lines, "*: - device torch: Torch [plc, firmware]\n");
}

/// A setter that comes breaks no code; one that goes does.
#[test]
fn a_constant_becomes_a_value() {
    let constant = LAMP.replace("type: mode, access: rw", "type: mode, access: const, default: 0");
    let value = LAMP.replace("type: mode, access: rw", "type: mode, access: rw, default: 0");
    let (constant, value) = (system(&constant), system(&value));
    let there = short(&difference(&constant, &value, Scope::Everything));
    assert_eq!(there, "lamp: ~ 2003h mode: access: const -> rw [behaviour, addition]\n");
    let back = short(&difference(&value, &constant, Scope::Everything));
    assert_eq!(back, "lamp: ~ 2003h mode: access: rw -> const [plc, firmware]\n");
}

/// Nothing is said about what cannot be known.
#[test]
fn what_cannot_be_code_breaks_no_firmware() {
    let found = changed("capacity: 16, access", "access");
    let device = &found.devices[0];
    assert_eq!(device.unknown, [Unknown::Firmware, Unknown::Stored]);
    assert_eq!(short(&found), "lamp: ~ 2001h place: capacity: 16 bytes -> none [documents]\n");
}

/// The numbers of the old file are 1 and 9, and 0.0.
#[test]
fn version_numbers_are_proposed_by_what_breaks() {
    let numbers = |found: &Difference| {
        let proposals = &found.devices[0].proposals;
        (found.class(), proposals.file.advice, proposals.revision.advice)
    };
    for (find, replace, class, file, revision) in [
        ("max: 100 %", "max: 90 %", Class::Plc, Advice::Raise((2, 0)), Advice::Raise((1, 0))),
        ("count: 3", "count: 4", Class::Stored, Advice::Raise((1, 10)), Advice::Raise((0, 1))),
        ("default: 80 %", "default: 70 %", Class::Behaviour, Advice::Raise((1, 10)), Advice::Raise((0, 1))),
        (
            "1: blinking}",
            "1: blinking, 2: dim}",
            Class::Addition,
            Advice::Raise((1, 10)),
            Advice::Raise((0, 1)),
        ),
        // A comment of the EDS.
        (
            "access: rw, pdo",
            "about: How bright., access: rw, pdo",
            Class::Documents,
            Advice::Raise((1, 10)),
            Advice::Keep,
        ),
        // No word of it is in the EDS.
        (
            "name: brightness, type",
            "name: brightness, identifier: level, type",
            Class::Firmware,
            Advice::Keep,
            Advice::Keep,
        ),
        ("{0: none}", "{0: nothing}", Class::Documents, Advice::Keep, Advice::Keep),
        // The new file states it already, or not enough.
        ("file-revision: 9", "file-revision: 10", Class::Documents, Advice::Keep, Advice::Keep),
    ] {
        assert_eq!(numbers(&changed(find, replace)), (Some(class), file, revision), "{replace}");
    }
    let raised = |version: &str, revision: &str| {
        let text = LAMP.replace("max: 100 %", "max: 90 %");
        let text = text.replace("file-version: 1, file-revision: 9", version);
        let text = text.replace("    bit-rates", &format!("    product-revision: {revision}\n    bit-rates"));
        let (_, file, product) = numbers(&difference(&system(LAMP), &system(&text), Scope::Everything));
        (file, product)
    };
    assert_eq!(raised("file-version: 2, file-revision: 0", "0x0001_0000"), (Advice::Raised, Advice::Raised));
    assert_eq!(
        raised("file-version: 1, file-revision: 10", "0x0000_0001"),
        (Advice::Raise((2, 0)), Advice::Raise((1, 0)))
    );
}
