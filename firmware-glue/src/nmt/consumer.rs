//! Heartbeat consumer: whether other nodes are alive (CiA 301 9.2.6.2, 1016h).

use crate::access::dictionary::Dictionary;
use crate::access::parameters::Parameters;
use crate::bus::clock::{Duration, Instant, earlier};
use crate::bus::frame::Frame;
use crate::bus::node_id::{NodeId, node_of};
use crate::nmt::{ERROR_CONTROL, State};

/// What is known about a node that 1016h watches.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Heartbeat {
    /// Its first heartbeat has not come: it is not watched yet.
    Awaited,
    /// It was alive then, in that state; `None` of a state that has no meaning.
    Alive {
        /// When its last heartbeat came.
        heard: Instant,
        /// The state in it.
        state: Option<State>,
    },
    /// It has sent nothing for too long.
    Lost,
}

/// What changed about a node that 1016h watches.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum NodeEvent {
    /// Its first heartbeat came: from now on it is watched.
    Started(NodeId, Option<State>),
    /// No heartbeat came for the time in 1016h: a communication error, for which 1029h.1 says what to do.
    Lost(NodeId),
    /// It is back.
    Resumed(NodeId, Option<State>),
    /// Its state is another one; [`State::Initialising`] of a node that sent its boot-up message, and so has been reset.
    Changed(NodeId, Option<State>),
}

/// Watches up to `N` nodes: those of the sub-indices 1 to `N` of 1016h.
#[derive(Debug, Clone, Copy)]
pub struct Consumer<const N: usize> {
    watched: [Watched; N],
}

/// An entry of 1016h, and what has been heard since it was set.
#[derive(Debug, Clone, Copy)]
struct Watched {
    entry: u32,
    heartbeat: Heartbeat,
}

impl Watched {
    const NOBODY: Self = Self { entry: 0, heartbeat: Heartbeat::Awaited };

    /// Begins anew when the entry is another one.
    fn update(&mut self, entry: u32) {
        if self.entry != entry {
            *self = Self { entry, heartbeat: Heartbeat::Awaited };
        }
    }

    /// The node and how long it may be silent; a time of 0 watches no node.
    fn target(&self) -> Option<(NodeId, Duration)> {
        let node = NodeId::new(u8::try_from(self.entry >> 16).ok()?)?;
        let time = self.entry & 0xFFFF;
        (time != 0).then(|| (node, Duration::from_millis(time.into())))
    }

    fn deadline(&self) -> Option<Instant> {
        let (_, time) = self.target()?;
        match self.heartbeat {
            Heartbeat::Alive { heard, .. } => Some(heard + time),
            Heartbeat::Awaited | Heartbeat::Lost => None,
        }
    }
}

impl<const N: usize> Default for Consumer<N> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const N: usize> Consumer<N> {
    /// Nothing is heard yet.
    #[must_use]
    pub const fn new() -> Self {
        Self { watched: [Watched::NOBODY; N] }
    }

    /// What a heartbeat or boot-up message reports, if 1016h watches its node.
    pub fn handle<'t, D: Dictionary<'t>>(
        &mut self,
        frame: &Frame,
        dictionary: &D,
        now: Instant,
    ) -> Option<NodeEvent> {
        if !Parameters::of(dictionary).has(0x1016) {
            return None;
        }
        let node = node_of(frame.id(), ERROR_CONTROL)?;
        let Some(&[code]) = frame.bytes() else { return None };
        let state = State::of_code(code);
        self.read(dictionary);
        let (watched, node) = self.watched.iter_mut().find_map(|watched| {
            let (target, _) = watched.target()?;
            (target.get() == node).then_some((watched, target))
        })?;
        let before = watched.heartbeat;
        watched.heartbeat = Heartbeat::Alive { heard: now, state };
        match before {
            Heartbeat::Awaited => Some(NodeEvent::Started(node, state)),
            Heartbeat::Lost => Some(NodeEvent::Resumed(node, state)),
            Heartbeat::Alive { state: was, .. } if was != state => Some(NodeEvent::Changed(node, state)),
            // A second boot-up message is a second reset.
            Heartbeat::Alive { .. } if state == Some(State::Initialising) => {
                Some(NodeEvent::Changed(node, state))
            }
            Heartbeat::Alive { .. } => None,
        }
    }

    /// A node that has been silent for too long; to be called until there is none.
    pub fn poll<'t, D: Dictionary<'t>>(&mut self, dictionary: &D, now: Instant) -> Option<NodeEvent> {
        if !Parameters::of(dictionary).has(0x1016) {
            return None;
        }
        self.read(dictionary);
        self.watched.iter_mut().find_map(|watched| {
            let (node, _) = watched.target()?;
            if now < watched.deadline()? {
                return None;
            }
            watched.heartbeat = Heartbeat::Lost;
            Some(NodeEvent::Lost(node))
        })
    }

    /// When the next node has been silent for too long.
    #[must_use]
    pub fn next_deadline(&self) -> Option<Instant> {
        self.watched.iter().map(Watched::deadline).fold(None, earlier)
    }

    /// What is known about a node; `None` of one that is not watched.
    #[must_use]
    pub fn heartbeat(&self, node: NodeId) -> Option<Heartbeat> {
        let watches = |watched: &&Watched| watched.target().is_some_and(|(target, _)| target == node);
        self.watched.iter().find(watches).map(|watched| watched.heartbeat)
    }

