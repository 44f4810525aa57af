//! Write conditions: an EDS does not have the key of its device.

use od_formats::eds::write_eds;

use super::compiled;

const LAMP: &str = "\
od-spec: 1
title: Lamp
vendor: {name: Example, number: 0x1FF}
uses: [cia301]
devices: {lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer], eds: {created: 2024-02-29 12:00}}}
objects:
  0x2000: {name: level, type: unsigned8, access: rw, default: 1, writable-when: 'lamp:0x2001 == 0'}
  0x2001: {name: state, type: unsigned8, access: ro}
";

#[test]
fn the_key_of_the_device_itself_is_left_out() {
    let system = compiled("lamp.od.yaml", LAMP).0.system.unwrap();
    let eds = String::from_utf8(write_eds(&system, &system.devices[0])).unwrap();
    assert!(eds.contains("; writable only while 0x2001 == 0\r\n"), "{eds}");
    let read = compiled("lamp.eds", &eds).0;
    assert_eq!(read.diagnostics.iter().map(|found| found.code.id).collect::<Vec<_>>(), [""; 0]);
    let again = read.system.unwrap();
    assert_eq!(String::from_utf8(write_eds(&again, &again.devices[0])).unwrap(), eds);
}
