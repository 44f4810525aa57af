//! Values that a device starts with where none is stated.

use crate::wrong_specifications::case::{self, Case, Right};

const START: &str = "OD0837";

fn entry(keys: &str) -> String {
    format!("objects:\n  0x2000: {{name: gain, {keys}}}")
}

/// With an enum that begins at 1, and one whose 0 is not supported.
fn typed(keys: &str) -> String {
    format!(
        "types:\n  mode: {{base: integer8, values: {{1: on, 2: fast}}}}\n  old: {{base: integer8, values: {{0: {{name: off, supported: no}}, 1: on}}}}\n\
         objects:\n  0x2000: {{name: mode, {keys}}}\n  0x2001: {{name: other, access: ro, type: {}, default: 1}}",
        if keys.contains("type: mode") { "old" } else { "mode" }
    )
}

pub(crate) fn wrong() -> Vec<Case> {
    let start = |name, specification: String| case::wrong(name, specification, START);
    vec![
        start("a low limit above 0 and no default", entry("type: unsigned8, access: rw, min: 1")),
        start("a measured value with a low limit above 0", entry("type: unsigned8, access: ro, min: 1")),
        start("a high limit below 0 and no default", entry("type: integer8, access: rw, max: -1")),
        start("a low limit above 0 of a locked entry", entry("type: unsigned8, access: rw locked, min: 1")),
        start("an enum without 0 and no default", typed("type: mode, access: rw")),
        start("a display of an enum without 0", typed("type: mode, access: ro")),
        start("an enum whose 0 is not supported and no default", typed("type: old, access: rw")),
        start(
            "elements with a low limit above 0",
            "objects:\n  0x2000: {name: gains, array: {count: 2, name: \"gain {n}\", type: unsigned8, access: rw, min: 1}}".to_owned(),
        ),
        case::wrong("a default that is not supported", typed("type: old, access: rw, default: 0"), "OD0403"),
        case::wrong(
            "a default that the enum does not have",
            typed("type: mode, access: rw, default: 0"),
            "OD0403",
        ),
        case::wrong(
            "a default that is not supported, by name",
            typed("type: old, access: rw, default: off"),
            "OD0403",
        ),
        case::wrong(
            "a default below the low limit",
            entry("type: unsigned8, access: rw, min: 1, default: 0"),
            "OD0406",
        ),
    ]
}

pub(crate) fn right() -> Vec<Right> {
    vec![
        case::right("a low limit of 0", entry("type: unsigned8, access: rw, min: 0, max: 5")),
        case::right(
            "a low limit above 0 with a default",
            entry("type: unsigned8, access: rw, min: 1, default: 1"),
        ),
        case::right(
            "a low limit above 0 with a start that is no promise",
            entry("type: unsigned8, access: rw, min: 1, default: 1, eds: {default: withheld}"),
        ),
        case::right(
            "a low limit above 0 with a 0 that means something",
            entry("type: unsigned8, access: ro, min: 1, special: {0: not known yet}"),
        ),
        case::right("a command with a low limit above 0", entry("type: unsigned8, access: wo, min: 1")),
        case::right("a high limit of 0", entry("type: integer8, access: rw, max: 0")),
        case::right("an enum without 0 with a default", typed("type: mode, access: rw, default: on")),
        case::right(
            "an enum without 0 with a 0 that means something",
            typed("type: mode, access: rw, special: {0: not chosen yet}"),
        ),
        case::right(
            "an enum without 0 that starts with a special value",
            typed("type: mode, access: rw, special: {0: not chosen yet}, default: 0"),
        ),
        case::right(
            "an enum whose 0 is not supported with a default",
            typed("type: old, access: rw, default: on"),
        ),
        case::right("an empty text", entry("type: visible-string, access: rw, capacity: 4")),
        case::right(
            "a view of an entry that has a default",
            "objects:\n  0x2000: {name: gain, type: integer16, access: rw, min: 1, default: 1}\n  0x2001: {name: short gain, alias: gain, type: integer8}",
        ),
    ]
}
