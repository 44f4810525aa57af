use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::ops::ControlFlow;
use std::time::Duration;

use firmware_glue::AbortCode;
use firmware_glue::frame::{CanId, Frame};
use od_spec::diag::Diagnostics;
use od_spec::model::{DataType, EntryId, Index, SubIndex, System, Value};
use od_spec::source::SourceMap;
use od_spec::{NoFiles, compile};

use super::*;
use crate::runtime::{self, LiveDictionary, VirtualNode};

mod blocks;
mod probe;

const LAMP: &str = "
od-spec: 1
title: Lamp
uses: [cia301]
devices:
  lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer]}
objects:
  0x2000: {name: low, type: unsigned16, access: rw, default: 20}
  0x2001: {name: high, type: unsigned16, access: rw, default: 40}
  0x2002: {name: label, type: visible-string, access: rw, capacity: 20, default: A lamp of glass}
  0x2003: {name: other, type: unsigned8, access: rw, default: 1}
  0x2004: {name: service, type: unsigned8, access: rw, default: 0, writable-when: \"0x2003 == 2\"}
  0x2005: {name: low too, alias: 0x2000, type: unsigned8, access: rw}
  0x2006: {name: measured, type: unsigned8, access: ro}
  0x2007: {name: picture, type: domain, access: rw}
constraints:
  thresholds keep their order: {require: \"0x2000 < 0x2001\"}
";

const fn id(index: u16) -> EntryId {
    EntryId { index: Index(index), sub: SubIndex(0) }
}

/// A device that takes two programs.
const PUMP: &str = "
od-spec: 1
title: Pump
uses: [cia301, cia302]
devices:
  pump: {name: Pump, bit-rates: [125], features: [{program download: 2}, program identification, flash status]}
";

fn lamp() -> System {
    compiled(LAMP)
}

fn compiled(specification: &str) -> System {
    let mut sources = SourceMap::new();
    let root = sources.add("device.od.yaml", specification);
    let compiled = compile(&mut sources, root, &mut NoFiles);
    compiled.system.unwrap_or_else(|| panic!("{:?}", compiled.diagnostics))
}

/// Virtual nodes, and a time that passes while nothing is sent.
struct Virtual<'t> {
    bus: runtime::Bus<'t>,
    heard: VecDeque<Frame>,
    now: u64,
}

impl Bus for Virtual<'_> {
    fn send(&mut self, frame: &Frame) -> Result<(), BusError> {
        // The first is what was sent.
        self.heard.extend(self.bus.take(*frame, self.now).into_iter().skip(1));
        Ok(())
    }

    fn receive(&mut self, within: Duration) -> Result<Option<Frame>, BusError> {
        if self.heard.is_empty() {
            self.now += u64::try_from(within.as_micros()).unwrap();
            self.heard.extend(self.bus.poll(self.now));
        }
        Ok(self.heard.pop_front())
    }

    fn now(&self) -> u64 {
        self.now
    }
}