    /// Whether any watched node is lost.
    #[must_use]
    pub fn is_any_lost(&self) -> bool {
        self.watched.iter().any(|watched| watched.target().is_some() && watched.heartbeat == Heartbeat::Lost)
    }

    /// Takes up what is written to 1016h.
    fn read<'t, D: Dictionary<'t>>(&mut self, dictionary: &D) {
        let parameters = Parameters::of(dictionary);
        let count = parameters.byte(0x1016, 0);
        for (sub, watched) in (1..=u8::MAX).zip(&mut self.watched) {
            let entry = if sub <= count { parameters.searched(0x1016, sub) } else { None };
            watched.update(entry.unwrap_or_default());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::access::parameters::set;
    use crate::access::test_table::{TestDictionary, dictionary, value};
    use crate::bus::frame::CanId;

    fn node(node: u8) -> NodeId {
        NodeId::new(node).expect("a node-ID")
    }

    fn at(millis: u64) -> Instant {
        Instant::from_millis(millis)
    }

    fn beat(node: u16, state: u8) -> Frame {
        Frame::data(CanId::new(0x700 + node).expect("11 bits"), &[state]).expect("a byte")
    }

    fn device() -> TestDictionary {
        dictionary(&[
            value(0x1016, 0, 1, 3),
            value(0x1016, 1, 4, 0x0003_0064),
            value(0x1016, 2, 4, 0x0004_0000),
            value(0x1016, 3, 4, 0x0005_00C8),
        ])
    }

    #[test]
    fn a_node_is_watched_from_its_first_heartbeat_on() {
        let (device, mut consumer) = (device(), Consumer::<3>::new());
        assert_eq!(consumer.poll(&device, at(1_000_000)), None);
        let started = consumer.handle(&beat(3, 127), &device, at(1000));
        assert_eq!(started, Some(NodeEvent::Started(node(3), Some(State::PreOperational))));
        assert_eq!(consumer.handle(&beat(3, 127), &device, at(1050)), None);
        assert_eq!(consumer.next_deadline(), Some(at(1150)));
        assert_eq!(consumer.poll(&device, at(1149)), None);
        assert_eq!(consumer.poll(&device, at(1150)), Some(NodeEvent::Lost(node(3))));
        assert_eq!(consumer.poll(&device, at(9999)), None, "said once");
        assert_eq!(consumer.heartbeat(node(3)), Some(Heartbeat::Lost));
        let resumed = consumer.handle(&beat(3, 5), &device, at(2000));
        assert_eq!(resumed, Some(NodeEvent::Resumed(node(3), Some(State::Operational))));
    }

    #[test]
    fn another_state_and_a_reset_are_told() {
        let (device, mut consumer) = (device(), Consumer::<3>::new());
        let mut report = |code| consumer.handle(&beat(5, code), &device, at(0));
        assert_eq!(report(0), Some(NodeEvent::Started(node(5), Some(State::Initialising))));
        assert_eq!(report(0), Some(NodeEvent::Changed(node(5), Some(State::Initialising))));
        assert_eq!(report(127), Some(NodeEvent::Changed(node(5), Some(State::PreOperational))));
        assert_eq!(report(127), None);
        assert_eq!(report(42), Some(NodeEvent::Changed(node(5), None)));
        assert_eq!(report(4), Some(NodeEvent::Changed(node(5), Some(State::Stopped))));
    }

    #[test]
    fn only_heartbeats_of_watched_nodes_count() {
        let (device, mut consumer) = (device(), Consumer::<3>::new());
        assert_eq!(consumer.handle(&beat(4, 5), &device, at(0)), None, "a time of 0 watches no node");
        assert_eq!(consumer.handle(&beat(6, 5), &device, at(0)), None);
        let two = Frame::data(CanId::new(0x703).expect("11 bits"), &[5, 5]).expect("two bytes");
        assert_eq!(consumer.handle(&two, &device, at(0)), None);
        let remote = Frame::remote(CanId::new(0x703).expect("11 bits"), 1).expect("a length");
        assert_eq!(consumer.handle(&remote, &device, at(0)), None);
        assert_eq!(consumer.next_deadline(), None);
    }

    #[test]
    fn an_entry_that_is_written_begins_anew() {
        let (mut device, mut consumer) = (device(), Consumer::<3>::new());
        consumer.handle(&beat(3, 5), &device, at(0));
        set(&mut device, 0x1016, 1, 0x0003_0032);
        assert_eq!(consumer.poll(&device, at(500)), None);
        assert_eq!(consumer.heartbeat(node(3)), Some(Heartbeat::Awaited));
        assert!(consumer.handle(&beat(3, 5), &device, at(500)).is_some());
        assert_eq!(consumer.poll(&device, at(550)), Some(NodeEvent::Lost(node(3))));
    }

    #[test]
    fn nodes_that_fall_silent_at_once_are_told_one_by_one() {
        let (device, mut consumer) = (device(), Consumer::<3>::new());
        consumer.handle(&beat(3, 5), &device, at(0));
        consumer.handle(&beat(5, 5), &device, at(0));
        assert_eq!(consumer.poll(&device, at(1000)), Some(NodeEvent::Lost(node(3))));
        assert_eq!(consumer.poll(&device, at(1000)), Some(NodeEvent::Lost(node(5))));
        assert_eq!(consumer.poll(&device, at(1000)), None);
    }
}
