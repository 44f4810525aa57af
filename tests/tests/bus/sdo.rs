//! The SDO client and server of firmware-glue against each other, over a bus that loses, doubles and swaps frames.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::VecDeque;

use firmware_glue::clock::{Duration, Instant};
use firmware_glue::frame::Frame;
use firmware_glue::sdo::{Channel, Failure, Filled, SdoClient, SdoRead, SdoServer, SdoWrite, Step, Way};
use firmware_glue::table::{Attributes, Block, Directory, EntryRow, Flags, NONE, Parts, Place};
use firmware_glue::{
    AbortCode, Application, DataType, Dictionary, Entries, EntryId, NodeId, Storage, Table, TableDictionary,
};
use proptest::prelude::*;

const LARGEST: u16 = 2000;
const TEXT: EntryId = EntryId { index: 0x2000, sub: 0 };
const DOMAIN: EntryId = EntryId { index: 0x2001, sub: 0 };
const NUMBER: EntryId = EntryId { index: 0x2002, sub: 0 };
/// When a transfer begins: later than 32 bits of microseconds can say.
const BEGIN: Instant = Instant::from_micros(1 << 33);
/// Length and bytes of the string, and four bytes of the number.
const VALUES: usize = 2 + 2000 + 4;

const fn attributes(data_type: DataType, place: Place, size: u16) -> Attributes {
    let (storage, limits, values, condition) = (Storage::No, NONE, NONE, NONE);
    let flags = Flags::READ.with(Flags::WRITE);
    Attributes { data_type, flags, place, storage, page: 0, size, limits, values, condition }
}

const ATTRIBUTES: [Attributes; 3] = [
    attributes(DataType::OctetString, Place::Image, LARGEST),
    attributes(DataType::Domain, Place::Application, 0),
    attributes(DataType::Unsigned32, Place::Image, 4),
];
const ENTRIES: [EntryRow; 3] = [
    EntryRow { attributes: 0, place: 0 },
    EntryRow { attributes: 1, place: 0 },
    EntryRow { attributes: 2, place: 2002 },
];

fn channel() -> Channel {
    Channel::predefined(NodeId::new(5).unwrap())
}

/// An application with one DOMAIN, which it takes over when it is complete.
#[derive(Default)]
struct Program {
    coming: Vec<u8>,
    complete: Vec<u8>,
}

impl<D: Entries> Application<D> for Program {
    fn read_domain(
        &mut self,
        _: &mut D,
        _: D::Entry,
        offset: u32,
        buffer: &mut [u8],
    ) -> Result<usize, AbortCode> {
        let rest = self.complete.get(usize::try_from(offset).unwrap()..).unwrap_or_default();
        let length = rest.len().min(buffer.len());
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
        self.coming.truncate(usize::try_from(offset).unwrap());
        assert_eq!(self.coming.len(), usize::try_from(offset).unwrap(), "pieces come without gaps");
        if self.coming.len() + data.len() > 3000 {
            return Err(AbortCode::OUT_OF_MEMORY);
        }
        self.coming.extend_from_slice(data);
        if last {
            self.complete = std::mem::take(&mut self.coming);
        }
        Ok(())
    }
}

/// What happens to a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Fate {
    Arrives,
    Lost,
    Doubled,
    /// Comes after the next one.
    Swapped,
}

/// Fates of frames, by their number, in either direction.
type Fates = Vec<(u16, Fate)>;

/// A bus in one direction.
struct Bus<'f> {
    fates: &'f [(u16, Fate)],
    sent: u16,
    waiting: Option<Frame>,
    frames: VecDeque<Frame>,
}

impl<'f> Bus<'f> {
    fn new(fates: &'f [(u16, Fate)]) -> Self {
        Self { fates, sent: 0, waiting: None, frames: VecDeque::new() }
    }

    fn send(&mut self, frame: Frame) {
        let fate = self.fates.iter().find(|(number, _)| *number == self.sent);
        self.sent = self.sent.wrapping_add(1);
        match fate.map_or(Fate::Arrives, |(_, fate)| *fate) {
            Fate::Arrives => self.frames.push_back(frame),
            Fate::Lost => {}
            Fate::Doubled => self.frames.extend([frame, frame]),
            Fate::Swapped => {
                self.waiting = Some(frame);
                return;
            }
        }
        self.frames.extend(self.waiting.take());
    }
}

/// A transfer of the client, of either kind.
trait Transfer {
    fn handle(&mut self, frame: &Frame, now: Instant) -> Step;
    fn poll(&mut self, now: Instant) -> Step;
}

