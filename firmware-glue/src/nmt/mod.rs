//! NMT: what state a node is in, and what it may do there (CiA 301 9.2.6 and 9.3).
//!
//! ```
//! use firmware_glue::NodeId;
//! use firmware_glue::frame::{CanId, Frame};
//! use firmware_glue::nmt::{Command, Nmt, Service, State, Transition};
//!
//! let node = NodeId::new(5).ok_or("1 to 127")?;
//! let mut nmt = Nmt::new();
//! nmt.booted();
//! let start = Frame::data(CanId::new(0).ok_or("11 bits")?, &[1, 5]).ok_or("8 bytes")?;
//! let command = Command::of(&start, node).ok_or("a command for node 5")?;
//! assert_eq!(nmt.command(command), Transition::To(State::Operational));
//! assert!(nmt.state().allows(Service::Pdo));
//! # Ok::<(), &str>(())
//! ```

mod consumer;
mod error_control;

pub use consumer::{Consumer, Heartbeat, NodeEvent};
pub use error_control::{ErrorControl, Guarding};

use crate::access::dictionary::Dictionary;
use crate::access::parameters::Parameters;
use crate::bus::frame::Frame;
use crate::bus::node_id::NodeId;

/// Base of the identifiers of heartbeat, boot-up and guarding (CiA 301 table 34).
const ERROR_CONTROL: u16 = 0x700;

/// The state of a node (CiA 301 9.3).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum State {
    /// It starts: nothing is served, until the boot-up message ends this state.
    #[default]
    Initialising,
    /// It can be set up: everything but PDOs.
    PreOperational,
    /// It works.
    Operational,
    /// It does nothing but NMT and error control.
    Stopped,
}

impl State {
    /// The state as heartbeats and guarding carry it; 0 is that of the boot-up message.
    #[must_use]
    pub const fn code(self) -> u8 {
        match self {
            Self::Initialising => 0,
            Self::Stopped => 4,
            Self::Operational => 5,
            Self::PreOperational => 127,
        }
    }

    /// The state of a code in a heartbeat; `None` of a code without one.
    #[must_use]
    pub const fn of_code(code: u8) -> Option<Self> {
        match code {
            0 => Some(Self::Initialising),
            4 => Some(Self::Stopped),
            5 => Some(Self::Operational),
            127 => Some(Self::PreOperational),
            _ => None,
        }
    }

    /// Whether a service runs in this state (CiA 301 table 32).
    #[must_use]
    pub const fn allows(self, service: Service) -> bool {
        match (self, service) {
            (Self::Initialising, _) | (Self::PreOperational, Service::Pdo) => false,
            (Self::PreOperational | Self::Operational, _) => true,
            (Self::Stopped, Service::Nmt | Service::ErrorControl) => true,
            (
                Self::Stopped,
                Service::Sdo | Service::Sync | Service::Time | Service::Emergency | Service::Pdo,
            ) => false,
        }
    }
}

/// A service of CANopen, which depends on the state.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Service {
    /// PDO.
    Pdo,
    /// SDO.
    Sdo,
    /// SYNC.
    Sync,
    /// TIME.
    Time,
    /// EMCY.
    Emergency,
    /// NMT commands.
    Nmt,
    /// Heartbeat and node guarding.
    ErrorControl,
}

/// What an NMT master commands a node to do (CiA 301 9.2.6.2).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Command {
    /// 1: to operational.
    Start,
    /// 2: to stopped.
    Stop,
    /// 128: to pre-operational.
    EnterPreOperational,
    /// 129: the whole device starts again.
    ResetNode,
    /// 130: the communication starts again, with the communication parameters of power-on.
    ResetCommunication,
}

