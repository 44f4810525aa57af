//! The application's part in a node.

use crate::abort::AbortCode;
use crate::access::application::Application;
use crate::access::application::Entries;
use crate::access::command::Command;
use crate::access::constraint::{Consistent, Constrained};
use crate::bus::node_id::NodeId;
use crate::emcy::{Emergency, EmergencyProducer};
use crate::lss::{LssEvent, LssHandler};
use crate::nmt::{Guarding, NodeEvent, State};
use crate::pdo::engine::{PdoEvent, PdoHandler};

/// What starts again.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Reset {
    /// The whole device: power-on, or "reset node".
    Node,
    /// The communication: "reset communication", or another node-ID by LSS.
    Communication,
}

/// Something that happened to the node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Event {
    /// It is in another state.
    State(State),
    /// Something happened to a node that 1016h watches.
    Heartbeat(NodeEvent),
    /// Something happened to the master that guards this node.
    Guarding(Guarding),
    /// A node that 1028h names reports an error, or, with the code 0000h, that one is gone.
    Emergency(NodeId, Emergency),
    /// The bit rate is to be switched.
    Lss(LssEvent),
}

/// An application with a node.
pub trait NodeHandler<D: Entries>: PdoHandler<D> + LssHandler {
    /// Called when the node starts again, before its boot-up message: the dictionary has the factory's values, of the communication objects alone
    /// if only the communication starts again. What the device keeps by itself ([`Storage::Remanent`](crate::Storage::Remanent)) is as it was: put in what your memory has
    /// of it before the node starts for the first time. The moment to load stored parameters, to put in what the device finds out
    /// about itself (serial number), and, at [`Reset::Node`], to bring the application to its beginning.
    fn restart(&mut self, dictionary: &mut D, node: NodeId, reset: Reset) {
        let _ = (dictionary, node, reset);
    }

    /// Called when something happened.
    fn node_event(&mut self, dictionary: &mut D, event: Event) {
        let _ = (dictionary, event);
    }
}

impl<D: Entries> NodeHandler<D> for () {}

impl<D: Constrained, A: NodeHandler<D>> NodeHandler<D> for Consistent<'_, A> {
    fn restart(&mut self, dictionary: &mut D, node: NodeId, reset: Reset) {
        self.0.restart(dictionary, node, reset);
    }

    fn node_event(&mut self, dictionary: &mut D, event: Event) {
        self.0.node_event(dictionary, event);
    }
}

/// The application, as PDOs see it: what goes wrong with them is an emergency, too.
pub(super) struct WithEmergencies<'a, A, const ERRORS: usize> {
    pub application: &'a mut A,
    pub emergencies: &'a mut EmergencyProducer<ERRORS>,
}

impl<'t, D: crate::access::dictionary::Dictionary<'t>, A: PdoHandler<D>, const ERRORS: usize> PdoHandler<D>
    for WithEmergencies<'_, A, ERRORS>
{
    fn pdo_event(&mut self, dictionary: &mut D, event: PdoEvent<D::Entry>) {
        let numbered = |emergency: Emergency, number: u16| {
            let [low, high] = number.to_le_bytes();
            emergency.with_details([low, high, 0, 0, 0])
        };
        match event {
            PdoEvent::TooShort { number } => {
                self.emergencies.raise(dictionary, numbered(Emergency::PDO_LENGTH, number));
            }
            PdoEvent::TooLong { number } => {
                self.emergencies.raise(dictionary, numbered(Emergency::PDO_TOO_LONG, number));
            }
            PdoEvent::SyncLength { .. } => {
                self.emergencies.raise(dictionary, Emergency::SYNC_LENGTH);
            }
            PdoEvent::Overdue { number } => {
                self.emergencies.raise(dictionary, numbered(Emergency::RPDO_TIMEOUT, number));
            }
            PdoEvent::Received { .. }
            | PdoEvent::NotReceived { .. }
            | PdoEvent::Resumed { .. }
            | PdoEvent::CameLate { .. }
            | PdoEvent::NotSentInTime { .. }
            | PdoEvent::NotSent { .. } => {}
        }
        self.application.pdo_event(dictionary, event);
    }
}

impl<D: Entries, A: Application<D>, const ERRORS: usize> Application<D> for WithEmergencies<'_, A, ERRORS> {
    fn is_unlocked(&self) -> bool {
        self.application.is_unlocked()
    }

    fn refresh(&mut self, dictionary: &mut D, entry: D::Entry) {
        self.application.refresh(dictionary, entry);
    }

    fn accept(&mut self, dictionary: &mut D, entry: D::Entry, value: &[u8]) -> Result<(), AbortCode> {
        self.application.accept(dictionary, entry, value)
    }

    fn command(&mut self, dictionary: &mut D, command: Command) -> Result<(), AbortCode> {
        self.application.command(dictionary, command)
    }

    fn changed(&mut self, dictionary: &mut D, entry: D::Entry) {
        self.application.changed(dictionary, entry);
    }

    fn read_domain(
        &mut self,
        dictionary: &mut D,
        entry: D::Entry,
        offset: u32,
        buffer: &mut [u8],
    ) -> Result<usize, AbortCode> {
        self.application.read_domain(dictionary, entry, offset, buffer)
    }

    fn write_domain(
        &mut self,
        dictionary: &mut D,
        entry: D::Entry,
        offset: u32,
        data: &[u8],
        last: bool,
    ) -> Result<(), AbortCode> {
        self.application.write_domain(dictionary, entry, offset, data, last)
    }
}
