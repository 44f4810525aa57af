//! `odgen node monitor`: what goes over a bus, in words, while it does.

use std::io::Write as _;
use std::path::Path;
use std::time::{Duration, Instant};

use firmware_glue::frame::Frame;
use od_bus::client::{Bus, BusError, Client};
use od_bus::monitor::{Detail, Monitor, Shows};
use od_bus::slcan::CanFrame;
use od_bus::trace::{Decoder, Node, What};
use od_spec::diag::{Diagnostic, codes};
use od_spec::model::{Dictionary, EntryId, Index, SubIndex};
use od_spec::visible::printable;

use super::args::NodeMonitorArgs;
use super::network::broken;
use super::reach::{AnyBus, bus};
use crate::bus_nodes::BusNodes;
use crate::exit::SUCCESS;
use crate::interrupt::Interrupt;
use crate::report::{Report, not_printed};

/// The longest time until the command looks whether it is to end.
const NAP: Duration = Duration::from_millis(100);

/// What decides which identifier belongs to what, in addition to the parameters of PDOs: SYNC, TIME, EMCY, and how
/// often a heartbeat comes.
const IDENTIFIERS: [u16; 4] = [0x1005, 0x1012, 0x1014, 0x1017];
/// No PDO carries more.
const MAPPED: u8 = 64;
/// The identifiers of what nodes answer begin here.
const SDO_ANSWERS: u16 = 0x580;

/// Prints what goes over the bus until Ctrl-C, or for a time; then what was seen of each node.
pub(super) fn monitor(args: &NodeMonitorArgs, directory: &Path, report: &Report) -> Result<u8, u8> {
    let nodes = if args.nodes.names_nothing() {
        report.note(
            "no node is named, so that nothing has names and units: `SPEC --node ID=KEY`, or a plant file",
        );
        None
    } else {
        Some(BusNodes::read(&args.nodes, directory, report)?)
    };
    let known = || nodes.iter().flat_map(BusNodes::iter);
    let interrupt = Interrupt::noted();
    let mut bus = bus(&args.link, report)?;
    let decoder = Decoder::new(known().map(|(id, system, device)| Node::new(id, system, device)).collect());
    let shows = Shows {
        detail: if args.all { Detail::Everything } else { Detail::Changes },
        only: args.only.iter().map(|name| name.service()).collect(),
    };
    let start = Instant::now();
    let mut watching = Watching { monitor: Monitor::new(decoder, shows, 0), start };
    if args.ask {
        let timeout = Duration::from_millis(args.link.timeout.into());
        for (id, _, device) in known() {
            let client = Client::new(Overheard { bus: &mut bus, heard: Vec::new() }, timeout);
            let client = client.with_retries(args.link.retries);
            watching.ask(Asking { client, node: id, device, report })?;
        }
    } else if nodes.is_some() {
        report.note("identifiers and mappings of PDOs are taken from the specification until one is written; `--ask` reads them from the nodes");
    }
    let until = args.seconds.and_then(|time| start.checked_add(time));
    while !interrupt.is_wanted() && until.is_none_or(|until| Instant::now() < until) {
        let left = until.map_or(NAP, |until| until.saturating_duration_since(Instant::now()));
        match bus.receive(left.min(watching.nap())) {
            Ok(Some(frame)) => watching.hear(&frame)?,
            // It refused a question, which is no longer waited for.
            Ok(None) | Err(BusError::Refused) => {}
            Err(error) => {
                watching.end(report)?;
                return Err(report.refuse(broken(&error)));
            }
        }
        watching.look()?;
    }
    watching.end(report)
}

/// What is watched, and since when.
struct Watching<'a> {
    monitor: Monitor<'a>,
    start: Instant,
}

