//! The two identifiers of an SDO channel.

use crate::access::communication::cob_id::valid_id;
use crate::access::dictionary::Dictionary;
use crate::access::parameters::Parameters;
use crate::bus::frame::CanId;
use crate::bus::node_id::NodeId;

/// The identifiers of a channel between one client and one server.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Channel {
    /// Of what the client sends.
    pub request: CanId,
    /// Of what the server sends.
    pub answer: CanId,
}

impl Channel {
    /// The first channel of a node, which every node has: 600h and 580h + node-ID (CiA 301 7.3.3).
    #[must_use]
    pub fn predefined(node: NodeId) -> Self {
        Self { request: node.identifier(0x600), answer: node.identifier(0x580) }
    }

    /// A channel of the node's server, as the dictionary has it now: number 0 in 1200h, up to number 127 in 127Fh
    /// (CiA 301 7.5.2.33). `None` if there is no such object, or one of its identifiers is switched off or has 29 bits.
    ///
    /// Where it has none at 1200h, the node's first channel is the [`predefined`](Self::predefined) one.
    pub fn of_server<'t>(dictionary: &impl Dictionary<'t>, number: u8) -> Option<Self> {
        let index = 0x1200 + u16::from(number);
        if number > 127 {
            return None;
        }
        let identifier = |sub| Parameters::of(dictionary).searched(index, sub).and_then(valid_id);
        Some(Self { request: identifier(1)?, answer: identifier(2)? })
    }
}
