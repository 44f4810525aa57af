//! Objects that a standard fixes: shape, type, access, sub-indices.

use crate::wrong_specifications::case::{self, Case, Right};

/// An object in full, after `OBJECT: `.
fn full(object: &str) -> String {
    format!("objects:\n  {object}")
}

/// A drive with further objects.
fn drive(objects: &str) -> String {
    with_modes("0x10000", "", objects)
}

/// A drive with a value of 6502h, an enum `mode` that represents the type of 6060h, and further objects.
fn with_modes(modes: &str, values: &str, objects: &str) -> String {
    let types = match values {
        "" => String::new(),
        values => format!("types:\n  mode: {{base: integer8, values: {{{values}}}}}\n"),
    };
    format!(
        "uses: [cia301, cia402]
{types}devices:
  io: {{name: Example, bit-rates: [125], device-type: 0x00020192, features: [heartbeat producer, drive]}}
pdos:
  io: {{receive: {{1: {{map: [0x6040]}}}}, transmit: {{1: {{map: [0x6041]}}}}}}
objects:
  0x6502: {{from: cia402, default: {modes}}}
{objects}"
    )
}

pub(crate) fn wrong() -> Vec<Case> {
    [shapes(), types(), sub_indices(), access(), drives(), modes()].into_iter().flatten().collect()
}

fn shapes() -> Vec<Case> {
    let shape = |name, object| case::wrong(name, full(object), "OD0320");
    vec![
        shape("1018h as a VAR", "0x1018: {name: Identity, type: unsigned32, access: ro}"),
        shape(
            "1018h as an ARRAY",
            "0x1018: {name: Identity, array: {count: 4, name: \"id {n}\", type: unsigned32, access: ro}}",
        ),
        shape("1010h as a VAR", "0x1010: {name: Store, type: unsigned32, access: rw}"),
        shape(
            "1010h as a RECORD",
            "0x1010: {name: Store, record: {1: {name: all, type: unsigned32, access: rw}}}",
        ),
        shape("1003h as a VAR", "0x1003: {name: Errors, type: unsigned32, access: ro}"),
    ]
}

fn types() -> Vec<Case> {
    let of_type = |name, object| case::wrong(name, full(object), "OD0320");
    vec![
        of_type("1000h as UNSIGNED8", "0x1000: {name: Device type, type: unsigned8, access: ro}"),
        of_type("1000h as UNSIGNED8, taken from the library", "0x1000: {from: cia301, type: unsigned8}"),
        of_type("1000h as INTEGER32, taken from the library", "0x1000: {from: cia301, type: integer32}"),
        of_type("1001h as a string", "0x1001: {name: Error register, type: visible-string, access: ro}"),
        of_type("1001h as a string, taken from the library", "0x1001: {from: cia301, type: visible-string}"),
        of_type("1017h as UNSIGNED32", "0x1017: {name: Heartbeat, type: unsigned32, access: ro, default: 0}"),
        of_type("1017h as UNSIGNED32, taken from the library", "0x1017: {from: cia301, type: unsigned32}"),
        of_type(
            "elements of 1010h as UNSIGNED8",
            "0x1010: {name: Store, array: {count: 1, name: \"store {n}\", type: unsigned8, access: rw}}",
        ),
        of_type(
            "vendor-ID as UNSIGNED16, taken from the library",
            "0x1018: {from: cia301, record: {1: {type: unsigned16}}}",
        ),
    ]
}

fn sub_indices() -> Vec<Case> {
    let lacking = |name, object| case::wrong(name, full(object), "OD0321");
    vec![
        lacking(
            "1018h without the vendor-ID",
            "0x1018: {name: Identity, record: {2: {name: product, type: unsigned32, access: ro}}}",
        ),
        lacking("1018h without the vendor-ID, taken from the library", "0x1018: {from: cia301, omit: [1]}"),
        lacking(
            "1018h with a fifth member",
            "0x1018: {name: Identity, record: {1: {name: vendor, type: unsigned32, access: ro}, 5: {name: more, type: unsigned32, access: ro}}}",
        ),
        lacking(
            "1010h with 128 elements",
            "0x1010: {name: Store, array: {count: 128, name: \"store {n}\", type: unsigned32, access: rw}}",
        ),
        lacking(
            "an SDO client that names no server",
            "0x1280: {name: client, record: {1: {name: request, type: unsigned32, access: rw, default: 0x80000000}, 2: {name: answer, type: unsigned32, access: rw, default: 0x80000000}}}",
        ),
    ]
}

