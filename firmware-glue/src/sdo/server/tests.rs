use super::{SdoServer, Transfer};
use crate::abort::AbortCode;
use crate::access::application::Application;
use crate::access::application::Entries;
use crate::access::dictionary::Dictionary;
use crate::access::table_dictionary::TableDictionary;
use crate::bus::clock::Instant;
use crate::bus::frame::{CanId, Frame};
use crate::bus::node_id::NodeId;
use crate::sdo::Channel;
use crate::table::{Attributes, Block, Directory, EntryRow, Flags, NONE, Parts, Place, Storage, Table};
use crate::value::data_type::DataType;

const RW: Flags = Flags::READ.with(Flags::WRITE);

const fn attributes(data_type: DataType, flags: Flags, place: Place, size: u16) -> Attributes {
    let (storage, limits, values, condition) = (Storage::No, NONE, NONE, NONE);
    Attributes { data_type, flags, place, storage, page: 0, size, limits, values, condition }
}

/// 2000h: UNSIGNED16; 2001h: OCTET_STRING of up to 20; 2002h: DOMAIN; 2003h: UNSIGNED8, read-only; 2004h: UNSIGNED64;
/// 2006h: UNSIGNED64, locked.
const ATTRIBUTES: [Attributes; 6] = [
    attributes(DataType::Unsigned16, RW, Place::Image, 2),
    attributes(DataType::OctetString, RW, Place::Image, 20),
    attributes(DataType::Domain, RW, Place::Application, 0),
    attributes(DataType::Unsigned8, Flags::READ, Place::Image, 1),
    attributes(DataType::Unsigned64, RW, Place::Image, 8),
    attributes(DataType::Unsigned64, RW.with(Flags::LOCKED), Place::Image, 8),
];
const FACTORY: [u8; 41] = {
    let mut bytes = [0; 41];
    bytes[0] = 0x19;
    bytes
};
const ENTRIES: [EntryRow; 6] = [
    EntryRow { attributes: 0, place: 0 },
    EntryRow { attributes: 1, place: 2 },
    EntryRow { attributes: 2, place: 0 },
    EntryRow { attributes: 3, place: 24 },
    EntryRow { attributes: 4, place: 25 },
    EntryRow { attributes: 5, place: 33 },
];

/// What an application has of the DOMAIN.
#[derive(Default)]
struct Program {
    bytes: [u8; 32],
    length: usize,
    complete: bool,
}

impl<D: Entries> Application<D> for Program {
    fn read_domain(
        &mut self,
        _: &mut D,
        _: D::Entry,
        offset: u32,
        buffer: &mut [u8],
    ) -> Result<usize, AbortCode> {
        let rest =
            self.bytes[..self.length].get(usize::try_from(offset).expect("small")..).unwrap_or_default();
        // Never more than three at a time: an application may give as little as it likes.
        let length = rest.len().min(buffer.len()).min(3);
        buffer[..length].copy_from_slice(&rest[..length]);
        Ok(length)
    }

    fn write_domain(
        &mut self,
        _: &mut D,
        _: D::Entry,
        offset: u32,
        data: &[u8],
        last: bool,
    ) -> Result<(), AbortCode> {
        let at = usize::try_from(offset).expect("small");
        self.bytes.get_mut(at..at + data.len()).ok_or(AbortCode::OUT_OF_MEMORY)?.copy_from_slice(data);
        (self.length, self.complete) = (at + data.len(), last);
        Ok(())
    }
}

/// Runs with a dictionary, an application and a server.
fn with_server(test: impl FnOnce(&mut Bench<'_, '_>)) {
    let (mut blocks, mut seeds, mut order) = ([Block::FREE; 6], [0; 6], [0; 6]);
    let indices = [0x2000, 0x2001, 0x2002, 0x2003, 0x2004, 0x2006];
    let directory = Directory::arrange(&indices, &mut blocks, &mut seeds, &mut order).expect("room");
    let parts = Parts {
        directory,
        objects: &[0, 1, 2, 3, 4, 5, 6],
        entries: &ENTRIES,
        attributes: &ATTRIBUTES,
        factory: &FACTORY,
        ..Parts::EMPTY
    };
    let table = Table::checked(parts).expect("right");
    let dictionary = TableDictionary::new(&table, [0; 41], 1).expect("as many bytes");
    let server = SdoServer::new(Channel::predefined(NodeId::new(5).expect("a node")), [0; 20]);
    test(&mut Bench { dictionary, program: Program::default(), server: &mut server.clone() });
}

