//! A message: its identifier, its sender, its receivers, and what it carries.

use od_spec::model::{Direction, EntryId, Index, SubIndex};

use super::Node;
use super::signals::Signal;

/// A frame with an identifier of its own.
#[derive(Debug, Clone)]
pub(super) struct Message {
    /// Whose it is.
    pub owner: Owner,
    /// Its identifier.
    pub id: Identifier,
    /// Name.
    pub name: String,
    /// Bytes.
    pub length: usize,
    /// The node that sends it; `None` for one that the file does not know, such as the master.
    pub sender: Option<String>,
    /// The nodes that take it.
    pub receivers: Vec<String>,
    /// What it carries, by place.
    pub signals: Vec<Signal>,
    /// What a person should know.
    pub comment: String,
    /// Longest time between two, in ms.
    pub cycle: Option<u16>,
}

/// Whose a message is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Owner {
    /// Of all nodes: `SYNC`.
    Bus(&'static str),
    /// A service of a node: `EMCY`.
    Node {
        /// Its node-ID.
        node: u8,
        /// The service.
        what: String,
    },
    /// A PDO of a node.
    Pdo {
        /// Its node-ID.
        node: u8,
        /// Seen from the node.
        direction: Direction,
    },
}

/// Identifier of a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Identifier {
    /// Of 11 bits.
    Standard(u16),
    /// Of 29 bits.
    Extended(u32),
}

impl Identifier {
    /// The identifier in a COB-ID, whose upper bits say more than that; `None` for 0, which is that of NMT.
    pub(super) fn of_cob_id(cob_id: u32) -> Option<Self> {
        let id = if cob_id >> 29 & 1 == 1 {
            Self::Extended(cob_id & 0x1FFF_FFFF)
        } else {
            Self::Standard(u16::try_from(cob_id & 0x7FF).ok()?)
        };
        (id != Self::Standard(0)).then_some(id)
    }

    /// As the bus has it.
    pub(super) const fn number(self) -> u32 {
        match self {
            Self::Standard(id) => id as u32,
            Self::Extended(id) => id,
        }
    }

    /// As the format has it: bit 31 states that it has 29 bits.
    pub(super) const fn in_file(self) -> u32 {
        match self {
            Self::Standard(id) => id as u32,
            Self::Extended(id) => id | 1 << 31,
        }
    }
}

impl Message {
    /// A message that no known node sends or takes, and that carries nothing.
    pub(super) const fn of(owner: Owner, id: Identifier, name: String) -> Self {
        Self {
            owner,
            id,
            name,
            length: 0,
            sender: None,
            receivers: Vec::new(),
            signals: Vec::new(),
            comment: String::new(),
            cycle: None,
        }
    }

    /// Whether another message has the same content at the same places.
    pub(super) fn is_laid_out_as(&self, other: &Self) -> bool {
        self.signals.len() == other.signals.len()
            && self.signals.iter().zip(&other.signals).all(|(one, other)| one.is_laid_out_as(other))
    }
}

impl Node<'_> {
    /// A parameter of the node as a number.
    pub(super) fn parameter(&self, index: u16, sub: u8) -> Option<u32> {
        let id = EntryId { index: Index(index), sub: SubIndex(sub) };
        let default = self.device.entry(id)?.default.as_ref()?;
        u32::try_from(default.integer_for(self.id)?).ok()
    }
}
