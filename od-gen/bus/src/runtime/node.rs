//! A node that no hardware has: the node of the firmware over a dictionary that is not compiled.

use std::fmt;

use firmware_glue::clock::{Instant, earlier};
use firmware_glue::emcy::{Emergency, Raised};
use firmware_glue::frame::Frame;
use firmware_glue::nmt::{Service, State};
use firmware_glue::node::{NoRoom, Room, UpTo};
use firmware_glue::sdo::{Channel, SdoServer};
use firmware_glue::{AbortCode, Dictionary, EntryId, Node, NodeId};

use super::LiveDictionary;
use super::host::{Checks, Host};

/// As many TPDOs, and as many RPDOs, as CiA 301 has objects for.
const PDOS: usize = 512;
/// Errors at once; with more, those that are too many cannot be cleared one by one.
const ERRORS: usize = 256;
/// As many nodes as 1016h can have sub-indices.
const WATCHED: usize = 254;

/// A virtual node. Frames go in, frames come out, and the time is given, in microseconds from any beginning.
///
/// It is [`firmware_glue::Node`], with everything that this has: boot-up, the states of NMT, heartbeat and guarding, the nodes of 1016h, PDOs, SYNC,
/// emergencies, LSS (where the device has it) and the first SDO server. A firmware with more SDO servers (1201h to
/// 127Fh) runs them in addition to its node, as each needs a buffer of its own; so does this node, on every channel
/// that its dictionary has when it boots.
///
/// Parameters are stored and restored (1010h, 1011h) for as long as the program runs. That a value was written that an
/// event-driven TPDO carries, by SDO, by an RPDO or by [`set`](Self::set), is an event of that TPDO.
#[derive(Debug)]
pub struct VirtualNode<'t> {
    node: Box<Node<Vec<u8>, PDOS, PDOS, ERRORS, WATCHED>>,
    dictionary: LiveDictionary<'t>,
    host: Host,
    /// SDO servers on the channels of 1201h to 127Fh.
    further: Vec<SdoServer<Vec<u8>>>,
}

/// Why there is no node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum NoNode {
    /// The node-ID is not valid.
    NodeId,
    /// The dictionary has more PDOs, or watches more nodes, than CANopen.
    Room(NoRoom),
}

impl fmt::Display for NoNode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NodeId => f.write_str("a node-ID is 1 to 127"),
            Self::Room(room) => room.fmt(f),
        }
    }
}

impl std::error::Error for NoNode {}

impl<'t> VirtualNode<'t> {
    /// A node with a node-ID from 1 to 127, which starts with the first [`poll`](Self::poll).
    ///
    /// # Errors
    /// [`NoNode`]: why there is none.
    pub fn new(id: u8, dictionary: LiveDictionary<'t>) -> Result<Self, NoNode> {
        let id = NodeId::new(id).ok_or(NoNode::NodeId)?;
        let table = dictionary.table();
        let sdo_buffer = vec![0; table.largest_value()];
        let room = Room { tpdos: UpTo, rpdos: UpTo, errors: UpTo, watched: UpTo, sdo_buffer };
        // With room for all PDOs that there can be it is large, and no combinator moves it once more.
        let node = match Node::new(table, Some(id), room) {
            Ok(node) => Box::new(node),
            Err(room) => return Err(NoNode::Room(room)),
        };
        Ok(Self { node, host: Host::new(&dictionary), dictionary, further: Vec::new() })
    }

