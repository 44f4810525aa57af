extern crate std;

use std::vec;
use std::vec::Vec;

use super::*;
use crate::access::test_table::{dictionary, value};

const IDENTITY: Identity =
    Identity { vendor: 0x0000_0123, product: 0x8000_0001, revision: 0x0001_0002, serial: 0xDEAD_BEEF };

#[derive(Default)]
struct Firmware(Vec<(MaybeNode, Option<BitRate>)>);

impl LssHandler for Firmware {
    fn has_bit_rate(&self, rate: BitRate) -> bool {
        matches!(rate, BitRate::K125 | BitRate::K500)
    }

    fn store(&mut self, node: MaybeNode, rate: Option<BitRate>) -> Reply {
        self.0.push((node, rate));
        Reply::Done
    }
}

fn at(millis: u64) -> Instant {
    Instant::from_millis(millis)
}

fn node(node: u8) -> MaybeNode {
    NodeId::new(node)
}

fn request(bytes: [u8; 8]) -> Frame {
    Frame::full(CanId::new(REQUEST).expect("11 bits"), bytes)
}

fn ask(lss: &mut Lss, bytes: [u8; 8]) -> Option<[u8; 8]> {
    let answer = lss.handle(&request(bytes), IDENTITY, &mut Firmware::default(), at(0))?;
    assert_eq!(answer.id().get(), 0x7E4);
    answer.bytes().and_then(|bytes| bytes.try_into().ok())
}

fn part(command: u8, number: u32) -> [u8; 8] {
    let [a, b, c, d] = number.to_le_bytes();
    [command, a, b, c, d, 0, 0, 0]
}

fn configured(node: MaybeNode) -> Lss {
    let mut lss = Lss::new(node);
    assert_eq!(ask(&mut lss, [4, 1, 0, 0, 0, 0, 0, 0]), None);
    assert_eq!(lss.state(), LssState::Configuration);
    lss
}

#[test]
fn a_slave_is_chosen_by_its_whole_identity_in_order() {
    let parts = IDENTITY.parts();
    let mut lss = Lss::new(node(5));
    for (command, number) in (0x40..).zip(parts) {
        let expected = (command == 0x43).then_some([0x44, 0, 0, 0, 0, 0, 0, 0]);
        assert_eq!(ask(&mut lss, part(command, number)), expected);
    }
    assert_eq!(lss.state(), LssState::Configuration);
    ask(&mut lss, [4, 0, 0, 0, 0, 0, 0, 0]);
    assert_eq!(lss.state(), LssState::Waiting);
    // One wrong bit anywhere, one part left out, or two exchanged: not chosen.
    for wrong in 0..128u32 {
        let mut lss = Lss::new(node(5));
        for (at, (command, number)) in (0..).zip((0x40..).zip(parts)) {
            let number = if wrong / 32 == at { number ^ 1 << (wrong % 32) } else { number };
            assert_eq!(ask(&mut lss, part(command, number)), None);
        }
        assert_eq!(lss.state(), LssState::Waiting);
    }
    for order in [[1, 2, 3, 3], [0, 1, 3, 2], [0, 2, 3, 3], [3, 3, 3, 3], [0, 1, 1, 3]] {
        let mut lss = Lss::new(node(5));
        for at in order {
            assert_eq!(
                ask(&mut lss, part(0x40 + at, IDENTITY.part(at).expect("four parts"))),
                None,
                "{order:?}"
            );
        }
    }
}

#[test]
fn a_node_id_counts_from_the_reset_on() {
    let mut lss = configured(node(5));
    for number in 0..=255 {
        let ok = matches!(number, 1..=127 | 255);
        let before = lss.pending();
        let answer = ask(&mut lss, [0x11, number, 0, 0, 0, 0, 0, 0]);
        assert_eq!(answer, Some([0x11, u8::from(!ok), 0, 0, 0, 0, 0, 0]));
        assert_eq!(lss.pending(), if ok { NodeId::new(number) } else { before });
    }
    ask(&mut lss, [0x11, 9, 0, 0, 0, 0, 0, 0]);
    assert_eq!(ask(&mut lss, [0x5E, 0, 0, 0, 0, 0, 0, 0]), Some([0x5E, 5, 0, 0, 0, 0, 0, 0]));
    assert_eq!(lss.reset(), node(9));
    assert_eq!(lss.state(), LssState::Waiting);
    let mut lss = configured(None);
    assert_eq!(ask(&mut lss, [0x5E, 0, 0, 0, 0, 0, 0, 0]), Some([0x5E, 255, 0, 0, 0, 0, 0, 0]));
}

