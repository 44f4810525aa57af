//! Node-IDs.

use core::fmt;

use crate::bus::frame::CanId;

/// Which node of a network: 1 to 127 (CiA 301 9.4).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct NodeId(u8);

impl NodeId {
    /// A node-ID, if it is one from 1 to 127.
    #[must_use]
    pub const fn new(node: u8) -> Option<Self> {
        if matches!(node, 1..=127) { Some(Self(node)) } else { None }
    }

    /// The node-ID as a number, 1 to 127.
    #[must_use]
    pub const fn get(self) -> u8 {
        self.0
    }

    /// The node's own identifier after a base below 780h, such as 700h (CiA 301 table 34).
    pub(crate) fn identifier(self, base: u16) -> CanId {
        CanId::new(base + u16::from(self.0)).unwrap_or(CanId::MAX)
    }
}

/// As a number: `5`.
impl fmt::Display for NodeId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// Identifiers that belong to the nodes 1 to 127, one each, after a base such as 700h: the node of one.
pub(crate) fn node_of(id: CanId, base: u16) -> Option<u8> {
    let nodes = base + 1..base + 128;
    if nodes.contains(&id.get()) { u8::try_from(id.get() - base).ok() } else { None }
}

#[cfg(test)]
mod tests {
    use super::NodeId;

    #[test]
    fn nodes_are_1_to_127() {
        assert_eq!((NodeId::new(0), NodeId::new(128)), (None, None));
        assert_eq!(NodeId::new(127).map(|node| node.identifier(0x700).get()), Some(0x77F));
    }
}