fn access() -> Vec<Case> {
    let of_access = |name, object| case::wrong(name, full(object), "OD0812");
    vec![
        of_access("1000h that can be written", "0x1000: {name: Device type, type: unsigned32, access: rw}"),
        of_access("1000h that can be written, taken from the library", "0x1000: {from: cia301, access: rw}"),
        of_access("1001h that cannot be read", "0x1001: {name: Error register, type: unsigned8, access: wo}"),
        of_access("a vendor-ID that can be written", "0x1018: {from: cia301, record: {1: {access: rw}}}"),
        of_access(
            "1008h that can be written",
            "0x1008: {name: Device name, type: visible-string, access: rw}",
        ),
        of_access(
            "errors of 1003h that can be written",
            "0x1003: {name: Errors, sub0: {access: rw, default: 0}, array: {count: 1, name: \"error {n}\", type: unsigned32, access: rw}}",
        ),
        of_access(
            "1015h that cannot be written",
            "0x1015: {name: Inhibit time, type: unsigned16, access: ro, default: 0}",
        ),
    ]
}

fn drives() -> Vec<Case> {
    let object = |name, object| case::wrong(name, drive(object), "OD0831");
    let alone = |device_type: &str, objects: &str| {
        format!(
            "devices:\n  io: {{name: Example, bit-rates: [125], device-type: {device_type}, features: [heartbeat producer]}}\nobjects:\n{objects}"
        )
    };
    vec![
        case::wrong(
            "a drive without a controlword",
            alone("0x00020192", "  0x2000: {name: level, type: unsigned8, access: ro}"),
            "OD0817",
        ),
        case::wrong(
            "a second axis without a controlword",
            alone(
                "0xFFFF0192",
                "  0x6FFF: {name: Type of axis 2, type: unsigned32, access: ro, default: 0x00020192}",
            ),
            "OD0817",
        ),
        object(
            "a controlword of four bytes",
            "  0x6040: {name: controlword, type: unsigned32, access: rw, pdo: receive}",
        ),
        object(
            "a statusword that can be written",
            "  0x6041: {name: statusword, type: unsigned16, access: rw, pdo: transmit}",
        ),
        object("a mode without sign", "  0x6060: {name: mode, type: unsigned8, access: rw}"),
        object("a mode that cannot be written", "  0x6060: {name: mode, type: integer8, access: ro}"),
        object("a position without sign", "  0x607A: {name: target position, type: unsigned32, access: rw}"),
        object(
            "a position without sign, taken from the library",
            "  0x607A: {from: cia402, type: unsigned32}",
        ),
        object("a position as text", "  0x6064: {name: position, type: visible-string, access: ro}"),
        object("two limits in a VAR", "  0x607D: {name: limits, type: integer32, access: rw}"),
    ]
}

/// What homing needs.
const HOMING: &str = "  0x6098: {from: cia402, pdo: none}\n  0x6099: {from: cia402, array: {pdo: none}}\n";
const OWN_MODE: &str = "  0x6060: {from: cia402, type: mode, default: 0}";

fn modes() -> Vec<Case> {
    let lacks = |name, modes, objects: &str| case::wrong(name, with_modes(modes, "", objects), "OD0839");
    let unlisted = |name, modes, values, object: &str| {
        case::wrong(name, with_modes(modes, values, &format!("{HOMING}{object}")), "OD0840")
    };
    vec![
        lacks("positioning without its objects", "1", ""),
        lacks("velocity mode without its objects", "2", ""),
        lacks("profile velocity without its objects", "4", ""),
        lacks("torque without its objects", "8", ""),
        lacks("homing without its objects", "0x20", ""),
        lacks("homing without speeds", "0x20", "  0x6098: {from: cia402, pdo: none}"),
        lacks("interpolation without its objects", "0x40", ""),
        lacks("cyclic positions without its objects", "0x80", ""),
        lacks("cyclic velocities without its objects", "0x100", ""),
        lacks("cyclic torques without its objects", "0x200", ""),
        case::wrong(
            "homing of the second axis without its objects",
            with_modes(
                "0x10000",
                "",
                "  0x67FF: {from: cia402, default: 0x00020192}\n  0x6FFF: {from: cia402, default: 0x00020192}\n  0x6D02: {from: cia402, default: 0x20}",
            )
            .replace("0x00020192, features: [heartbeat producer", "0xFFFF0192, features: [heartbeat producer, drive axis 2")
            .replace("map: [0x6040]", "map: [0x6040, 0x6840]")
            .replace("map: [0x6041]", "map: [0x6041, 0x6841]"),
            "OD0839",
        ),
        unlisted("a mode that is not listed", "0x20", "", "  0x6060: {from: cia402, default: 1}"),
        unlisted(
            "a reserved mode",
            "0x20",
            "",
            "  0x6060: {name: mode, type: integer8, access: rw, default: 5, eds: {default: withheld}}",
        ),
        unlisted(
            "a display of a mode that is not listed",
            "0x20",
            "",
            "  0x6061: {from: cia402, default: 3}",
        ),
        unlisted(
            "an enum with a mode that is not listed",
            "0x20",
            "0: none, 1: positioning, 6: homing",
            OWN_MODE,
        ),
        unlisted("an enum without a mode that is listed", "0x20", "0: none", OWN_MODE),
        unlisted(
            "an enum that does not support a mode that is listed",
            "0x20",
            "0: none, 6: {name: homing, supported: no}",
            OWN_MODE,
        ),
        unlisted("a mode that is not listed, set", "0x20", "", "").set(&["6060=1"]),
    ]
}

