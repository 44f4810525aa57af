//! Values that a device starts with.

use crate::wrong_specifications::case::{self, Case, Right};

/// An object, with features in addition to the usual ones.
fn with(features: &str, object: &str) -> String {
    format!(
        "devices:\n  io: {{name: Example, bit-rates: [125], features: [heartbeat producer{features}]}}\nobjects:\n  {object}"
    )
}

/// 1016h with these entries.
fn heartbeats(values: &[&str]) -> String {
    let element = |(at, value): (usize, &&str)| format!("{}: {{default: {value}}}", at + 1);
    let elements: Vec<String> = values.iter().enumerate().map(element).collect();
    let count = values.len();
    with(
        ", heartbeat consumer",
        &format!(
            "0x1016: {{from: cia301, array: {{count: {count}, elements: {{{}}}}}}}",
            elements.join(", ")
        ),
    )
}

fn counter(default: u8) -> String {
    with(", sync counter", &format!("0x1019: {{from: cia301, default: {default}}}"))
}

fn reaction(default: u8) -> String {
    with(
        "",
        &format!(
            "0x1029: {{name: Error behaviour, array: {{count: 1, name: \"class {{n}}\", type: unsigned8, access: rw, default: {default}}}}}"
        ),
    )
}

fn real(data_type: &str, default: &str) -> String {
    with(
        "",
        &format!(
            "0x2000: {{name: gain, type: {data_type}, access: rw, default: {default}, eds: {{default: withheld}}}}"
        ),
    )
}

fn text(data_type: &str, default: &str) -> String {
    with("", &format!("0x2000: {{name: label, type: {data_type}, access: rw, default: \"{default}\"}}"))
}

/// An entry and a view of it.
fn view(target: &str, more: &str) -> String {
    with(
        "",
        &format!(
            "0x2000: {{name: target, type: unsigned32, {target}}}\n  0x2001: {{name: view, alias: target, type: unsigned16{more}}}"
        ),
    )
}

const COMMAND: &str = "access: rw, eds: {flags: [no-write]}";
const MODES: &str = "types:\n  mode: {base: unsigned8, values: {0: off, 1: on}}\n";

pub(crate) fn wrong() -> Vec<Case> {
    let watch = |name, values: &[&str], code| case::wrong(name, heartbeats(values), code);
    let count = |name, default| case::wrong(name, counter(default), "OD0510");
    vec![
        watch("a heartbeat of node 128", &["0x008003E8"], "OD0510"),
        watch("a heartbeat of node 128 by a formula", &["$NODEID + 0x008003E8"], "OD0510"),
        watch("a heartbeat of no node", &["0x000003E8"], "OD0828"),
        watch("a heartbeat with a reserved bit", &["0x010503E8"], "OD0510"),
        watch("one node twice", &["0x000503E8", "0x000503E8"], "OD0510"),
        watch("one node twice by a formula", &["$NODEID + 0x000503E8", "$NODEID + 0x000503E9"], "OD0510"),
        watch("the own heartbeat, set", &["0"], "OD0828").set(&["1016.1=0x503E8"]),
        watch("a heartbeat of node 128, set by a formula", &["0"], "OD0510")
            .set(&["1016.1=$NODEID+0x8003E8"]),
        count("a SYNC counter that never changes", 1),
        case::wrong("a SYNC counter to 241", counter(241), "OD0406"),
        case::wrong(
            "a SYNC counter to 241, in full",
            with(", sync consumer", "0x1019: {name: counter, type: unsigned8, access: rw, default: 241}"),
            "OD0510",
        ),
        case::wrong("a reserved reaction to errors", reaction(3), "OD0510"),
        case::wrong("the last reserved reaction to errors", reaction(127), "OD0510"),
        case::wrong(
            "a reserved storage format",
            with(
                "",
                "0x1021: {name: Store EDS, type: domain, access: ro}\n  0x1022: {name: Storage format, type: unsigned16, access: ro, default: 5}",
            ),
            "OD0510",
        ),
        case::wrong(
            "a signature that is read",
            with(
                "",
                "0x1010: {name: Store, array: {count: 1, name: \"store {n}\", type: unsigned32, access: rw, default: 0x65766173, eds: {flags: [no-write]}}}",
            ),
            "OD0510",
        ),
        case::wrong("a REAL32 of twelve digits", real("real32", "0.123456789012"), "OD0830"),
        case::wrong("an integer that a REAL32 does not have", real("real32", "16777217"), "OD0830"),
        case::wrong(
            "a REAL32 with digits after those of a REAL64",
            real("real32", "0.10000000000000000001"),
            "OD0830",
        ),
        case::wrong("a REAL64 of twenty digits", real("real64", "0.10000000000000000001"), "OD0830"),
        case::wrong("an integer that a REAL64 does not have", real("real64", "9007199254740993"), "OD0830"),
        case::wrong("a number that is 0 in a REAL64", real("real64", "1e-400"), "OD0830"),
        case::wrong(
            "a REAL64 of twenty digits, set",
            with("", "0x2000: {name: gain, type: real64, access: rw}"),
            "OD0830",
        )
        .set(&["2000=0.10000000000000000001"]),
        case::wrong("a number that is 0 in a REAL32", real("real32", "1e-50"), "OD0830"),
        case::wrong(
            "a REAL32 of ten digits, set",
            with("", "0x2000: {name: gain, type: real32, access: rw}"),
            "OD0830",
        )
        .set(&["2000=0.1234567891"]),
        case::wrong("a formula in a text", text("visible-string", "$NODEID + 1"), "OD0319"),
        case::wrong("a node-ID inside a text", text("visible-string", "node $nodeid"), "OD0319"),
        case::wrong("a node-ID in a UNICODE_STRING", text("unicode-string", "$NODEID"), "OD0319"),
        case::wrong(
            "a node-ID in a text, set",
            with("", "0x2000: {name: label, type: visible-string, access: rw, capacity: 20}"),
            "OD0319",
        )
        .set(&["2000=$NODEID+1"]),
        case::wrong("a view that is read of what cannot be", view("access: wo", ", access: ro"), "OD0418"),
        case::wrong(
            "a view that is read and written of what cannot be read",
            view("access: wo", ", access: rw"),
            "OD0418",
        ),
        case::wrong("a view that is written of what cannot be", view("access: ro", ", access: rw"), "OD0418"),
        case::wrong("a view of a command", view(COMMAND, ""), "OD0420"),
        case::wrong(
            "a view of 1010h",
            with(", store parameters", "0x2001: {name: view, alias: 0x1010.1, type: unsigned16}"),
            "OD0420",
        ),
        case::wrong(
            "a value that the enum does not have",
            format!("{MODES}objects:\n  0x2000: {{name: mode, type: mode, access: rw, default: 7}}"),
            "OD0403",
        ),
        case::wrong(
            "a node-ID for an enum",
            format!("{MODES}objects:\n  0x2000: {{name: mode, type: mode, access: rw, default: $NODEID}}"),
            "OD0403",
        ),
    ]
}

