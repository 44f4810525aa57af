//! Nodes that start again, as boot-up messages and heartbeats show it.

use std::collections::{BTreeMap, BTreeSet};

use firmware_glue::frame::Frame;

/// The identifiers of boot-up messages and heartbeats begin here.
pub(crate) const ERROR_CONTROL: u16 = 0x700;
const NMT: u16 = 0;

const BOOT_UP: u8 = 0;
const STOPPED: u8 = 4;
const OPERATIONAL: u8 = 5;
const PRE_OPERATIONAL: u8 = 127;
/// NMT command: to pre-operational.
const ENTER_PRE_OPERATIONAL: u8 = 128;

/// The identifiers of emergency messages begin here, and those of SDO requests here.
const EMERGENCY: u16 = 0x80;
const SDO_REQUEST: u16 = 0x600;
/// The class of communication errors, in the upper byte of an error code.
const COMMUNICATION: u8 = 0x81;
/// 1029h, which says what a node does at an error.
const ERROR_BEHAVIOUR: u16 = 0x1029;

/// How a node shows that it has started again.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Restart {
    /// By its boot-up message.
    BootUp,
    /// Its heartbeat is pre-operational again, and neither a command nor an error explains it: its boot-up message was lost.
    FellBack,
}

/// Notes which nodes start again.
#[derive(Debug, Default)]
pub(crate) struct Restarts {
    /// The last state of each node.
    states: BTreeMap<u8, u8>,
    /// Nodes that have a reason to become pre-operational, and have not shown it yet: a command, or another error behaviour (1029h).
    expected: BTreeSet<u8>,
    /// Nodes with a communication error, at which they may become pre-operational (CiA 301, 1029h.1).
    in_error: BTreeSet<u8>,
    found: BTreeMap<u8, Restart>,
}

impl Restarts {
    /// Takes a frame; the node that starts again by it.
    pub(crate) fn hear(&mut self, frame: &Frame) -> Option<(u8, Restart)> {
        let id = frame.id().get();
        if let (NMT, Some([ENTER_PRE_OPERATIONAL, node])) = (id, frame.bytes()) {
            let nodes = if *node == 0 { 1..=127 } else { *node..=*node };
            self.expected.extend(nodes);
            return None;
        }
        if let (Some(node), Some(&[0x20..=0x2F, low, high, ..])) = (of_node(id, SDO_REQUEST), frame.bytes())
            && u16::from_le_bytes([low, high]) == ERROR_BEHAVIOUR
        {
            self.expected.insert(node);
            return None;
        }
        if let (Some(node), Some(&[code, class, ..])) = (of_node(id, EMERGENCY), frame.bytes()) {
            match (code, class) {
                (_, COMMUNICATION) => self.in_error.insert(node),
                (0, 0) => self.in_error.remove(&node),
                _ => false,
            };
            return None;
        }
        let node = of_node(id, ERROR_CONTROL)?;
        let Some([state]) = frame.bytes() else { return None };
        // The highest bit belongs to node guarding.
        let state = state & 0x7F;
        let before = self.states.insert(node, state);
        let restart = match (before, state) {
            (_, BOOT_UP) => {
                self.expected.remove(&node);
                self.in_error.remove(&node);
                Restart::BootUp
            }
            (before, PRE_OPERATIONAL) => {
                let is_explained = self.expected.remove(&node) || self.in_error.contains(&node);
                if is_explained || !matches!(before, Some(STOPPED | OPERATIONAL)) {
                    return None;
                }
                Restart::FellBack
            }
            _ => return None,
        };
        self.found.insert(node, restart);
        Some((node, restart))
    }

    /// Whether a node has started again.
    pub(crate) fn of(&self, node: u8) -> Option<Restart> {
        self.found.get(&node).copied()
    }
}

/// The node of an identifier in a range of 127.
fn of_node(id: u16, first: u16) -> Option<u8> {
    let node = id.checked_sub(first).and_then(|node| u8::try_from(node).ok());
    node.filter(|node| (1..=127).contains(node))
}

#[cfg(test)]
mod tests {
    use firmware_glue::frame::CanId;

    use super::*;

    /// What some frames show of nodes 5 and 6.
    fn after(frames: &[(u16, &[u8])]) -> [Option<Restart>; 2] {
        let mut restarts = Restarts::default();
        for (id, bytes) in frames {
            restarts.hear(&Frame::data(CanId::new(*id).unwrap(), bytes).unwrap());
        }
        [restarts.of(5), restarts.of(6)]
    }

    #[test]
    fn a_boot_up_message_or_a_state_that_was_not_commanded_is_a_restart() {
        let (boot_up, fell_back) = (Some(Restart::BootUp), Some(Restart::FellBack));
        assert_eq!(after(&[(0x705, &[0]), (0x705, &[127])]), [boot_up, None]);
        assert_eq!(after(&[(0x705, &[5]), (0x705, &[127])]), [fell_back, None]);
        assert_eq!(after(&[(0x706, &[4]), (0x706, &[0xFF])]), [None, fell_back]);
        assert_eq!(after(&[(0x705, &[5]), (0x000, &[128, 6]), (0x705, &[127])]), [fell_back, None]);
        // A reset is commanded, and what it takes away is lost all the same.
        assert_eq!(after(&[(0x705, &[5]), (0x000, &[129, 5]), (0x705, &[127])]), [fell_back, None]);
    }

    #[test]
    fn a_node_that_does_as_it_is_commanded_does_not_start_again() {
        assert_eq!(after(&[(0x705, &[127]), (0x705, &[5]), (0x705, &[5]), (0x705, &[4])]), [None; 2]);
        assert_eq!(after(&[(0x706, &[127]), (0x705, &[127])]), [None; 2]);
        for node in [0, 5] {
            // A heartbeat may be on its way when the command comes.
            let frames: [(u16, &[u8]); 4] =
                [(0x705, &[5]), (0x000, &[128, node]), (0x705, &[5]), (0x705, &[127])];
            assert_eq!(after(&frames), [None; 2]);
        }
    }

    #[test]
    fn a_node_that_falls_back_by_its_error_behaviour_does_not_start_again() {
        // Heartbeat lost, or another error behaviour: the node does what 1029h.1 says.
        let error: (u16, &[u8]) = (0x85, &[0x30, 0x81, 0x11, 7, 0, 0, 0, 0]);
        let set: (u16, &[u8]) = (0x605, &[0x2F, 0x29, 0x10, 1, 0, 0, 0, 0]);
        for why in [error, set] {
            assert_eq!(after(&[(0x705, &[5]), why, (0x705, &[127])]), [None; 2]);
        }
        let fell_back = [Some(Restart::FellBack), None];
        let solved: (u16, &[u8]) = (0x85, &[0; 8]);
        let read: (u16, &[u8]) = (0x605, &[0x40, 0x29, 0x10, 1, 0, 0, 0, 0]);
        assert_eq!(after(&[(0x705, &[5]), error, solved, (0x705, &[127])]), fell_back);
        assert_eq!(after(&[(0x705, &[5]), read, (0x705, &[127])]), fell_back);
        assert_eq!(after(&[(0x705, &[5]), (0x85, &[0, 0x50, 1, 0, 0, 0, 0, 0]), (0x705, &[127])]), fell_back);
    }

    #[test]
    fn other_frames_show_nothing() {
        assert_eq!(after(&[(0x700, &[0]), (0x780, &[0]), (0x705, &[]), (0x705, &[0, 0])]), [None; 2]);
    }
}
