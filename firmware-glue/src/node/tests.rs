extern crate std;

mod restarts;

use std::vec;
use std::vec::Vec;

use super::*;
use crate::access::application::Application;
use crate::access::parameters::{Parameters, set};
use crate::access::test_table::{TestDictionary, TestValue, dictionary, stored, value};
use crate::bus::frame::CanId;
use crate::emcy::ErrorRegister;
use crate::lss::{BitRate, LssEvent, LssHandler, Reply};
use crate::nmt::Guarding;
use crate::pdo::engine::{PdoEvent, PdoHandler, TooManyPdos};
use crate::table::Storage;
use crate::table::entry::EntryId;

/// What an application hears.
#[derive(Default)]
struct Heard {
    events: Vec<Event>,
    restarts: Vec<(u8, Reset)>,
}

impl Application<TestDictionary> for Heard {}

impl PdoHandler<TestDictionary> for Heard {
    fn pdo_event(&mut self, _: &mut TestDictionary, _: PdoEvent<EntryId>) {}
}

impl LssHandler for Heard {
    fn has_bit_rate(&self, _: BitRate) -> bool {
        true
    }

    fn store(&mut self, _: MaybeNode, _: Option<BitRate>) -> Reply {
        Reply::Done
    }
}

impl NodeHandler<TestDictionary> for Heard {
    fn restart(&mut self, _: &mut TestDictionary, node: NodeId, reset: Reset) {
        self.restarts.push((node.get(), reset));
    }

    fn node_event(&mut self, _: &mut TestDictionary, event: Event) {
        self.events.push(event);
    }
}

struct Bench {
    dictionary: TestDictionary,
    node: Node<[u8; 16], 2, 2, 4, 2>,
    heard: Heard,
}

const fn room<const T: usize>(tpdos: UpTo<T>) -> Room<[u8; 16], T, 2, 4, 2> {
    Room { tpdos, rpdos: UpTo, errors: UpTo, watched: UpTo, sdo_buffer: [0; 16] }
}

/// Entries of the node's dictionary.
fn values() -> Vec<TestValue> {
    let mut values = vec![
        value(0x1001, 0, 1, 0),
        value(0x1003, 0, 1, 0),
        value(0x1003, 1, 4, 0),
        value(0x1003, 2, 4, 0),
        value(0x1005, 0, 4, 0x80),
        value(0x100C, 0, 2, 100),
        value(0x100D, 0, 1, 2),
        value(0x1014, 0, 4, 0x85),
        value(0x1016, 0, 1, 1),
        value(0x1016, 1, 4, 0x0007_0064),
        value(0x1017, 0, 2, 0),
        value(0x1018, 0, 1, 4),
        value(0x1018, 1, 4, 1),
        value(0x1018, 2, 4, 2),
        value(0x1018, 3, 4, 3),
        value(0x1018, 4, 4, 4),
        value(0x1029, 0, 1, 1),
        value(0x1029, 1, 1, 0),
    ];
    for (index, cob_id, mapped) in [(0x1400, 0x205, 0x2000_0010), (0x1800, 0x185, 0x2001_0010)] {
        values.extend([value(index, 0, 1, 5), value(index, 1, 4, cob_id), value(index, 2, 1, 255)]);
        values.extend([value(index, 3, 2, 0), value(index, 4, 1, 0), value(index, 5, 2, 50)]);
        values.extend([value(index + 0x200, 0, 1, 1), value(index + 0x200, 1, 4, mapped)]);
    }
    values.extend([value(0x2000, 0, 2, 0), stored(0x2001, 0, 2, 0, Storage::Application)]);
    values
}

impl Bench {
    fn new(node: u8) -> Self {
        Self::of(values(), node)
    }

    fn of(mut values: Vec<TestValue>, node: u8) -> Self {
        values.sort_by_key(TestValue::id);
        let dictionary = dictionary(&values);
        let node = Node::new(dictionary.table(), NodeId::new(node), room(UpTo)).expect("two of each");
        Self { dictionary, node, heard: Heard::default() }
    }

    /// A node that has started at 0, and what was said before is forgotten.
    fn started() -> Self {
        Self::started_with(values())
    }

    fn started_with(values: Vec<TestValue>) -> Self {
        let mut bench = Self::of(values, 5);
        assert_eq!(bench.sent(0), [(0x705, vec![0])]);
        bench.heard = Heard::default();
        bench
    }