    /// Its dictionary.
    pub const fn dictionary(&self) -> &LiveDictionary<'t> {
        &self.dictionary
    }

    /// Its node-ID, which LSS can change; none where LSS has taken it.
    pub fn id(&self) -> Option<u8> {
        self.node.id().map(NodeId::get)
    }

    /// Its state.
    pub const fn state(&self) -> State {
        self.node.state()
    }

    /// Takes a frame, and says what answers it. What else there is to say comes with [`poll`](Self::poll).
    pub fn take(&mut self, frame: &Frame, now: u64) -> Option<Frame> {
        let (dictionary, host) = (&mut self.dictionary, &mut self.host);
        let mut answer = self.node.handle(frame, dictionary, host, Instant::from_micros(now));
        if answer.is_none() && self.node.serves(Service::Sdo) {
            let mut servers = self.further.iter_mut();
            answer =
                servers.find_map(|server| server.handle(frame, dictionary, host, Instant::from_micros(now)));
        }
        self.follow(now);
        answer
    }

    /// What it says by itself. To be called until it is nothing.
    pub fn poll(&mut self, now: u64) -> Vec<Frame> {
        let (dictionary, host) = (&mut self.dictionary, &mut self.host);
        let mut frames: Vec<Frame> =
            self.node.poll(dictionary, host, Instant::from_micros(now)).into_iter().collect();
        if self.node.serves(Service::Sdo) {
            let servers = self.further.iter_mut();
            frames.extend(
                servers.filter_map(|server| server.poll(dictionary, host, Instant::from_micros(now))),
            );
        }
        self.follow(now);
        frames
    }

    /// When it has something to say next, unless a frame comes before; a time that has passed means at once.
    pub fn next_deadline(&self) -> Option<u64> {
        let node = self.node.next_deadline(&self.dictionary);
        self.further.iter().map(SdoServer::next_deadline).fold(node, earlier).map(Instant::as_micros)
    }

    /// Checks more of every value that comes over the bus from now on, or less.
    pub const fn check(&mut self, checks: Checks) {
        self.host.check(checks);
    }

    /// Puts a value as the device itself does, such as one that it has measured: whatever a client may write. An entry that an
    /// event-driven TPDO carries is sent.
    ///
    /// # Errors
    /// Why the entry cannot have it. Communication objects are set over the bus alone.
    pub fn set(&mut self, entry: EntryId, value: &[u8], now: u64) -> Result<(), AbortCode> {
        let table = self.dictionary.table();
        if table.find(entry.index, entry.sub)? < table.parts().first_application_row {
            return Err(AbortCode::UNSUPPORTED_ACCESS);
        }
        self.dictionary.hold(entry, value)?;
        self.node.trigger_entry(&self.dictionary, entry, Instant::from_micros(now));
        Ok(())
    }

    /// An error of the device occurs: it is in 1001h and 1003h, and an emergency message reports it.
    pub fn raise(&mut self, emergency: Emergency, now: u64) -> Raised {
        let raised = self.node.raise(&mut self.dictionary, emergency);
        self.error_register_changed(now);
        raised
    }

    /// An error of the device, by its code, is gone. `false` if it was not present.
    pub fn clear(&mut self, code: u16, now: u64) -> bool {
        let was_present = self.node.clear(&mut self.dictionary, code);
        self.error_register_changed(now);
        was_present
    }

    /// The errors that are present.
    pub fn errors(&self) -> impl Iterator<Item = Emergency> {
        self.node.emergencies().present()
    }

    fn error_register_changed(&mut self, now: u64) {
        if let Ok(entry) = self.dictionary.find(0x1001, 0) {
            self.node.trigger_entry(&self.dictionary, entry, Instant::from_micros(now));
        }
    }

    /// What has happened to the application.
    fn follow(&mut self, now: u64) {
        if self.host.has_restarted() {
            let size = self.dictionary.table().largest_value();
            let channels = (1..=127).filter_map(|number| Channel::of_server(&self.dictionary, number));
            self.further = channels.map(|channel| SdoServer::new(channel, vec![0; size])).collect();
        } else if !self.node.state().allows(Service::Sdo) {
            self.further.iter_mut().for_each(SdoServer::reset);
        }
        for entry in self.host.changed() {
            self.node.trigger_entry(&self.dictionary, entry, Instant::from_micros(now));
        }
    }
}
