//! The SDO client of firmware-glue, answered frame by frame.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use firmware_glue::clock::{Duration, Instant};
use firmware_glue::frame::Frame;
use firmware_glue::sdo::{Channel, Failure, Filled, SdoClient, Step, Way};
use firmware_glue::{AbortCode, EntryId, NodeId};

const TEXT: EntryId = EntryId { index: 0x2000, sub: 0 };
/// When a transfer begins: later than 32 bits of microseconds can say.
const BEGIN: Instant = Instant::from_micros(1 << 33);

fn channel() -> Channel {
    Channel::predefined(NodeId::new(5).unwrap())
}

fn client(way: Way, block_size: u8) -> SdoClient {
    SdoClient { way, block_size, ..SdoClient::new(channel()) }
}

#[test]
fn a_server_that_says_nothing_is_given_up() {
    let (mut writing, _) = client(Way::Blocks, 127).start_write(TEXT, &[1; 9][..], BEGIN).unwrap();
    assert_eq!(writing.poll(BEGIN + Duration::from_micros(999_999)), Step { send: None, outcome: None });
    let step = writing.poll(BEGIN + Duration::from_millis(1000));
    assert_eq!(step.outcome, Some(Err(Failure::Client(AbortCode::TIMEOUT))));
    assert_eq!(step.send.unwrap().bytes(), Some(&[0x80, 0x00, 0x20, 0, 0, 0, 4, 5][..]));
}

#[test]
fn what_a_server_cannot_do_in_blocks_is_done_in_segments() {
    let channel = channel();
    let hear = |bytes| Frame::full(channel.answer, bytes);
    let sent = |step: Step| step.send.unwrap().bytes().unwrap().to_vec();
    // It does not know them.
    let (mut writing, _) = client(Way::Blocks, 127).start_write(TEXT, &[1; 9][..], BEGIN).unwrap();
    let step = writing.handle(&hear([0x80, 0, 0x20, 0, 1, 0, 4, 5]), BEGIN);
    assert_eq!(sent(step), [0x21, 0, 0x20, 0, 9, 0, 0, 0]);
    // It knows them without checksums.
    let (mut writing, _) = client(Way::Blocks, 127).start_write(TEXT, &[1; 9][..], BEGIN).unwrap();
    let step = writing.handle(&hear([0xA0, 0, 0x20, 0, 127, 0, 0, 0]), BEGIN);
    assert_eq!(sent(step)[0], 0x80);
    assert_eq!(sent(writing.poll(BEGIN)), [0x21, 0, 0x20, 0, 9, 0, 0, 0]);
    let mut buffer = [0; 9];
    let (mut reading, _) = client(Way::Blocks, 127).start_read(TEXT, Filled::new(&mut buffer), BEGIN);
    let step = reading.handle(&hear([0xC2, 0, 0x20, 0, 9, 0, 0, 0]), BEGIN);
    assert_eq!(sent(step)[0], 0x80);
    assert_eq!(sent(reading.poll(BEGIN)), [0x40, 0, 0x20, 0, 0, 0, 0, 0]);
    // An entry that is not there is not asked for again.
    let (mut writing, _) = client(Way::Blocks, 127).start_write(TEXT, &[1; 9][..], BEGIN).unwrap();
    let step = writing.handle(&hear([0x80, 0, 0x20, 0, 0, 0, 2, 6]), BEGIN);
    assert_eq!(step, Step { send: None, outcome: Some(Err(Failure::Server(AbortCode::NO_OBJECT))) });
}

#[test]
fn an_abort_of_another_transfer_is_none_of_this_one() {
    let hear = |bytes| Frame::full(channel().answer, bytes);
    let nothing = Step { send: None, outcome: None };
    let failed = |code| Step { send: None, outcome: Some(Err(Failure::Server(code))) };
    // The answer to one that was given up comes late: it names its entry.
    let late = hear([0x80, 9, 0x30, 0, 0, 0, 4, 5]);
    for way in [Way::Segments, Way::Blocks] {
        let mut buffer = [0; 20];
        let (mut reading, _) = client(way, 127).start_read(TEXT, Filled::new(&mut buffer), BEGIN);
        assert_eq!(reading.handle(&late, BEGIN), nothing);
        if way == Way::Blocks {
            // Also between segments of a block.
            assert!(reading.handle(&hear([0xC6, 0, 0x20, 0, 20, 0, 0, 0]), BEGIN).send.is_some());
            assert_eq!(reading.handle(&late, BEGIN), nothing);
            assert_eq!(reading.handle(&hear([1, 1, 2, 3, 4, 5, 6, 7]), BEGIN), nothing);
        }
        // A server that knows of no transfer names none.
        let unknown = hear([0x80, 0, 0, 0, 1, 0, 4, 5]);
        let step = reading.handle(&unknown, BEGIN);
        if way == Way::Segments {
            assert_eq!(step, failed(AbortCode::COMMAND));
        }
    }
    let (mut writing, _) = client(Way::Segments, 127).start_write(TEXT, &[1; 9][..], BEGIN).unwrap();
    assert_eq!(writing.handle(&late, BEGIN), nothing);
    let ours = hear([0x80, 0, 0x20, 0, 2, 0, 1, 6]);
    assert_eq!(writing.handle(&ours, BEGIN), failed(AbortCode::READ_ONLY));
}

#[test]
fn a_transfer_says_when_it_wants_to_be_asked() {
    let hear = |bytes| Frame::full(channel().answer, bytes);
    let (late, soon) = (BEGIN + Duration::from_millis(1000), BEGIN + Duration::from_millis(1));
    let (mut writing, _) = client(Way::Blocks, 127).start_write(TEXT, &[1; 9][..], BEGIN).unwrap();
    assert_eq!(writing.next_deadline(), Some(late));
    assert!(writing.handle(&hear([0xA4, 0, 0x20, 0, 127, 0, 0, 0]), soon).send.is_some());
    assert_eq!(writing.next_deadline(), Some(Instant::ZERO), "there is another segment");
    assert!(writing.poll(soon).send.is_some());
    assert_eq!(writing.next_deadline(), Some(soon + Duration::from_millis(1000)));
    writing.cancel(AbortCode::GENERAL);
    assert_eq!(writing.next_deadline(), None);
    let mut buffer = [0; 9];
    let (mut reading, _) = client(Way::Blocks, 127).start_read(TEXT, Filled::new(&mut buffer), BEGIN);
    assert_eq!(reading.next_deadline(), Some(late));
    assert!(reading.handle(&hear([0xC2, 0, 0x20, 0, 9, 0, 0, 0]), BEGIN).send.is_some());
    assert_eq!(reading.next_deadline(), Some(Instant::ZERO), "it asks again, for segments");
}
