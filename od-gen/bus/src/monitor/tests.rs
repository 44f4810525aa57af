use firmware_glue::frame::{CanId, Frame};
use od_spec::model::{Index, SubIndex, System};
use od_spec::source::SourceMap;
use od_spec::{NoFiles, compile};

use super::*;
use crate::trace::Node;

const LAMP: &str = "
od-spec: 1
title: Lamp
uses: [cia301]
devices:
  lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer, emergency]}
objects:
  0x1017: {from: cia301, default: 1000 ms}
  0x2000: {name: brightness, type: unsigned8, unit: percent, access: rw, pdo: transmit, default: 80}
pdos:
  lamp:
    transmit: {1: {map: [brightness]}}
units:
  percent: {symbol: \"%\", scale: 1}
errors:
  0x4210: {name: too hot, about: It is over 80 degrees.}
";

fn lamp() -> System {
    let mut sources = SourceMap::new();
    let root = sources.add("lamp.od.yaml", LAMP);
    let compiled = compile(&mut sources, root, &mut NoFiles);
    compiled.system.unwrap_or_else(|| panic!("{:?}", compiled.diagnostics))
}

/// A monitor with what it reported.
struct Watching<'a> {
    monitor: Monitor<'a>,
    described: Vec<String>,
}

impl<'a> Watching<'a> {
    fn new(system: &'a System, shows: Shows) -> Self {
        let decoder = Decoder::new(vec![Node::new(5, system, &system.devices[0])]);
        Self { monitor: Monitor::new(decoder, shows, 0), described: Vec::new() }
    }

    fn hear(&mut self, milliseconds: u64, id: u16, bytes: &[u8]) {
        self.wait(milliseconds);
        let frame = Frame::data(CanId::new(id).unwrap(), bytes).unwrap();
        let lines = self.monitor.take(&What::Frame(CanFrame::Standard(frame)), milliseconds * 1000);
        self.described.extend(lines);
    }

    /// Lets time pass, as a program does that sleeps until the deadline.
    fn wait(&mut self, milliseconds: u64) {
        while let Some(at) = self.monitor.next_deadline().filter(|at| *at <= milliseconds * 1000) {
            self.described.extend(self.monitor.poll(at));
        }
    }
}

#[test]
fn what_changes_is_reported() {
    let system = lamp();
    let mut watching = Watching::new(&system, Shows::default());
    watching.hear(10, 0x705, &[0]);
    for at in [1000, 2000, 3000] {
        watching.hear(at, 0x705, &[127]);
        watching.hear(at, 0x185, &[40]);
        watching.hear(at, 0x080, &[]);
    }
    watching.hear(3500, 0x185, &[41]);
    watching.hear(3600, 0x000, &[1, 5]);
    watching.hear(4000, 0x705, &[5]);
    watching.hear(4100, 0x085, &[0x10, 0x42, 0x09, 0, 0, 0, 0, 0]);
    watching.hear(4100, 0x085, &[0x10, 0x42, 0x09, 0, 0, 0, 0, 0]);
    watching.hear(4200, 0x709, &[5]);
    assert_eq!(
        watching.described,
        [
            "(0.010)  705h  lamp (node 5)  boot-up",
            "(1.000)  705h  lamp (node 5)  heartbeat  pre-operational",
            "(1.000)  185h  lamp (node 5)  TPDO1  2000h brightness = 40 %",
            "(3.500)  185h  lamp (node 5)  TPDO1  2000h brightness = 41 %",
            "(3.600)  000h  NMT  start: lamp (node 5)",
            "(4.000)  705h  lamp (node 5)  heartbeat  operational",
            "(4.100)  085h  lamp (node 5)  EMCY  4210h too hot – It is over 80 degrees; error register 0x09 (generic error, temperature)",
            "(4.100)  085h  lamp (node 5)  EMCY  4210h too hot – It is over 80 degrees; error register 0x09 (generic error, temperature)",
            "(4.200)  709h  node 9 (no dictionary)  heartbeat  operational",
        ]
    );
    assert_eq!(
        watching.monitor.summary(5_000_000),
        "16 frames in 5.0 s\n  lamp (node 5)  operational, heard 1.0 s ago, every 1.0 s; last EMCY 0.9 s ago: 4210h too hot – It is over 80 degrees; error register 0x09 (generic error, temperature)\n  node 9 (no dictionary)  operational, heard 0.8 s ago\n"
    );
}