    fn operational() -> Self {
        let mut bench = Self::started();
        bench.handle(0, &[1, 5], 0);
        assert_eq!(bench.events(), [Event::State(State::Operational)]);
        bench
    }

    fn handle(&mut self, id: u16, data: &[u8], now: u64) -> Option<Vec<u8>> {
        let frame = Frame::data(CanId::new(id).expect("11 bits"), data).expect("8 bytes");
        self.take(&frame, now)
    }

    fn take(&mut self, frame: &Frame, now: u64) -> Option<Vec<u8>> {
        let answer = self.node.handle(frame, &mut self.dictionary, &mut self.heard, at(now))?;
        answer.bytes().map(<[u8]>::to_vec)
    }

    fn sent(&mut self, now: u64) -> Vec<(u16, Vec<u8>)> {
        let poll = || self.node.poll(&mut self.dictionary, &mut self.heard, at(now));
        let frames = core::iter::from_fn(poll).take(20);
        frames.map(|frame| (frame.id().get(), frame.bytes().expect("data").to_vec())).collect()
    }

    fn events(&mut self) -> Vec<Event> {
        core::mem::take(&mut self.heard.events)
    }

    fn read(&self, index: u16, sub: u8) -> Option<u32> {
        Parameters::of(&self.dictionary).number(index, sub)
    }
}

fn at(millis: u64) -> Instant {
    Instant::from_millis(millis)
}

const UPLOAD_1017H: [u8; 8] = [0x40, 0x17, 0x10, 0, 0, 0, 0, 0];

#[test]
fn services_follow_the_state() {
    let mut bench = Bench::new(5);
    assert_eq!(bench.node.next_deadline(&bench.dictionary), Some(Instant::ZERO));
    assert_eq!(bench.handle(0x605, &UPLOAD_1017H, 0), None, "not before the boot-up message");
    assert!(!bench.node.serves(Service::Sdo) && !bench.node.serves(Service::Nmt));
    assert_eq!(bench.sent(0), [(0x705, vec![0])]);
    assert_eq!(bench.heard.restarts, [(5, Reset::Node)]);
    assert_eq!(bench.node.state(), State::PreOperational);
    let answer = Some(vec![0x4B, 0x17, 0x10, 0, 0, 0, 0, 0]);
    assert_eq!(bench.handle(0x605, &UPLOAD_1017H, 0), answer);
    assert!(bench.node.serves(Service::Sdo) && !bench.node.serves(Service::Pdo));
    bench.handle(0x205, &[1, 2], 0);
    assert_eq!(bench.read(0x2000, 0), Some(0), "no PDO before operational");
    bench.handle(0, &[1, 0], 0);
    bench.handle(0x205, &[1, 2], 0);
    assert_eq!(bench.read(0x2000, 0), Some(0x0201));
    assert_eq!(bench.sent(50).first(), Some(&(0x185, vec![0, 0])), "the event timer");
    bench.handle(0, &[2, 5], 60);
    assert_eq!(bench.node.state(), State::Stopped);
    assert_eq!((bench.handle(0x605, &UPLOAD_1017H, 60), bench.handle(0x205, &[9, 9], 60)), (None, None));
    assert_eq!((bench.sent(1000), bench.read(0x2000, 0)), (vec![], Some(0x0201)));
    bench.handle(0, &[128, 5], 1000);
    assert_eq!(bench.handle(0x605, &UPLOAD_1017H, 1000), answer);
}

#[test]
fn a_heartbeat_that_is_written_by_sdo_begins() {
    let mut bench = Bench::started();
    assert!(bench.handle(0x605, &[0x2B, 0x17, 0x10, 0, 0x64, 0, 0, 0], 0).is_some());
    assert_eq!(bench.sent(0), [(0x705, vec![127])]);
    assert_eq!(bench.node.next_deadline(&bench.dictionary), Some(at(100)));
    bench.handle(0, &[2, 5], 50);
    assert_eq!((bench.sent(99), bench.sent(100)), (vec![], vec![(0x705, vec![4])]));
}

#[test]
fn an_open_transfer_is_no_reason_to_be_asked_before_it_is_late() {
    let mut bench = Bench::started();
    assert!(bench.handle(0x605, &[0x21, 0x17, 0x10, 0, 2, 0, 0, 0], 10).is_some());
    assert_eq!(bench.node.next_deadline(&bench.dictionary), Some(at(1010)));
    assert_eq!(bench.sent(1009), []);
    assert_eq!(bench.sent(1010), [(0x585, vec![0x80, 0x17, 0x10, 0, 0, 0, 4, 5])]);
    assert_eq!(bench.node.next_deadline(&bench.dictionary), None);
}

