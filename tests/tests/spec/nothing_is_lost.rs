//! Whatever a key says of objects, entries, errors and machines reaches the model, or a message says why not: each key is
//! planted at each place that takes it, over nothing, over a library and over another object.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::BTreeSet;
use std::fmt::Write as _;

use od_formats::json;
use od_spec::diag::Diagnostic;
use od_spec::keys::{ARRAY, COMMAND, ENTRY, ERROR, Keys, MACHINE, OBJECT, STATE, SUB0, TRANSITION};
use od_tests::plant::compiled;

const HEAD: &str = "od-spec: 1
title: T
vendor: {name: V, number: 1}
uses: [cia301, cia402]
devices:
  dd: {name: D, product: 1, bit-rates: [125], features: [heartbeat producer]}
  ee: {name: E, product: 2, bit-rates: [125], features: [heartbeat producer]}
units: {planted unit: {symbol: pu}}
types: {bits: {base: unsigned8, bits: {0: x}, rest: unused}}
";

const OTHERS: &str = "objects:
  0x2FFC: {name: command, type: unsigned8, access: rw}
  0x2FFD: {name: status, type: unsigned8, access: ro}
  0x2FFE: {name: other, type: unsigned32, access: rw, about: Something else.}
  0x2FFF: {name: another, type: bits, access: rw}
";

const MACHINE_START: &str = "state-machines:\n  m: {status: 0x2FFD, command: 0x2FFC, ";
const STATES: &str = "states: {a: {pattern: xxxx xxx0}, b: {pattern: xxxx xxx1}}";
const TRANSITIONS: &str = "transitions: {0: {from: start, to: a, event: x}, 1: {from: a, to: b, event: x}, 2: {from: b, to: a, event: x}}";

/// Two values that a key may have: one of them differs from what is there.
fn values(table: &Keys, key: &str) -> [&'static str; 2] {
    match (table.name, key) {
        ("a state machine", "from") => ["cia301", "cia402"],
        ("a state machine", "command") => ["0x2FFE", "0x2FFD"],
        ("a state machine", "states") => ["{planted: {pattern: xxxx xx1x}}", "{a: {pattern: xxxx x1xx}}"],
        ("a state machine", "transitions") => ["{9: {from: start, to: a, event: planted}}", "{}"],
        ("a state machine", "commands") => ["{planted: {pattern: xxxx x1xx}}", "{}"],
        ("a state", "pattern") => ["x1xx xxxx", "x1xx xxxx xxxx xxxx"],
        ("a command", "pattern") => ["xx1x xxxx", "xx1x xxxx xxxx xxxx"],
        ("a transition", "from") => ["b", "Fault"],
        ("a command", "transitions") => ["[2]", "[3]"],
        (_, "name" | "identifier") => ["planted", "also_planted"],
        (_, "type") => ["integer16", "unsigned32"],
        (_, "unit") => ["planted unit", "millisecond"],
        (_, "access") => ["ro", "wo"],
        (_, "pdo") => ["receive", "transmit"],
        (_, "default") => ["3", "4"],
        (_, "min") => ["1", "2"],
        (_, "max") => ["100", "99"],
        (_, "special") => ["{77: planted}", "{78: planted}"],
        (_, "stored") => ["application", "communication"],
        (_, "category") => ["optional", "mandatory"],
        (_, "since") => ["\"9.99\"", "\"9.98\""],
        (_, "writable-when") => ["0x2FFF == 1", "0x2FFF == 2"],
        (_, "bit-errors") => ["{0: 0x4310}", "{0: 0x4210}"],
        (_, "capacity") => ["9", "10"],
        (_, "eds") => ["{flags: [no-scan]}", "{default: withheld}"],
        (_, "devices" | "treated-by") => ["[dd]", "[ee]"],
        (_, "from") => ["cia301", "cia402"],
        (_, "like" | "alias") => ["0x2FFE", "0x2FFF"],
        (_, "outside") => ["wrap", "saturate"],
        (_, "rounding") => ["nearest", "down"],
        (_, "array") => ["{count: 3, name: \"planted {n}\", type: unsigned16, access: rw}", "{count: 4}"],
        (_, "record") => ["{1: {name: planted, type: unsigned16, access: rw}}", "{1: {name: planted}}"],
        (_, "sub0") => ["{name: planted}", "{name: also planted}"],
        (_, "omit") => ["[1]", "[2]"],
        (_, "links") => ["[0x2FFF]", "[0x2FFE]"],
        (_, "count") => ["3", "4"],
        (_, "elements") => ["{1: {name: planted}}", "{2: {name: planted}}"],
        (_, "option-code" | "status" | "command") => ["0x2FFE", "0x2FFF"],
        (_, "register") => ["[current]", "[temperature, voltage]"],
        (_, "send") => ["1", "3"],
        (_, "to") => ["b", "Fault"],
        (_, "by-device") => ["event", "automatic"],
        (_, "about" | "gap" | "warning" | "priority" | "reaction" | "reset" | "event" | "action") => {
            ["planted", "also planted"]
        }
        (_, "search") => ["{en: planted}", "{de: [also, planted]}"],
        (table, key) => panic!("a value is needed for `{key}` of {table}"),
    }
}