struct Bench<'s, 't> {
    dictionary: TableDictionary<'t, [u8; 41]>,
    program: Program,
    server: &'s mut SdoServer<[u8; 20]>,
}

impl Bench<'_, '_> {
    fn at(&mut self, now: u64, request: [u8; 8]) -> Option<[u8; 8]> {
        let frame = Frame::full(CanId::new(0x605).expect("11 bits"), request);
        let answer =
            self.server.handle(&frame, &mut self.dictionary, &mut self.program, Instant::from_micros(now))?;
        assert_eq!(answer.id().get(), 0x585);
        answer.bytes()?.try_into().ok()
    }

    fn ask(&mut self, request: [u8; 8]) -> [u8; 8] {
        self.at(0, request).expect("an answer")
    }

    /// Asks for what is refused.
    fn refused(&mut self, request: [u8; 8]) -> AbortCode {
        let [command, _, _, _, code @ ..] = self.ask(request);
        assert_eq!(command, 0x80);
        assert!(matches!(self.server.transfer, Transfer::None), "an abort ends the transfer");
        AbortCode(u32::from_le_bytes(code))
    }

    fn poll(&mut self, now: u64) -> Option<[u8; 8]> {
        let now = Instant::from_micros(now);
        self.server.poll(&mut self.dictionary, &mut self.program, now)?.bytes()?.try_into().ok()
    }
}

#[test]
fn up_to_four_bytes_are_one_frame() {
    with_server(|bench| {
        assert_eq!(bench.ask([0x40, 0, 0x20, 0, 0, 0, 0, 0]), [0x4B, 0, 0x20, 0, 0x19, 0, 0, 0]);
        assert_eq!(bench.ask([0x2B, 0, 0x20, 0, 0x34, 0x12, 0, 0]), [0x60, 0, 0x20, 0, 0, 0, 0, 0]);
        assert_eq!(bench.ask([0x40, 0, 0x20, 0, 0, 0, 0, 0]), [0x4B, 0, 0x20, 0, 0x34, 0x12, 0, 0]);
        // Without a length, the type has it.
        assert_eq!(bench.ask([0x22, 0, 0x20, 0, 7, 0, 9, 9]), [0x60, 0, 0x20, 0, 0, 0, 0, 0]);
        assert_eq!(*bench.dictionary.read(0x2000, 0).expect("there"), [7, 0]);
        assert_eq!(bench.refused([0x22, 1, 0x20, 0, 7, 0, 9, 9]), AbortCode::LENGTH);
        assert_eq!(bench.refused([0x22, 4, 0x20, 0, 7, 0, 9, 9]), AbortCode::TOO_SHORT);
        assert_eq!(bench.refused([0x22, 3, 0x20, 0, 7, 0, 9, 9]), AbortCode::READ_ONLY);
    });
}

