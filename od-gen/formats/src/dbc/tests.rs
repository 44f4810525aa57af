use od_spec::diag::render::{Format, render};
use od_spec::model::System;
use od_spec::source::SourceMap;
use od_spec::{NoFiles, compile};

use super::message::Identifier;
use super::{Node, Written, write};

fn system(text: &str) -> System {
    let mut sources = SourceMap::new();
    let root = sources.add("bus.od.yaml", text);
    let compiled = compile(&mut sources, root, &mut NoFiles);
    compiled
        .system
        .unwrap_or_else(|| panic!("{}", render(&compiled.diagnostics, &sources, Format::Human, false)))
}

fn written(nodes: &[(u8, &System, &str)]) -> (Written, String) {
    let nodes: Vec<Node<'_>> = nodes
        .iter()
        .map(|(id, system, key)| Node { id: *id, system, device: system.device(key).expect("a device") })
        .collect();
    let written = write(&nodes);
    // Windows-1252 of what the tests have.
    let text = written.bytes.iter().map(|byte| char::from(*byte)).collect();
    (written, text)
}

/// A sensor sends what a valve takes; a panel takes it, too, but as something else.
const BUS: &str = "
od-spec: 1
title: Bus
uses: [cia301]
devices:
  sensor: {name: Sensor, bit-rates: [125], granularity: 8, features: [heartbeat producer, emergency]}
  valve: {name: Valve, bit-rates: [125], granularity: 8, features: [heartbeat producer]}
units: {warm: {symbol: °C, scale: 1/10, offset: -40}}
objects:
  0x2000: {devices: sensor, name: temperature, type: unsigned16, unit: warm, access: ro, pdo: transmit, max: 60.0 °C, special: {0xFFFF: broken}}
  0x2001: {devices: valve, name: temperature, type: unsigned16, unit: warm, access: rw, pdo: receive}
  0x2002: {devices: valve, name: position, type: unsigned16, access: rw, pdo: receive}
pdos:
  sensor:
    transmit:
      1: {cob-id: 0x1A0, map: [0x2000]}
      2: {cob-id: 0x1A1, map: [0x2000]}
      3: {valid: no, map: [0x2000]}
  valve:
    receive:
      1: {cob-id: 0x1A0, map: [0x2001]}
      2: {cob-id: 0x1A2, map: [0x2001]}
";

#[test]
fn who_sends_and_who_takes_a_pdo_are_ends_of_one_message() {
    let bus = system(BUS);
    let (written, text) = written(&[(9, &bus, "valve"), (3, &bus, "sensor")]);
    assert!(text.contains("BU_: sensor_3 valve_9"), "{text}");
    assert!(text.contains("BO_ 416 sensor_3_TPDO1: 2 sensor_3\r\n SG_ temperature : 0|16@1+ (0.1,-40) [-40|6513.5] \"\u{b0}C\" valve_9"), "{text}");
    assert!(text.contains("taken as RPDO1 of valve (node 9)"), "{text}");
    assert!(text.contains("VAL_ 416 temperature 65535 \"broken\" ;"), "{text}");
    assert_eq!(written.left_out, []);
    let silent: Vec<String> = written.silent.values().map(ToString::to_string).collect();
    assert_eq!(silent, ["sensor (node 3): TPDO3"]);
}

#[test]
fn an_identifier_of_29_bits_is_marked() {
    let number = |cob_id| Identifier::of_cob_id(cob_id).map(|id| (id.number(), id.in_file()));
    assert_eq!(number(0x4000_0181), Some((0x181, 0x181)));
    assert_eq!(number(0x2000_0181), Some((0x181, 0x8000_0181)));
    assert_eq!(number(0x3FFF_FFFF), Some((0x1FFF_FFFF, 0x9FFF_FFFF)));
    assert_eq!(number(0x8000_0000), None);
}