#[test]
fn the_identity_is_told_part_by_part() {
    let mut lss = configured(node(5));
    for (command, number) in (0x5A..).zip(IDENTITY.parts()) {
        assert_eq!(ask(&mut lss, part(command, 0)), Some(part(command, number)));
    }
    let device = dictionary(&[
        value(0x1018, 0, 1, 4),
        value(0x1018, 1, 4, IDENTITY.vendor),
        value(0x1018, 2, 4, IDENTITY.product),
        value(0x1018, 3, 4, IDENTITY.revision),
        value(0x1018, 4, 4, IDENTITY.serial),
    ]);
    assert_eq!(Identity::of(&device), IDENTITY);
}

#[test]
fn who_waits_is_not_set_up() {
    for command in [0x11, 0x13, 0x15, 0x17, 0x5A, 0x5B, 0x5C, 0x5D, 0x5E] {
        let mut lss = Lss::new(node(5));
        assert_eq!(ask(&mut lss, [command, 9, 0, 0, 0, 0, 0, 0]), None, "{command:02X}h");
        assert_eq!(lss, Lss::new(node(5)));
    }
}

#[test]
fn the_bit_rate_is_switched_between_two_delays() {
    let mut lss = configured(node(5));
    let mut firmware = Firmware::default();
    for (table, index, error) in [(0, 2, 0), (0, 4, 0), (0, 3, 1), (0, 5, 1), (0, 10, 1), (1, 2, 1)] {
        let answer = ask(&mut lss, [0x13, table, index, 0, 0, 0, 0, 0]);
        assert_eq!(answer, Some([0x13, error, 0, 0, 0, 0, 0, 0]), "{table} {index}");
    }
    let activate = request([0x15, 0xE8, 3, 0, 0, 0, 0, 0]);
    assert!(lss.handle(&activate, IDENTITY, &mut firmware, at(50)).is_none());
    assert!(lss.is_silent());
    assert_eq!((lss.poll(at(1049)), lss.next_deadline()), (None, Some(at(1050))));
    assert!(lss.handle(&activate, IDENTITY, &mut firmware, at(1049)).is_none());
    assert_eq!(lss.poll(at(1050)), Some(LssEvent::Switch(BitRate::K125)));
    assert_eq!((lss.poll(at(2049)), lss.is_silent()), (None, true));
    assert_eq!(lss.poll(at(2050)), Some(LssEvent::Switched));
    assert_eq!((lss.is_silent(), lss.next_deadline()), (false, None));
    // Nothing was set: nothing is switched.
    let mut lss = configured(node(5));
    lss.handle(&activate, IDENTITY, &mut firmware, at(50));
    assert!(!lss.is_silent());
}

#[test]
fn what_was_set_is_stored_on_demand() {
    let mut lss = configured(node(5));
    let mut firmware = Firmware::default();
    for bytes in [[0x11, 9, 0, 0, 0, 0, 0, 0], [0x13, 0, 2, 0, 0, 0, 0, 0], [0x17, 0, 0, 0, 0, 0, 0, 0]] {
        let answer = lss.handle(&request(bytes), IDENTITY, &mut firmware, at(0)).expect("an answer");
        assert_eq!(answer.bytes(), Some(&[bytes[0], 0, 0, 0, 0, 0, 0, 0][..]));
    }
    assert_eq!(firmware.0, [(node(9), Some(BitRate::K500))]);
}