impl Watching<'_> {
    fn now(&self) -> u64 {
        u64::try_from(self.start.elapsed().as_micros()).unwrap_or(u64::MAX)
    }

    /// So long nothing is late.
    fn nap(&self) -> Duration {
        let left = self.monitor.next_deadline().map(|at| at.saturating_sub(self.now()));
        left.map_or(NAP, |left| Duration::from_micros(left).clamp(Duration::from_millis(1), NAP))
    }

    fn hear(&mut self, frame: &Frame) -> Result<(), u8> {
        let lines = self.monitor.take(&What::Frame(CanFrame::Standard(*frame)), self.now());
        print(&lines)
    }

    /// Reports what has not come.
    fn look(&mut self) -> Result<(), u8> {
        let lines = self.monitor.poll(self.now());
        print(&lines)
    }

    /// Prints what was seen of each node, and of which of them the answers do not count any more.
    fn end(&self, report: &Report) -> Result<u8, u8> {
        let summary = self.monitor.summary(self.now());
        print(&[summary.trim_end().to_owned()])?;
        let outdated: Vec<String> = self.monitor.outdated().collect();
        if outdated.is_empty() {
            return Ok(SUCCESS);
        }
        let message = format!("{} started again after it was asked", outdated.join(", "));
        let help = "give the command again: identifiers and mappings that the node had not stored are lost";
        Err(report.refuse(Diagnostic::without_place(codes::ACCESS_FAILED, message).help(help)))
    }

    /// Reads from a node which identifiers it uses and what its PDOs carry; one that is silent once is not asked the rest.
    fn ask(&mut self, mut asking: Asking<'_>) -> Result<(), u8> {
        for index in IDENTIFIERS {
            if asking.read(self, id(index, 0))? == Answer::Silent {
                return Ok(());
            }
        }
        for pdo in &asking.device.pdos {
            asking.read(self, id(pdo.communication_index(), 1))?;
            let count = match asking.read(self, id(pdo.mapping_index(), 0))? {
                Answer::Bytes(bytes) => bytes.first().copied().unwrap_or(0),
                Answer::Nothing => 0,
                Answer::Silent => return Ok(()),
            };
            for sub in 1..=count.min(MAPPED) {
                asking.read(self, id(pdo.mapping_index(), sub))?;
            }
        }
        Ok(())
    }
}

/// A node that is asked what it has.
struct Asking<'a> {
    client: Client<Overheard<'a>>,
    node: u8,
    device: &'a Dictionary,
    report: &'a Report,
}

/// What a node says to a question.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Answer {
    Bytes(Vec<u8>),
    /// It does not have it, or does not report it.
    Nothing,
    /// It says nothing at all.
    Silent,
}

impl Asking<'_> {
    /// Reads an entry. What goes over the bus meanwhile is printed.
    fn read(&mut self, watching: &mut Watching<'_>, id: EntryId) -> Result<Answer, u8> {
        let Some(entry) = self.device.entry(id).filter(|entry| entry.access.is_readable()) else {
            return Ok(Answer::Nothing);
        };
        let described = self.client.read_as(self.node, id, entry.data_type);
        let own = SDO_ANSWERS + u16::from(self.node);
        for frame in std::mem::take(&mut self.client.bus().heard) {
            if frame.id().get() != own {
                watching.hear(&frame)?;
            }
        }
        Ok(match described {
            Ok(bytes) => {
                watching.monitor.learn(self.node, id, &bytes);
                Answer::Bytes(bytes)
            }
            Err(error) => {
                let node = self.node;
                self.report
                    .note(&format!("node {node} does not report {id}, which is taken as specified: {error}"));
                if error.is_of_node() { Answer::Silent } else { Answer::Nothing }
            }
        })
    }
}

const fn id(index: u16, sub: u8) -> EntryId {
    EntryId { index: Index(index), sub: SubIndex(sub) }
}

/// A bus of which everything that is heard is kept.
struct Overheard<'b> {
    bus: &'b mut AnyBus,
    heard: Vec<Frame>,
}

impl Bus for Overheard<'_> {
    fn send(&mut self, frame: &Frame) -> Result<(), BusError> {
        self.bus.send(frame)
    }

    fn receive(&mut self, within: Duration) -> Result<Option<Frame>, BusError> {
        let heard = self.bus.receive(within)?;
        self.heard.extend(heard);
        Ok(heard)
    }

    fn now(&self) -> u64 {
        self.bus.now()
    }
}

/// Prints lines as they come, for a pipe, too. The exit code where they are no longer read.
fn print(lines: &[String]) -> Result<(), u8> {
    if lines.is_empty() {
        return Ok(());
    }
    let mut text = lines.join("\n");
    text.push('\n');
    let mut out = std::io::stdout().lock();
    let written = out.write_all(printable(&text, false).as_bytes()).and_then(|()| out.flush());
    written.map_err(|error| not_printed(&error))
}