impl Command {
    /// The command in a frame, if it is one and is for a node: for it alone, or for all (node-ID 0).
    #[must_use]
    pub fn of(frame: &Frame, node: NodeId) -> Option<Self> {
        let (0, Some(&[command, target])) = (frame.id().get(), frame.bytes()) else { return None };
        if target != 0 && target != node.get() {
            return None;
        }
        match command {
            1 => Some(Self::Start),
            2 => Some(Self::Stop),
            128 => Some(Self::EnterPreOperational),
            129 => Some(Self::ResetNode),
            130 => Some(Self::ResetCommunication),
            _ => None,
        }
    }
}

/// What a command or an error did.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Transition {
    /// Nothing: the node is in that state already, or does not take commands yet.
    None,
    /// The node is in another state.
    To(State),
    /// The device has to start again: parameters of power-on everywhere, then communication, then [`Nmt::booted`].
    ResetNode,
    /// The communication has to start again: communication parameters of power-on, then [`Nmt::booted`].
    ResetCommunication,
}

/// What 1029h makes a node do when an error occurs (CiA 301 9.6.3, 1029h).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum ErrorBehaviour {
    /// 0: to pre-operational, from operational only.
    PreOperational,
    /// 1: no other state.
    Stay,
    /// 2: to stopped.
    Stopped,
    /// 128 and above: what the manufacturer says; the application does it. Reserved values are here, too: nothing is done.
    Other(u8),
}

impl ErrorBehaviour {
    /// What a dictionary says: sub-index 1 for communication errors (bus off, a heartbeat or the guarding lost), others for
    /// those of the device profile. Where nothing is said, it is pre-operational.
    pub fn of<'t, D: Dictionary<'t>>(dictionary: &D, sub: u8) -> Self {
        match Parameters::of(dictionary).byte(0x1029, sub) {
            0 => Self::PreOperational,
            1 => Self::Stay,
            2 => Self::Stopped,
            other => Self::Other(other),
        }
    }
}

/// The state machine of a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Nmt(State);

impl Nmt {
    /// A node that starts.
    #[must_use]
    pub const fn new() -> Self {
        Self(State::Initialising)
    }

    /// Its state.
    #[must_use]
    pub const fn state(self) -> State {
        self.0
    }

    /// The node has started and sends its boot-up message: it goes to pre-operational by itself.
    pub fn booted(&mut self) {
        if self.0 == State::Initialising {
            self.0 = State::PreOperational;
        }
    }

    /// Carries out a command. A node that starts takes none.
    pub fn command(&mut self, command: Command) -> Transition {
        match (self.0, command) {
            (State::Initialising, _) => Transition::None,
            (_, Command::Start) => self.enter(State::Operational),
            (_, Command::Stop) => self.enter(State::Stopped),
            (_, Command::EnterPreOperational) => self.enter(State::PreOperational),
            (_, Command::ResetNode) => {
                self.0 = State::Initialising;
                Transition::ResetNode
            }
            (_, Command::ResetCommunication) => {
                self.0 = State::Initialising;
                Transition::ResetCommunication
            }
        }
    }

    /// Does what 1029h says about an error.
    pub fn error(&mut self, behaviour: ErrorBehaviour) -> Transition {
        match (self.0, behaviour) {
            (State::Operational, ErrorBehaviour::PreOperational) => self.enter(State::PreOperational),
            (State::Operational | State::PreOperational, ErrorBehaviour::Stopped) => {
                self.enter(State::Stopped)
            }
            (State::Initialising | State::Stopped, _)
            | (State::PreOperational, ErrorBehaviour::PreOperational)
            | (_, ErrorBehaviour::Stay | ErrorBehaviour::Other(_)) => Transition::None,
        }
    }

