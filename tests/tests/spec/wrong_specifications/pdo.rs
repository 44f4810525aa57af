//! PDOs as a whole: transmission, times, SYNC counter, mapping.

use crate::wrong_specifications::case::{self, Case, Right};

/// A device with RPDO 1 and TPDO 1, `features` in addition to heartbeat, `objects`, and more keys of the two PDOs.
fn device(features: &str, objects: &str, receive: &str, transmit: &str) -> String {
    let features = if features.is_empty() { String::new() } else { format!(", {features}") };
    let key = |keys: &str| if keys.is_empty() { String::new() } else { format!("{keys}, ") };
    format!(
        "devices:
  io: {{name: Example, bit-rates: [125], features: [heartbeat producer{features}]}}
objects:
  0x2000: {{name: level, type: unsigned8, access: ro, pdo: transmit}}
  0x2001: {{name: target, type: unsigned8, access: rw, pdo: receive}}
{objects}pdos:
  io:
    receive: {{1: {{{}map: [target]}}}}
    transmit: {{1: {{{}map: [level]}}}}",
        key(receive),
        key(transmit)
    )
}

fn tpdo(features: &str, keys: &str) -> String {
    device(features, "", "", keys)
}

fn rpdo(features: &str, keys: &str) -> String {
    device(features, "", keys, "")
}

/// A device whose SYNC counter runs to a number.
fn counter(last: u8, receive: &str, transmit: &str) -> String {
    device("sync counter", &format!("  0x1019: {{from: cia301, default: {last}}}\n"), receive, transmit)
}

/// A device with a communication object that can be mapped.
fn mappable(features: &str, object: &str) -> String {
    device(features, &format!("  {object}\n"), "", "")
}

const NO_SYNC: &str = "OD0814";
const REMOTE: &str = "OD0516";
const START: &str = "OD0836";
const TIME: &str = "OD0824";
const ACCESS: &str = "OD0812";
/// All times and the start value, each of no effect.
const TIMES: &str = "transmission: 1, sync-start: 0, inhibit-time: 0, event-timer: 0";

pub(crate) fn wrong() -> Vec<Case> {
    [sync(), remote_frames(), sync_start(), times(), mapping()].into_iter().flatten().collect()
}

fn sync() -> Vec<Case> {
    let wrong = |name, specification| case::wrong(name, specification, NO_SYNC);
    vec![
        wrong("synchronous acyclic without 1005h", tpdo("", "transmission: 0")),
        wrong("every SYNC without 1005h", tpdo("", "transmission: 1")),
        wrong("every 240th SYNC without 1005h", tpdo("", "transmission: 240")),
        wrong("synchronous on remote frames without 1005h", tpdo("", "transmission: 252")),
        wrong("an RPDO that waits for SYNC without 1005h", rpdo("", "transmission: 0")),
        wrong("set to SYNC without 1005h", tpdo("", "")).set(&["1800.2=1"]),
        case::wrong("an RPDO on remote frames", rpdo("sync consumer", "transmission: 252"), "OD0505"),
        case::wrong("an RPDO on remote frames at any time", rpdo("", "transmission: 253"), "OD0505"),
        case::wrong("an RPDO set to remote frames", rpdo("", ""), "OD0505").set(&["1400.2=253"]),
        case::wrong("a reserved type", tpdo("", "transmission: 241"), "OD0505"),
    ]
}

fn remote_frames() -> Vec<Case> {
    let wrong = |name, specification| case::wrong(name, specification, REMOTE);
    vec![
        wrong("252 without remote frames", tpdo("sync consumer", "transmission: 252, no-rtr: yes")),
        wrong("253 without remote frames", tpdo("", "transmission: 253, no-rtr: yes")),
        wrong("253 without remote frames, off", tpdo("", "transmission: 253, no-rtr: yes, valid: no")),
        wrong("set to remote frames that are forbidden", tpdo("", "no-rtr: yes")).set(&["1800.2=253"]),
        wrong("remote frames forbidden by a setting", tpdo("", "transmission: 253"))
            .set(&["1800.1=$NODEID+0x40000180"]),
        case::wrong("an RPDO without remote frames", rpdo("", "no-rtr: yes"), "OD0508"),
        case::wrong("bit 30 of an RPDO set", rpdo("", ""), "OD0508").set(&["1400.1=0x40000201"]),
    ]
}