#[test]
fn what_the_dictionary_refuses_is_refused() {
    with_server(|bench| {
        assert_eq!(
            bench.ask([0x40, 5, 0x20, 9, 0, 0, 0, 0]),
            [0x80, 5, 0x20, 9, 0, 0, 2, 6],
            "the abort names the entry"
        );
        assert_eq!(bench.refused([0x40, 0, 0x20, 1, 0, 0, 0, 0]), AbortCode::NO_SUB_INDEX);
        assert_eq!(bench.refused([0x2F, 3, 0x20, 0, 1, 0, 0, 0]), AbortCode::READ_ONLY);
        assert_eq!(bench.refused([0x2F, 0, 0x20, 0, 1, 0, 0, 0]), AbortCode::TOO_SHORT);
        assert_eq!(bench.refused([0x23, 0, 0x20, 0, 1, 0, 0, 0]), AbortCode::TOO_LONG);
        // What is announced is refused before it comes.
        assert_eq!(bench.refused([0x21, 3, 0x20, 0, 1, 0, 0, 0]), AbortCode::READ_ONLY);
        assert_eq!(bench.refused([0x21, 4, 0x20, 0, 9, 0, 0, 0]), AbortCode::TOO_LONG);
        assert_eq!(bench.refused([0x21, 4, 0x20, 0, 7, 0, 0, 0]), AbortCode::TOO_SHORT);
        assert_eq!(bench.refused([0x21, 1, 0x20, 0, 21, 0, 0, 0]), AbortCode::TOO_LONG);
        assert_eq!(bench.refused([0xE0, 0, 0x20, 0, 0, 0, 0, 0]), AbortCode::COMMAND);
        assert_eq!(bench.refused([0x60, 0, 0, 0, 0, 0, 0, 0]), AbortCode::COMMAND);
        assert_eq!(bench.refused([0x00, 0, 0, 0, 0, 0, 0, 0]), AbortCode::COMMAND);
    });
}

#[test]
fn a_lock_is_asked_before_anything_comes() {
    with_server(|bench| {
        assert_eq!(bench.refused([0x21, 6, 0x20, 0, 8, 0, 0, 0]), AbortCode::DEVICE_STATE);
        assert_eq!(bench.refused([0x21, 6, 0x20, 0, 9, 0, 0, 0]), AbortCode::DEVICE_STATE, "however long");
        assert_eq!(bench.refused([0x20, 6, 0x20, 0, 0, 0, 0, 0]), AbortCode::DEVICE_STATE);
        #[cfg(feature = "sdo-block")]
        assert_eq!(bench.refused([0xC6, 6, 0x20, 0, 8, 0, 0, 0]), AbortCode::DEVICE_STATE);
    });
}

#[test]
fn longer_values_go_in_segments() {
    with_server(|bench| {
        assert_eq!(bench.ask([0x21, 1, 0x20, 0, 9, 0, 0, 0]), [0x60, 1, 0x20, 0, 0, 0, 0, 0]);
        assert_eq!(bench.ask([0x00, 1, 2, 3, 4, 5, 6, 7]), [0x20, 0, 0, 0, 0, 0, 0, 0]);
        assert!(
            bench.dictionary.read(0x2001, 0).expect("there").is_empty(),
            "nothing is written before the end"
        );
        assert_eq!(bench.ask([0x1B, 8, 9, 0, 0, 0, 0, 0]), [0x30, 0, 0, 0, 0, 0, 0, 0]);
        assert_eq!(*bench.dictionary.read(0x2001, 0).expect("there"), [1, 2, 3, 4, 5, 6, 7, 8, 9]);

        assert_eq!(bench.ask([0x40, 1, 0x20, 0, 0, 0, 0, 0]), [0x41, 1, 0x20, 0, 9, 0, 0, 0]);
        // A value that changes meanwhile is not mixed in.
        bench.dictionary.write(0x2001, 0, &[0xFF; 20], &mut ()).expect("writable");
        assert_eq!(bench.ask([0x60, 0, 0, 0, 0, 0, 0, 0]), [0x00, 1, 2, 3, 4, 5, 6, 7]);
        assert_eq!(bench.ask([0x70, 0, 0, 0, 0, 0, 0, 0]), [0x1B, 8, 9, 0, 0, 0, 0, 0]);
        assert!(!bench.server.is_busy());
    });
}

#[test]
fn an_empty_value_is_one_empty_segment() {
    with_server(|bench| {
        assert_eq!(bench.ask([0x40, 1, 0x20, 0, 0, 0, 0, 0]), [0x41, 1, 0x20, 0, 0, 0, 0, 0]);
        assert_eq!(bench.ask([0x60, 0, 0, 0, 0, 0, 0, 0]), [0x0F, 0, 0, 0, 0, 0, 0, 0]);
    });
}

