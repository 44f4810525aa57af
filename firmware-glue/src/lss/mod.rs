//! LSS slave: node-ID and bit rate of a node that a master knows by its identity (CiA 305).
//!
//! The machine changes nothing by itself: it says what the master wants ([`LssEvent`]), and the firmware answers what it could do.

use crate::access::constraint::Consistent;
use crate::access::dictionary::Dictionary;
use crate::access::parameters::Parameters;
use crate::bus::clock::{Duration, Instant};
use crate::bus::frame::{CanId, Frame};
use crate::bus::node_id::NodeId;

/// Identifier of the master's requests. A [`Node`](crate::Node) answers them if its device [has LSS](crate::Dictionary::is_lss_slave).
pub const REQUEST: u16 = 0x7E5;
/// Identifier of the slave's answers.
const ANSWER: u16 = 0x7E4;

/// A node-ID, or none: a node without one takes part in nothing but LSS. On the bus, 255 means none.
pub type MaybeNode = Option<NodeId>;

/// The identity of a node: 1018h.1 to 1018h.4.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Identity {
    /// Vendor-ID.
    pub vendor: u32,
    /// Product code.
    pub product: u32,
    /// Revision number.
    pub revision: u32,
    /// Serial number.
    pub serial: u32,
}

impl Identity {
    /// What a dictionary says; 0 for what it does not have.
    pub fn of<'t, D: Dictionary<'t>>(dictionary: &D) -> Self {
        let parameters = Parameters::of(dictionary);
        let number = |sub| parameters.number(0x1018, sub).unwrap_or_default();
        Self { vendor: number(1), product: number(2), revision: number(3), serial: number(4) }
    }

    const fn parts(self) -> [u32; 4] {
        [self.vendor, self.product, self.revision, self.serial]
    }

    fn part(self, number: u8) -> Option<u32> {
        self.parts().get(usize::from(number)).copied()
    }
}

/// The bit rates of the table that LSS uses.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum BitRate {
    /// 1 Mbit/s.
    K1000,
    /// 800 kbit/s.
    K800,
    /// 500 kbit/s.
    K500,
    /// 250 kbit/s.
    K250,
    /// 125 kbit/s.
    K125,
    /// 50 kbit/s.
    K50,
    /// 20 kbit/s.
    K20,
    /// 10 kbit/s.
    K10,
    /// What the device finds out by itself.
    Automatic,
}

impl BitRate {
    /// The bit rate at a place of the table; 5 is reserved.
    #[must_use]
    pub const fn of_index(index: u8) -> Option<Self> {
        match index {
            0 => Some(Self::K1000),
            1 => Some(Self::K800),
            2 => Some(Self::K500),
            3 => Some(Self::K250),
            4 => Some(Self::K125),
            6 => Some(Self::K50),
            7 => Some(Self::K20),
            8 => Some(Self::K10),
            9 => Some(Self::Automatic),
            _ => None,
        }
    }

    /// kbit/s; `None` of the automatic one.
    #[must_use]
    pub const fn kbits(self) -> Option<u16> {
        match self {
            Self::K1000 => Some(1000),
            Self::K800 => Some(800),
            Self::K500 => Some(500),
            Self::K250 => Some(250),
            Self::K125 => Some(125),
            Self::K50 => Some(50),
            Self::K20 => Some(20),
            Self::K10 => Some(10),
            Self::Automatic => None,
        }
    }
}

/// What the firmware says about something that the master wants.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Reply {
    /// It is done.
    Done,
    /// The device cannot do it.
    NotSupported,
    /// It failed: the memory does not take it.
    Failed,
}

/// The firmware's part. A device that implements no method cannot switch its bit rate and cannot store.
pub trait LssHandler {
    /// Whether the device has a bit rate. It is used only after [`LssEvent::Switch`].
    fn has_bit_rate(&self, rate: BitRate) -> bool {
        let _ = rate;
        false
    }

    /// Keeps the node-ID, which counts from the next reset of the communication on, and the bit rate, if the master has set one, over power-off.
    fn store(&mut self, node: MaybeNode, rate: Option<BitRate>) -> Reply {
        let _ = (node, rate);
        Reply::NotSupported
    }
}

impl LssHandler for () {}

impl<A: LssHandler> LssHandler for Consistent<'_, A> {
    fn has_bit_rate(&self, rate: BitRate) -> bool {
        self.0.has_bit_rate(rate)
    }

    fn store(&mut self, node: MaybeNode, rate: Option<BitRate>) -> Reply {
        self.0.store(node, rate)
    }
}