/// Does something with lamps as nodes 5 and 6.
fn with_lamps(test: impl FnOnce(&System, &mut Client<Virtual<'_>>)) {
    with_nodes(&lamp(), test);
}

/// Does something with two devices as nodes 5 and 6.
fn with_nodes(system: &System, test: impl FnOnce(&System, &mut Client<Virtual<'_>>)) {
    let device = runtime::device(system, &system.devices[0], &mut Diagnostics::new()).unwrap();
    let lists = device.lists();
    let table = lists.table().unwrap();
    let node = |id| VirtualNode::new(id, LiveDictionary::new(&device, &table, id).unwrap()).unwrap();
    let mut bus = runtime::Bus::new(vec![node(5), node(6)]);
    // The nodes start.
    drop(bus.poll(0));
    let mut client = Client::new(Virtual { bus, heard: VecDeque::new(), now: 0 }, Duration::from_millis(500));
    test(system, &mut client);
}

#[test]
fn entries_are_read_and_written_whatever_their_length() {
    with_lamps(|_, client| {
        assert_eq!(client.read(5, id(0x2000)).unwrap(), [20, 0]);
        assert_eq!(client.read(5, id(0x2002)).unwrap(), b"A lamp of glass");
        client.write(5, id(0x2002), b"More than seven").unwrap();
        client.write(6, id(0x2000), &[30, 0]).unwrap();
        assert_eq!(client.read(5, id(0x2002)).unwrap(), b"More than seven");
        assert_eq!(
            (client.read(5, id(0x2000)).unwrap(), client.read(6, id(0x2000)).unwrap()),
            (vec![20, 0], vec![30, 0])
        );
    });
}

#[test]
fn refusals_and_silence_are_distinguished() {
    with_lamps(|_, client| {
        let refused = client.write(5, id(0x2004), &[1]).unwrap_err();
        assert!(matches!(refused, AccessError::Refused(AbortCode::DEVICE_STATE)), "{refused}");
        assert!(refused.is_of_entry());
        let silent = client.read(7, id(0x2000)).unwrap_err();
        assert!(matches!(silent, AccessError::Silent), "{silent}");
        assert!(!silent.is_of_entry());
        // A frame that came twice is not a word about the entry.
        let confused = [AbortCode::TOGGLE_BIT, AbortCode::COMMAND, AbortCode::SEQUENCE, AbortCode::CRC];
        assert!(confused.into_iter().all(|code| !AccessError::Refused(code).is_of_entry()));
        assert!(AccessError::Refused(AbortCode::OUT_OF_MEMORY).is_of_entry());
    });
}

/// Program 2 of a node: what is written to it, commands, and what the node says of it.
struct Program<'c, 't>(&'c mut Client<Virtual<'t>>);

impl Program<'_, '_> {
    const fn id(index: u16) -> EntryId {
        EntryId { index: Index(index), sub: SubIndex(2) }
    }

    fn command(&mut self, code: u8) -> Option<AbortCode> {
        refusal(self.0.write(5, Self::id(0x1F51), &[code]))
    }

    fn load(
        &mut self,
        data: &[u8],
        reported: impl FnMut(usize) -> ControlFlow<()>,
    ) -> Result<(), AccessError> {
        self.0.load(5, Self::id(0x1F50), data, Duration::from_secs(1), reported)
    }

    /// 1F51h, 1F56h and 1F57h.
    fn says(&mut self) -> [u32; 3] {
        [0x1F51, 0x1F56, 0x1F57].map(|index| {
            let bytes = self.0.read(5, Self::id(index)).unwrap();
            bytes.iter().rev().fold(0, |number, byte| number << 8 | u32::from(*byte))
        })
    }
}

/// The code of an access that the node refuses.
fn refusal(access: Result<(), AccessError>) -> Option<AbortCode> {
    match access {
        Ok(()) => None,
        Err(AccessError::Refused(code)) => Some(code),
        Err(other) => panic!("{other}"),
    }
}

#[test]
fn a_program_is_loaded_in_the_order_of_cia_302() {
    with_nodes(&compiled(PUMP), |_, client| {
        let mut program = Program(client);
        let (refused, goes_on) = (Some(AbortCode::DEVICE_STATE), |_| ControlFlow::Continue(()));
        assert_eq!(program.says(), [1, 1, 0]);
        // It runs.
        assert_eq!(program.command(3), refused);
        assert_eq!(refusal(program.load(&[1; 100], goes_on)), refused);
        assert_eq!((program.command(0), program.says()), (None, [0, 1, 0]));
        // It was not deleted.
        assert_eq!(refusal(program.load(&[1; 100], goes_on)), refused);
        assert_eq!((program.command(3), program.says()), (None, [3, 0, 2]));
        // There is none.
        assert_eq!([1, 2].map(|code| program.command(code)), [refused, refused]);
        let data: Vec<u8> = (0..=255).cycle().take(3001).collect();
        let mut most = 0;
        let reported = |sent| {
            most = most.max(sent);
            ControlFlow::Continue(())
        };
        program.load(&data, reported).unwrap();
        assert_eq!(most, data.len());
        let [state, identification, flash] = program.says();
        assert_eq!((state, flash), (0, 0));
        assert_ne!(identification, 0);
        assert_eq!(program.0.read(5, Program::id(0x1F50)).unwrap(), data);
        assert_eq!((program.command(1), program.says()), (None, [1, identification, 0]));
        assert_eq!((program.command(2), program.says()), (None, [1, identification, 0]));
        // Its memory outlasts a reset, with which it starts.
        assert_eq!((program.command(0), program.says()), (None, [0, identification, 0]));
        program.0.command(129, 5).unwrap();
        assert!(program.0.booted(5, Duration::from_secs(1)).unwrap());
        assert_eq!(program.says(), [1, identification, 0]);
        // Commands are for a node that is pre-operational, and there are four of them.
        program.0.command(1, 5).unwrap();
        assert_eq!(program.command(0), refused);
        program.0.command(128, 5).unwrap();
        assert_eq!(program.command(4), Some(AbortCode::INVALID_VALUE));
    });
}

#[test]
fn a_transfer_that_is_ended_leaves_no_program() {
    with_nodes(&compiled(PUMP), |_, client| {
        let mut program = Program(client);
        assert_eq!([0, 3].map(|code| program.command(code)), [None, None]);
        let ends = |sent| if sent > 1000 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
        let ended = program.load(&[7; 5000], ends).unwrap_err();
        assert!(matches!(ended, AccessError::Wrong(AbortCode::GENERAL)), "{ended}");
        assert_eq!((program.says(), program.command(1)), ([3, 0, 2], Some(AbortCode::DEVICE_STATE)));
        program.load(&[7; 5000], |_| ControlFlow::Continue(())).unwrap();
        assert_eq!(program.command(1), None);
    });
}

/// A bus whose nodes refuse transfers in blocks.
struct WithoutBlocks<'t>(Virtual<'t>);

impl Bus for WithoutBlocks<'_> {
    fn send(&mut self, frame: &Frame) -> Result<(), BusError> {
        if let Some([command, low, high, sub, ..]) = frame.bytes()
            && command & 0xE0 == 0xC0
        {
            let abort = [0x80, *low, *high, *sub, 1, 0, 4, 5];
            self.0.heard.push_back(Frame::full(CanId::new(0x585).unwrap(), abort));
            return Ok(());
        }
        self.0.send(frame)
    }

    fn receive(&mut self, within: Duration) -> Result<Option<Frame>, BusError> {
        self.0.receive(within)
    }

    fn now(&self) -> u64 {
        self.0.now()
    }
}

