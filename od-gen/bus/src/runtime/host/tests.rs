use firmware_glue::frame::{CanId, Frame};
use firmware_glue::{Dictionary as _, EntryId};
use od_spec::diag::Diagnostics;
use od_spec::source::SourceMap;
use od_spec::{NoFiles, compile};

use crate::runtime::{self, LiveDictionary, VirtualNode};

const LAMP: &str = "
od-spec: 1
title: Lamp
uses: [cia301]
vendor: {name: Lamps, number: 1}
devices:
  lamp: {name: Lamp, bit-rates: [125], lss: yes, features: [emergency, heartbeat producer, store parameters, restore defaults]}
objects:
  0x1014: {from: cia301, stored: communication}
  0x1017: {from: cia301, stored: communication}
  0x2000: {name: hours, type: unsigned32, access: ro, stored: remanent}
  0x2001: {name: brightness, type: unsigned16, access: rw, default: 40, stored: application}
";

/// Does something with a lamp as node 5, which has started.
fn with_lamp(test: impl FnOnce(&mut VirtualNode<'_>)) {
    let mut sources = SourceMap::new();
    let root = sources.add("lamp.od.yaml", LAMP);
    let compiled = compile(&mut sources, root, &mut NoFiles);
    let system = compiled.system.unwrap_or_else(|| panic!("{:?}", compiled.diagnostics));
    let device = runtime::device(&system, &system.devices[0], &mut Diagnostics::new()).unwrap();
    let lists = device.lists();
    let table = lists.table().unwrap();
    let mut node = VirtualNode::new(5, LiveDictionary::new(&device, &table, 5).unwrap()).unwrap();
    settle(&mut node);
    test(&mut node);
}

fn settle(node: &mut VirtualNode<'_>) {
    while !node.poll(0).is_empty() {}
}

/// Sends frames, and lets the node say what it has to say.
fn send(node: &mut VirtualNode<'_>, frames: &[(u16, &[u8])]) {
    for (id, data) in frames {
        node.take(&Frame::data(CanId::new(*id).unwrap(), data).unwrap(), 0);
        settle(node);
    }
}

fn read(node: &VirtualNode<'_>, index: u16) -> u32 {
    element(node, index, 0)
}

/// A value of 32 bits of an array.
fn element(node: &VirtualNode<'_>, index: u16, sub: u8) -> u32 {
    let value = node.dictionary().read(index, sub).unwrap();
    value.iter().rev().fold(0, |number, byte| number << 8 | u32::from(*byte))
}

#[test]
fn the_node_reports_that_it_stores_and_restores_on_command() {
    with_lamp(|lamp| {
        let tells = |lamp: &VirtualNode<'_>| [0x1010, 0x1011].map(|index| element(lamp, index, 1));
        assert_eq!(tells(lamp), [1, 1]);
        for reset in [RESET, RESET_COMMUNICATION] {
            send(lamp, &[reset]);
            assert_eq!(tells(lamp), [1, 1]);
        }
        // A signature is a command, and no value.
        send(lamp, &[(0x605, &[0x23, 0x10, 0x10, 1, b's', b'a', b'v', b'e'])]);
        assert_eq!(tells(lamp), [1, 1]);
    });
}

const RESET: (u16, &[u8]) = (0, &[129, 0]);
const RESET_COMMUNICATION: (u16, &[u8]) = (0, &[130, 0]);

#[test]
fn what_the_device_keeps_by_itself_outlives_resets() {
    with_lamp(|lamp| {
        lamp.set(EntryId { index: 0x2000, sub: 0 }, &1234u32.to_le_bytes(), 0).unwrap();
        lamp.set(EntryId { index: 0x2001, sub: 0 }, &[7, 0], 0).unwrap();
        send(lamp, &[RESET_COMMUNICATION]);
        assert_eq!((read(lamp, 0x2000), read(lamp, 0x2001)), (1234, 7));
        send(lamp, &[RESET]);
        assert_eq!((read(lamp, 0x2000), read(lamp, 0x2001)), (1234, 40));
    });
}

#[test]
fn another_node_id_takes_no_identifiers_that_were_stored_for_the_old_one() {
    with_lamp(|lamp| {
        lamp.set(EntryId { index: 0x2001, sub: 0 }, &[7, 0], 0).unwrap();
        send(lamp, &[(0x605, b"\x23\x10\x10\x01save")]);
        // LSS: node-ID 6.
        send(lamp, &[(0x7E5, &[4, 1, 0, 0, 0, 0, 0, 0]), (0x7E5, &[0x11, 6, 0, 0, 0, 0, 0, 0])]);
        send(lamp, &[(0x7E5, &[4, 0, 0, 0, 0, 0, 0, 0]), RESET_COMMUNICATION]);
        assert_eq!((lamp.id(), read(lamp, 0x1014)), (Some(6), 0x86));
        send(lamp, &[RESET]);
        assert_eq!((read(lamp, 0x1014), read(lamp, 0x2001)), (0x86, 7), "the brightness follows no node-ID");
        // What is stored now is node 6's.
        send(
            lamp,
            &[(0x606, &[0x2B, 0x17, 0x10, 0, 0x23, 1, 0, 0]), (0x606, b"\x23\x10\x10\x01save"), RESET],
        );
        assert_eq!((read(lamp, 0x1014), read(lamp, 0x1017)), (0x86, 0x123));
        send(lamp, &[(0x606, b"\x23\x11\x10\x01load"), RESET]);
        assert_eq!((read(lamp, 0x1017), read(lamp, 0x2001)), (0, 40));
    });
}
