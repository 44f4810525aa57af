//! Identifiers of messages: which are free, which are kept, and which two services may share.

use crate::wrong_specifications::case::{self, Case, Right};

/// A device with TPDO 1 and RPDO 1, features in addition to the usual ones, and further objects.
fn device(features: &str, objects: &str) -> String {
    pdos(features, objects, "1: {map: [wish]}", "1: {map: [level]}")
}

/// The same with other PDOs.
fn pdos(features: &str, objects: &str, receive: &str, transmit: &str) -> String {
    format!(
        "devices:
  io: {{name: Example, bit-rates: [125], features: [heartbeat producer, emergency{features}]}}
objects:
  0x2000: {{name: level, type: unsigned8, access: ro, pdo: transmit}}
  0x2001: {{name: wish, type: unsigned8, access: rww, pdo: receive}}
{objects}pdos:
  io: {{receive: {{{receive}}}, transmit: {{{transmit}}}}}"
    )
}

/// SDO channels: index, request, answer, other side.
fn channels(list: &[(u16, &str, &str, &str)]) -> String {
    let channel = |(index, request, answer, node): &(u16, &str, &str, &str)| {
        format!(
            "  0x{index:X}: {{name: SDO channel {index:X}, record: {{1: {{name: request, type: unsigned32, access: rw, default: {request}}}, 2: {{name: answer, type: unsigned32, access: rw, default: {answer}}}, 3: {{name: other side, type: unsigned8, access: rw, default: {node}}}}}}}\n"
        )
    };
    device("", &list.iter().map(channel).collect::<String>())
}

const OFF: &str = "0x80000000";

/// One object of the library with a default.
fn with_default(features: &str, index: u16, default: &str) -> String {
    device(features, &format!("  0x{index:X}: {{from: cia301, default: {default}}}\n"))
}

/// A consumer of the emergency messages of the nodes 1 to 6.
fn emergency_consumer() -> String {
    device(", emergency consumer, sync consumer", "  0x1028: {from: cia301, array: {count: 6}}\n")
}

pub(crate) fn wrong() -> Vec<Case> {
    [services(), between_pdos(), sdo_channels(), reserved_bits(), set()].into_iter().flatten().collect()
}

fn services() -> Vec<Case> {
    let emcy = |name, default| case::wrong(name, with_default("", 0x1014, default), "OD0503");
    let sync =
        |name, default, code| case::wrong(name, with_default(", sync consumer", 0x1005, default), code);
    vec![
        emcy("EMCY on the identifier of NMT", "0"),
        emcy("EMCY on requests to SDO servers", "$NODEID + 0x600"),
        emcy("EMCY on heartbeats", "$NODEID + 0x700"),
        emcy("EMCY in a frame of 29 bits", "0x20000881"),
        case::wrong("EMCY where masters do not listen", with_default("", 0x1014, "0x6E5"), "OD0815"),
        case::wrong(
            "EMCY on the identifier of SYNC",
            with_default(", sync consumer", 0x1014, "0x80"),
            "OD0504",
        ),
        sync("SYNC on the identifier of LSS", "0x7E5", "OD0503"),
        sync("SYNC on the identifier of EMCY of node 5", "0x85", "OD0504"),
        sync("SYNC on the identifier of EMCY of every node", "$NODEID + 0x80", "OD0504"),
        sync("SYNC that is produced, without a period", "0x40000080", "OD0814"),
        case::wrong("TIME on the identifier of EMCY", with_default(", time", 0x1012, "0x80000085"), "OD0504"),
    ]
}

fn between_pdos() -> Vec<Case> {
    let clash =
        |name, receive, transmit| case::wrong(name, pdos(", sync consumer", "", receive, transmit), "OD0504");
    vec![
        clash(
            "two TPDOs on one identifier",
            "1: {map: [wish]}",
            "1: {map: [level]}, 2: {cob-id: $NODEID + 0x180, map: [level]}",
        ),
        clash(
            "an RPDO that hears the TPDO of its own device",
            "1: {cob-id: $NODEID + 0x180, map: [wish]}",
            "1: {map: [level]}",
        ),
        clash("a TPDO on SYNC", "1: {map: [wish]}", "1: {cob-id: 0x80, map: [level]}"),
        clash("a TPDO on the EMCY of one node", "1: {map: [wish]}", "1: {cob-id: 0x85, map: [level]}"),
        case::wrong(
            "a TPDO on heartbeats",
            pdos("", "", "1: {map: [wish]}", "1: {cob-id: $NODEID + 0x700, map: [level]}"),
            "OD0503",
        ),
    ]
}