#[test]
fn a_node_without_blocks_gets_segments() {
    let system = compiled(PUMP);
    let device = runtime::device(&system, &system.devices[0], &mut Diagnostics::new()).unwrap();
    let lists = device.lists();
    let table = lists.table().unwrap();
    let node = VirtualNode::new(5, LiveDictionary::new(&device, &table, 5).unwrap()).unwrap();
    let mut bus = runtime::Bus::new(vec![node]);
    drop(bus.poll(0));
    let bus = WithoutBlocks(Virtual { bus, heard: VecDeque::new(), now: 0 });
    let mut client = Client::new(bus, Duration::from_millis(500));
    for code in [0, 3] {
        client.write(5, Program::id(0x1F51), &[code]).unwrap();
    }
    let data = [9; 1000];
    let reported = |_| ControlFlow::Continue(());
    client.load(5, Program::id(0x1F50), &data, Duration::from_secs(1), reported).unwrap();
    assert_eq!(client.read(5, Program::id(0x1F50)).unwrap(), data);
}

#[test]
fn a_reset_brings_a_boot_up_message() {
    with_lamps(|_, client| {
        client.command(129, 5).unwrap();
        assert!(client.booted(5, Duration::from_secs(1)).unwrap());
        assert!(!client.booted(6, Duration::from_secs(1)).unwrap());
    });
}

#[test]
fn a_node_that_starts_while_another_is_talked_to_is_noted() {
    with_lamps(|_, client| {
        assert_eq!(client.restarted(6).unwrap(), None);
        client.command(129, 6).unwrap();
        client.read(5, id(0x2000)).unwrap();
        assert_eq!(client.restarted(6).unwrap(), Some(Restart::BootUp));
        assert_eq!(client.restarted(5).unwrap(), None);
    });
}