impl Transfer for SdoRead<Filled<'_>> {
    fn handle(&mut self, frame: &Frame, now: Instant) -> Step {
        Self::handle(self, frame, now)
    }
    fn poll(&mut self, now: Instant) -> Step {
        Self::poll(self, now)
    }
}

impl Transfer for SdoWrite<&[u8]> {
    fn handle(&mut self, frame: &Frame, now: Instant) -> Step {
        Self::handle(self, frame, now)
    }
    fn poll(&mut self, now: Instant) -> Step {
        Self::poll(self, now)
    }
}

type Outcome = Result<u32, Failure>;

/// A node.
struct Node<'t> {
    dictionary: TableDictionary<'t, Vec<u8>>,
    program: Program,
    server: SdoServer<Vec<u8>>,
}

impl Node<'_> {
    /// Runs a transfer to its end, over a bus on which some frames have fates of their own; how it ends.
    fn run(&mut self, transfer: &mut impl Transfer, request: Frame, fates: [&Fates; 2]) -> Outcome {
        let [mut there, mut back] = fates.map(|fates| Bus::new(fates));
        let mut now = BEGIN;
        let mut outcome = None;
        there.send(request);
        for _ in 0..20_000 {
            now = now + Duration::from_millis(1);
            if let Some(frame) = there.frames.pop_front() {
                let answer = self.server.handle(&frame, &mut self.dictionary, &mut self.program, now);
                if let Some(frame) = answer {
                    back.send(frame);
                }
            }
            if let Some(frame) = self.server.poll(&mut self.dictionary, &mut self.program, now) {
                back.send(frame);
            }
            let heard = back
                .frames
                .pop_front()
                .map_or(Step { send: None, outcome: None }, |frame| transfer.handle(&frame, now));
            let polled = transfer.poll(now);
            for step in [heard, polled] {
                if let Some(frame) = step.send {
                    there.send(frame);
                }
                outcome = outcome.or(step.outcome);
            }
            let idle = there.frames.is_empty() && back.frames.is_empty();
            if let (Some(outcome), true, false) = (outcome, idle, self.server.is_busy()) {
                return outcome;
            }
        }
        panic!("the transfer does not end");
    }
}