/// A place that takes the keys of a table.
struct Place {
    table: &'static Keys,
    /// What is before the map of the keys, and after it.
    around: [String; 2],
    /// What is in the map.
    there: &'static [(&'static str, &'static str)],
}

impl Place {
    fn new(
        table: &'static Keys,
        before: impl Into<String>,
        there: &'static [(&'static str, &'static str)],
        behind: &str,
    ) -> Self {
        Self { table, around: [before.into(), behind.to_owned()], there }
    }

    /// The specification with a key more.
    fn text(&self, planted: Option<(&str, &str)>) -> String {
        let others =
            self.there.iter().copied().filter(|(key, _)| planted.is_none_or(|(name, _)| name != *key));
        let keys: Vec<String> = others.chain(planted).map(|(key, value)| format!("{key}: {value}")).collect();
        let [before, behind] = &self.around;
        format!("{HEAD}{before}{{{}}}{behind}\n", keys.join(", "))
    }
}

#[expect(clippy::too_many_lines, reason = "it is one table")]
fn places() -> Vec<Place> {
    let object = |before: &str| format!("{OTHERS}  {before}");
    let mut places = vec![
        Place::new(
            &OBJECT,
            object("0x2000: "),
            &[("name", "a"), ("type", "unsigned8"), ("access", "rw")],
            "",
        ),
        Place::new(&OBJECT, object("0x2000: "), &[("name", "a"), ("type", "bits"), ("access", "rw")], ""),
        Place::new(
            &OBJECT,
            object("0x2000: "),
            &[("name", "a"), ("type", "visible-string"), ("access", "rw")],
            "",
        ),
        Place::new(
            &OBJECT,
            object("0x2000: "),
            &[("name", "a"), ("array", "{count: 2, name: \"e {n}\", type: unsigned8, access: rw}")],
            "",
        ),
        Place::new(
            &OBJECT,
            object("0x2000: "),
            &[
                ("name", "a"),
                ("type", "unsigned8"),
                ("access", "rw"),
                ("array", "{count: 2, name: \"e {n}\"}"),
            ],
            "",
        ),
        Place::new(
            &OBJECT,
            object("0x2000: "),
            &[("name", "a"), ("record", "{1: {name: b, type: unsigned8, access: rw}}")],
            "",
        ),
        Place::new(
            &OBJECT,
            object("0x2000: "),
            &[("name", "a"), ("alias", "other"), ("type", "unsigned16")],
            "",
        ),
        Place::new(
            &ARRAY,
            object("0x2000: {name: a, array: "),
            &[
                ("count", "2"),
                ("name", "\"e {n}\""),
                ("type", "unsigned8"),
                ("access", "rw"),
                ("elements", "{1: {name: z, default: 9, min: 7}}"),
            ],
            "}",
        ),
        Place::new(
            &ENTRY,
            object(
                "0x2000: {name: a, array: {count: 2, name: \"e {n}\", type: unsigned8, access: rw, default: 8, min: 5, elements: {1: ",
            ),
            &[],
            "}}}",
        ),
        Place::new(
            &ENTRY,
            object("0x2000: {name: a, record: {1: "),
            &[("name", "b"), ("type", "unsigned8"), ("access", "rw")],
            "}}",
        ),
        Place::new(
            &SUB0,
            object("0x2000: {name: a, record: {1: {name: b, type: unsigned8, access: rw}}, sub0: "),
            &[],
            "}",
        ),
        Place::new(&ERROR, "errors:\n  0x4310: ", &[("name", "hot")], ""),
        Place::new(&ERROR, "errors:\n  0x2310: ", &[("from", "cia402")], ""),
        Place::new(
            &MACHINE,
            format!("{OTHERS}state-machines:\n  m: "),
            &[
                ("status", "0x2FFD"),
                ("command", "0x2FFC"),
                ("states", "{a: {pattern: xxxx xxx0}, b: {pattern: xxxx xxx1}}"),
            ],
            "",
        ),
        Place::new(
            &STATE,
            format!("{OTHERS}{MACHINE_START}states: {{a: "),
            &[("pattern", "xxxx xxx0")],
            "}}",
        ),
        Place::new(
            &TRANSITION,
            format!("{OTHERS}{MACHINE_START}{STATES}, transitions: {{1: "),
            &[("from", "a"), ("to", "b"), ("event", "x")],
            "}}",
        ),
        Place::new(
            &COMMAND,
            format!("{OTHERS}{MACHINE_START}{STATES}, {TRANSITIONS}, commands: {{go: "),
            &[("pattern", "xxxx xxx1"), ("transitions", "[1]")],
            "}}",
        ),
    ];
    let words = "objects:\n  0x6040: {from: cia402}\n  0x6041: {from: cia402}\n  0x2FFD: {name: status, type: unsigned8, access: ro}\n  0x2FFE: {name: other, type: unsigned16, access: rw}\n  0x2FFF: {name: more, type: unsigned16, access: rw}\n";
    let machine = format!("{words}state-machines:\n  power drive system: ");
    places.extend([
        Place::new(&MACHINE, &machine, &[("from", "cia402")], ""),
        Place::new(&STATE, format!("{machine}{{from: cia402, states: {{Fault: "), &[], "}}"),
        Place::new(&TRANSITION, format!("{machine}{{from: cia402, transitions: {{15: "), &[], "}}"),
        Place::new(&COMMAND, format!("{machine}{{from: cia402, commands: {{Fault reset: "), &[], "}}"),
    ]);
    for (index, library) in [("0x1015", "cia301"), ("0x6040", "cia402")] {
        let from: &[_] = if library == "cia301" { &[("from", "cia301")] } else { &[("from", "cia402")] };
        places.push(Place::new(&OBJECT, object(&format!("{index}: ")), from, ""));
    }
    let arrays = [
        ("0x1003", "cia301"),
        ("0x1010", "cia301"),
        ("0x1016", "cia301"),
        ("0x1029", "cia301"),
        ("0x6091", "cia402"),
        ("0x6099", "cia402"),
    ];
    for (index, library) in arrays {
        let from = object(&format!("{index}: {{from: {library}"));
        places.extend([
            Place::new(&ARRAY, format!("{from}, array: "), &[("count", "2")], "}"),
            Place::new(&ENTRY, format!("{from}, array: {{count: 2, elements: {{1: "), &[], "}}}"),
            Place::new(&SUB0, format!("{from}, sub0: "), &[], "}"),
            Place::new(
                &ARRAY,
                format!("{from}}}\n  0x2100: {{name: b, like: {index}, array: "),
                &[("count", "2")],
                "}",
            ),
        ]);
    }
    let from = object("0x60C2: {from: cia402");
    places.extend([
        Place::new(&OBJECT, object("0x1010: "), &[("from", "cia301")], ""),
        Place::new(&OBJECT, object("0x60C2: "), &[("from", "cia402")], ""),
        Place::new(&ENTRY, format!("{from}, record: {{1: "), &[], "}}"),
        Place::new(&SUB0, format!("{from}, sub0: "), &[], "}"),
        Place::new(&OBJECT, format!("{from}}}\n  0x2100: "), &[("name", "b"), ("like", "0x60C2")], ""),
        Place::new(&ENTRY, format!("{from}}}\n  0x2100: {{name: b, like: 0x60C2, record: {{1: "), &[], "}}"),
    ]);
    places
}