pub(crate) fn right() -> Vec<Right> {
    let watch = |name, values: &[&str]| case::right(name, heartbeats(values));
    let count = |name, default| case::right(name, counter(default));
    let number = |name, data_type, default| case::right(name, real(data_type, default));
    vec![
        watch("a heartbeat of node 127", &["0x007F03E8"]),
        watch("a heartbeat of node 1", &["0x000103E8"]),
        watch("no heartbeat, and no time for node 5", &["0", "0x00050000"]),
        watch("one node, once without a time", &["0x000503E8", "0x00050000"]),
        watch("a heartbeat of another node, set", &["0"]).set(&["1016.1=0x603E8"]),
        watch("the own node without a time, set", &["0"]).set(&["1016.1=0x50000"]),
        count("no SYNC counter", 0),
        count("a SYNC counter to 2", 2),
        count("a SYNC counter to 240", 240),
        case::right("the last reaction to errors", reaction(2)),
        case::right("a reaction to errors of the maker's own", reaction(128)),
        number("a tenth", "real32", "0.1"),
        number("a tenth with zeros", "real32", "0.1000"),
        number("a tenth as a program prints it", "real32", "0.10000000149011612"),
        number("the last integer of a REAL32", "real32", "16777216"),
        number("twelve digits of a REAL64", "real64", "0.123456789012"),
        number("a tenth of a REAL64", "real64", "0.1"),
        number("a tenth of a REAL64 as a program prints it", "real64", "0.10000000000000001"),
        number("the last integer of a REAL64", "real64", "9007199254740992"),
        case::right(
            "a REAL32 of eight digits, set",
            with("", "0x2000: {name: gain, type: real32, access: rw}"),
        )
        .set(&["2000=0.12345679"]),
        case::right("a dollar in a text", text("visible-string", "5 $NODE")),
        case::right(
            "a node-ID in a text that no EDS shows",
            with(
                "",
                "0x2000: {name: label, type: visible-string, access: rw, default: \"$NODEID\", eds: {default: withheld}}",
            ),
        ),
        case::right("a view of what cannot be read", view("access: wo", "")),
        case::right("a view that is only read", view("access: rw", ", access: ro")),
        case::right("a view of a command that is only read", view(COMMAND, ", access: ro")),
        case::right("a view of a locked entry", view("access: rw locked", "")),
        case::right(
            "a value of the enum",
            format!("{MODES}objects:\n  0x2000: {{name: mode, type: mode, access: rw, default: on}}"),
        ),
    ]
}