#[test]
fn a_heartbeat_that_does_not_come_is_lost_and_comes_back() {
    let system = lamp();
    let mut watching = Watching::new(&system, Shows::default());
    for at in [100, 400, 700, 1000] {
        watching.hear(at, 0x705, &[5]);
    }
    watching.hear(5000, 0x705, &[5]);
    watching.wait(20_000);
    assert_eq!(
        watching.described,
        [
            "(0.100)  705h  lamp (node 5)  heartbeat  operational",
            "(1.600)  lamp (node 5)  heartbeat lost: none for 0.6 s, where one came every 0.3 s",
            "(5.000)  lamp (node 5)  is back after 4.0 s",
            "(5.000)  705h  lamp (node 5)  heartbeat  operational",
            "(7.000)  lamp (node 5)  heartbeat lost: none for 2.0 s, where one came every 1.0 s",
        ]
    );
    assert_eq!(
        watching.monitor.summary(9_000_000),
        "5 frames in 9.0 s\n  lamp (node 5)  LOST, operational when it was heard 4.0 s ago\n"
    );
}

#[test]
fn a_node_that_never_says_anything_is_reported_once() {
    let system = lamp();
    let mut watching = Watching::new(&system, Shows::default());
    watching.wait(60_000);
    assert_eq!(
        watching.described,
        ["(2.000)  lamp (node 5)  no heartbeat for 2.0 s, where 1017h says one every 1.0 s"]
    );
}

#[test]
fn a_delayed_heartbeat_and_one_that_is_asked_for_are_not_lost() {
    let system = lamp();
    let mut watching = Watching::new(&system, Shows::default());
    // The second one was held up, so that the third follows at once.
    for at in [0, 1000, 2900, 3000, 4000] {
        watching.hear(at, 0x705, &[5]);
    }
    assert_eq!(watching.described.len(), 1, "{:?}", watching.described);
    let ask = Frame::remote(CanId::new(0x705).unwrap(), 1).unwrap();
    watching.monitor.take(&What::Frame(CanFrame::Standard(ask)), 4_500_000);
    watching.wait(60_000);
    assert_eq!(watching.described.len(), 1, "{:?}", watching.described);
}

#[test]
fn what_is_reported_can_be_chosen() {
    let system = lamp();
    let only = BTreeSet::from([Service::Sync, Service::Emergency]);
    let mut watching = Watching::new(&system, Shows { detail: Detail::Changes, only });
    watching.hear(0, 0x705, &[0]);
    watching.hear(1, 0x080, &[]);
    watching.hear(2, 0x080, &[]);
    watching.wait(60_000);
    assert_eq!(watching.described, ["(0.001)  080h  SYNC", "(0.002)  080h  SYNC"]);
    let mut watching = Watching::new(&system, Shows { detail: Detail::Everything, ..Shows::default() });
    watching.hear(0, 0x080, &[]);
    watching.hear(1, 0x705, &[5]);
    watching.hear(2, 0x705, &[5]);
    assert_eq!(watching.described.len(), 3);
}

#[test]
fn what_a_node_was_read_to_have_counts() {
    let system = lamp();
    let mut watching = Watching::new(&system, Shows::default());
    let cob_id = EntryId { index: Index(0x1800), sub: SubIndex(1) };
    watching.monitor.learn(5, cob_id, &0x4000_0205u32.to_le_bytes());
    watching.hear(0, 0x205, &[7]);
    assert_eq!(watching.described, ["(0.000)  205h  lamp (node 5)  TPDO1  2000h brightness = 7 %"]);
}

#[test]
fn a_heartbeat_that_was_switched_off_is_not_missed() {
    let system = lamp();
    let mut watching = Watching::new(&system, Shows::default());
    for at in [0, 1000, 2000] {
        watching.hear(at, 0x705, &[5]);
    }
    watching.hear(2100, 0x605, &[0x2B, 0x17, 0x10, 0, 0, 0, 0, 0]);
    watching.hear(2101, 0x585, &[0x60, 0x17, 0x10, 0, 0, 0, 0, 0]);
    watching.wait(60_000);
    assert_eq!(watching.described.len(), 3, "{:?}", watching.described);
}
