//! The two identifiers of an SDO channel.

use crate::cob_id::NOT_VALID;
use crate::dictionary::Dictionary;
use crate::frame::CanId;

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
    /// The first channel of a node, which every node has: 600h and 580h + node-ID (CiA 301 7.3.3), for a node-ID from 1 to 127.
    pub fn predefined(node_id: u8) -> Option<Self> {
        if !(1..=127).contains(&node_id) {
            return None;
        }
        let of = |base: u16| CanId::new(base + u16::from(node_id));
        Some(Self { request: of(0x600)?, answer: of(0x580)? })
    }

    /// A channel of the node's server, as the dictionary has it now: number 0 in 1200h, up to number 127 in 127Fh
    /// (CiA 301 7.5.2.33). `None` if there is no such object, or one of its identifiers is switched off or has 29 bits.
    ///
    /// A dictionary without 1200h has the [`predefined`](Self::predefined) channel.
    pub fn of_server<'t>(dictionary: &impl Dictionary<'t>, number: u8) -> Option<Self> {
        let index = 0x1200 + u16::from(number);
        if number > 127 {
            return None;
        }
        let identifier = |sub| {
            let value = dictionary.read(index, sub).ok()?;
            let cob_id = u32::from_le_bytes(value.bytes().try_into().ok()?);
            if cob_id & (NOT_VALID | FRAME_29) != 0 {
                return None;
            }
            CanId::new((cob_id & u32::from(CanId::MAX.get())).try_into().ok()?)
        };
        Some(Self { request: identifier(1)?, answer: identifier(2)? })
    }
}

/// Bit 29 of a COB-ID: the identifier has 29 bits.
const FRAME_29: u32 = 1 << 29;