fn sync_start() -> Vec<Case> {
    let wrong = |name, specification| case::wrong(name, specification, START);
    vec![
        wrong("a SYNC start value without 1019h", tpdo("sync consumer", "transmission: 1, sync-start: 1")),
        wrong(
            "a SYNC start value of a SYNC without counter",
            counter(0, "", "transmission: 1, sync-start: 1"),
        ),
        wrong("a SYNC start value beyond the counter", counter(2, "", "transmission: 1, sync-start: 3")),
        wrong("a SYNC start value of an event", counter(2, "", "transmission: 254, sync-start: 1")),
        wrong("a SYNC start value of another event", counter(2, "", "transmission: 255, sync-start: 1")),
        wrong("a SYNC start value of remote frames", counter(2, "", "transmission: 253, sync-start: 1")),
        wrong("a SYNC start value of an RPDO", counter(2, "transmission: 1, sync-start: 1", "")),
        wrong("a SYNC start value set without counter", counter(0, "", TIMES)).set(&["1800.6=1"]),
        wrong("a SYNC counter set too short", counter(9, "", "transmission: 1, sync-start: 9"))
            .set(&["1019=8"]),
        wrong("set to an event with a SYNC start value", counter(9, "", "transmission: 1, sync-start: 9"))
            .set(&["1800.2=255"]),
        case::wrong("a SYNC start value that no counter has", counter(240, "", TIMES), "OD0508")
            .set(&["1800.6=241"]),
    ]
}

fn times() -> Vec<Case> {
    let wrong = |name, specification| case::wrong(name, specification, TIME);
    vec![
        wrong(
            "an event timer together with SYNC",
            tpdo("sync consumer", "transmission: 1, event-timer: 100"),
        ),
        wrong("an event timer together with remote frames", tpdo("", "transmission: 253, event-timer: 100")),
        wrong(
            "an inhibit time together with SYNC",
            tpdo("sync consumer", "transmission: 240, inhibit-time: 1"),
        ),
        wrong("an inhibit time of an RPDO", rpdo("", "inhibit-time: 1")),
        wrong("an event timer shorter than the inhibit time", tpdo("", "event-timer: 9, inhibit-time: 91")),
        wrong("an event timer set together with SYNC", counter(0, "", TIMES)).set(&["1800.5=1"]),
        wrong("an event timer set too short", tpdo("", "event-timer: 10, inhibit-time: 100"))
            .set(&["1800.5=9"]),
        wrong("an inhibit time set too long", tpdo("", "event-timer: 10, inhibit-time: 100"))
            .set(&["1800.3=101"]),
    ]
}

fn mapping() -> Vec<Case> {
    let wrong = |name, object| case::wrong(name, mappable("", object), ACCESS);
    vec![
        wrong("the heartbeat time as process data", "0x1017: {from: cia301, pdo: receive}"),
        wrong("the device type as process data", "0x1000: {from: cia301, pdo: transmit}"),
        wrong(
            "the heartbeat time as process data, written in full",
            "0x1017: {name: Producer heartbeat time, type: unsigned16, access: rw, pdo: receive, default: 0}",
        ),
        case::wrong(
            "the identifier of SYNC as process data",
            mappable("sync consumer", "0x1005: {from: cia301, pdo: receive}"),
            ACCESS,
        ),
        case::wrong("a parameter mapped by a setting", rpdo("", ""), "OD0502").set(&["1600.1=0x10170010"]),
        case::wrong("a capacity of a fixed mapping", rpdo("", "mapping: fixed, capacity: 4"), "OD0208"),
    ]
}

pub(crate) fn right() -> Vec<Right> {
    [right_transmission(), right_times(), right_mapping()].into_iter().flatten().collect()
}