#[test]
fn a_lost_heartbeat_is_an_emergency_and_a_reaction() {
    for (setting, state) in [(0, State::PreOperational), (1, State::Operational), (2, State::Stopped)] {
        let mut bench = Bench::operational();
        set(&mut bench.dictionary, 0x1029, 1, setting);
        set(&mut bench.dictionary, 0x1800, 5, 0);
        bench.handle(0x707, &[5], 10);
        let node = NodeId::new(7).expect("a node-ID");
        let started = Event::Heartbeat(NodeEvent::Started(node, Some(State::Operational)));
        assert_eq!((bench.events(), bench.sent(109)), (vec![started], vec![]));
        let reported = bench.sent(110);
        let emergency = (0x85, vec![0x30, 0x81, 0x11, 7, 0, 0, 0, 0]);
        assert_eq!(reported, if setting == 2 { vec![] } else { vec![emergency] });
        assert_eq!((bench.node.state(), bench.read(0x1001, 0)), (state, Some(0x11)));
        assert!(bench.events().contains(&Event::Heartbeat(NodeEvent::Lost(node))));
        bench.handle(0x707, &[5], 200);
        let reset = bench.sent(200);
        assert_eq!(reset, if setting == 2 { vec![] } else { vec![(0x85, vec![0; 8])] });
        assert_eq!(
            (bench.node.state(), bench.read(0x1001, 0)),
            (state, Some(0)),
            "it does not go back by itself"
        );
    }
}

#[test]
fn a_master_that_stops_guarding_is_a_lost_heartbeat() {
    let mut bench = Bench::operational();
    set(&mut bench.dictionary, 0x1800, 5, 0);
    let question = Frame::remote(CanId::new(0x705).expect("11 bits"), 1).expect("a length");
    assert_eq!(bench.take(&question, 0), Some(vec![5]));
    assert_eq!(bench.sent(199), []);
    assert_eq!(bench.sent(200), [(0x85, vec![0x30, 0x81, 0x11, 0, 0, 0, 0, 0])]);
    assert_eq!(bench.node.state(), State::PreOperational);
    assert_eq!(bench.take(&question, 300), Some(vec![0xFF]));
    assert_eq!(bench.sent(300), [(0x85, vec![0; 8])]);
    assert!(bench.events().contains(&Event::Guarding(Guarding::Resumed)));
}

#[test]
fn what_is_wrong_with_pdos_is_an_emergency() {
    let mut bench = Bench::operational();
    set(&mut bench.dictionary, 0x1800, 5, 0);
    let sent = |bench: &mut Bench, now| {
        let emergencies = bench.sent(now).into_iter();
        emergencies
            .map(|(_, data)| (u16::from_le_bytes([data[0], data[1]]), data[2], data[3]))
            .collect::<Vec<_>>()
    };
    bench.handle(0x205, &[1], 0);
    bench.handle(0x205, &[1, 2, 3], 0);
    bench.handle(0x80, &[1], 0);
    assert_eq!(sent(&mut bench, 0), [(0x8210, 0x11, 1), (0x8220, 0x11, 1), (0x8240, 0x11, 0), (0, 0x11, 0)]);
    assert_eq!((sent(&mut bench, 50), bench.read(0x1001, 0)), (vec![(0x8250, 0x11, 1)], Some(0x11)));
    bench.handle(0x205, &[1, 2], 60);
    assert_eq!(sent(&mut bench, 60), [(0, 0x11, 0), (0, 0x11, 0)]);
    bench.handle(0x80, &[], 70);
    assert_eq!((sent(&mut bench, 70), bench.read(0x1001, 0)), (vec![(0, 0, 0)], Some(0)));
}

#[test]
fn a_sender_with_another_mapping_does_not_push_an_error_out() {
    let mut bench = Bench::operational();
    set(&mut bench.dictionary, 0x1800, 5, 0);
    bench.node.raise(&mut bench.dictionary, Emergency::new(0x2310));
    for _ in 0..100 {
        bench.handle(0x205, &[1], 0);
        bench.handle(0x80, &[1], 0);
    }
    let codes: Vec<_> = bench.sent(0).into_iter().map(|(_, data)| (data[1], data[0])).collect();
    assert_eq!(codes, [(0x23, 0x10), (0x82, 0x10), (0x82, 0x40)]);
    bench.handle(0, &[128, 5], 0);
    assert_eq!(
        (bench.sent(0).len(), bench.read(0x1001, 0)),
        (2, Some(3)),
        "PDOs are over, the current is not"
    );
}