#[test]
fn a_size_that_does_not_come_true_is_refused_and_nothing_is_written() {
    with_server(|bench| {
        bench.ask([0x21, 1, 0x20, 0, 9, 0, 0, 0]);
        assert_eq!(bench.refused([0x01, 1, 2, 3, 4, 5, 6, 7]), AbortCode::TOO_SHORT);
        bench.ask([0x21, 1, 0x20, 0, 6, 0, 0, 0]);
        assert_eq!(bench.refused([0x01, 1, 2, 3, 4, 5, 6, 7]), AbortCode::TOO_LONG);
        // Nor can what is announced by nothing be longer than the entry.
        bench.ask([0x20, 1, 0x20, 0, 0, 0, 0, 0]);
        bench.ask([0x00, 1, 2, 3, 4, 5, 6, 7]);
        bench.ask([0x10, 1, 2, 3, 4, 5, 6, 7]);
        assert_eq!(bench.refused([0x00, 1, 2, 3, 4, 5, 6, 7]), AbortCode::TOO_LONG);
        assert!(bench.dictionary.read(0x2001, 0).expect("there").is_empty());
    });
}

#[test]
fn the_toggle_bit_alternates() {
    with_server(|bench| {
        bench.ask([0x21, 1, 0x20, 0, 9, 0, 0, 0]);
        assert_eq!(bench.refused([0x10, 1, 2, 3, 4, 5, 6, 7]), AbortCode::TOGGLE_BIT);
        bench.ask([0x40, 1, 0x20, 0, 0, 0, 0, 0]);
        assert_eq!(bench.ask([0x70, 0, 0, 0, 0, 0, 0, 0]), [0x80, 1, 0x20, 0, 0, 0, 3, 5]);
    });
}

#[test]
fn a_silent_client_is_told_once_that_it_took_too_long() {
    with_server(|bench| {
        // Later than 32 bits of microseconds can say.
        let begin = u64::from(u32::MAX) + 10;
        assert_eq!(bench.at(begin, [0x21, 1, 0x20, 0, 9, 0, 0, 0]), Some([0x60, 1, 0x20, 0, 0, 0, 0, 0]));
        let late = Instant::from_micros(begin + 1_000_000);
        assert_eq!((bench.server.next_deadline(), bench.poll(begin + 999_999)), (Some(late), None));
        assert_eq!(bench.poll(begin + 1_000_000), Some([0x80, 1, 0x20, 0, 0, 0, 4, 5]));
        assert_eq!((bench.server.next_deadline(), bench.poll(begin + 3_000_000)), (None, None));
        // However long it is, it has passed once.
        bench.at(begin, [0x21, 1, 0x20, 0, 9, 0, 0, 0]);
        assert_eq!(bench.poll(begin + (1 << 32) + 10), Some([0x80, 1, 0x20, 0, 0, 0, 4, 5]));
    });
}

#[test]
fn a_client_can_give_up() {
    with_server(|bench| {
        bench.ask([0x21, 1, 0x20, 0, 9, 0, 0, 0]);
        assert_eq!(bench.at(0, [0x80, 1, 0x20, 0, 0, 0, 0, 8]), None);
        assert_eq!(bench.refused([0x00, 1, 2, 3, 4, 5, 6, 7]), AbortCode::COMMAND);
    });
}

#[test]
fn other_frames_are_not_the_servers_business() {
    with_server(|bench| {
        let id = CanId::new(0x605).expect("11 bits");
        let frames = [
            Frame::full(CanId::new(0x604).expect("11 bits"), [0x40, 0, 0x20, 0, 0, 0, 0, 0]),
            Frame::data(id, &[0x40, 0, 0x20, 0, 0, 0, 0]).expect("seven bytes"),
            Frame::remote(id, 8).expect("eight bytes"),
        ];
        for frame in frames {
            assert_eq!(
                bench.server.handle(&frame, &mut bench.dictionary, &mut bench.program, Instant::ZERO),
                None
            );
        }
    });
}