fn sdo_channels() -> Vec<Case> {
    let server =
        |name, request, answer, code| case::wrong(name, channels(&[(0x1201, request, answer, "1")]), code);
    let client = |name, set| case::wrong(name, channels(&[(0x1280, OFF, OFF, "6")]), "OD0829").set(set);
    vec![
        server("a server that asks and answers on one identifier", "0x6E1", "0x6E1", "OD0504"),
        server("a server on the identifier of TPDO 1", "$NODEID + 0x180", "0x6A0", "OD0504"),
        server("a second server on the identifiers of the first", "$NODEID + 0x600", "0x6A0", "OD0503"),
        case::wrong("a channel to node 200", channels(&[(0x1280, OFF, OFF, "200")]), "OD0510"),
        case::wrong(
            "a client of its own node",
            channels(&[(0x1280, "$NODEID + 0x600", "$NODEID + 0x580", "1")])
                .replace("default: 1}", "default: $NODEID}"),
            "OD0504",
        ),
        client("a client that asks one node and hears another", &["1280.1=0x606", "1280.2=0x587"]),
        client("a client of another node than it says", &["1280.1=0x607", "1280.2=0x587"]),
        client("a client of no node", &["1280.1=0x6E1", "1280.2=0x6E2", "1280.3=0"]),
        case::wrong(
            "a client that asks on the identifier of answers",
            channels(&[(0x1280, OFF, OFF, "6")]),
            "OD0503",
        )
        .set(&["1280.1=0x586"]),
        case::wrong(
            "two clients of one server",
            channels(&[(0x1280, OFF, OFF, "6"), (0x1281, OFF, OFF, "6")]),
            "OD0504",
        )
        .set(&["1280.1=0x606", "1280.2=0x586", "1281.1=0x606", "1281.2=0x586"]),
    ]
}

fn reserved_bits() -> Vec<Case> {
    let reserved = |name, specification| case::wrong(name, specification, "OD0810");
    vec![
        reserved("bit 30 of EMCY", with_default("", 0x1014, "$NODEID + 0x40000080")),
        reserved("bit 30 of an SDO channel", channels(&[(0x1201, "0x400006E1", "0x6E2", "1")])),
        reserved("bit 30 of EMCY, set", device("", "")).set(&["1014=0x40000085"]),
        reserved("bit 30 of the EMCY of another node", emergency_consumer()).set(&["1028.6=0x40000086"]),
        case::wrong("bit 29 of SYNC", with_default(", sync consumer", 0x1005, "0x20000080"), "OD0503"),
        case::wrong("bit 11 of EMCY", device("", ""), "OD0503").set(&["1014=0x885"]),
        case::wrong(
            "bit 30 of an RPDO",
            pdos("", "", "1: {no-rtr: yes, map: [wish]}", "1: {map: [level]}"),
            "OD0508",
        ),
        case::wrong("bit 30 of an RPDO, set", device("", ""), "OD0508").set(&["1400.1=0x40000201"]),
        case::wrong("bit 29 of a TPDO, set", device("", ""), "OD0503").set(&["1800.1=0x20000185"]),
    ]
}

fn set() -> Vec<Case> {
    let clash = |name, set| case::wrong(name, device(", sync consumer, time", ""), "OD0504").set(set);
    let consumer = |name, set| case::wrong(name, emergency_consumer(), "OD0504").set(set);
    vec![
        clash("EMCY set to the identifier of TPDO 1", &["1014=0x185"]),
        clash("SYNC set to the identifier of TPDO 1", &["1005=0x185"]),
        clash("TIME set to the identifier of TPDO 1", &["1012=0x80000185"]),
        clash("TPDO 1 set to EMCY", &["1800.1=0x85"]),
        clash("RPDO 1 set to TPDO 1", &["1400.1=0x185"]),
        clash("RPDO 1 set to SYNC", &["1400.1=0x80"]),
        consumer("another node with the own EMCY", &["1028.6=0x85"]),
        consumer("the EMCY of another node on TPDO 1", &["1028.6=0x185"]),
        consumer("the EMCY of another node on RPDO 1", &["1028.6=0x205"]),
        consumer("the EMCY of another node on SYNC", &["1028.6=0x80"]),
        consumer("two nodes with one EMCY", &["1028.6=0x86", "1028.3=0x86"]),
    ]
}

pub(crate) fn right() -> Vec<Right> {
    [rights_of_devices(), rights_of_nodes()].into_iter().flatten().collect()
}

