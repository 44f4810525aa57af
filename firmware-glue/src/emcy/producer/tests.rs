extern crate std;

use std::vec::Vec;

use super::*;
use crate::abort::AbortCode;
use crate::access::test_table::{TestDictionary, dictionary, value};

fn device() -> TestDictionary {
    dictionary(&[
        value(0x1001, 0, 1, 0),
        value(0x1003, 0, 1, 0),
        value(0x1003, 1, 4, 0),
        value(0x1003, 2, 4, 0),
        value(0x1003, 3, 4, 0),
        value(0x1014, 0, 4, 0x85),
        value(0x1015, 0, 2, 100),
    ])
}

fn at(millis: u64) -> Instant {
    Instant::from_millis(millis)
}

fn sent<const N: usize>(
    producer: &mut EmergencyProducer<N>,
    device: &TestDictionary,
    now: u64,
) -> Option<[u8; 8]> {
    let frame = producer.poll(device, at(now))?;
    assert_eq!(frame.id().get(), 0x85);
    frame.bytes().and_then(|bytes| <[u8; 8]>::try_from(bytes).ok())
}

fn read(device: &TestDictionary, index: u16, sub: u8) -> Result<u32, AbortCode> {
    let value = device.read(index, sub)?;
    Ok(value.iter().rev().fold(0, |number, byte| number << 8 | u32::from(*byte)))
}

#[test]
fn an_error_is_told_remembered_and_reset() {
    let (mut device, mut producer) = (device(), EmergencyProducer::<4>::new());
    let hot = Emergency::new(0x4210).with_details([1, 2, 3, 4, 5]);
    assert_eq!(producer.raise(&mut device, hot), Raised::New);
    assert_eq!(producer.raise(&mut device, hot), Raised::Present);
    assert_eq!(sent(&mut producer, &device, 0), Some([0x10, 0x42, 0x09, 1, 2, 3, 4, 5]));
    assert_eq!(producer.raise(&mut device, Emergency::new(0x3210)), Raised::New);
    assert_eq!((read(&device, 0x1001, 0), read(&device, 0x1003, 0)), (Ok(0x0D), Ok(2)));
    assert_eq!((read(&device, 0x1003, 1), read(&device, 0x1003, 2)), (Ok(0x3210), Ok(0x0201_4210)));
    assert_eq!(read(&device, 0x1003, 3), Err(AbortCode::NO_DATA));
    assert!(producer.clear(&mut device, 0x4210));
    assert!(!producer.clear(&mut device, 0x4210));
    assert_eq!(read(&device, 0x1001, 0), Ok(0x05));
    assert!(producer.clear(&mut device, 0x3210));
    assert_eq!(read(&device, 0x1001, 0), Ok(0));
    let rest: Vec<_> = (1..10).filter_map(|turn| sent(&mut producer, &device, turn * 10)).collect();
    assert_eq!(rest, [[0x10, 0x32, 0x0D, 0, 0, 0, 0, 0], [0, 0, 0x05, 0, 0, 0, 0, 0], [0; 8]]);
    assert_eq!(read(&device, 0x1003, 0), Ok(2), "the history keeps what is gone");
}

#[test]
fn the_inhibit_time_lies_between_messages() {
    let (mut device, mut producer) = (device(), EmergencyProducer::<4>::new());
    producer.raise(&mut device, Emergency::new(0x1000));
    producer.clear(&mut device, 0x1000);
    assert!(sent(&mut producer, &device, 5).is_some());
    assert_eq!(producer.next_deadline(&device), Some(at(15)));
    assert_eq!(sent(&mut producer, &device, 14), None);
    assert!(sent(&mut producer, &device, 15).is_some());
    assert_eq!(producer.next_deadline(&device), None);
    producer.raise(&mut device, Emergency::new(0x1000));
    set(&mut device, 0x1015, 0, 0);
    assert!(sent(&mut producer, &device, 15).is_some());
}

