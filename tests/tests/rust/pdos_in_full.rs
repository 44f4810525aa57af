//! PDO parameter objects that are written in full say the same as `pdos:`, and nothing is lost or breaks where they are odd.

use firmware_glue::{Dictionary as _, pdo};
use od_spec::diag::Diagnostics;
use od_spec::diag::render::{Format, render};
use od_spec::model::{Dictionary, Direction, Index, Mapped, Pdo, Storage, System, Value};
use od_spec::source::SourceMap;
use od_spec::{NoFiles, compile};

#[deny(warnings)]
mod odd {
    od_macros::object_dictionary!("shared/pdos-in-full.od.yaml");
}

const DEVICE: &str = "
od-spec: 1
title: Lamp
uses: [cia301]
devices:
  lamp: {name: Lamp, bit-rates: [125], granularity: 32, features: [heartbeat producer, store parameters], dummies: [unsigned32]}
objects:
  0x2000: {name: level, type: unsigned32, access: rw, pdo: receive}
  0x2001: {name: hours, type: unsigned32, access: ro, pdo: transmit}
";

const MADE: &str = "
pdos:
  lamp:
    receive: {3: {map: [unsigned32, level], inhibit-time: 7, valid: no, about: How bright it is to be.}}
    transmit: {1: {map: [0x2001], mapping: fixed, no-rtr: yes, transmission: 1, event-timer: 10, sync-start: 5}}
";

const IN_FULL: &str = "
  0x1402:
    name: RPDO 3 communication parameter
    about: How bright it is to be.
    sub0: {name: highest sub-index supported}
    record:
      1:
        name: COB-ID used by RPDO
        type: unsigned32
        access: rw
        default: $NODEID + 0x8000_0400
        stored: communication
        about: 'CAN identifier; bit 31: PDO not valid, bit 30: no remote frames (TPDO)'
      2:
        name: transmission type
        type: unsigned8
        access: rw
        default: 255
        stored: communication
        about: '0 to 240: synchronous; 254, 255: event-driven; 252, 253: on remote frame'
      3:
        name: inhibit time
        type: unsigned16
        access: rw
        default: 7
        stored: communication
        about: least time between two transmissions, in 100 µs
  0x1602:
    name: RPDO 3 mapping parameter
    sub0: {name: number of mapped entries, access: rw, default: 2, stored: communication, about: 0 disables the mapping while it is changed}
    stored: communication
    type: unsigned32
    access: rw
    record:
      1: {name: mapped entry 1, default: 0x0007_0020, about: &bits 'bits 31..16 index, 15..8 sub-index, 7..0 length in bits'}
      2: {name: mapped entry 2, default: 0x2000_0020, about: *bits}
  0x1800:
    name: TPDO 1 communication parameter
    sub0: {name: highest sub-index supported}
    stored: communication
    access: rw
    record:
      1:
        name: COB-ID used by TPDO
        type: unsigned32
        default: $NODEID + 0x4000_0180
        about: 'CAN identifier; bit 31: PDO not valid, bit 30: no remote frames (TPDO)'
      2:
        name: transmission type
        type: unsigned8
        default: 1
        about: '0 to 240: synchronous; 254, 255: event-driven; 252, 253: on remote frame'
      5:
        name: event timer
        type: unsigned16
        default: 10
        about: 'longest time between two transmissions or, for an RPDO, receptions, in ms; 0: off'
      6:
        name: SYNC start value
        type: unsigned8
        default: 5
        about: 'SYNC counter value of the first transmission; 0: any'
  0x1A00:
    name: TPDO 1 mapping parameter
    sub0: {name: number of mapped entries, default: 1, about: 0 disables the mapping while it is changed}
    record:
      1: {name: mapped entry 1, type: unsigned32, access: ro, default: 0x2001_0020, about: *bits}
";

fn system(text: &str) -> System {
    let mut sources = SourceMap::new();
    let root = sources.add("lamp.od.yaml", text);
    let compiled = compile(&mut sources, root, &mut NoFiles);
    let shown = render(&compiled.diagnostics, &sources, Format::Human, false);
    compiled.system.unwrap_or_else(|| panic!("{shown}"))
}

/// The storage of the parameters that can be written, of a device with these objects of its own and this said of all its PDOs.
fn storage(objects: &str, said: &str) -> Vec<Storage> {
    let device = DEVICE.replace(", store parameters", "");
    let made = MADE.replace("  lamp:\n", &format!("  lamp:\n{said}"));
    let system = system(&format!("{device}{objects}{made}"));
    let parameters = system.devices[0].entries().filter(|(_, object, _)| object.role().is_pdo_parameter());
    let mut kept: Vec<Storage> =
        parameters.filter(|(.., entry)| entry.access.is_writable()).map(|(.., entry)| entry.stored).collect();
    kept.dedup();
    kept
}

