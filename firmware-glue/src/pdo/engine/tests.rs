extern crate std;

mod troubles;

use std::vec;
use std::vec::Vec;

use super::*;
use crate::access::application::Application;
use crate::access::parameters::set;
use crate::access::test_table::{TestDictionary, TestValue, dictionary, value};
use crate::bus::frame::CanId;
use crate::pdo::PdoError;
use crate::table::entry::EntryId;

/// What an application hears.
#[derive(Default)]
struct Heard {
    events: Vec<PdoEvent<EntryId>>,
    changed: Vec<u16>,
}

impl Application<TestDictionary> for Heard {
    fn changed(&mut self, _: &mut TestDictionary, entry: EntryId) {
        self.changed.push(entry.index);
    }
}

impl PdoHandler<TestDictionary> for Heard {
    fn pdo_event(&mut self, _: &mut TestDictionary, event: PdoEvent<EntryId>) {
        self.events.push(event);
    }
}

/// The communication parameters of a PDO: COB-ID, transmission type, inhibit time, event timer, SYNC start value.
type Communication = (u32, u32, u32, u32, u32);

fn pdo(
    index: u16,
    (cob_id, transmission, inhibit, timer, start): Communication,
    mapped: u32,
) -> Vec<TestValue> {
    vec![
        value(index, 0, 1, 6),
        value(index, 1, 4, cob_id),
        value(index, 2, 1, transmission),
        value(index, 3, 2, inhibit),
        value(index, 4, 1, 0),
        value(index, 5, 2, timer),
        value(index, 6, 1, start),
        value(index + 0x200, 0, 1, 1),
        value(index + 0x200, 1, 4, mapped),
    ]
}

/// A device with RPDOs 1 and 2 (2000h, 2001h), TPDOs 1 and 2 (2002h, 2003h), and a counter in SYNCs if there is one.
struct Bench {
    dictionary: TestDictionary,
    engine: PdoEngine<2, 2>,
    heard: Heard,
}

impl Bench {
    fn new(receive: [Communication; 2], transmit: [Communication; 2], counter: u32) -> Self {
        let mut values =
            vec![value(0x1005, 0, 4, 0x80), value(0x1007, 0, 4, 0), value(0x1019, 0, 1, counter)];
        let receive = [pdo(0x1400, receive[0], 0x2000_0010), pdo(0x1401, receive[1], 0x2001_0010)];
        let transmit = [pdo(0x1800, transmit[0], 0x2002_0010), pdo(0x1801, transmit[1], 0x2003_0010)];
        values.extend(receive.into_iter().chain(transmit).flatten());
        values.extend((0x2000..0x2004).map(|index| value(index, 0, 2, 0)));
        values.sort_by_key(TestValue::id);
        let dictionary = dictionary(&values);
        let mut engine = PdoEngine::new(dictionary.table()).expect("two of each");
        engine.start(&dictionary, at(0));
        Self { dictionary, engine, heard: Heard::default() }
    }

    fn transmitting(transmit: Communication) -> Self {
        Self::new([OFF; 2], [transmit, OFF], 0)
    }

    fn receiving(receive: Communication) -> Self {
        Self::new([receive, OFF], [OFF; 2], 0)
    }

    fn handle(&mut self, frame: &Frame, now: u64) {
        self.engine.handle(frame, &mut self.dictionary, &mut self.heard, at(now));
    }

    fn sync(&mut self, now: u64) {
        self.handle(&frame(0x80, &[]), now);
    }

    /// Identifiers of what is sent.
    fn sent(&mut self, now: u64) -> Vec<u16> {
        self.frames(now).iter().map(|frame| frame.id().get()).collect()
    }

    fn frames(&mut self, now: u64) -> Vec<Frame> {
        core::iter::from_fn(|| self.engine.poll(&mut self.dictionary, &mut self.heard, at(now)))
            .take(10)
            .collect()
    }

    fn trigger(&mut self, number: u16, now: u64) {
        self.engine.trigger(&self.dictionary, number, at(now));
    }

    fn read(&self, index: u16) -> u32 {
        Parameters::of(&self.dictionary).number(index, 0).expect("a value")
    }

    fn events(&mut self) -> Vec<PdoEvent<EntryId>> {
        core::mem::take(&mut self.heard.events)
    }
}

const OFF: Communication = (0x8000_0000, 255, 0, 0, 0);

fn at(millis: u64) -> Instant {
    Instant::from_millis(millis)
}

fn frame(id: u16, data: &[u8]) -> Frame {
    Frame::data(CanId::new(id).expect("11 bits"), data).expect("8 bytes")
}

fn remote(id: u16) -> Frame {
    Frame::remote(CanId::new(id).expect("11 bits"), 2).expect("a length")
}