pub(crate) fn right() -> Vec<Right> {
    let of_modes = |name, modes, values, object: &str| {
        case::right(name, with_modes(modes, values, &format!("{HOMING}{object}")))
    };
    let right = |name, object| case::right(name, full(object));
    let of_drive = |name, object| case::right(name, drive(object));
    vec![
        right(
            "1018h with the vendor-ID alone",
            "0x1018: {name: Identity, record: {1: {name: vendor, type: unsigned32, access: ro}}}",
        ),
        right("1018h without a serial number", "0x1018: {from: cia301, omit: [4]}"),
        right(
            "1001h as a constant",
            "0x1001: {name: Error register, type: unsigned8, access: const, default: 0}",
        ),
        right(
            "1002h that is not in the library's words",
            "0x1002: {name: Status, type: unsigned32, access: ro}",
        ),
        right(
            "1008h that is no constant",
            "0x1008: {name: Device name, type: visible-string, access: ro, default: Example}",
        ),
        right(
            "1017h that cannot be changed",
            "0x1017: {name: Heartbeat, type: unsigned16, access: ro, default: 1000}",
        ),
        right(
            "1017h that cannot be changed, taken from the library",
            "0x1017: {from: cia301, access: ro, default: 1000}",
        ),
        right(
            "1010h with four elements",
            "0x1010: {name: Store, array: {count: 4, name: \"store {n}\", type: unsigned32, access: rw}}",
        ),
        right(
            "1010h that says what the device can do",
            "0x1010: {name: Store, array: {count: 1, name: \"store {n}\", type: unsigned32, access: rw, default: 3, eds: {flags: [no-write]}}}",
        ),
        right(
            "1011h with 127 elements",
            "0x1011: {name: Restore, array: {count: 127, name: \"restore {n}\", type: unsigned32, access: rw}}",
        ),
        right(
            "1014h that cannot be changed",
            "0x1014: {name: EMCY, type: unsigned32, access: ro, default: $NODEID + 0x80}",
        ),
        right(
            "1022h of eight bits",
            "0x1021: {name: Store EDS, type: domain, access: ro}\n  0x1022: {name: Storage format, type: unsigned8, access: ro, default: 0}",
        ),
        case::right(
            "6040h of a device that is no drive",
            format!(
                "devices:\n  io: {{name: Example, bit-rates: [125], device-type: 410, features: [heartbeat producer]}}\n{}",
                full("0x6040: {name: Inputs, type: unsigned32, access: ro}")
            ),
        ),
        of_drive("a drive as the library has it", ""),
        of_drive(
            "a target position in full",
            "  0x607A: {name: target position, type: integer32, access: rw}",
        ),
        of_drive(
            "limits as a RECORD",
            "  0x607D: {name: limits, record: {1: {name: low, type: integer32, access: rw}, 2: {name: high, type: integer32, access: rw}}}",
        ),
        of_modes("homing with its objects", "0x20", "", ""),
        of_modes("a mode that is listed", "0x20", "", "  0x6060: {from: cia402, default: 6}"),
        of_modes("no mode", "0x20", "", "  0x6060: {from: cia402, default: 0}"),
        of_modes("a mode that is listed, set", "0x20", "", "").set(&["6060=6"]),
        of_modes(
            "a mode of the maker's own, in addition to the bits of CiA 402",
            "0x10020",
            "0: none, -1: service, 6: homing",
            OWN_MODE,
        ),
        of_modes(
            "an enum with a mode that is not supported",
            "0x20",
            "0: none, 1: {name: positioning, supported: no}, 6: homing",
            OWN_MODE,
        ),
        case::right(
            "a drive that does not say its modes",
            drive("  0x6060: {from: cia402, default: 1}")
                .replace("  0x6502: {from: cia402, default: 0x10000}\n", "  0x6502: {from: cia402}\n"),
        ),
        of_drive("a mode of version 2", "  0x6060: {from: cia402, access: wo}"),
        of_drive(
            "a polarity of 16 bits, about which sources disagree",
            "  0x607E: {name: polarity, type: unsigned16, access: rw, default: 0}",
        ),
    ]
}