/// What an LSS slave wants from the firmware.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum LssEvent {
    /// Switch to the bit rate now. Until [`Lss::is_silent`] ends, nothing may be sent.
    Switch(BitRate),
    /// The delay after switching is over: messages may be sent again.
    Switched,
}

/// What state a slave is in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum LssState {
    /// It waits to be chosen.
    Waiting,
    /// The master sets it up.
    Configuration,
}

/// An LSS slave.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Lss {
    state: LssState,
    active: MaybeNode,
    pending: MaybeNode,
    rate: Option<BitRate>,
    /// Parts of the identity that the master has named in order, and that are this node's.
    selected: u8,
    /// Parts of the range that the master has named in order, and that hold this node.
    identified: u8,
    /// The part of the identity that fastscan is about.
    scanned: u8,
    activation: Activation,
}

/// Switching the bit rate (15h): a delay before, so that all nodes have heard of it, and one after, until all have switched.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Activation {
    None,
    Before { switch: Instant, end: Instant, rate: BitRate },
    After { end: Instant },
}

impl Lss {
    /// A slave that begins with a node-ID, or none.
    #[must_use]
    pub const fn new(node: MaybeNode) -> Self {
        Self {
            state: LssState::Waiting,
            active: node,
            pending: node,
            rate: None,
            selected: 0,
            identified: 0,
            scanned: 0,
            activation: Activation::None,
        }
    }

    /// Its state.
    #[must_use]
    pub const fn state(&self) -> LssState {
        self.state
    }

    /// The node-ID that counts from the next reset of the communication on.
    #[must_use]
    pub const fn pending(&self) -> MaybeNode {
        self.pending
    }

    /// Resets the communication: the node-ID that was set counts now.
    pub fn reset(&mut self) -> MaybeNode {
        let (node, rate, activation) = (self.pending, self.rate, self.activation);
        *self = Self { rate, activation, ..Self::new(node) };
        node
    }

    /// The slave is no longer being set up: the node works, and does not hear the master's end.
    pub const fn leave(&mut self) {
        (self.state, self.selected, self.identified, self.scanned) = (LssState::Waiting, 0, 0, 0);
    }

    /// Whether nothing may be sent, because the bit rate is being switched.
    #[must_use]
    pub const fn is_silent(&self) -> bool {
        !matches!(self.activation, Activation::None)
    }

    /// When [`poll`](Self::poll) has something to do.
    #[must_use]
    pub const fn next_deadline(&self) -> Option<Instant> {
        match self.activation {
            Activation::None => None,
            Activation::Before { switch, .. } => Some(switch),
            Activation::After { end } => Some(end),
        }
    }

    /// What is to be done now.
    pub fn poll(&mut self, now: Instant) -> Option<LssEvent> {
        match self.activation {
            Activation::Before { switch, end, rate } if now >= switch => {
                // Late: the others still need their time.
                self.activation = Activation::After { end: now + (end - switch) };
                Some(LssEvent::Switch(rate))
            }
            Activation::After { end } if now >= end => {
                self.activation = Activation::None;
                Some(LssEvent::Switched)
            }
            Activation::None | Activation::Before { .. } | Activation::After { .. } => None,
        }
    }

    /// Takes a request of the master; the answer, if there is one.
    pub fn handle<H: LssHandler>(
        &mut self,
        frame: &Frame,
        identity: Identity,
        handler: &mut H,
        now: Instant,
    ) -> Option<Frame> {
        if frame.id().get() != REQUEST || self.is_silent() {
            return None;
        }
        let request = <[u8; 8]>::try_from(frame.bytes()?).ok()?;
        let [command, rest @ ..] = request;
        let [a, b, c, d, ..] = rest;
        let number = u32::from_le_bytes([a, b, c, d]);
        // Parts come one after the other: anything in between begins anew.
        let (selected, identified) = (self.selected, self.identified);
        (self.selected, self.identified) = (0, 0);
        match (command, self.state) {
            (0x04, _) => self.switch(a),
            (0x40..=0x43, LssState::Waiting) => {
                return self.select(command - 0x40, number, selected, identity);
            }
            (0x46..=0x4B, _) => return self.identify(command - 0x46, number, identified, identity),
            (0x4C, _) => return (self.is_unconfigured()).then(|| answer(0x50, &[])),
            (0x51, LssState::Waiting) => return self.scan(rest, identity),
            (0x11, LssState::Configuration) => return Some(answer(command, &[self.set_node(a), 0])),
            (0x13, LssState::Configuration) => {
                return Some(answer(command, &[self.set_bit_rate(a, b, handler), 0]));
            }
            (0x15, LssState::Configuration) => self.activate(u16::from_le_bytes([a, b]), now),
            (0x17, LssState::Configuration) => {
                let reply = match handler.store(self.pending, self.rate) {
                    Reply::Done => 0,
                    Reply::NotSupported => 1,
                    Reply::Failed => 2,
                };
                return Some(answer(command, &[reply, 0]));
            }
            (0x5A..=0x5D, LssState::Configuration) => {
                return Some(answer(command, &identity.part(command - 0x5A)?.to_le_bytes()));
            }
            (0x5E, LssState::Configuration) => return Some(answer(command, &[code(self.active)])),
            _ => {}
        }
        None
    }