#[test]
fn what_was_not_kept_can_be_cleared_all_the_same() {
    let mut bench = Bench::operational();
    bench.handle(0x80, &[1], 0);
    for code in [0x2310, 0x3110, 0x4210] {
        bench.node.raise(&mut bench.dictionary, Emergency::new(code));
    }
    let not_kept = bench.node.raise(&mut bench.dictionary, Emergency::new(0xFF01));
    assert_eq!((not_kept, bench.read(0x1001, 0)), (Raised::NotKept, Some(0x9F)));
    assert!(!bench.node.clear(&mut bench.dictionary, 0xFF01));
    assert!(bench.node.clear_all(&mut bench.dictionary));
    assert_eq!(bench.read(0x1001, 0), Some(0x11), "the wrong SYNC stays");
    assert!(!bench.node.clear_all(&mut bench.dictionary));
}

#[test]
fn a_dictionary_that_watches_more_nodes_than_there_is_room_for_has_no_node() {
    let watching = |nodes| {
        let mut values = values();
        values.retain(|value| value.id().0 != 0x1016);
        values.extend((0..=nodes).map(|sub| value(0x1016, sub, if sub == 0 { 1 } else { 4 }, 0)));
        values.sort_by_key(TestValue::id);
        Node::new(dictionary(&values).table(), NodeId::new(5), room(UpTo::<2>)).map(drop)
    };
    assert_eq!((watching(2), watching(3)), (Ok(()), Err(NoRoom::Watched(3))));
    let pdos = Node::new(Bench::new(5).dictionary.table(), None, room(UpTo::<0>)).map(drop);
    assert_eq!(pdos, Err(NoRoom::Pdos(TooManyPdos { transmit: 1, receive: 1 })));
}

#[test]
fn a_node_that_produces_sync_follows_it_and_rests_while_stopped() {
    let mut values = values();
    values.push(value(0x1006, 0, 4, 100_000));
    let mut bench = Bench::started_with(values);
    set(&mut bench.dictionary, 0x1800, 2, 1);
    set(&mut bench.dictionary, 0x1400, 2, 1);
    set(&mut bench.dictionary, 0x1400, 5, 0);
    bench.handle(0, &[1, 5], 0);
    bench.handle(0x205, &[1, 2], 0);
    // 1005h: bit 30.
    assert!(bench.handle(0x605, &[0x23, 0x05, 0x10, 0, 0x80, 0, 0, 0x40], 0).is_some());
    assert_eq!(bench.sent(0), [(0x80, vec![]), (0x185, vec![0, 0])]);
    assert_eq!((bench.read(0x2000, 0), bench.sent(99)), (Some(0x0201), vec![]));
    bench.handle(0, &[128, 5], 99);
    assert_eq!(bench.node.next_deadline(&bench.dictionary), Some(at(100)));
    assert_eq!(bench.sent(100), [(0x80, vec![])], "without PDOs");
    bench.handle(0, &[2, 5], 110);
    assert_eq!((bench.sent(140), bench.node.next_deadline(&bench.dictionary)), (vec![], None));
    bench.handle(0, &[1, 5], 150);
    assert_eq!(bench.sent(150), [(0x80, vec![]), (0x185, vec![0, 0])], "it begins anew");
    bench.handle(0, &[129, 5], 1050);
    assert_eq!(bench.sent(2000), [(0x705, vec![0])], "1005h is the factory's again");
}

#[test]
fn emergencies_of_other_nodes_are_heard() {
    let mut values = values();
    values.extend([value(0x1028, 0, 1, 2), value(0x1028, 1, 4, 0x8000_0081), value(0x1028, 2, 4, 0x345)]);
    let mut bench = Bench::started_with(values);
    let data = [0x10, 0x23, 3, 9, 8, 0, 0, 0];
    assert_eq!(
        (bench.handle(0x81, &data, 0), bench.handle(0x345, &data[..7], 0), bench.events()),
        (None, None, vec![])
    );
    bench.handle(0x345, &data, 0);
    let emergency = Emergency::new(0x2310).with_details([9, 8, 0, 0, 0]);
    let node = NodeId::new(2).expect("a node-ID");
    assert_eq!(bench.events(), [Event::Emergency(node, emergency)]);
    set(&mut bench.dictionary, 0x1028, 1, 0x81);
    bench.handle(0x81, &[0; 8], 0);
    let [Event::Emergency(node, emergency)] = bench.events()[..] else { panic!("an emergency") };
    assert_eq!((node.get(), emergency.code(), emergency.register()), (1, 0, ErrorRegister::NONE));
    bench.handle(0, &[2, 5], 0);
    bench.events();
    bench.handle(0x345, &data, 0);
    assert_eq!(bench.events(), [], "not while it is stopped");
}