#[test]
fn the_history_is_cleared_by_writing_0_and_holds_the_newest() {
    let (mut device, mut producer) = (device(), EmergencyProducer::<8>::new());
    for code in 0x1001..0x1006 {
        producer.raise(&mut device, Emergency::new(code));
    }
    let history = |device: &TestDictionary| [0, 1, 2, 3].map(|sub| read(device, 0x1003, sub));
    assert_eq!(history(&device), [Ok(3), Ok(0x1005), Ok(0x1004), Ok(0x1003)]);
    assert_eq!(device.write(0x1003, 0, &[1], &mut ()), Err(AbortCode::INVALID_VALUE));
    device.write(0x1003, 0, &[0], &mut ()).expect("0 clears");
    let empty = Err(AbortCode::NO_DATA);
    assert_eq!(history(&device), [Ok(0), empty, empty, empty]);
    producer.raise(&mut device, Emergency::new(0x2000));
    assert_eq!(history(&device), [Ok(1), Ok(0x2000), empty, empty]);
}

#[test]
fn without_an_identifier_messages_wait() {
    let (mut device, mut producer) = (device(), EmergencyProducer::<2>::new());
    set(&mut device, 0x1014, 0, 0x8000_0085);
    producer.raise(&mut device, Emergency::new(0x1000));
    assert_eq!((sent(&mut producer, &device, 0), producer.next_deadline(&device)), (None, None));
    set(&mut device, 0x1014, 0, 0x85);
    assert!(sent(&mut producer, &device, 0).is_some());
}

#[test]
fn more_errors_than_there_is_room_for_stay_in_the_register() {
    let (mut device, mut producer) = (device(), EmergencyProducer::<2>::new());
    set(&mut device, 0x1015, 0, 0);
    assert_eq!(producer.raise(&mut device, Emergency::new(0x2000)), Raised::New);
    assert_eq!(producer.raise(&mut device, Emergency::new(0x3000)), Raised::New);
    assert_eq!(producer.raise(&mut device, Emergency::new(0x4000)), Raised::NotKept);
    assert_eq!((producer.dropped(), producer.register().bits()), (1, 0x0F));
    assert_eq!(sent(&mut producer, &device, 0).map(|bytes| bytes[1]), Some(0x30), "the oldest was dropped");
    assert_eq!(
        sent(&mut producer, &device, 0).map(|bytes| bytes[..3].to_vec()),
        Some([0, 0x40, 0x0F].to_vec())
    );
    producer.clear(&mut device, 0x2000);
    assert_eq!(producer.register().bits(), 0x0D);
    producer.clear(&mut device, 0x3000);
    assert_eq!(producer.register().bits(), 0x09, "whether 4000h is gone, is unknown");
    assert!(!producer.clear(&mut device, 0x4000));
    assert!(producer.clear_all(&mut device));
    assert_eq!((producer.register(), read(&device, 0x1001, 0)), (ErrorRegister::NONE, Ok(0)));
}

#[test]
fn a_device_without_the_objects_tells_nothing_and_breaks_nothing() {
    let mut device = dictionary(&[value(0x1000, 0, 4, 0)]);
    let mut none = EmergencyProducer::<0>::new();
    assert_eq!(none.raise(&mut device, Emergency::new(0x1000)), Raised::NotKept);
    assert!(none.poll(&device, at(1)).is_none());
    assert!(none.clear_all(&mut device));
    assert!(!none.clear_all(&mut device));
}

#[test]
fn classes_of_codes_have_their_bits() {
    for code in 0..=u16::MAX {
        let bits = ErrorRegister::of_code(code).bits();
        assert_eq!(bits & 1 == 0, code < 0x0100, "{code:04X}h");
        assert_eq!(bits & 1 << 6, 0);
    }
    let of = |code| ErrorRegister::of_code(code).bits();
    assert_eq!([0x2310, 0x3220, 0x4310, 0x8130, 0x8611, 0xFF01, 0x5530].map(of), [3, 5, 9, 0x11, 1, 0x81, 1]);
}

#[test]
fn a_consumer_reads_what_a_producer_sends() {
    let (mut device, mut producer) = (device(), EmergencyProducer::<2>::new());
    let emergency = Emergency::new(0x5530).with_details([9, 8, 7, 6, 5]);
    producer.raise(&mut device, emergency);
    let frame = producer.poll(&device, at(0)).expect("a message");
    assert_eq!(Emergency::from_frame(&frame), Some(emergency));
    assert_eq!(Emergency::from_frame(&Frame::data(frame.id(), &[0; 7]).expect("seven bytes")), None);
}