/// The model without what only says who states something, and the messages.
fn seen(text: &str) -> (Option<serde_json::Value>, BTreeSet<String>) {
    fn strip(value: &mut serde_json::Value) {
        match value {
            serde_json::Value::Object(map) => {
                map.retain(|key, _| !matches!(key.as_str(), "differs" | "standard"));
                map.values_mut().for_each(strip);
            }
            serde_json::Value::Array(list) => list.iter_mut().for_each(strip),
            _ => {}
        }
    }
    let (_, compiled) = compiled(text);
    let dump = compiled.system.map(|system| {
        let mut dump = serde_json::from_slice(&json::dump(&system, &[])).unwrap();
        strip(&mut dump);
        dump
    });
    let said = |one: &Diagnostic| format!("{}: {}", one.code.id, one.message);
    (dump, compiled.diagnostics.iter().map(said).collect())
}

#[test]
fn every_key_reaches_the_model_or_is_answered() {
    let mut lost = String::new();
    for place in places() {
        let (dump, said) = seen(&place.text(None));
        assert!(dump.is_some(), "{}: {said:?}", place.text(None));
        for key in place.table.keys {
            let shows = |value: &str| {
                let (planted, answer) = seen(&place.text(Some((key.name, value))));
                planted.is_some() && planted != dump || !answer.is_subset(&said)
            };
            if !values(place.table, key.name).into_iter().any(shows) {
                let _ = writeln!(
                    lost,
                    "`{}` of {}: {}",
                    key.name,
                    place.table.name,
                    place.around[0].lines().last().unwrap()
                );
            }
        }
    }
    assert!(lost.is_empty(), "{lost}");
}