#[test]
fn two_messages_with_one_identifier_are_reported() {
    let text = BUS.replace("cob-id: 0x1A2, map: [0x2001]", "cob-id: 0x1A2, map: [0x2002]");
    let (one, other) = (system(BUS), system(&text));
    let (first, _) = written(&[(3, &one, "valve"), (4, &one, "valve")]);
    assert_eq!(first.left_out, [], "they take the same");
    let (second, text) = written(&[(3, &one, "valve"), (4, &other, "valve")]);
    let reported: Vec<String> = second.left_out.iter().map(ToString::to_string).collect();
    assert_eq!(reported, ["RPDO2 of valve (node 4): the identifier 1A2h is that of RPDO2 of valve (node 3)"]);
    assert!(text.contains("BO_ 418 valve_3_RPDO2: 2 Vector__XXX\r\n SG_ temperature : 0|16@1+ (0.1,-40) [0|0] \"\u{b0}C\" valve_3\r\n"), "{text}");
    let (third, _) = written(&[(3, &one, "sensor"), (4, &one, "sensor")]);
    let reported: Vec<String> = third.left_out.iter().map(ToString::to_string).collect();
    assert_eq!(
        reported,
        [
            "TPDO1 of sensor (node 4): the identifier 1A0h is that of TPDO1 of sensor (node 3)",
            "TPDO2 of sensor (node 4): the identifier 1A1h is that of TPDO2 of sensor (node 3)",
        ]
    );
}

/// Names as long as the standards have them, names that are one in the characters of the format, and an entry that is
/// mapped twice.
const NAMES: &str = "
od-spec: 1
title: Names
uses: [cia301]
devices:
  a-device-whose-key-is-a-long-one: {name: Names, bit-rates: [125], granularity: 8, features: [heartbeat producer]}
objects:
  0x2000: {name: additional position actual value of the second axis, type: unsigned8, access: ro, pdo: transmit}
  0x2001: {name: Größe, type: unsigned8, access: ro, pdo: transmit}
  0x2002: {name: groesse, type: unsigned8, access: ro, pdo: transmit}
  0x2003: {name: 24V, type: unsigned8, access: ro, pdo: transmit}
pdos:
  a-device-whose-key-is-a-long-one:
    transmit:
      1: {map: [0x2000, 0x2001, 0x2002, 0x2003, 0x2000]}
";

#[test]
fn names_fit_and_are_given_once() {
    let names = system(NAMES);
    let (_, text) = written(&[(5, &names, "a-device-whose-key-is-a-long-one")]);
    let signals: Vec<&str> = text
        .lines()
        .filter_map(|line| line.strip_prefix(" SG_ "))
        .filter_map(|line| line.split(' ').next())
        .filter(|name| !name.starts_with("NMT"))
        .collect();
    assert_eq!(
        signals,
        [
            "additional_position_actua_2000_0",
            "groesse_2001_0",
            "groesse_2002_0",
            "n24v",
            "additional_position_actua_again2",
        ]
    );
    assert!(signals.iter().all(|name| name.len() <= 32));
    assert!(text.contains("\"SystemSignalLongSymbol\" SG_ 389 additional_position_actua_2000_0 \"additional_position_actual_value_of_the_second_axis_2000_0\";"), "{text}");
    assert!(text.contains("BU_: a_device_whose_key_i_5\r\n"), "{text}");
    assert!(text.contains("BO_ 1797 a_device_whose_key_i_5_heartbeat: 1 a_device_whose_key_i_5"), "{text}");
    assert!(
        text.contains(
            "\"SystemNodeLongSymbol\" BU_ a_device_whose_key_i_5 \"a_device_whose_key_is_a_long_one_5\";"
        ),
        "{text}"
    );
}

#[test]
fn texts_do_not_end_early() {
    let text = BUS.replace(
        "special: {0xFFFF: broken}",
        "special: {0xFFFF: \"it \\\"is\\\"\\nbröken\\\\ Ω\"}, about: \"one\\ntwo \\\"three\\\"\\tfour\"",
    );
    let bus = system(&text);
    let (_, text) = written(&[(3, &bus, "sensor")]);
    assert!(text.contains("VAL_ 416 temperature 65535 \"it 'is' br\u{f6}ken/ Ohm\" ;"), "{text}");
    assert!(text.contains("one\r\ntwo 'three' four\r\n"), "{text}");
}
