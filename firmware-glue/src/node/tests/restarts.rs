//! What a node keeps and forgets when something begins anew.

use super::*;

#[test]
fn what_the_device_keeps_by_itself_outlives_every_reset() {
    let mut values = values();
    values.push(stored(0x3050, 0, 4, 0, Storage::Remanent));
    let mut bench = Bench::of(values, 5);
    // The firmware has it from its own memory, before the node starts.
    set(&mut bench.dictionary, 0x3050, 0, 12_345);
    set(&mut bench.dictionary, 0x2001, 0, 77);
    bench.sent(0);
    assert_eq!((bench.read(0x3050, 0), bench.read(0x2001, 0)), (Some(12_345), Some(0)), "power-on");
    for command in [129, 130] {
        set(&mut bench.dictionary, 0x2000, 0, 5);
        bench.handle(0, &[command, 0], 10);
        assert_eq!(bench.sent(10).first(), Some(&(0x705, vec![0])));
        assert_eq!(bench.read(0x3050, 0), Some(12_345), "command {command}");
        assert_eq!(bench.read(0x2000, 0), Some(if command == 129 { 0 } else { 5 }));
    }
}

#[test]
fn a_reset_of_the_communication_leaves_what_another_command_stores() {
    let group = |storage| {
        values().into_iter().map(move |value| match value.id() {
            (0x1016, 1) => stored(0x1016, 1, 4, 0, storage),
            _ => value,
        })
    };
    for (storage, kept) in [
        (Storage::No, 0),
        (Storage::Communication, 0),
        (Storage::Application, 0x0009_0064),
        (Storage::Manufacturer, 0x0009_0064),
        (Storage::Remanent, 0x0009_0064),
    ] {
        let mut bench = Bench::started_with(group(storage).collect());
        set(&mut bench.dictionary, 0x1016, 1, 0x0009_0064);
        bench.handle(0, &[130, 5], 0);
        bench.sent(0);
        assert_eq!(bench.read(0x1016, 1), Some(kept), "{storage:?}");
    }
}

#[test]
fn a_node_that_is_started_is_no_longer_set_up_by_lss() {
    let mut bench = Bench::started();
    bench.handle(0x7E5, &[4, 1, 0, 0, 0, 0, 0, 0], 0);
    bench.handle(0, &[1, 5], 0);
    // The master's end is not heard, and the next one means another node.
    bench.handle(0x7E5, &[4, 0, 0, 0, 0, 0, 0, 0], 0);
    bench.handle(0, &[128, 5], 0);
    assert_eq!(bench.handle(0x7E5, &[0x11, 9, 0, 0, 0, 0, 0, 0], 0), None);
    assert_eq!(bench.handle(0x7E5, &[0x5E, 0, 0, 0, 0, 0, 0, 0], 0), None);
}

/// Switches the bit rate, which takes 200 ms from a time on.
fn switch_bit_rate(bench: &mut Bench, now: u64) {
    for request in [[4, 1, 0, 0, 0, 0, 0, 0], [0x13, 0, 2, 0, 0, 0, 0, 0], [0x15, 100, 0, 0, 0, 0, 0, 0]] {
        bench.handle(0x7E5, &request, now);
    }
    assert_eq!(bench.sent(now + 100), []);
}

#[test]
fn nobody_is_lost_because_the_bit_rate_was_switched() {
    let mut bench = Bench::started();
    bench.handle(0x707, &[5], 10);
    switch_bit_rate(&mut bench, 20);
    assert_eq!((bench.sent(300), bench.read(0x1001, 0)), (vec![], Some(0)));
    bench.handle(0x707, &[5], 310);
    assert_eq!(bench.sent(410), [(0x85, vec![0x30, 0x81, 0x11, 7, 0, 0, 0, 0])], "watched as before");
    let mut bench = Bench::started();
    let question = Frame::remote(CanId::new(0x705).expect("11 bits"), 1).expect("a length");
    assert_eq!(bench.take(&question, 10), Some(vec![127]));
    switch_bit_rate(&mut bench, 20);
    assert_eq!(bench.sent(300), []);
    assert_eq!(bench.take(&question, 310), Some(vec![0xFF]), "the toggle bit goes on");
    assert_eq!(bench.sent(510), [(0x85, vec![0x30, 0x81, 0x11, 0, 0, 0, 0, 0])]);
}

#[test]
fn guarding_that_is_switched_off_is_not_lost() {
    let mut bench = Bench::started();
    let question = Frame::remote(CanId::new(0x705).expect("11 bits"), 1).expect("a length");
    bench.take(&question, 0);
    assert_eq!(bench.sent(200), [(0x85, vec![0x30, 0x81, 0x11, 0, 0, 0, 0, 0])]);
    set(&mut bench.dictionary, 0x100C, 0, 0);
    assert_eq!((bench.sent(300), bench.read(0x1001, 0)), (vec![(0x85, vec![0; 8])], Some(0)));
    set(&mut bench.dictionary, 0x100C, 0, 100);
    assert_eq!(bench.sent(9000), [], "it begins anew, with the first question");
    bench.take(&question, 9000);
    assert_eq!(bench.sent(9200), [(0x85, vec![0x30, 0x81, 0x11, 0, 0, 0, 0, 0])]);
}