    /// Neither has a node-ID nor gets one at the next reset.
    const fn is_unconfigured(&self) -> bool {
        self.active.is_none() && self.pending.is_none()
    }

    /// 04h: all slaves at once.
    fn switch(&mut self, mode: u8) {
        match mode {
            0 => self.state = LssState::Waiting,
            1 => self.state = LssState::Configuration,
            _ => {}
        }
    }

    /// 40h to 43h: the slave with this identity.
    fn select(&mut self, part: u8, number: u32, before: u8, identity: Identity) -> Option<Frame> {
        if part != before || identity.part(part) != Some(number) {
            return None;
        }
        if part < 3 {
            self.selected = part + 1;
            return None;
        }
        self.state = LssState::Configuration;
        Some(answer(0x44, &[]))
    }

    /// 46h to 4Bh: slaves of a vendor and product with revision and serial number in ranges.
    fn identify(&mut self, part: u8, number: u32, before: u8, identity: Identity) -> Option<Frame> {
        let holds = match part {
            0 => identity.vendor == number,
            1 => identity.product == number,
            2 => identity.revision >= number,
            3 => identity.revision <= number,
            4 => identity.serial >= number,
            _ => identity.serial <= number,
        };
        if part != before || !holds {
            return None;
        }
        if part < 5 {
            self.identified = part + 1;
            return None;
        }
        Some(answer(0x4F, &[]))
    }

    /// 51h: the master finds the identity of a slave without node-ID bit by bit, from the highest down. All slaves whose bits are those so far
    /// say so.
    fn scan(&mut self, [a, b, c, d, bit, part, next]: [u8; 7], identity: Identity) -> Option<Frame> {
        /// Every slave without node-ID begins anew.
        const BEGIN: u8 = 0x80;
        if !self.is_unconfigured() {
            return None;
        }
        if bit == BEGIN {
            self.scanned = 0;
            return Some(answer(0x4F, &[]));
        }
        if bit > 31 || next > 3 || part != self.scanned {
            return None;
        }
        let differs = identity.part(part)? ^ u32::from_le_bytes([a, b, c, d]);
        if differs >> bit != 0 {
            return None;
        }
        self.scanned = next;
        // The last part is whole: the slave is found.
        if bit == 0 && next < part {
            self.state = LssState::Configuration;
        }
        Some(answer(0x4F, &[]))
    }

    /// 11h: 0 done, 1 out of range.
    fn set_node(&mut self, node: u8) -> u8 {
        match (node, NodeId::new(node)) {
            (255, _) => self.pending = None,
            (_, Some(node)) => self.pending = Some(node),
            (_, None) => return 1,
        }
        0
    }

    /// 13h: 0 done, 1 not supported. Table 0 is the one of CiA 305.
    fn set_bit_rate<H: LssHandler>(&mut self, table: u8, index: u8, handler: &H) -> u8 {
        match BitRate::of_index(index).filter(|rate| table == 0 && handler.has_bit_rate(*rate)) {
            Some(rate) => {
                self.rate = Some(rate);
                0
            }
            None => 1,
        }
    }

    /// 15h, without an answer: the bit rate that was set, after a delay in ms; another one follows.
    fn activate(&mut self, delay: u16, now: Instant) {
        let Some(rate) = self.rate else { return };
        let delay = Duration::from_millis(delay.into());
        self.activation = Activation::Before { switch: now + delay, end: now + delay + delay, rate };
    }
}

const fn code(node: MaybeNode) -> u8 {
    match node {
        Some(node) => node.get(),
        None => 255,
    }
}

fn answer(command: u8, data: &[u8]) -> Frame {
    let mut bytes = [0; 8];
    for (byte, value) in bytes.iter_mut().zip([command].iter().chain(data)) {
        *byte = *value;
    }
    Frame::full(CanId::new(ANSWER).unwrap_or(CanId::MAX), bytes)
}

#[cfg(test)]
mod tests;