#[test]
fn parameters_are_stored_where_the_device_can_store_them() {
    let count = |count: u8| format!("  0x1010: {{from: cia301, array: {{count: {count}}}}}\n");
    assert_eq!(storage("", ""), [Storage::No]);
    // "Save all parameters", and the communication parameters alone.
    assert_eq!(storage(&count(1), ""), [Storage::Communication]);
    assert_eq!(storage(&count(2), ""), [Storage::Communication]);
    // What is said goes before that.
    assert_eq!(storage(&count(2), "    stored: no\n"), [Storage::No]);
    assert_eq!(storage("", "    stored: communication\n"), [Storage::Communication]);
}

/// What a PDO is, wherever it is written.
fn said(pdo: &Pdo) -> String {
    let Pdo { direction, number, cob_id, valid, transmission, inhibit_time, event_timer, sync_start, .. } =
        pdo;
    let Pdo { variable_mapping, capacity, map, about, .. } = pdo;
    format!(
        "{direction:?} {number} {cob_id:?} {valid} {transmission:?} {inhibit_time:?} {event_timer:?} {sync_start:?} \
        {variable_mapping} {capacity} {map:?} {about:?}"
    )
}

#[test]
fn in_full_is_said_the_same_as_under_pdos() {
    let made = system(&format!("{DEVICE}{MADE}"));
    let in_full = system(&format!("{DEVICE}{IN_FULL}"));
    let pdos = |system: &System| system.devices[0].pdos.iter().map(said).collect::<Vec<_>>();
    assert_eq!(pdos(&made), pdos(&in_full));
    assert_eq!(made.devices[0].pdos.len(), 2);
    let eds = |system: &System| {
        let bytes = od_formats::eds::write_eds(system, &system.devices[0]);
        String::from_utf8(bytes).unwrap().lines().map(ToOwned::to_owned).collect::<Vec<_>>()
    };
    for (line, (made, in_full)) in eds(&made).iter().zip(&eds(&in_full)).enumerate() {
        assert_eq!(made, in_full, "line {line}");
    }
    assert_eq!(eds(&made).len(), eds(&in_full).len());
    assert!(eds(&made).contains(&"[1602sub2]".to_owned()));
    assert!(eds(&made).contains(&"; How bright it is to be.".to_owned()));
    let rust = |system: &System| {
        let tokens = od_gen::rust::tokens(system, &system.devices[0], &mut Diagnostics::new());
        tokens.unwrap().to_string()
    };
    assert_eq!(rust(&made), rust(&in_full));
}

fn device() -> Dictionary {
    system(include_str!("../../shared/pdos-in-full.od.yaml")).devices.remove(0)
}

#[test]
fn odd_parameters_give_pdos_that_say_what_they_say() {
    let device = device();
    let numbers = |direction| device.pdos_of(direction).map(|pdo| pdo.number).collect::<Vec<_>>();
    assert_eq!(numbers(Direction::Receive), [1, 3]);
    assert_eq!(numbers(Direction::Transmit), [3]);
    let [usual, unstated, pieces] = device.pdos.as_slice() else { panic!("{:?}", device.pdos) };
    let parameters = |pdo: &Pdo| pdo.map.iter().map(Mapped::parameter).collect::<Vec<_>>();

    assert_eq!((usual.cob_id.clone(), usual.valid), (Some(Value::NodeId(0x200)), true));
    assert_eq!((usual.transmission, usual.capacity, usual.variable_mapping), (Some(254), 3, true));
    assert_eq!(parameters(usual), [0x2000_0008, 0x2001_0010]);
    assert_eq!((&unstated.cob_id, unstated.valid, unstated.transmission), (&None, false, None));
    assert_eq!((parameters(unstated), unstated.capacity, unstated.variable_mapping), (vec![], 2, true));
    assert_eq!((pieces.cob_id.clone(), pieces.variable_mapping), (Some(Value::Integer(0x380)), false));
    assert_eq!((pieces.event_timer, parameters(pieces).len()), (Some(100), 3));

    // How much is mapped does not follow from how much could be.
    let count = |index| device.objects[&Index(index)].entries[0].default.clone();
    assert_eq!((count(0x1602), count(0x1400)), (None, Some(Value::Integer(4))));
    assert_eq!(device.objects.range(Index(0x1400)..Index(0x1C00)).count(), 6);
}

#[test]
fn what_is_regular_is_served_and_the_rest_does_not_exist() {
    let mut od = odd::Odd::new(3);
    let received = pdo::unpack(&mut od, 1, &[7, 0x34, 0x12], &mut ()).unwrap();
    assert_eq!((received.refused, od.target_level(), od.target_speed()), (None, 7, 0x1234));
    assert_eq!(pdo::unpack(&mut od, 2, &[1], &mut ()), Err(pdo::PdoError::NoPdo), "not there");
    assert_eq!(pdo::unpack(&mut od, 3, &[1], &mut ()), Err(pdo::PdoError::NotValid), "no COB-ID is stated");
    assert_eq!(*od.read(0x1402, 1).unwrap(), [0, 0, 0, 0x80]);
    assert_eq!(*pdo::pack(&mut od, 3, &mut ()).unwrap(), [9, 0x34, 0x12, 3]);
    assert_eq!(odd::pdos::Tpdo3::of(&od).pack(), [9, 0x34, 0x12, 3]);
    assert_eq!(odd::pdos::Rpdo1::cob_id(3), 0x203);
}
