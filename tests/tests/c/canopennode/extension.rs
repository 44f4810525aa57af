//! The extension next to the stack, as an application meets it: rules, locks, conditions, views, extensions of its own,
//! storage.

use crate::canopennode::project::of_text;

const SPECIFICATION: &str = "
od-spec: 1
title: Extension
uses: [cia301]
devices:
  thing: {name: Thing, bit-rates: [125], features: [emergency, heartbeat producer, store parameters, restore defaults]}
units:
  decivolt: {symbol: V, scale: 1/10}
  volt: {symbol: V}
  millivolt: {symbol: mV, base: 1/1000 V}
types:
  mode: {base: unsigned8, values: {0: off, 1: on, 2: {name: fast, supported: no}, 3: slow}}
objects:
  0x2000: {name: set point, identifier: set_point, type: unsigned16, access: rw, unit: decivolt, min: 1.0 V, max: 100.0 V, special: {65535: none}}
  0x2001: {name: mode, type: mode, access: rw, default: off}
  0x2002: {name: switch, type: boolean, access: rw}
  0x2003: {name: text, type: visible-string, capacity: 8, access: rw, default: abc}
  0x2004: {name: list, array: {count: 4, name: \"part {n}\", type: unsigned16, access: rw, max: 7}}
  0x2005: {name: protected, type: unsigned16, access: rw locked}
  0x2006: {name: limit, type: unsigned16, access: rw, unit: millivolt, writable-when: 0x2000 >= 2}
  0x2007: {name: wide, type: unsigned32, access: rw, unit: millivolt, max: 100000000}
  0x2008: {alias: 0x2007, name: narrow, type: unsigned16, unit: volt}
  0x2009: {name: program, type: domain, access: rw}
  0x200A: {name: identifier, type: unsigned32, access: rw, default: $NODEID + 0x700}
  0x200B: {name: free, type: unsigned16, access: rw}
  0x200C:
    name: kept
    record:
      1: {name: first, type: unsigned16, access: rw, default: 1, stored: application}
      2: {name: second, type: unsigned16, access: rw, default: 2}
  0x200D: {name: hours, type: unsigned32, access: ro, stored: remanent}
";

#[test]
fn an_application_meets_the_rules() {
    let project = of_text("extension.od.yaml", SPECIFICATION);
    assert_eq!(project.run("try_extension.c", &[]), "done\n");
}