fn with_node<R>(test: impl FnOnce(&mut Node<'_>) -> R) -> R {
    let (mut blocks, mut seeds, mut order) = ([Block::FREE; 3], [0; 3], [0; 3]);
    let directory =
        Directory::arrange(&[0x2000, 0x2001, 0x2002], &mut blocks, &mut seeds, &mut order).unwrap();
    let factory = [0; VALUES];
    let parts = Parts {
        directory,
        objects: &[0, 1, 2, 3],
        entries: &ENTRIES,
        attributes: &ATTRIBUTES,
        factory: &factory,
        ..Parts::EMPTY
    };
    let table = Table::checked(parts).unwrap();
    let dictionary = TableDictionary::new(&table, vec![0; VALUES], 1).unwrap();
    let server = SdoServer::new(channel(), vec![0; usize::from(LARGEST)]);
    test(&mut Node { dictionary, program: Program::default(), server })
}

fn client(way: Way, block_size: u8) -> SdoClient {
    SdoClient { way, block_size, ..SdoClient::new(channel()) }
}

/// Bytes that differ by place and by seed, so that a mixture is seen.
fn data(length: usize, seed: u8) -> Vec<u8> {
    (0..length).map(|at| u8::try_from(at * 7 % 251).unwrap().wrapping_add(seed)).collect()
}

fn value(node: &Node<'_>, id: EntryId) -> Vec<u8> {
    if id == DOMAIN {
        return node.program.complete.clone();
    }
    node.dictionary.read(id.index, id.sub).unwrap().to_vec()
}

fn set(node: &mut Node<'_>, id: EntryId, bytes: &[u8]) {
    if id == DOMAIN {
        node.program.complete = bytes.to_vec();
    } else {
        node.dictionary.write(id.index, id.sub, bytes, &mut ()).unwrap();
    }
}

/// An OCTET_STRING keeps no zeros at its end.
fn kept(id: EntryId, bytes: &[u8]) -> bool {
    id == DOMAIN || bytes.last() != Some(&0)
}

/// Writes new data over old ones, and reads: what is there afterwards is the one or the other, and what is read is what is there.
fn write_and_read(node: &mut Node<'_>, id: EntryId, client: SdoClient, new: &[u8], fates: [&Fates; 4]) {
    let [there, back, there_again, back_again] = fates;
    let old = value(node, id);
    let (mut writing, request) = client.start_write(id, new, BEGIN).unwrap();
    let written = node.run(&mut writing, request, [there, back]);
    let held = value(node, id);
    match written {
        Ok(length) => assert_eq!((usize::try_from(length).unwrap(), &held[..]), (new.len(), new)),
        // The last answer may be what was lost.
        Err(_) => assert!(held == old || held == new, "neither the old value nor the new one"),
    }
    if [there, back].iter().all(|fates| fates.is_empty()) {
        written.unwrap();
    }
    let mut buffer = [0; 3000];
    let (mut reading, request) = client.start_read(id, Filled::new(&mut buffer), BEGIN);
    let read = node.run(&mut reading, request, [there_again, back_again]);
    if read.is_ok() {
        assert_eq!(reading.sink().bytes(), held);
    }
    if [there_again, back_again].iter().all(|fates| fates.is_empty()) {
        read.unwrap();
    }
}

#[test]
fn every_size_goes_over_on_every_way() {
    let (none, mut done) = (Fates::new(), 0);
    // Of the longer ones each fifth: segments of seven bytes end everywhere all the same.
    let is_tried = |length: usize| od_tests::is_long() || length < 130 || length.is_multiple_of(5);
    with_node(|node| {
        for (id, way, block_size) in [
            (TEXT, Way::Segments, 127),
            (TEXT, Way::Blocks, 127),
            (DOMAIN, Way::Segments, 127),
            (DOMAIN, Way::Blocks, 127),
            (DOMAIN, Way::Blocks, 1),
            (TEXT, Way::Blocks, 5),
        ] {
            node.server.set_block_size(block_size);
            for length in (0..=2000).filter(|length| is_tried(*length)) {
                let new = data(length, u8::try_from(length % 251).unwrap());
                if kept(id, &new) {
                    write_and_read(node, id, client(way, block_size), &new, [&none; 4]);
                    done += 1;
                }
            }
        }
    });
    assert!(done > if od_tests::is_long() { 11_900 } else { 2_900 }, "{done}");
}

fn fates() -> impl Strategy<Value = Fates> {
    let fate = prop_oneof![Just(Fate::Lost), Just(Fate::Doubled), Just(Fate::Swapped)];
    proptest::collection::vec((0..40_u16, fate), 0..4)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: od_tests::cases(2000), ..ProptestConfig::default() })]

    #[test]
    fn whatever_the_bus_does_data_are_right_or_it_is_an_error(
        domain: bool,
        blocks: bool,
        length in prop_oneof![0..30_usize, 0..1000_usize],
        block_size in prop_oneof![1..5_u8, Just(127)],
        seed: u8,
        there in fates(),
        back in fates(),
        there_again in fates(),
        back_again in fates(),
    ) {
        let (id, way) = (if domain { DOMAIN } else { TEXT }, if blocks { Way::Blocks } else { Way::Segments });
        let new = data(length, seed);
        prop_assume!(kept(id, &new));
        with_node(|node| {
            node.server.set_block_size(block_size);
            set(node, id, &data(100, seed.wrapping_add(1)));
            write_and_read(node, id, client(way, block_size), &new, [&there, &back, &there_again, &back_again]);
            // And the next transfer is as if nothing had been.
            write_and_read(node, id, client(way, block_size), &data(9, seed | 1), [&Fates::new(); 4]);
        });
    }
}

/// A generator of numbers that are the same in each run.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> u64 {
        // xorshift64*
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_F491_4F6C_DD1D)
    }

    fn below(&mut self, end: u64) -> u64 {
        (self.next() >> 33) % end
    }
}

/// A frame as it may come from a client or a server gone mad: commands that exist, entries that exist, and anything.
fn any_frame(numbers: &mut Numbers, commands: &[u8]) -> [u8; 8] {
    let mut bytes = numbers.next().to_le_bytes();
    if numbers.below(8) > 0 {
        bytes[0] = commands[usize::try_from(numbers.below(commands.len().try_into().unwrap())).unwrap()];
        [bytes[1], bytes[2], bytes[3]] = [u8::try_from(numbers.below(4)).unwrap(), 0x20, 0];
        if numbers.below(2) == 0 {
            bytes[4..].copy_from_slice(&u32::try_from(numbers.below(20)).unwrap().to_le_bytes());
        }
    }
    bytes
}