#[test]
fn slaves_in_a_range_say_so() {
    let Identity { vendor, product, revision, serial } = IDENTITY;
    let inside = [vendor, product, revision, revision, serial, serial];
    let ask_all = |numbers: [u32; 6]| {
        let mut lss = Lss::new(node(5));
        let answers =
            (0x46..).zip(numbers).filter_map(|(command, number)| ask(&mut lss, part(command, number)));
        answers.collect::<Vec<_>>()
    };
    let yes = vec![[0x4F, 0, 0, 0, 0, 0, 0, 0]];
    assert_eq!(ask_all(inside), yes);
    assert_eq!(ask_all([vendor, product, 0, u32::MAX, 0, u32::MAX]), yes);
    for (at, off) in [(0, 1), (1, 1), (2, 1), (3, u32::MAX), (4, 1), (5, u32::MAX)] {
        let mut outside = inside;
        outside[at] = outside[at].wrapping_add(off);
        assert_eq!(ask_all(outside), Vec::<[u8; 8]>::new());
    }
}

#[test]
fn who_has_no_node_id_says_so() {
    assert_eq!(ask(&mut Lss::new(None), part(0x4C, 0)), Some([0x50, 0, 0, 0, 0, 0, 0, 0]));
    assert_eq!(ask(&mut Lss::new(node(5)), part(0x4C, 0)), None);
}

/// A master that knows nothing but the rules finds one of several slaves after the other.
#[test]
fn fastscan_finds_every_slave() {
    let other = Identity { serial: IDENTITY.serial ^ 1, ..IDENTITY };
    let third = Identity { vendor: 0x8000_0123, ..IDENTITY };
    let identities = [IDENTITY, other, third];
    let mut slaves = identities.map(|_| Lss::new(None));
    let mut found = Vec::new();
    for number in 1..=3 {
        let mut bus = |bytes: [u8; 8]| {
            let ask = |(slave, identity): (&mut Lss, Identity)| {
                slave.handle(&request(bytes), identity, &mut Firmware::default(), at(0)).is_some()
            };
            slaves.iter_mut().zip(identities).map(ask).filter(|answered| *answered).count()
        };
        assert_eq!(bus([0x51, 0, 0, 0, 0, 0x80, 0, 0]), 4 - number);
        let mut identity = [0u32; 4];
        for part in 0..4u8 {
            let value = &mut identity[usize::from(part)];
            for bit in (0..32u8).rev() {
                let [a, b, c, d] = value.to_le_bytes();
                if bus([0x51, a, b, c, d, bit, part, part]) == 0 {
                    *value |= 1 << bit;
                }
            }
            let [a, b, c, d] = value.to_le_bytes();
            assert!(bus([0x51, a, b, c, d, 0, part, (part + 1) % 4]) > 0, "the whole part is confirmed");
        }
        found.push(identity);
        let chosen: Vec<_> =
            slaves.iter_mut().filter(|slave| slave.state() == LssState::Configuration).collect();
        assert_eq!(chosen.len(), 1);
        for slave in chosen {
            let number = u8::try_from(number).expect("small");
            assert!(ask(slave, [0x11, number, 0, 0, 0, 0, 0, 0]).is_some());
            ask(slave, [4, 0, 0, 0, 0, 0, 0, 0]);
        }
    }
    found.sort_unstable();
    let mut expected = identities.map(Identity::parts);
    expected.sort_unstable();
    assert_eq!(found, expected);
}

#[test]
fn who_has_a_node_id_takes_no_part_in_fastscan() {
    assert_eq!(ask(&mut Lss::new(node(5)), [0x51, 0, 0, 0, 0, 0x80, 0, 0]), None);
}

#[test]
fn other_frames_are_none_of_its_business() {
    let mut lss = Lss::new(node(5));
    let mut handle = |frame: Option<Frame>| {
        lss.handle(&frame.expect("a frame"), IDENTITY, &mut Firmware::default(), at(0))
    };
    let id = CanId::new(REQUEST).expect("11 bits");
    assert_eq!(handle(Frame::data(id, &[4, 1, 0, 0, 0, 0, 0])), None);
    assert_eq!(handle(Frame::remote(id, 8)), None);
    assert_eq!(handle(Some(Frame::full(CanId::MAX, [4, 1, 0, 0, 0, 0, 0, 0]))), None);
    assert_eq!(lss.state(), LssState::Waiting);
    for command in 0..=255 {
        for parameter in [0, 1, 2, 255] {
            for mut lss in [Lss::new(None), configured(None), configured(node(1))] {
                ask(&mut lss, [command, parameter, parameter, 255, 0, 255, 255, 255]);
            }
        }
    }
}