fn rights_of_devices() -> Vec<Right> {
    vec![
        case::right("EMCY on its own identifier", with_default("", 0x1014, "$NODEID + 0x80")),
        case::right("EMCY switched off", with_default("", 0x1014, "$NODEID + 0x80000080")),
        case::right(
            "SYNC with bit 31, which means nothing",
            with_default(", sync consumer", 0x1005, "0x80000080"),
        ),
        case::right(
            "SYNC that is produced, with a period of 0 at first",
            with_default(", sync producer", 0x1005, "0x40000080"),
        ),
        case::right("TIME that is received", with_default(", time", 0x1012, "0x80000100")),
        case::right("TIME that is sent and received", with_default(", time", 0x1012, "0xC0000100")),
        case::right(
            "TPDO 5 without an identifier, switched off",
            pdos("", "", "1: {map: [wish]}", "1: {map: [level]}, 5: {valid: no, map: [level]}"),
        ),
        case::right(
            "TPDO 2 on the identifier of TPDO 1, switched off",
            pdos(
                "",
                "",
                "1: {map: [wish]}",
                "1: {map: [level]}, 2: {valid: no, cob-id: $NODEID + 0x180, map: [level]}",
            ),
        ),
        case::right(
            "a TPDO without remote frames",
            pdos("", "", "1: {map: [wish]}", "1: {no-rtr: yes, map: [level]}"),
        ),
        case::right(
            "SDO channels that are switched off",
            channels(&[(0x1201, OFF, OFF, "1"), (0x1280, OFF, OFF, "1")]),
        ),
        case::right("an SDO server on free identifiers", channels(&[(0x1201, "0x6E1", "0x6E2", "1")])),
        case::right(
            "an SDO server with one half on the identifier of TPDO 1 and the other off",
            channels(&[(0x1201, "$NODEID + 0x180", OFF, "1")]),
        ),
        case::right(
            "EMCY of all other nodes by default",
            device(
                ", emergency consumer",
                "  0x1028: {from: cia301, array: {count: 2, elements: {1: {default: 0x81}, 2: {default: 0x82}}}}\n",
            ),
        ),
    ]
}

fn rights_of_nodes() -> Vec<Right> {
    let set = |name, set| case::right(name, device(", sync consumer, time", "")).set(set);
    let two = || pdos("", "", "1: {map: [wish]}, 2: {map: [wish]}", "1: {map: [level]}");
    let consumer = |name, set| case::right(name, emergency_consumer()).set(set);
    let client = |name, set| {
        let both = channels(&[(0x1280, OFF, OFF, "6"), (0x1281, OFF, OFF, "7")]);
        case::right(name, both).set(set)
    };
    vec![
        set("EMCY set to another free identifier", &["1014=0x6E5"]),
        set("EMCY switched off on the identifier of TPDO 1", &["1014=0x80000185"]),
        set("TPDO 1 switched off on the identifier of EMCY", &["1800.1=0x80000085"]),
        set("TPDO 1 switched off on the identifier of LSS", &["1800.1=0x800007E5"]),
        set("TPDO 1 switched off on a restricted identifier", &["1800.1=0xC0000180"]),
        set("EMCY switched off on a restricted identifier", &["1014=0x80000701"]),
        set("EMCY takes the identifier that TPDO 1 gives up", &["1014=0x185", "1800.1=0x6E5"]),
        set("a TPDO on the identifier of a TIME that the device does not use", &["1800.1=0x100"]),
        set("RPDO 1 hears a TPDO of another node", &["1400.1=0x186"]),
        set("RPDO 1 hears the EMCY of another node", &["1400.1=0x86"]),
        case::right("two RPDOs hear one message", two()).set(&["1400.1=0x386", "1401.1=0x386"]),
        consumer("EMCY of another node", &["1028.6=0x86"]),
        consumer("the own EMCY as that of the own node", &["1028.5=0x85"]),
        consumer("EMCY of another node on another identifier", &["1028.6=0x6E6"]),
        consumer("EMCY of another node on TPDO 1, switched off", &["1028.6=0x80000185"]),
        client("a client of node 6", &["1280.1=0x606", "1280.2=0x586"]),
        client("clients of two nodes", &["1280.1=0x606", "1280.2=0x586", "1281.1=0x607", "1281.2=0x587"]),
        client("a client of a further server of node 6", &["1280.1=0x6E1", "1280.2=0x6E2"]),
        client(
            "half a client of one node, half of another, switched off",
            &["1280.1=0x606", "1280.2=0x80000587"],
        ),
    ]
}