#[test]
fn a_device_without_a_period_produces_no_sync() {
    let mut bench = Bench::started();
    let refused = bench.handle(0x605, &[0x23, 0x05, 0x10, 0, 0x80, 0, 0, 0x40], 0);
    assert_eq!(refused, Some(vec![0x80, 0x05, 0x10, 0, 0x30, 0, 9, 6]));
}

#[test]
fn a_reset_brings_back_what_it_is_for() {
    for (command, kind, application) in [(129, Reset::Node, 0), (130, Reset::Communication, 77)] {
        let mut bench = Bench::operational();
        set(&mut bench.dictionary, 0x1017, 0, 500);
        set(&mut bench.dictionary, 0x2001, 0, 77);
        bench.node.raise(&mut bench.dictionary, Emergency::new(0x4210));
        bench.handle(0, &[command, 5], 10);
        assert_eq!(bench.node.state(), State::Initialising);
        assert_eq!(bench.handle(0x605, &UPLOAD_1017H, 10), None);
        assert_eq!(bench.sent(10).first(), Some(&(0x705, vec![0])));
        assert_eq!(bench.heard.restarts, [(5, kind)]);
        assert_eq!((bench.read(0x1017, 0), bench.read(0x2001, 0)), (Some(0), Some(application)));
        let kept = kind == Reset::Communication;
        assert_eq!(
            (bench.node.emergencies().is_present(0x4210), bench.read(0x1001, 0)),
            (kept, Some(if kept { 9 } else { 0 }))
        );
        assert_eq!(bench.node.state(), State::PreOperational);
    }
}

#[test]
fn a_node_without_node_id_waits_for_lss() {
    let mut bench = Bench::new(0);
    assert_eq!((bench.sent(0), bench.node.next_deadline(&bench.dictionary)), (vec![], None));
    bench.handle(0, &[1, 0], 0);
    assert_eq!(bench.node.state(), State::Initialising);
    assert_eq!(bench.handle(0x7E5, &[0x4C, 0, 0, 0, 0, 0, 0, 0], 0).map(|data| data[0]), Some(0x50));
    bench.handle(0x7E5, &[4, 1, 0, 0, 0, 0, 0, 0], 0);
    assert_eq!(bench.handle(0x7E5, &[0x11, 9, 0, 0, 0, 0, 0, 0], 0).map(|data| data[1]), Some(0));
    assert_eq!(bench.sent(0), []);
    bench.handle(0x7E5, &[4, 0, 0, 0, 0, 0, 0, 0], 0);
    assert_eq!(bench.sent(0), [(0x709, vec![0])]);
    assert_eq!(bench.node.id(), NodeId::new(9));
    assert!(bench.handle(0x609, &UPLOAD_1017H, 0).is_some());
}

#[test]
fn a_node_id_by_lss_counts_after_a_reset_and_lss_rests_in_operational() {
    let mut bench = Bench::started();
    for request in [[4, 1, 0, 0, 0, 0, 0, 0], [0x11, 6, 0, 0, 0, 0, 0, 0], [4, 0, 0, 0, 0, 0, 0, 0]] {
        bench.handle(0x7E5, &request, 0);
    }
    assert_eq!(bench.node.id(), NodeId::new(5));
    bench.handle(0, &[130, 5], 0);
    assert_eq!(bench.sent(0), [(0x706, vec![0])]);
    bench.handle(0, &[1, 6], 0);
    bench.handle(0x7E5, &[4, 1, 0, 0, 0, 0, 0, 0], 0);
    assert_eq!(bench.handle(0x7E5, &[0x5E, 0, 0, 0, 0, 0, 0, 0], 0), None);
}