    fn enter(&mut self, state: State) -> Transition {
        if self.0 == state {
            return Transition::None;
        }
        self.0 = state;
        Transition::To(state)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::access::test_table::{dictionary, value};
    use crate::bus::frame::CanId;

    const STATES: [State; 4] =
        [State::Initialising, State::PreOperational, State::Operational, State::Stopped];
    const COMMANDS: [Command; 5] = [
        Command::Start,
        Command::Stop,
        Command::EnterPreOperational,
        Command::ResetNode,
        Command::ResetCommunication,
    ];

    fn frame(id: u16, data: &[u8]) -> Frame {
        Frame::data(CanId::new(id).expect("11 bits"), data).expect("8 bytes")
    }

    #[test]
    fn every_command_in_every_state() {
        for state in STATES {
            for command in COMMANDS {
                let mut nmt = Nmt(state);
                let target = match command {
                    Command::Start => State::Operational,
                    Command::Stop => State::Stopped,
                    Command::EnterPreOperational => State::PreOperational,
                    Command::ResetNode | Command::ResetCommunication => State::Initialising,
                };
                let expected = match (state, command) {
                    (State::Initialising, _) => Transition::None,
                    (_, Command::ResetNode) => Transition::ResetNode,
                    (_, Command::ResetCommunication) => Transition::ResetCommunication,
                    _ if state == target => Transition::None,
                    _ => Transition::To(target),
                };
                assert_eq!(nmt.command(command), expected, "{state:?} {command:?}");
                assert_eq!(nmt.state(), if state == State::Initialising { state } else { target });
            }
        }
    }

    #[test]
    fn commands_are_for_one_node_or_all_and_have_two_bytes() {
        let node = NodeId::new(5).expect("a node-ID");
        for specifier in 0..=255 {
            for target in 0..=255 {
                let command = Command::of(&frame(0, &[specifier, target]), node);
                let known = matches!(specifier, 1 | 2 | 128..=130);
                assert_eq!(command.is_some(), known && matches!(target, 0 | 5), "{specifier} {target}");
            }
        }
        for data in [&[][..], &[1], &[1, 5, 0]] {
            assert_eq!(Command::of(&frame(0, data), node), None);
        }
        assert_eq!(Command::of(&frame(1, &[1, 5]), node), None);
        let remote = Frame::remote(CanId::new(0).expect("11 bits"), 2).expect("a length");
        assert_eq!(Command::of(&remote, node), None);
    }

    #[test]
    fn services_by_state() {
        use Service::{Emergency, ErrorControl, Nmt, Pdo, Sdo, Sync, Time};
        for service in [Pdo, Sdo, Sync, Time, Emergency, Nmt, ErrorControl] {
            assert!(!State::Initialising.allows(service));
            assert!(State::Operational.allows(service));
            assert_eq!(State::PreOperational.allows(service), service != Pdo);
            assert_eq!(State::Stopped.allows(service), matches!(service, Nmt | ErrorControl));
        }
    }

    #[test]
    fn codes_of_states_come_back() {
        for code in 0..=255 {
            assert!(State::of_code(code).is_none_or(|state| state.code() == code));
        }
        for state in STATES {
            assert_eq!(State::of_code(state.code()), Some(state));
        }
    }

    #[test]
    fn an_error_does_what_1029h_says() {
        for (setting, from, expected) in [
            (0, State::Operational, Transition::To(State::PreOperational)),
            (0, State::PreOperational, Transition::None),
            (0, State::Stopped, Transition::None),
            (1, State::Operational, Transition::None),
            (2, State::Operational, Transition::To(State::Stopped)),
            (2, State::PreOperational, Transition::To(State::Stopped)),
            (2, State::Initialising, Transition::None),
            (200, State::Operational, Transition::None),
        ] {
            let dictionary = dictionary(&[value(0x1029, 0, 1, 1), value(0x1029, 1, 1, setting)]);
            let mut nmt = Nmt(from);
            assert_eq!(nmt.error(ErrorBehaviour::of(&dictionary, 1)), expected, "{setting} {from:?}");
        }
        let without = dictionary(&[value(0x1000, 0, 4, 0)]);
        assert_eq!(ErrorBehaviour::of(&without, 1), ErrorBehaviour::PreOperational);
    }
}
