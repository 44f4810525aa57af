//! What is wrong with what comes, or with when it comes.

use super::*;

#[test]
fn a_sync_of_another_length_than_1019h_says_is_told_and_not_followed() {
    for (counter, data, follows) in
        [(0, &[][..], true), (0, &[1][..], false), (10, &[1], true), (10, &[], false), (10, &[1, 2], false)]
    {
        let mut bench = Bench::new([OFF; 2], [(0x185, 1, 0, 0, 0), OFF], counter);
        bench.handle(&frame(0x80, data), 0);
        assert_eq!(!bench.sent(0).is_empty(), follows);
        let length = u8::try_from(data.len()).expect("short");
        let reported = if follows { vec![] } else { vec![PdoEvent::SyncLength { length }] };
        assert_eq!(bench.events(), reported);
    }
}

#[test]
fn a_wrong_length_is_told_once_until_it_is_right_again() {
    let long = PdoEvent::TooLong { number: 1 };
    let short = |number| PdoEvent::TooShort { number };
    let mut bench = Bench::new([(0x205, 255, 0, 0, 0), (0x206, 1, 0, 0, 0)], [OFF; 2], 0);
    for _ in 0..10 {
        bench.handle(&frame(0x205, &[1]), 0);
        bench.handle(&frame(0x206, &[1]), 0);
    }
    assert_eq!(bench.events(), [short(1), short(2)], "two senders in turn");
    assert!(bench.engine.is_any_too_short() && !bench.engine.is_any_too_long());
    bench.handle(&frame(0x205, &[1, 0, 0]), 0);
    bench.handle(&frame(0x205, &[1, 0, 0]), 0);
    assert_eq!(bench.events(), [long, received(1), received(1)]);
    bench.handle(&frame(0x206, &[1, 0]), 0);
    assert!(!bench.engine.is_any_too_short() && bench.engine.is_any_too_long());
    bench.handle(&frame(0x205, &[1, 0]), 0);
    assert!(!bench.engine.is_any_too_long());
    bench.handle(&frame(0x205, &[1]), 0);
    assert_eq!(bench.events(), [received(1), short(1)], "again");
    // Other parameters are another beginning.
    set(&mut bench.dictionary, 0x1400, 1, 0x207);
    bench.sent(0);
    assert!(!bench.engine.is_any_too_short());
    for data in [&[1][..], &[1, 2], &[1]] {
        bench.handle(&frame(0x80, data), 0);
    }
    assert_eq!(
        (bench.events(), bench.engine.is_sync_wrong()),
        (vec![PdoEvent::SyncLength { length: 1 }], true)
    );
    bench.sync(0);
    assert_eq!((bench.events(), bench.engine.is_sync_wrong()), (vec![received(2)], false));
    bench.handle(&frame(0x80, &[1]), 0);
    bench.engine.stop();
    assert!(!bench.engine.is_sync_wrong());
}

#[test]
fn what_comes_or_goes_after_the_window_waits_for_the_next_sync() {
    let synchronous = [(0x205, 1, 0, 0, 0), (0x206, 255, 0, 0, 0)];
    let mut bench = Bench::new(synchronous, [(0x185, 1, 0, 0, 0), (0x186, 255, 0, 0, 0)], 0);
    set(&mut bench.dictionary, 0x1007, 0, 10_000);
    bench.handle(&frame(0x205, &[1, 0]), 100);
    bench.sync(100);
    assert_eq!(
        (bench.sent(109), bench.events()),
        (vec![0x185], vec![received(1)]),
        "9 ms after the first SYNC, whose window is 10 ms"
    );
    bench.handle(&frame(0x205, &[2, 0]), 110);
    assert_eq!(bench.events(), []);
    bench.sync(200);
    assert_eq!((bench.read(0x2000), bench.events()), (2, vec![received(1)]));
    // Too late, in both directions. What is not synchronous does not mind.
    bench.trigger(2, 211);
    assert_eq!((bench.sent(211), bench.events()), (vec![0x186], vec![PdoEvent::NotSentInTime { number: 1 }]));
    bench.handle(&frame(0x205, &[3, 0]), 211);
    bench.handle(&frame(0x206, &[4, 0]), 211);
    assert_eq!(bench.events(), [PdoEvent::CameLate { number: 1 }, received(2)]);
    bench.sync(300);
    assert_eq!((bench.read(0x2000), bench.sent(300), bench.events()), (2, vec![0x185], vec![]));
    set(&mut bench.dictionary, 0x1007, 0, 0);
    bench.sync(400);
    bench.handle(&frame(0x205, &[5, 0]), 10_000);
    assert_eq!((bench.sent(10_000), bench.events()), (vec![0x185], vec![]), "without a window");
}

#[test]
fn data_that_waits_may_be_too_short_at_the_sync() {
    let mut bench = Bench::receiving((0x205, 1, 0, 0, 0));
    set(&mut bench.dictionary, 0x1600, 1, 0x2000_0008);
    bench.handle(&frame(0x205, &[1]), 0);
    set(&mut bench.dictionary, 0x1600, 1, 0x2000_0010);
    bench.sync(0);
    assert_eq!((bench.read(0x2000), bench.events()), (0, vec![PdoEvent::TooShort { number: 1 }]));
}

#[test]
fn an_rpdo_that_stays_away_is_told_once() {
    let mut bench = Bench::receiving((0x205, 255, 0, 100, 0));
    bench.sent(1_000_000);
    assert_eq!(bench.events(), [], "watched from its first reception on");
    bench.handle(&frame(0x205, &[3, 0]), 1_000_000);
    assert_eq!(bench.events(), [received(1)]);
    assert_eq!(bench.engine.next_deadline(&bench.dictionary), Some(at(1_000_100)));
    bench.sent(1_000_099);
    assert_eq!(bench.events(), []);
    bench.sent(1_000_100);
    bench.sent(1_000_300);
    assert_eq!(bench.events(), [PdoEvent::Overdue { number: 1 }]);
    bench.handle(&frame(0x205, &[4]), 1_000_400);
    assert_eq!(bench.events(), [PdoEvent::TooShort { number: 1 }], "what is not processed does not count");
    bench.handle(&frame(0x205, &[4, 0]), 1_000_400);
    assert_eq!(bench.events(), [received(1), PdoEvent::Resumed { number: 1 }]);
}