#[test]
fn a_server_survives_any_frames_and_writes_what_is_complete_only() {
    const COMMANDS: [u8; 28] = [
        0x22, 0x23, 0x2B, 0x21, 0x20, 0x00, 0x10, 0x01, 0x11, 0x0D, 0x40, 0x60, 0x70, 0x80, 0xC0, 0xC6, 0xC2,
        0xC1, 0xD5, 0xA0, 0xA4, 0xA1, 0xA2, 0xA3, 0x02, 0x03, 0x81, 0x82,
    ];
    with_node(|node| {
        let mut numbers = Numbers(0x5EED);
        let channel = channel();
        let (mut now, mut writes, mut aborts) = (BEGIN, 0_u32, 0_u32);
        for _ in 0..1_000_000 {
            now = now + Duration::from_micros(numbers.below(3000));
            let request = any_frame(&mut numbers, &COMMANDS);
            let before = (node.dictionary.image().to_vec(), node.program.complete.clone());
            let frame = Frame::full(channel.request, request);
            let answer = node.server.handle(&frame, &mut node.dictionary, &mut node.program, now);
            let command = answer.and_then(|answer| answer.bytes()?.first().copied());
            aborts += u32::from(command == Some(0x80));
            let after = (node.dictionary.image(), &node.program.complete);
            if (&before.0[..], &before.1) != after {
                writes += 1;
                // Written at once, with the last segment, or at the end of blocks.
                assert!(matches!(command, Some(0x60 | 0x20 | 0x30 | 0xA1)), "{request:02x?} {command:02x?}");
            }
            while numbers.below(4) > 0 {
                if node.server.poll(&mut node.dictionary, &mut node.program, now).is_none() {
                    break;
                }
            }
        }
        assert!(writes > 1000 && aborts > 1000, "{writes} writes, {aborts} aborts: the frames reach little");
        // It serves as before.
        node.server.reset();
        write_and_read(node, TEXT, client(Way::Blocks, 127), &data(50, 3), [&Fates::new(); 4]);
        write_and_read(node, NUMBER, client(Way::Blocks, 127), &data(4, 3), [&Fates::new(); 4]);
    });
}

#[test]
fn a_client_survives_any_frames() {
    const COMMANDS: [u8; 22] = [
        0x60, 0x20, 0x30, 0x43, 0x42, 0x4B, 0x41, 0x40, 0x00, 0x10, 0x0D, 0x1D, 0x80, 0xA0, 0xA4, 0xA2, 0xA1,
        0xC0, 0xC6, 0xC1, 0xD5, 0x01,
    ];
    let mut numbers = Numbers(0x00C0_FFEE);
    let channel = channel();
    let (mut done, mut failed, mut frames) = (0_u32, 0_u32, 0_u32);
    while frames < 1_000_000 {
        let way = if numbers.below(2) == 0 { Way::Segments } else { Way::Blocks };
        let id = EntryId { index: 0x2000 + u16::try_from(numbers.below(4)).unwrap(), sub: 0 };
        let (mut buffer, new) = ([0; 64], data(usize::try_from(numbers.below(40)).unwrap(), 1));
        let mut transfer: Box<dyn Transfer> = if numbers.below(2) == 0 {
            Box::new(client(way, 3).start_read(id, Filled::new(&mut buffer), BEGIN).0)
        } else {
            Box::new(client(way, 3).start_write(id, &new[..], BEGIN).unwrap().0)
        };
        for now in (0..).map(|after| BEGIN + Duration::from_micros(after)) {
            frames += 1;
            let frame = Frame::full(channel.answer, any_frame(&mut numbers, &COMMANDS));
            let step = transfer.handle(&frame, now);
            let polled = transfer.poll(now);
            match step.outcome.or(polled.outcome) {
                Some(Ok(_)) => done += 1,
                Some(Err(_)) => failed += 1,
                None => continue,
            }
            // It is over, and stays so.
            assert_eq!(
                transfer.poll(BEGIN + Duration::from_millis(u64::MAX)),
                Step { send: None, outcome: None }
            );
            break;
        }
    }
    assert!(done > 1000 && failed > 1000, "{done} done, {failed} failed: the frames reach little");
}

#[test]
fn who_takes_no_segment_for_ever_is_left() {
    // A client that says of each block that nothing of it came keeps the server busy, and no time runs out.
    with_node(|node| {
        set(node, TEXT, &data(100, 1));
        let mut ask = |bytes| {
            let frame = Frame::full(channel().request, bytes);
            let answer = node.server.handle(&frame, &mut node.dictionary, &mut node.program, BEGIN);
            while node.server.poll(&mut node.dictionary, &mut node.program, BEGIN).is_some() {}
            answer.unwrap().bytes().unwrap().to_vec()
        };
        ask([0xA4, 0, 0x20, 0, 127, 0, 0, 0]);
        ask([0xA3, 0, 0, 0, 0, 0, 0, 0]);
        let end = (0..100).map(|_| ask([0xA2, 0, 127, 0, 0, 0, 0, 0])).find(|answer| answer[0] == 0x80);
        assert_eq!(end.unwrap(), [0x80, 0, 0x20, 0, 3, 0, 4, 5]);
    });
}