#[test]
fn a_scan_finds_who_is_there() {
    with_lamps(|system, client| {
        let found = scan(client, Duration::from_millis(100)).unwrap();
        assert_eq!(found.iter().map(|one| (one.node, one.state)).collect::<Vec<_>>(), [(5, None), (6, None)]);
        let Answer::Of(identity) = &found[0].answer else { panic!("{found:?}") };
        let device = Identity::of(&system.devices[0]);
        assert_eq!(identity.device_type, device.device_type);
        assert!(identity.fits(&device));
        let maker = Identity { vendor: Some(7), product: Some(1), ..Identity::default() };
        let own =
            Identity { device_type: Some(0), revision: Some(3), name: Some("B".to_owned()), ..maker.clone() };
        assert!(own.fits(&maker));
        assert!(!Identity { product: Some(2), ..own.clone() }.fits(&maker));
        assert!(!own.fits(&Identity { name: Some("A".to_owned()), ..maker }));
        assert!(!own.fits(&Identity::default()), "nothing is known of the device");
    });
}

#[test]
fn a_scan_hears_who_does_not_answer() {
    with_lamps(|_, client| {
        let heartbeat = EntryId { index: Index(0x1017), sub: SubIndex(0) };
        for node in [5, 6] {
            client.write(node, heartbeat, &[50, 0]).unwrap();
        }
        client.command(1, 5).unwrap();
        client.command(2, 6).unwrap();
        let found = scan(client, Duration::from_millis(100)).unwrap();
        let reported: Vec<_> =
            found.iter().map(|one| (one.node, one.state, matches!(one.answer, Answer::Of(_)))).collect();
        assert_eq!(reported, [(5, Some(5), true), (6, Some(4), false)]);
        assert_eq!(found[1].answer, Answer::None);
    });
}

/// A bus on which a second device answers with a node-ID, a little later and otherwise.
struct Shared<'t> {
    bus: Virtual<'t>,
    /// So many requests of a client are answered twice.
    twice: usize,
}

impl Bus for Shared<'_> {
    fn send(&mut self, frame: &Frame) -> Result<(), BusError> {
        self.bus.send(frame)?;
        if frame.id().get() == 0x605 && self.twice > 0 {
            self.twice -= 1;
            let twin = self.bus.heard.back().copied().and_then(|frame| {
                let mut bytes: [u8; 8] = frame.bytes()?.try_into().ok()?;
                bytes[4] ^= 0x55;
                Some(Frame::full(frame.id(), bytes))
            });
            self.bus.heard.extend(twin);
        }
        Ok(())
    }

    fn receive(&mut self, within: Duration) -> Result<Option<Frame>, BusError> {
        self.bus.receive(within)
    }

    fn now(&self) -> u64 {
        self.bus.now()
    }
}

#[test]
fn two_devices_with_one_node_id_answer_every_time() {
    // Another client may ask the node at the same time, once.
    for (twice, is_shared) in [(1, false), (usize::MAX, true)] {
        with_lamps(|_, client| {
            let Virtual { bus, .. } = client.bus();
            let bus = std::mem::replace(bus, runtime::Bus::new(Vec::new()));
            let bus = Virtual { bus, heard: VecDeque::new(), now: 0 };
            let mut client = Client::new(Shared { bus, twice }, Duration::from_millis(500));
            let found = scan(&mut client, Duration::from_millis(100)).unwrap();
            let reported: Vec<_> = found.iter().map(|one| (one.node, one.answer == Answer::Two)).collect();
            assert_eq!(reported, [(5, is_shared), (6, false)]);
        });
    }
}

/// A bus on which a node's answers are lost, changed or doubled.
struct Dirty<'t, F> {
    bus: Virtual<'t>,
    /// What becomes of the answer that is the first, the second …
    becomes: F,
    answers: usize,
    /// Requests of a client, except aborts.
    requests: usize,
}

impl<F: FnMut(usize, Frame) -> Vec<Frame>> Bus for Dirty<'_, F> {
    fn send(&mut self, frame: &Frame) -> Result<(), BusError> {
        self.requests += usize::from(frame.bytes().is_some_and(|bytes| bytes[0] != 0x80));
        self.bus.send(frame)?;
        for answer in std::mem::take(&mut self.bus.heard) {
            self.answers += 1;
            self.bus.heard.extend((self.becomes)(self.answers, answer));
        }
        Ok(())
    }

    fn receive(&mut self, within: Duration) -> Result<Option<Frame>, BusError> {
        self.bus.receive(within)
    }

    fn now(&self) -> u64 {
        self.bus.now()
    }
}