#[test]
fn a_domain_goes_to_the_application_and_comes_from_it() {
    with_server(|bench| {
        assert_eq!(bench.ask([0x20, 2, 0x20, 0, 0, 0, 0, 0]), [0x60, 2, 0x20, 0, 0, 0, 0, 0]);
        bench.ask([0x00, 1, 2, 3, 4, 5, 6, 7]);
        assert!(!bench.program.complete);
        bench.ask([0x11, 8, 9, 10, 11, 12, 13, 14]);
        assert!(bench.program.complete);
        assert_eq!(bench.ask([0x40, 2, 0x20, 0, 0, 0, 0, 0]), [0x40, 2, 0x20, 0, 0, 0, 0, 0]);
        assert_eq!(bench.ask([0x60, 0, 0, 0, 0, 0, 0, 0]), [0x00, 1, 2, 3, 4, 5, 6, 7]);
        // The last one is known, though it is full.
        assert_eq!(bench.ask([0x70, 0, 0, 0, 0, 0, 0, 0]), [0x11, 8, 9, 10, 11, 12, 13, 14]);
        assert_eq!(bench.ask([0x2B, 2, 0x20, 0, 21, 22, 0, 0]), [0x60, 2, 0x20, 0, 0, 0, 0, 0]);
        assert_eq!((bench.program.length, bench.program.bytes[0], bench.program.complete), (2, 21, true));
    });
}

#[test]
fn a_buffer_that_is_too_small_is_told() {
    with_server(|bench| {
        let channel = bench.server.channel();
        let mut small = SdoServer::new(channel, [0; 7]);
        let mut ask = |bytes| {
            let frame = Frame::full(channel.request, bytes);
            let answer =
                small.handle(&frame, &mut bench.dictionary, &mut (), Instant::ZERO).expect("an answer");
            let [command, _, _, _, code @ ..]: [u8; 8] = answer.bytes()?.try_into().ok()?;
            (command == 0x80).then_some(AbortCode(u32::from_le_bytes(code)))
        };
        assert_eq!(ask([0x40, 4, 0x20, 0, 0, 0, 0, 0]), Some(AbortCode::OUT_OF_MEMORY));
        assert_eq!(ask([0x21, 4, 0x20, 0, 8, 0, 0, 0]), Some(AbortCode::OUT_OF_MEMORY));
        assert_eq!(ask([0x20, 4, 0x20, 0, 0, 0, 0, 0]), None);
        assert_eq!(ask([0x00, 0, 0, 0, 0, 0, 0, 0]), None);
        assert_eq!(ask([0x1D, 0, 0, 0, 0, 0, 0, 0]), Some(AbortCode::OUT_OF_MEMORY));
    });
}

#[cfg(feature = "sdo-block")]
mod block {
    use super::*;

    /// Writes 9 bytes into 2001h in one block, with an end of the test's choice.
    fn download(bench: &mut Bench<'_, '_>, end: [u8; 8]) -> [u8; 8] {
        assert_eq!(bench.ask([0xC6, 1, 0x20, 0, 9, 0, 0, 0]), [0xA4, 1, 0x20, 0, 127, 0, 0, 0]);
        assert_eq!(bench.at(0, [0x01, b'1', b'2', b'3', b'4', b'5', b'6', b'7']), None);
        assert_eq!(bench.ask([0x82, b'8', b'9', 0, 0, 0, 0, 0]), [0xA2, 2, 127, 0, 0, 0, 0, 0]);
        bench.ask(end)
    }

    #[test]
    fn a_download_has_a_checksum() {
        with_server(|bench| {
            assert_eq!(download(bench, [0xD5, 0xC3, 0x31, 0, 0, 0, 0, 0]), [0xA1, 0, 0, 0, 0, 0, 0, 0]);
            assert_eq!(*bench.dictionary.read(0x2001, 0).expect("there"), *b"123456789");
            bench.dictionary.write(0x2001, 0, &[], &mut ()).expect("writable");
            assert_eq!(download(bench, [0xD5, 0xC3, 0x30, 0, 0, 0, 0, 0]), [0x80, 1, 0x20, 0, 4, 0, 4, 5]);
            assert!(bench.dictionary.read(0x2001, 0).expect("there").is_empty());
        });
    }

