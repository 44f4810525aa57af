//! A whole CANopen node: SDO server, PDOs, SYNC, NMT, heartbeat and guarding, emergencies and LSS together, by the states of CiA 301 9.3.
//!
//! A firmware gives every frame it receives to [`Node::handle`] and sends the answer; it calls [`Node::poll`] until there is nothing to
//! send, whenever something has happened or [`Node::next_deadline`] has come. The dictionary stays the firmware's.
//!
//! ```
//! # use firmware_glue::table::{Attributes, Block, Directory, EntryRow, Flags, NONE, Parts, Place};
//! # use firmware_glue::{DataType, Storage, Table, TableDictionary};
//! use firmware_glue::clock::Instant;
//! use firmware_glue::frame::{CanId, Frame};
//! use firmware_glue::nmt::State;
//! use firmware_glue::node::{Room, UpTo};
//! use firmware_glue::{Node, NodeId};
//! # const TIME: Attributes = Attributes {
//! #     data_type: DataType::Unsigned16, flags: Flags::READ.with(Flags::WRITE), place: Place::Image,
//! #     storage: Storage::No, page: 0, size: 2, limits: NONE, values: NONE, condition: NONE,
//! # };
//! # let (mut blocks, mut seeds, mut order) = ([Block::FREE; 1], [0; 1], [0; 1]);
//! # let table = Table::checked(Parts {
//! #     directory: Directory::arrange(&[0x1017], &mut blocks, &mut seeds, &mut order).ok_or("no room")?,
//! #     objects: &[0, 1], entries: &[EntryRow { attributes: 0, place: 0 }], attributes: &[TIME],
//! #     first_application_row: 1, factory: &[0xE8, 3], ..Parts::EMPTY
//! # })?;
//! # let mut dictionary = TableDictionary::new(&table, [0; 2], 1)?;
//!
//! let room = Room {
//!     tpdos: UpTo::<4>,
//!     rpdos: UpTo::<4>,
//!     errors: UpTo::<8>,
//!     watched: UpTo::<2>,
//!     sdo_buffer: [0; 64],
//! };
//! let mut node = Node::new(&table, NodeId::new(5), room)?;
//! let boot_up = node.poll(&mut dictionary, &mut (), Instant::from_millis(10));
//! assert_eq!(boot_up.map(|frame| frame.id().get()), Some(0x705));
//!
//! let start = Frame::data(CanId::new(0).ok_or("11 bits")?, &[1, 5]).ok_or("8 bytes")?;
//! assert_eq!(node.handle(&start, &mut dictionary, &mut (), Instant::from_millis(20)), None);
//! assert_eq!(node.state(), State::Operational);
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```

mod handler;
mod room;
#[cfg(test)]
mod tests;

pub use handler::{Event, NodeHandler, Reset};
pub use room::{NoRoom, Room, UpTo};

use crate::access::dictionary::Dictionary;
use crate::access::parameters::Parameters;
use crate::bus::clock::{Instant, earlier};
use crate::bus::frame::Frame;
use crate::bus::node_id::NodeId;
use crate::emcy::{self, Emergency, EmergencyProducer, Raised};
use crate::lss::{Identity, Lss, LssEvent, LssState, MaybeNode};
use crate::nmt::{
    Command, Consumer, ErrorBehaviour, ErrorControl, Nmt, NodeEvent, Service, State, Transition,
};
use crate::node::handler::WithEmergencies;
use crate::pdo::engine::PdoEngine;
use crate::sdo::{Channel, SdoServer};
use crate::sync::{Sync, SyncProducer};
use crate::table::stored::reset;
use crate::table::{Region, Storage, Table};

/// A node with up to `T` TPDOs, `R` RPDOs, `ERRORS` errors at the same time and `WATCHED` monitored nodes. [`Room`] names these
/// numbers, and the buffer `B` of the SDO server.
#[derive(Debug)]
pub struct Node<B, const T: usize, const R: usize, const ERRORS: usize, const WATCHED: usize> {
    nmt: Nmt,
    /// What starts again with the next poll.
    restart: Option<Reset>,
    control: ErrorControl,
    consumer: Consumer<WATCHED>,
    pdos: PdoEngine<T, R>,
    sync: SyncProducer,
    emergencies: EmergencyProducer<ERRORS>,
    sdo: SdoServer<B>,
    lss: Lss,
    /// The node-ID that counts now.
    id: MaybeNode,
}

impl<B: AsRef<[u8]> + AsMut<[u8]>, const T: usize, const R: usize, const ERRORS: usize, const WATCHED: usize>
    Node<B, T, R, ERRORS, WATCHED>
{
    /// A node that starts with the first poll. Without a node-ID, it takes part in nothing but LSS until a master gives it one.
    ///
    /// # Errors
    /// [`NoRoom`] when the dictionary has more than `T` TPDOs or `R` RPDOs, or watches more than `WATCHED` nodes.
    pub fn new(
        table: &Table<'_>,
        id: MaybeNode,
        room: Room<B, T, R, ERRORS, WATCHED>,
    ) -> Result<Self, NoRoom> {
        let watched = watchable(table);
        if watched > WATCHED {
            return Err(NoRoom::Watched(watched));
        }
        // Before the node is made: what is large is moved as little as can be.
        PdoEngine::<T, R>::check(table).map_err(NoRoom::Pdos)?;
        Ok(Self {
            nmt: Nmt::new(),
            restart: Some(Reset::Node),
            control: ErrorControl::new(),
            consumer: Consumer::new(),
            pdos: PdoEngine::resting(),
            sync: SyncProducer::new(),
            emergencies: EmergencyProducer::new(),
            sdo: SdoServer::new(NO_CHANNEL, room.sdo_buffer),
            lss: Lss::new(id),
            id,
        })
    }

    /// Its state.
    pub const fn state(&self) -> State {
        self.nmt.state()
    }

    /// Its node-ID, if it has one.
    pub const fn id(&self) -> MaybeNode {
        self.id
    }

    /// Whether a service runs now: for what the firmware has in addition to the node, such as more SDO servers (1201h
    /// to 127Fh).
    pub const fn serves(&self, service: Service) -> bool {
        self.id.is_some() && self.restart.is_none() && !self.lss.is_silent() && self.state().allows(service)
    }

    /// Its SDO server, for settings of it.
    pub const fn sdo_mut(&mut self) -> &mut SdoServer<B> {
        &mut self.sdo
    }

    /// The nodes whose heartbeats it hears.
    pub const fn consumer(&self) -> &Consumer<WATCHED> {
        &self.consumer
    }

    /// The errors that are present.
    pub const fn emergencies(&self) -> &EmergencyProducer<ERRORS> {
        &self.emergencies
    }

    /// An error of the device occurs. The codes 8130h (heartbeat), 8210h, 8220h (length of an RPDO), 8240h (length of a SYNC) and 8250h
    /// (RPDO overdue) belong to the node.
    pub fn raise<'t, D: Dictionary<'t>>(&mut self, dictionary: &mut D, emergency: Emergency) -> Raised {
        self.emergencies.raise(dictionary, emergency)
    }

    /// An error of the device, by its code, is gone. `false` if it was not present.
    pub fn clear<'t, D: Dictionary<'t>>(&mut self, dictionary: &mut D, code: u16) -> bool {
        self.emergencies.clear(dictionary, code)
    }

    /// Every error of the device is gone, also those that there was no room for ([`Raised::NotKept`]); what the node itself finds wrong stays.
    /// `false` if there was no such error.
    pub fn clear_all<'t, D: Dictionary<'t>>(&mut self, dictionary: &mut D) -> bool {
        self.emergencies.clear_all_but(dictionary, |code| OWN_ERRORS.contains(&code))
    }

    /// An event of a TPDO, 1 to 512; see [`PdoEngine::trigger`].
    pub fn trigger<'t, D: Dictionary<'t>>(&mut self, dictionary: &D, number: u16, now: Instant) {
        self.pdos.trigger(dictionary, number, now);
    }

    /// An entry has changed: an event of every TPDO that carries it.
    pub fn trigger_entry<'t, D: Dictionary<'t>>(&mut self, dictionary: &D, entry: D::Entry, now: Instant) {
        self.pdos.trigger_entry(dictionary, entry, now);
    }

    /// A communication error that the CAN driver found, such as bus off: the node does what 1029h.1 says.
    pub fn communication_error<'t, D: Dictionary<'t>, A: NodeHandler<D>>(
        &mut self,
        dictionary: &mut D,
        application: &mut A,
        now: Instant,
    ) {
        let transition = self.nmt.error(ErrorBehaviour::of(dictionary, 1));
        self.follow(transition, dictionary, application, now);
    }

    /// Takes a frame that was received; the answer, if it needs one.
    pub fn handle<'t, D: Dictionary<'t>, A: NodeHandler<D>>(
        &mut self,
        frame: &Frame,
        dictionary: &mut D,
        application: &mut A,
        now: Instant,
    ) -> Option<Frame> {
        // Not while the node works: LSS sets up, and may switch the bit rate.
        if dictionary.is_lss_slave()
            && self.state() != State::Operational
            && let Some(answer) = self.lss.handle(frame, Identity::of(dictionary), application, now)
        {
            return Some(answer);
        }
        let id = self.id?;
        if self.restart.is_some() || self.is_silent(dictionary) {
            return None;
        }
        if let Some(command) = Command::of(frame, id) {
            let transition = self.nmt.command(command);
            self.follow(transition, dictionary, application, now);
            return None;
        }
        if let Some(event) = self.consumer.handle(frame, dictionary, now) {
            application.node_event(dictionary, Event::Heartbeat(event));
        }
        if self.state().allows(Service::Emergency)
            && let Some((node, emergency)) = emcy::heard(frame, dictionary)
        {
            application.node_event(dictionary, Event::Emergency(node, emergency));
            return None;
        }
        if let Some((answer, event)) = self.control.guard(frame, dictionary, id, self.state(), now) {
            if let Some(event) = event {
                application.node_event(dictionary, Event::Guarding(event));
            }
            return Some(answer);
        }
        if self.state().allows(Service::Pdo) {
            let emergencies = &mut self.emergencies;
            self.pdos.handle(frame, dictionary, &mut WithEmergencies { application, emergencies }, now);
        }
        if !self.state().allows(Service::Sdo) {
            return None;
        }
        // The type of application that PDOs have: what is written is checked by the same code.
        let emergencies = &mut self.emergencies;
        self.sdo.handle(frame, dictionary, &mut WithEmergencies { application, emergencies }, now)
    }

    /// A frame that is to be sent now; to be called until there is none.
    pub fn poll<'t, D: Dictionary<'t>, A: NodeHandler<D>>(
        &mut self,
        dictionary: &mut D,
        application: &mut A,
        now: Instant,
    ) -> Option<Frame> {
        if dictionary.is_lss_slave() {
            self.poll_lss(dictionary, application, now);
        }
        let id = self.id?;
        if self.is_silent(dictionary) {
            return None;
        }
        if let Some(reset) = self.restart.take() {
            return self.start(reset, dictionary, application, now);
        }
        self.watch(dictionary, application, now);
        if let Some(heartbeat) = self.control.poll(dictionary, id, self.state(), now) {
            return Some(heartbeat);
        }
        if self.state().allows(Service::Sync)
            && let Some(Sync { frame, counter }) = self.sync.poll(dictionary, now)
        {
            let emergencies = &mut self.emergencies;
            self.pdos.sync(counter, dictionary, &mut WithEmergencies { application, emergencies }, now);
            return Some(frame);
        }
        if let Some(emergency) = self.emergency(dictionary, now) {
            return Some(emergency);
        }
        let emergencies = &mut self.emergencies;
        let pdo = self.pdos.poll(dictionary, &mut WithEmergencies { application, emergencies }, now);
        // Looking for a PDO may have found one that is overdue.
        if let Some(frame) = pdo.or_else(|| self.emergency(dictionary, now)) {
            return Some(frame);
        }
        if !self.state().allows(Service::Sdo) {
            return None;
        }
        let emergencies = &mut self.emergencies;
        self.sdo.poll(dictionary, &mut WithEmergencies { application, emergencies }, now)
    }

    /// Does what is due of LSS.
    fn poll_lss<'t, D: Dictionary<'t>, A: NodeHandler<D>>(
        &mut self,
        dictionary: &mut D,
        application: &mut A,
        now: Instant,
    ) {
        while let Some(event) = self.lss.poll(now) {
            if event == LssEvent::Switched {
                // All were silent: a watched node is watched from the next frame on.
                self.consumer = Consumer::new();
                self.control.forget_master();
            }
            application.node_event(dictionary, Event::Lss(event));
        }
        // A node that had no node-ID starts as soon as the master has given it one and lets it go.
        if self.id.is_none() && self.lss.pending().is_some() && self.lss.state() == LssState::Waiting {
            self.restart = Some(Reset::Node);
            self.id = self.lss.pending();
        }
    }

    /// Whether LSS switches the bit rate.
    fn is_silent<'t, D: Dictionary<'t>>(&self, dictionary: &D) -> bool {
        dictionary.is_lss_slave() && self.lss.is_silent()
    }

    /// When there is something to do next, unless a frame comes or something happens before; a time that has passed means at once.
    pub fn next_deadline<'t, D: Dictionary<'t>>(&self, dictionary: &D) -> Option<Instant> {
        let lss = if dictionary.is_lss_slave() { self.lss.next_deadline() } else { None };
        if self.is_silent(dictionary) || self.id.is_none() {
            return lss;
        }
        if self.restart.is_some() {
            return Some(Instant::ZERO);
        }
        let mut next = earlier(lss, self.control.next_deadline(dictionary));
        if Parameters::of(dictionary).has(0x1016) {
            next = earlier(next, self.consumer.next_deadline());
        }
        if self.state().allows(Service::Emergency) {
            next = earlier(next, self.emergencies.next_deadline(dictionary));
        }
        if self.state().allows(Service::Sync) {
            next = earlier(next, self.sync.next_deadline(dictionary));
        }
        next = earlier(next, self.pdos.next_deadline(dictionary));
        earlier(next, self.sdo.next_deadline())
    }

    /// An emergency message that is to be sent now.
    fn emergency<'t, D: Dictionary<'t>>(&mut self, dictionary: &D, now: Instant) -> Option<Frame> {
        if self.state().allows(Service::Emergency) { self.emergencies.poll(dictionary, now) } else { None }
    }

    /// Looks at the nodes that this one relies on, and whether what was wrong still is.
    fn watch<'t, D: Dictionary<'t>, A: NodeHandler<D>>(
        &mut self,
        dictionary: &mut D,
        application: &mut A,
        now: Instant,
    ) {
        while let Some(event) = self.consumer.poll(dictionary, now) {
            if let NodeEvent::Lost(node) = event {
                let emergency = Emergency::HEARTBEAT.with_details([node.get(), 0, 0, 0, 0]);
                self.emergencies.raise(dictionary, emergency);
                self.communication_error(dictionary, application, now);
            }
            application.node_event(dictionary, Event::Heartbeat(event));
        }
        if let Some(event) = self.control.check_life(dictionary, now) {
            self.emergencies.raise(dictionary, Emergency::HEARTBEAT);
            self.communication_error(dictionary, application, now);
            application.node_event(dictionary, Event::Guarding(event));
        }
        let is_any_lost = Parameters::of(dictionary).has(0x1016) && self.consumer.is_any_lost();
        if !is_any_lost && !self.control.is_lost() {
            self.emergencies.clear(dictionary, Emergency::HEARTBEAT.code());
        }
        for (goes_on, error) in [
            (self.pdos.is_any_overdue(), Emergency::RPDO_TIMEOUT),
            (self.pdos.is_any_too_short(), Emergency::PDO_LENGTH),
            (self.pdos.is_any_too_long(), Emergency::PDO_TOO_LONG),
            (self.pdos.is_sync_wrong(), Emergency::SYNC_LENGTH),
        ] {
            if !goes_on {
                self.emergencies.clear(dictionary, error.code());
            }
        }
    }

    /// What a change of state brings with it.
    fn follow<'t, D: Dictionary<'t>, A: NodeHandler<D>>(
        &mut self,
        transition: Transition,
        dictionary: &mut D,
        application: &mut A,
        now: Instant,
    ) {
        match transition {
            Transition::None => return,
            Transition::To(State::Operational) => {
                self.lss.leave();
                self.pdos.start(dictionary, now);
            }
            Transition::To(state) => {
                self.pdos.stop();
                if !state.allows(Service::Sdo) {
                    self.sdo.reset();
                }
                if !state.allows(Service::Sync) {
                    self.sync.stop();
                }
            }
            Transition::ResetNode => self.restart = Some(Reset::Node),
            Transition::ResetCommunication => self.restart = Some(Reset::Communication),
        }
        if self.restart.is_some() {
            self.sync.stop();
            self.pdos.stop();
            self.sdo.reset();
        }
        application.node_event(dictionary, Event::State(self.state()));
    }

    /// Starts again: values, then communication, then the boot-up message.
    fn start<'t, D: Dictionary<'t>, A: NodeHandler<D>>(
        &mut self,
        kind: Reset,
        dictionary: &mut D,
        application: &mut A,
        now: Instant,
    ) -> Option<Frame> {
        self.id = self.lss.reset();
        let id = self.id?;
        match kind {
            Reset::Node => {
                reset_all(dictionary, id);
                self.emergencies = EmergencyProducer::new();
            }
            Reset::Communication => reset_communication(dictionary, id),
        }
        application.restart(dictionary, id, kind);
        self.consumer = Consumer::new();
        self.sdo.set_channel(channel(dictionary, id));
        let boot_up = self.control.boot_up(dictionary, id, now);
        self.nmt.booted();
        application.node_event(dictionary, Event::State(self.state()));
        Some(boot_up)
    }
}

/// Codes of errors that the node finds by itself, and clears as they end.
const OWN_ERRORS: [u16; 5] = [
    Emergency::HEARTBEAT.code(),
    Emergency::PDO_LENGTH.code(),
    Emergency::PDO_TOO_LONG.code(),
    Emergency::SYNC_LENGTH.code(),
    Emergency::RPDO_TIMEOUT.code(),
];

/// The highest sub-index of 1016h: as many nodes can be watched.
fn watchable(table: &Table<'_>) -> usize {
    let last = table.object(0x1016).ok().and_then(Iterator::last);
    last.map_or(0, |row| table.id(row).sub.into())
}

/// The channel of an SDO server before the first reset, when no frame is taken.
const NO_CHANNEL: Channel =
    Channel { request: crate::bus::frame::CanId::ZERO, answer: crate::bus::frame::CanId::ZERO };

/// The first SDO channel: every node has one, so that of the predefined connection set where 1200h names none.
fn channel<'t, D: Dictionary<'t>>(dictionary: &D, id: NodeId) -> Channel {
    Channel::of_server(dictionary, 0).unwrap_or(Channel::predefined(id))
}

/// Puts every value back to the factory's, except those that the device keeps by itself ([`Storage::Remanent`]).
fn reset_all<'t, D: Dictionary<'t>>(dictionary: &mut D, id: NodeId) {
    let table = dictionary.table();
    let kept = table.region(Storage::Remanent).map_or(0..0, Region::range);
    for part in [0..kept.start, kept.end..usize::MAX] {
        reset(table, dictionary.image_mut(), &part, id.get());
    }
}

/// Puts communication objects back to the factory's values, those that are not stored among them, except what other
/// commands store, and the errors that are present and those that were (1001h to 1003h): they outlive a reset of the
/// communication.
fn reset_communication<'t, D: Dictionary<'t>>(dictionary: &mut D, id: NodeId) {
    let table = dictionary.table();
    for row in 0..table.parts().first_application_row {
        let found = table.found(row);
        let is_reset = matches!(found.shared.storage, Storage::No | Storage::Communication)
            && !matches!(table.id(row).index, 0x1001..=0x1003);
        if let Some(place) = found.place_in_image().filter(|_| is_reset) {
            reset(table, dictionary.image_mut(), &place, id.get());
        }
    }
}