fn right_transmission() -> Vec<Right> {
    vec![
        case::right("every 240th SYNC with 1005h", tpdo("sync consumer", "transmission: 240")),
        case::right("synchronous acyclic with 1005h", tpdo("sync consumer", "transmission: 0")),
        case::right("an RPDO that waits for SYNC", rpdo("sync consumer", "transmission: 240")),
        case::right("252 with remote frames", tpdo("sync consumer", "transmission: 252")),
        case::right("253 with remote frames", tpdo("", "transmission: 253, no-rtr: no")),
        case::right("an event without remote frames", tpdo("", "transmission: 254, no-rtr: yes")),
        case::right("SYNC without remote frames", tpdo("sync consumer", "transmission: 1, no-rtr: yes")),
        case::right("set to remote frames", tpdo("", "")).set(&["1800.2=253"]),
        case::right("remote frames allowed by a setting", tpdo("", "no-rtr: yes"))
            .set(&["1800.1=$NODEID+0x180", "1800.2=253"]),
        case::right("remote frames forbidden by a setting, of an event", tpdo("", ""))
            .set(&["1800.1=$NODEID+0x40000180"]),
        case::right("the first SYNC of two", counter(2, "", "transmission: 1, sync-start: 1")),
        case::right("the last SYNC of two", counter(2, "", "transmission: 1, sync-start: 2")),
        case::right("the last SYNC of all", counter(240, "", "transmission: 240, sync-start: 240")),
        case::right("any SYNC, without 1019h", tpdo("sync consumer", "transmission: 1, sync-start: 0")),
        case::right("any SYNC, of an event", tpdo("", "transmission: 255, sync-start: 0")),
        case::right("counter and SYNC start value set", counter(0, "", TIMES)).set(&["1019=4", "1800.6=4"]),
        case::right(
            "counter and SYNC start value taken back",
            counter(2, "", "transmission: 1, sync-start: 2"),
        )
        .set(&["1019=0", "1800.6=0"]),
    ]
}

fn right_times() -> Vec<Right> {
    vec![
        case::right("an event timer of an event", tpdo("", "transmission: 255, event-timer: 100")),
        case::right("an event timer of another event", tpdo("", "transmission: 254, event-timer: 1")),
        case::right(
            "an event timer as long as the inhibit time",
            tpdo("", "event-timer: 10, inhibit-time: 100"),
        ),
        case::right("no event timer, an inhibit time", tpdo("", "event-timer: 0, inhibit-time: 65535")),
        case::right("times of 0 together with SYNC", tpdo("sync consumer", TIMES)),
        case::right("an RPDO that watches", rpdo("", "event-timer: 100")),
        case::right(
            "an RPDO that watches for SYNC",
            rpdo("sync consumer", "transmission: 1, event-timer: 100"),
        ),
        case::right("an RPDO with an inhibit time of 0", rpdo("", "inhibit-time: 0")),
        case::right("set to an event with its timer", counter(0, "", TIMES)).set(&[
            "1800.2=255",
            "1800.5=10",
            "1800.3=100",
        ]),
    ]
}

fn right_mapping() -> Vec<Right> {
    vec![
        case::right(
            "the error register as process data",
            mappable("", "0x1001: {from: cia301, pdo: transmit}"),
        ),
        case::right(
            "the maker's status as process data",
            mappable("", "0x1002: {from: cia301, pdo: transmit}"),
        ),
        case::right(
            "the time stamp as process data",
            mappable("high resolution time stamp", "0x1013: {from: cia301, pdo: receive}"),
        ),
        case::right("no capacity of a fixed mapping", rpdo("", "mapping: fixed")),
        case::right("a capacity of a variable mapping", rpdo("", "capacity: 4")),
        case::right("a PDO that maps nothing yet", device("", "", "valid: no", "").replace("[target]", "[]")),
        case::right("the predefined identifier, by a number", tpdo("", "")).set(&["1800.1=0x185"]),
        case::right("a multiplexed PDO switched off by its number", rpdo("", "")).set(&["1600.0=0"]),
    ]
}