    #[test]
    fn a_checksum_that_was_not_agreed_upon_is_not_looked_at() {
        with_server(|bench| {
            bench.ask([0xC0, 1, 0x20, 0, 0, 0, 0, 0]);
            bench.ask([0x81, 1, 2, 3, 4, 5, 6, 7]);
            assert_eq!(bench.ask([0xC1, 0, 0, 0, 0, 0, 0, 0]), [0xA1, 0, 0, 0, 0, 0, 0, 0]);
            assert_eq!(*bench.dictionary.read(0x2001, 0).expect("there"), [1, 2, 3, 4, 5, 6, 7]);
        });
    }

    #[test]
    fn an_upload_comes_in_blocks_and_what_is_lost_comes_again() {
        with_server(|bench| {
            bench.dictionary.write(0x2001, 0, b"123456789", &mut ()).expect("writable");
            assert_eq!(bench.ask([0xA4, 1, 0x20, 0, 2, 0, 0, 0]), [0xC6, 1, 0x20, 0, 9, 0, 0, 0]);
            assert_eq!(bench.poll(0), None, "the client has not begun");
            assert_eq!(bench.server.next_deadline(), Some(Instant::from_millis(1000)));
            let first = [0x01, b'1', b'2', b'3', b'4', b'5', b'6', b'7'];
            assert_eq!(bench.ask([0xA3, 0, 0, 0, 0, 0, 0, 0]), first);
            assert_eq!(bench.server.next_deadline(), Some(Instant::ZERO), "there is more of the block");
            assert_eq!(bench.poll(0), Some([0x82, b'8', b'9', 0, 0, 0, 0, 0]));
            assert_eq!(bench.server.next_deadline(), Some(Instant::from_millis(1000)));
            assert_eq!(bench.poll(0), None);
            assert_eq!(bench.ask([0xA2, 0, 1, 0, 0, 0, 0, 0]), first);
            assert_eq!(bench.poll(0), None, "a block of one");
            assert_eq!(bench.ask([0xA2, 1, 1, 0, 0, 0, 0, 0]), [0x81, b'8', b'9', 0, 0, 0, 0, 0]);
            assert_eq!(bench.ask([0xA2, 1, 1, 0, 0, 0, 0, 0]), [0xD5, 0xC3, 0x31, 0, 0, 0, 0, 0]);
            assert_eq!(bench.at(0, [0xA1, 0, 0, 0, 0, 0, 0, 0]), None);
            assert!(!bench.server.is_busy());
        });
    }

    #[test]
    fn short_data_may_come_the_other_way_if_the_client_says_so() {
        with_server(|bench| {
            assert_eq!(bench.ask([0xA4, 0, 0x20, 0, 2, 2, 0, 0]), [0x4B, 0, 0x20, 0, 0x19, 0, 0, 0]);
            assert_eq!(bench.ask([0xA4, 0, 0x20, 0, 2, 1, 0, 0]), [0xC6, 0, 0x20, 0, 2, 0, 0, 0]);
        });
    }

    #[test]
    fn numbers_out_of_range_are_refused() {
        with_server(|bench| {
            assert_eq!(bench.refused([0xA4, 0, 0x20, 0, 0, 0, 0, 0]), AbortCode::BLOCK_SIZE);
            assert_eq!(bench.refused([0xA4, 0, 0x20, 0, 128, 0, 0, 0]), AbortCode::BLOCK_SIZE);
            bench.ask([0xA4, 0, 0x20, 0, 2, 0, 0, 0]);
            bench.ask([0xA3, 0, 0, 0, 0, 0, 0, 0]);
            assert_eq!(bench.refused([0xA2, 2, 2, 0, 0, 0, 0, 0]), AbortCode::SEQUENCE);
            bench.ask([0xC6, 1, 0x20, 0, 9, 0, 0, 0]);
            assert_eq!(bench.refused([0x00, 0, 0, 0, 0, 0, 0, 0]), AbortCode::SEQUENCE);
        });
    }
}

#[test]
fn a_channel_stands_in_the_dictionary() {
    let channel = NodeId::new(127).map(Channel::predefined).expect("a node");
    assert_eq!((channel.request.get(), channel.answer.get()), (0x67F, 0x5FF));
    with_server(|bench| assert_eq!(Channel::of_server(&bench.dictionary, 0), None));
}