fn received(number: u16) -> PdoEvent<EntryId> {
    PdoEvent::Received { number, refused: None }
}

#[test]
fn an_event_driven_tpdo_waits_for_its_inhibit_time() {
    let mut bench = Bench::transmitting((0x185, 255, 50, 0, 0));
    assert_eq!(bench.sent(0), []);
    set(&mut bench.dictionary, 0x2002, 0, 0x1234);
    bench.trigger(1, 10);
    let frames = bench.frames(10);
    assert_eq!(frames.iter().map(|frame| frame.bytes().expect("data")).collect::<Vec<_>>(), [[0x34, 0x12]]);
    bench.trigger(1, 11);
    assert_eq!(bench.engine.next_deadline(&bench.dictionary), Some(at(15)));
    assert_eq!(bench.sent(14), []);
    set(&mut bench.dictionary, 0x2002, 0, 0x5678);
    assert_eq!(bench.frames(15).first().and_then(Frame::bytes), Some(&[0x78, 0x56][..]), "the newest values");
    assert_eq!(bench.sent(100), []);
}

#[test]
fn an_event_timer_sends_without_an_event() {
    let mut bench = Bench::transmitting((0x185, 254, 0, 100, 0));
    assert_eq!(bench.engine.next_deadline(&bench.dictionary), Some(at(100)));
    assert_eq!((bench.sent(99), bench.sent(100), bench.sent(101)), (vec![], vec![0x185], vec![]));
    bench.trigger(1, 150);
    assert_eq!((bench.sent(150), bench.sent(249), bench.sent(250)), (vec![0x185], vec![], vec![0x185]));
    set(&mut bench.dictionary, 0x1800, 5, 0);
    assert_eq!(bench.sent(10_000), []);
    // An inhibit time that is longer wins.
    let mut bench = Bench::transmitting((0x185, 255, 2000, 100, 0));
    assert_eq!((bench.sent(100), bench.sent(299), bench.sent(300)), (vec![0x185], vec![], vec![0x185]));
}

#[test]
fn a_cyclic_tpdo_goes_with_every_nth_sync() {
    for every in 1..=240u32 {
        let mut bench = Bench::transmitting((0x185, every, 0, 0, 0));
        let with = (1..=3 * every).filter(|_| {
            bench.sync(1);
            !bench.sent(1).is_empty()
        });
        assert_eq!(with.collect::<Vec<_>>(), [every, 2 * every, 3 * every]);
    }
}

#[test]
fn an_acyclic_tpdo_goes_with_the_sync_after_an_event() {
    let mut bench = Bench::transmitting((0x185, 0, 1000, 5, 0));
    bench.sync(1);
    assert_eq!(bench.sent(50), [], "neither without an event nor by a timer");
    bench.trigger(1, 60);
    assert_eq!(bench.sent(60), []);
    set(&mut bench.dictionary, 0x2002, 0, 1);
    bench.sync(70);
    // An event between SYNC and sending belongs to the next SYNC; values are those of the SYNC.
    bench.trigger(1, 70);
    set(&mut bench.dictionary, 0x2002, 0, 2);
    assert_eq!(bench.frames(71).first().and_then(Frame::bytes), Some(&[1, 0][..]));
    assert_eq!(bench.sent(72), []);
    bench.sync(80);
    assert_eq!(bench.frames(80).first().and_then(Frame::bytes), Some(&[2, 0][..]));
    bench.sync(90);
    assert_eq!(bench.sent(90), []);
}

#[test]
fn the_start_value_chooses_the_sync_from_which_on_others_are_counted() {
    let mut bench = Bench::new([OFF; 2], [(0x185, 3, 0, 0, 2), (0x285, 3, 0, 0, 0)], 4);
    let mut with = Vec::new();
    for counter in [3, 4, 1, 2, 3, 4, 1, 2, 3] {
        bench.handle(&frame(0x80, &[counter]), 0);
        with.push((counter, bench.sent(0)));
    }
    let expected = [
        (3, vec![]),
        (4, vec![]),
        (1, vec![0x285]),
        (2, vec![]),
        (3, vec![]),
        (4, vec![0x185, 0x285]),
        (1, vec![]),
        (2, vec![]),
        (3, vec![0x185, 0x285]),
    ];
    let sorted = with.into_iter().map(|(counter, mut ids)| {
        ids.sort_unstable();
        (counter, ids)
    });
    assert_eq!(sorted.collect::<Vec<_>>(), expected);
}