#[test]
fn while_the_bit_rate_is_switched_nothing_is_sent() {
    let mut bench = Bench::started();
    set(&mut bench.dictionary, 0x1017, 0, 10);
    for request in [[4, 1, 0, 0, 0, 0, 0, 0], [0x13, 0, 2, 0, 0, 0, 0, 0], [0x15, 100, 0, 0, 0, 0, 0, 0]] {
        bench.handle(0x7E5, &request, 0);
    }
    assert_eq!((bench.sent(50), bench.handle(0x605, &UPLOAD_1017H, 50)), (vec![], None));
    assert!(!bench.node.serves(Service::Sdo));
    assert_eq!(bench.node.next_deadline(&bench.dictionary), Some(at(100)));
    assert_eq!(bench.sent(100), []);
    assert_eq!(bench.events(), [Event::Lss(LssEvent::Switch(BitRate::K500))]);
    assert_eq!(bench.sent(200), [(0x705, vec![127])]);
    assert_eq!(bench.events(), [Event::Lss(LssEvent::Switched)]);
}

/// Frames at random, at any time, with identifiers that the node hears more often than others: nothing panics, nothing is sent without end, and
/// the node still starts and answers.
#[test]
fn no_frame_breaks_a_node() {
    const IDS: [u16; 12] = [0, 0x80, 0x185, 0x205, 0x285, 0x605, 0x605, 0x605, 0x705, 0x707, 0x7E5, 0x7FF];
    let mut random = 12345u64;
    let mut next = move |below: u64| {
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (random >> 33) % below
    };
    for start in [0, 5] {
        let mut more = values();
        more.extend([value(0x1006, 0, 4, 0), value(0x1007, 0, 4, 0), value(0x1019, 0, 1, 0)]);
        more.extend([value(0x1028, 0, 1, 1), value(0x1028, 1, 4, 0x81)]);
        let mut bench = Bench::of(more, start);
        let mut now = 0;
        for _ in 0..40_000 {
            now += next(30);
            let id = IDS.get(usize::try_from(next(14)).expect("small")).copied();
            let id = CanId::new(id.unwrap_or(u16::try_from(next(0x800)).expect("11 bits"))).expect("11 bits");
            let length = usize::try_from(if next(3) == 0 { next(9) } else { 8 }).expect("small");
            let mut data = [0; 8];
            for byte in &mut data {
                *byte = u8::try_from(if next(2) == 0 { next(256) } else { next(6) }).expect("a byte");
            }
            // Requests to objects that exist.
            if id.get() == 0x605 && next(3) > 0 {
                const OBJECTS: [u16; 14] = [
                    0x1003, 0x1005, 0x1006, 0x1007, 0x1014, 0x1016, 0x1017, 0x1019, 0x1028, 0x1400, 0x1600,
                    0x1800, 0x1A00, 0x2000,
                ];
                let index = OBJECTS[usize::try_from(next(14)).expect("small")].to_le_bytes();
                data[0] = [0x22, 0x2F, 0x2B, 0x23, 0x40][usize::try_from(next(5)).expect("small")];
                (data[1], data[2]) = (index[0], index[1]);
            }
            let frame = match next(8) {
                0 => Frame::remote(id, u8::try_from(length).expect("short")),
                _ => Frame::data(id, &data[..length]),
            };
            bench.take(&frame.expect("8 bytes"), now);
            if next(4) == 0 {
                assert!(bench.sent(now).len() < 20, "it ends");
            }
            let due = bench.node.next_deadline(&bench.dictionary);
            if next(50) == 0 && due.is_some_and(|due| due.as_micros() / 1000 > now) {
                now = due.expect("a deadline").as_micros().div_ceil(1000);
            }
            if next(200) == 0 {
                bench.node.trigger(&bench.dictionary, 1, at(now));
                bench.node.raise(&mut bench.dictionary, Emergency::new(0x1000));
            }
        }
        // The longest silence of LSS ends, before and after switching.
        for _ in 0..2 {
            now += 70_000;
            bench.sent(now);
        }
        bench.handle(0, &[129, 0], now);
        // LSS has taken its node-ID, or it never had one.
        if bench.sent(now).is_empty() {
            for request in [[4, 1, 0, 0, 0, 0, 0, 0], [0x11, 5, 0, 0, 0, 0, 0, 0], [4, 0, 0, 0, 0, 0, 0, 0]] {
                bench.handle(0x7E5, &request, now);
            }
            assert_eq!(bench.sent(now), [(0x705, vec![0])]);
        }
        let id = bench.node.id().expect("it has started").get();
        assert_eq!(bench.node.state(), State::PreOperational);
        assert!(bench.handle(0x600 + u16::from(id), &UPLOAD_1017H, now).is_some());
    }
}
