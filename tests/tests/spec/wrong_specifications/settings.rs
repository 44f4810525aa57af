//! Values of a node, of every kind of entry: what the generated dictionary would refuse is refused before.

use crate::wrong_specifications::case::{self, Case, Right};

const DEVICE: &str = "\
devices:
  io: {name: Example, bit-rates: [125], features: [heartbeat producer, error history, store parameters]}
types:
  mode: {base: unsigned16, values: {0: off, 1: on, 2: {name: old, supported: no}}}
  flags: {base: unsigned8, bits: {0: run}, rest: reserved}
objects:
  0x2000: {name: label, type: visible-string, capacity: 4, access: rw}
  0x2001: {name: key, type: octet-string, capacity: 2, access: rw}
  0x2002: {name: title, type: unicode-string, capacity: 4, access: rw}
  0x2003: {name: mode, type: mode, access: rw, default: off, special: {9: test bench}}
  0x2004: {name: short mode, alias: mode, type: unsigned8}
  0x2005: {name: flags, type: flags, access: rw}
  0x2006: {name: gain, type: unsigned8, access: rw, min: 2, max: 9, default: 2, special: {0: none}}
  0x2007: {name: state, type: unsigned8, access: ro}
  0x2008: {name: calibration, type: unsigned8, access: rw locked}
  0x2009: {name: switch, type: boolean, access: rw}";

pub(crate) fn wrong() -> Vec<Case> {
    let wrong = |name, code, set| case::wrong(name, DEVICE, code).set(set);
    vec![
        wrong("a text over its capacity", "OD0404", &["2000=abcde"]),
        wrong("octets over their capacity", "OD0404", &["2001=01 02 03"]),
        wrong("characters over their capacity", "OD0404", &["2002=abc"]),
        wrong("a stranger to the enum", "OD0403", &["2003=3"]),
        wrong("an unsupported value of the enum", "OD0403", &["2003=2"]),
        wrong("an unsupported value of the enum, by name", "OD0403", &["2003=old"]),
        wrong("an unsupported value of the enum, through a view", "OD0403", &["2004=2"]),
        wrong("a reserved bit", "OD0810", &["2005=2"]),
        wrong("below the low limit", "OD0406", &["2006=1"]),
        wrong("above the high limit", "OD0406", &["2006=10"]),
        wrong("more than the type holds", "OD0404", &["2006=256"]),
        wrong("an entry that can only be read", "OD0703", &["2007=1"]),
        wrong("a locked entry", "OD0704", &["2008=1"]),
        wrong("more than a BOOLEAN", "OD0401", &["2009=2"]),
        wrong("a command", "OD0707", &["1010.1=0x65766173"]),
    ]
}

pub(crate) fn right() -> Vec<Right> {
    let right = |name, set| case::right(name, DEVICE).set(set);
    vec![
        right("a text as long as its capacity", &["2000=abcd"]),
        right("octets as long as their capacity", &["2001=01 02"]),
        right("characters as long as their capacity", &["2002=ab"]),
        right("a supported value of the enum", &["2003=1"]),
        right("a special value in addition to the enum", &["2003=9"]),
        right("a special value in addition to the enum, through a view", &["2004=9"]),
        right("a named bit", &["2005=1"]),
        right("the low limit", &["2006=2"]),
        right("the high limit", &["2006=9"]),
        right("a special value below the limits", &["2006=0"]),
        right("a BOOLEAN", &["2009=yes"]),
    ]
}