#[test]
fn remote_frames_are_answered_as_the_type_says() {
    // 253: at once.
    let mut bench = Bench::transmitting((0x185, 253, 0, 0, 0));
    bench.trigger(1, 0);
    bench.sync(0);
    assert_eq!(bench.sent(0), []);
    bench.handle(&remote(0x185), 1);
    assert_eq!((bench.sent(1), bench.sent(2)), (vec![0x185], vec![]));
    // 252: the values of the last SYNC, and nothing before one.
    let mut bench = Bench::transmitting((0x185, 252, 0, 0, 0));
    bench.handle(&remote(0x185), 0);
    assert_eq!(bench.sent(0), []);
    set(&mut bench.dictionary, 0x2002, 0, 7);
    bench.sync(1);
    assert_eq!(bench.sent(1), []);
    set(&mut bench.dictionary, 0x2002, 0, 8);
    for _ in 0..2 {
        bench.handle(&remote(0x185), 2);
        assert_eq!(bench.frames(2).first().and_then(Frame::bytes), Some(&[7, 0][..]));
    }
    // Synchronous: with the next SYNC.
    for transmission in [0, 100] {
        let mut bench = Bench::transmitting((0x185, transmission, 0, 0, 0));
        bench.handle(&remote(0x185), 0);
        assert_eq!(bench.sent(0), []);
        bench.sync(1);
        assert_eq!(bench.sent(1), [0x185]);
        bench.sync(2);
        assert_eq!(bench.sent(2), []);
    }
    // 255: as an event.
    let mut bench = Bench::transmitting((0x185, 255, 50, 0, 0));
    bench.handle(&remote(0x185), 0);
    assert_eq!(bench.sent(0), [0x185]);
    bench.handle(&remote(0x185), 1);
    assert_eq!((bench.sent(1), bench.sent(5)), (vec![], vec![0x185]));
}

#[test]
fn remote_frames_are_not_answered_where_bit_30_says_so() {
    for transmission in [0, 1, 252, 253, 254, 255] {
        let mut bench = Bench::transmitting((0x4000_0185, transmission, 0, 0, 0));
        bench.sync(0);
        bench.frames(0);
        bench.handle(&remote(0x185), 0);
        assert_eq!(bench.sent(0), [], "{transmission}");
    }
    let mut bench = Bench::transmitting((0x185, 253, 0, 0, 0));
    bench.handle(&remote(0x186), 0);
    bench.handle(&frame(0x185, &[1, 2]), 0);
    assert_eq!(bench.sent(0), []);
}

#[test]
fn a_synchronous_rpdo_takes_effect_at_the_next_sync() {
    for transmission in [0, 1, 2, 240] {
        let mut bench = Bench::receiving((0x205, transmission, 0, 0, 0));
        bench.handle(&frame(0x205, &[1, 0]), 0);
        bench.handle(&frame(0x205, &[2, 0]), 0);
        // Too short: not processed, and what came before it still counts.
        bench.handle(&frame(0x205, &[9]), 0);
        assert_eq!((bench.read(0x2000), bench.events()), (0, vec![PdoEvent::TooShort { number: 1 }]));
        bench.sync(1);
        assert_eq!((bench.read(0x2000), bench.events()), (2, vec![received(1)]));
        set(&mut bench.dictionary, 0x2000, 0, 5);
        bench.sync(2);
        assert_eq!((bench.read(0x2000), bench.events()), (5, vec![]), "once");
    }
}

#[test]
fn an_event_driven_rpdo_takes_effect_at_once() {
    for transmission in [254, 255] {
        let mut bench = Bench::receiving((0x205, transmission, 0, 0, 0));
        bench.handle(&frame(0x205, &[0x34, 0x12]), 0);
        assert_eq!((bench.read(0x2000), bench.events()), (0x1234, vec![received(1)]));
        assert_eq!(bench.heard.changed, [0x2000]);
        bench.handle(&frame(0x205, &[1, 0, 0]), 0);
        assert_eq!(
            (bench.read(0x2000), bench.events()),
            (1, vec![PdoEvent::TooLong { number: 1 }, received(1)])
        );
        bench.handle(&frame(0x205, &[9]), 0);
        assert_eq!((bench.read(0x2000), bench.events()), (1, vec![PdoEvent::TooShort { number: 1 }]));
        bench.handle(&remote(0x205), 0);
        bench.handle(&frame(0x206, &[9, 9]), 0);
        assert_eq!((bench.read(0x2000), bench.events()), (1, vec![]));
    }
}

#[test]
fn types_that_an_rpdo_cannot_have_take_nothing() {
    for transmission in 241..=253 {
        let mut bench = Bench::receiving((0x205, transmission, 0, 0, 0));
        bench.handle(&frame(0x205, &[1, 0]), 0);
        bench.sync(0);
        assert_eq!((bench.read(0x2000), bench.events()), (0, vec![]), "{transmission}");
    }
}

