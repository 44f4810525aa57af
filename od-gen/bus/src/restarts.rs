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

/// How a node shows that it has started again.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Restart {
    /// By its boot-up message.
    BootUp,
    /// Its heartbeat is pre-operational again, and no command was heard: its boot-up message was lost.
    FellBack,
}

/// Notes which nodes start again.
#[derive(Debug, Default)]
pub(crate) struct Restarts {
    /// The last state of each node.
    states: BTreeMap<u8, u8>,
    /// Nodes that were commanded to become pre-operational, and have not shown it yet.
    commanded: BTreeSet<u8>,
    found: BTreeMap<u8, Restart>,
}

impl Restarts {
    /// Takes a frame; the node that starts again by it.
    pub(crate) fn hear(&mut self, frame: &Frame) -> Option<(u8, Restart)> {
        let id = frame.id().get();
        if let (NMT, Some([ENTER_PRE_OPERATIONAL, node])) = (id, frame.bytes()) {
            let nodes = if *node == 0 { 1..=127 } else { *node..=*node };
            self.commanded.extend(nodes);
            return None;
        }
        let node = id.checked_sub(ERROR_CONTROL).and_then(|node| u8::try_from(node).ok());
        let node = node.filter(|node| (1..=127).contains(node))?;
        let Some([state]) = frame.bytes() else { return None };
        // The highest bit belongs to node guarding.
        let state = state & 0x7F;
        let before = self.states.insert(node, state);
        let restart = match (before, state) {
            (_, BOOT_UP) => Restart::BootUp,
            (before, PRE_OPERATIONAL) => {
                let was_commanded = self.commanded.remove(&node);
                if was_commanded || !matches!(before, Some(STOPPED | OPERATIONAL)) {
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
    fn a_boot_up_message_or_a_state_that_nobody_commanded_is_a_restart() {
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
        assert_eq!(after(&[(0x700, &[0]), (0x780, &[0]), (0x705, &[]), (0x705, &[0, 0])]), [None; 2]);
    }
}