/// Does something with lamps on a bus with dirt.
fn with_dirt<F: FnMut(usize, Frame) -> Vec<Frame>>(becomes: F, test: impl FnOnce(&mut Client<Dirty<'_, F>>)) {
    with_lamps(|_, client| {
        let bus = std::mem::replace(&mut client.bus().bus, runtime::Bus::new(Vec::new()));
        let bus = Virtual { bus, heard: VecDeque::new(), now: 0 };
        let dirty = Dirty { bus, becomes, answers: 0, requests: 0 };
        test(&mut Client::new(dirty, Duration::from_millis(500)));
    });
}

/// A frame with another first byte.
fn changed(frame: Frame, command: u8) -> Frame {
    let mut bytes: [u8; 8] = frame.bytes().unwrap().try_into().unwrap();
    bytes[0] = command;
    Frame::full(frame.id(), bytes)
}

#[test]
fn a_read_is_repeated_when_a_frame_was_lost_or_broken() {
    type Becomes = fn(usize, Frame) -> Vec<Frame>;
    let dirt: [(&str, Becomes); 5] = [
        ("the first answer is lost", |at, frame| if at == 1 { Vec::new() } else { vec![frame] }),
        ("a segment is lost", |at, frame| if at == 2 { Vec::new() } else { vec![frame] }),
        ("a segment came twice", |at, frame| if at == 2 { vec![frame; 2] } else { vec![frame] }),
        ("the first answer came twice", |at, frame| if at == 1 { vec![frame; 2] } else { vec![frame] }),
        ("a wrong toggle bit", |at, frame| vec![if at == 2 { changed(frame, 0x10) } else { frame }]),
    ];
    for (what, becomes) in dirt {
        with_dirt(becomes, |client| {
            assert_eq!(client.read(5, id(0x2002)).expect(what), b"A lamp of glass", "{what}");
            assert_eq!(client.read(5, id(0x2000)).expect(what), [20, 0], "{what}");
        });
    }
    with_dirt(
        |at, frame| if at <= 2 { Vec::new() } else { vec![frame] },
        |client| {
            let silent = client.read(5, id(0x2000)).unwrap_err();
            assert!(silent.is_of_node() && client.bus().requests == 2, "{silent}");
        },
    );
}

/// The late answer begins the second transfer, and the answer to that comes in its middle.
#[test]
fn an_answer_that_came_too_late_uses_up_no_repetition() {
    let mut late = None;
    let becomes = move |at, frame| {
        if at == 1 {
            late = Some(frame);
            return Vec::new();
        }
        late.take().into_iter().chain([frame]).collect()
    };
    with_dirt(becomes, |client| {
        assert_eq!(client.read(5, id(0x2002)).unwrap(), b"A lamp of glass");
        assert_eq!(client.read(5, id(0x2000)).unwrap(), [20, 0]);
    });
}

#[test]
fn a_broken_answer_is_no_end_of_the_node() {
    let becomes = |_, frame: Frame| match frame.bytes() {
        Some([_, 0x00, 0x20, ..]) => vec![changed(frame, 0xFF)],
        Some([_, 0x01, 0x20, ..]) => vec![Frame::data(frame.id(), &[0x4B, 0x01, 0x20, 0]).unwrap()],
        _ => vec![frame],
    };
    with_dirt(becomes, |client| {
        let wrong = client.read(5, id(0x2000)).unwrap_err();
        assert!(matches!(wrong, AccessError::Wrong(AbortCode::COMMAND)), "{wrong}");
        assert!(!wrong.is_of_entry() && !wrong.is_of_node());
        let short = client.read(5, id(0x2001)).unwrap_err();
        assert!(matches!(short, AccessError::Short(4)) && !short.is_of_node(), "{short}");
        assert_eq!(client.read(5, id(0x2003)).unwrap(), [1]);
    });
}

#[test]
fn an_answer_without_a_size_has_the_length_of_the_type() {
    let becomes = |_, frame: Frame| match frame.bytes() {
        Some([0x43 | 0x47 | 0x4B | 0x4F, ..]) => vec![changed(frame, 0x42)],
        _ => vec![frame],
    };
    with_dirt(becomes, |client| {
        assert_eq!(client.read_as(5, id(0x2000), DataType::Unsigned16).unwrap(), [20, 0]);
        assert_eq!(client.read_as(5, id(0x2003), DataType::Unsigned8).unwrap(), [1]);
        assert_eq!(client.read(5, id(0x2003)).unwrap(), [1, 0, 0, 0]);
        assert_eq!(client.read_as(5, id(0x2002), DataType::VisibleString).unwrap(), b"A lamp of glass");
    });
    // A length that the node states counts.
    with_lamps(|_, client| {
        assert_eq!(client.read_as(5, id(0x2000), DataType::Unsigned8).unwrap(), [20, 0]);
    });
}

#[test]
fn no_write_is_repeated() {
    with_dirt(
        |at, frame| if at == 1 { Vec::new() } else { vec![frame] },
        |client| {
            let silent = client.write(5, id(0x2000), &[30, 0]).unwrap_err();
            assert!(matches!(silent, AccessError::Silent), "{silent}");
            assert_eq!((client.bus().requests, client.writes()), (1, 1));
            assert_eq!(client.read(5, id(0x2000)).unwrap(), [30, 0]);
        },
    );
}

#[test]
fn what_conditions_ask_for_is_involved() {
    let system = lamp();
    let of = |index| involved(&system, &system.devices[0], &BTreeSet::from([id(index)]));
    assert_eq!(of(0x2000), BTreeSet::from([id(0x2001)]));
    assert_eq!(of(0x2005), BTreeSet::from([id(0x2001)]), "a view of 2000h");
    assert_eq!(of(0x2004), BTreeSet::from([id(0x2003)]));
    assert_eq!(of(0x2002), BTreeSet::new());
    let kept: Vec<EntryId> = kept(&system.devices[0]).filter(|id| id.index.0 >= 0x2000).collect();
    assert_eq!(kept, [0x2000, 0x2001, 0x2002, 0x2003, 0x2004, 0x2007].map(id));
}

#[test]
fn a_plan_begins_with_what_the_node_has() {
    let system = lamp();
    let values = |pairs: &[(u16, i128)]| -> BTreeMap<EntryId, Value> {
        pairs.iter().map(|(index, raw)| (id(*index), Value::Integer(*raw))).collect()
    };
    let order = |now: &[(u16, i128)], meant: &[(u16, i128)]| -> Vec<u16> {
        let plan = plan(&system, &system.devices[0], 5, &values(now), &values(meant)).unwrap();
        plan.iter().map(|write| write.id.index.0).collect()
    };
    let back = [(0x2000, 20), (0x2001, 40)];
    assert_eq!(order(&[(0x2000, 50), (0x2001, 60)], &back), [0x2000, 0x2001], "down");
    assert_eq!(order(&[(0x2000, 2), (0x2001, 4)], &back), [0x2001, 0x2000], "up");
    assert_eq!(order(&back, &back), [0_u16; 0], "nothing to do");
    assert_eq!(order(&[(0x2000, 20), (0x2001, 60)], &back), [0x2001]);
}

#[test]
fn a_node_that_obeys_the_client_does_not_start_again() {
    with_lamps(|_, client| {
        let heartbeat = EntryId { index: Index(0x1017), sub: SubIndex(0) };
        client.write(5, heartbeat, &[10, 0]).unwrap();
        for command in [1, 128] {
            client.command(command, 5).unwrap();
            // No node is started; heartbeats are heard.
            assert!(!client.booted(5, Duration::from_millis(50)).unwrap());
        }
        assert_eq!(client.restarted(5).unwrap(), None);
    });
}

#[test]
fn a_higher_minor_revision_is_newer_and_not_another_one() {
    let of = |revision| Identity { revision, ..Identity::default() };
    let relation = |reported, stated| Revision::of(&of(reported), &of(stated));
    assert_eq!(relation(Some(0x0001_0002), Some(0x0001_0002)), Revision::Same);
    assert_eq!(relation(Some(0x0001_0003), Some(0x0001_0002)), Revision::Newer);
    assert_eq!(relation(Some(0x0001_0001), Some(0x0001_0002)), Revision::Other);
    assert_eq!(relation(Some(0x0002_0002), Some(0x0001_0002)), Revision::Other);
    for unreported in [None, Some(0)] {
        assert_eq!(relation(unreported, Some(0x0001_0002)), Revision::Unreported);
        assert_eq!(relation(Some(0x0001_0002), unreported), Revision::Same, "nothing is stated");
    }
}