#[test]
fn several_rpdos_hear_one_frame() {
    let mut bench = Bench::new([(0x205, 255, 0, 0, 0), (0x205, 1, 0, 0, 0)], [OFF; 2], 0);
    bench.handle(&frame(0x205, &[3, 0]), 0);
    bench.sync(0);
    assert_eq!((bench.read(0x2000), bench.read(0x2001)), (3, 3));
    assert_eq!(bench.events(), [received(1), received(2)]);
}

#[test]
fn nothing_happens_unless_the_node_is_operational() {
    let mut bench = Bench::new(
        [(0x205, 255, 0, 100, 0), (0x305, 1, 0, 0, 0)],
        [(0x185, 255, 0, 10, 0), (0x285, 1, 0, 0, 0)],
        0,
    );
    bench.handle(&frame(0x205, &[3, 0]), 0);
    bench.handle(&frame(0x305, &[3, 0]), 0);
    bench.events();
    bench.engine.stop();
    bench.handle(&frame(0x205, &[4, 0]), 1);
    bench.handle(&frame(0x305, &[4, 0]), 1);
    bench.sync(1);
    bench.trigger(1, 1);
    assert_eq!((bench.sent(100_000), bench.events()), (vec![], vec![]));
    assert_eq!(bench.engine.next_deadline(&bench.dictionary), None);
    assert_eq!((bench.read(0x2000), bench.read(0x2001)), (3, 0));
    bench.engine.start(&bench.dictionary, at(200_000));
    assert_eq!(bench.sent(200_009), []);
    assert_eq!(bench.sent(200_010), [0x185]);
    bench.sync(200_010);
    assert_eq!((bench.read(0x2001), bench.sent(200_010)), (0, vec![0x285]), "what came before is gone");
}

#[test]
fn parameters_count_as_soon_as_they_are_written() {
    let mut bench = Bench::transmitting((0x185, 255, 100, 0, 0));
    bench.trigger(1, 0);
    assert_eq!(bench.sent(0), [0x185]);
    set(&mut bench.dictionary, 0x1800, 2, 1);
    bench.sync(1);
    assert_eq!(bench.sent(1), [0x185]);
    set(&mut bench.dictionary, 0x1800, 1, 0x8000_0185);
    bench.trigger(1, 2);
    bench.sync(2);
    assert_eq!(bench.sent(2), []);
    set(&mut bench.dictionary, 0x1800, 1, 0x186);
    bench.sync(3);
    assert_eq!(bench.sent(3), [0x186]);
    // The mapping is taken as it is: here, a second entry.
    set(&mut bench.dictionary, 0x1A00, 1, 0x2003_0010);
    set(&mut bench.dictionary, 0x2003, 0, 0x42);
    bench.sync(4);
    assert_eq!(bench.frames(4).first().and_then(Frame::bytes), Some(&[0x42, 0][..]));
    set(&mut bench.dictionary, 0x1A00, 0, 0);
    bench.sync(5);
    assert_eq!(bench.sent(5), []);
    assert_eq!(bench.events(), [PdoEvent::NotSent { number: 1, error: PdoError::NotMapped }]);
}

#[test]
fn a_changed_entry_is_an_event_of_the_tpdos_that_carry_it() {
    let mut bench = Bench::new([OFF; 2], [(0x185, 255, 0, 0, 0), (0x285, 255, 0, 0, 0)], 0);
    bench.engine.trigger_entry(&bench.dictionary, EntryId { index: 0x2003, sub: 0 }, at(0));
    assert_eq!(bench.sent(0), [0x285]);
    bench.engine.trigger_entry(&bench.dictionary, EntryId { index: 0x2000, sub: 0 }, at(0));
    assert_eq!(bench.sent(0), []);
}

#[test]
fn a_tpdo_with_many_events_does_not_hold_up_others() {
    let mut bench = Bench::new([OFF; 2], [(0x185, 255, 0, 0, 0), (0x285, 255, 0, 0, 0)], 0);
    let mut sent = Vec::new();
    for _ in 0..4 {
        bench.trigger(1, 0);
        bench.trigger(2, 0);
        let frame = bench.engine.poll(&mut bench.dictionary, &mut bench.heard, at(0)).expect("a frame");
        sent.push(frame.id().get());
    }
    assert_eq!(sent, [0x185, 0x285, 0x185, 0x285]);
}

#[test]
fn no_pdo_is_left_out_in_silence() {
    let bench = Bench::transmitting(OFF);
    let error = PdoEngine::<1, 2>::new(bench.dictionary.table()).expect_err("too little room");
    assert_eq!(error, TooManyPdos { transmit: 2, receive: 2 });
    assert!(PdoEngine::<2, 1>::new(bench.dictionary.table()).is_err());
    assert!(PdoEngine::<3, 3>::new(bench.dictionary.table()).is_ok());
}
