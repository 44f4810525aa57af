//! Identifiers of messages: which are free, which are kept, and which two services may share.

use crate::case::{self, Case, Right};

/// A device with TPDO 1.
const TPDO: &str = "objects:\n  0x2000: {name: level, type: unsigned8, access: ro, pdo: transmit}\npdos:\n  io: {transmit: {1: {map: [level]}}}";

pub(crate) fn wrong() -> Vec<Case> {
    vec![
        case::wrong(
            "EMCY on the identifier of NMT",
            "objects:\n  0x1014: {from: cia301, default: 0}",
            "OD0503",
        ),
        case::wrong("EMCY set to the identifier of TPDO 1", TPDO, "OD0504").set(&["1014=0x185"]),
    ]
}

pub(crate) fn right() -> Vec<Right> {
    vec![
        case::right(
            "EMCY on its own identifier",
            "objects:\n  0x1014: {from: cia301, default: $NODEID + 0x80}",
        ),
        case::right("EMCY switched off", TPDO).set(&["1014=0x80000185"]),
    ]
}
