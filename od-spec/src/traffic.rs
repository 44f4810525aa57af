//! The messages of a node: which COB-IDs it sends and receives.

use crate::model::{Dictionary, Direction, EntryId, Fact, Index, SubIndex, Value};
use crate::source::Span;

/// Bit of a COB-ID: the message does not exist; in those of SYNC and TIME it says something else.
const NOT_VALID: i128 = 1 << 31;
/// Bit of 1005h and 1012h: the device sends the message itself.
const PRODUCER: i128 = 1 << 30;
/// The identifier in a COB-ID, with the bit for 29 bits.
const IDENTIFIER: i128 = 0x3FFF_FFFF;
const WIDE: i128 = 1 << 29;

/// What a message on the bus is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Traffic {
    /// SYNC (1005h).
    Sync,
    /// TIME (1012h).
    Time,
    /// An emergency message (1014h).
    Emergency,
    /// What a PDO of this number carries.
    Pdo(Direction, u16),
    /// Requests to the first SDO server.
    Request,
    /// Answers of the first SDO server.
    Answer,
    /// Another SDO channel.
    Channel,
    /// Heartbeat and boot-up.
    Heartbeat,
}

impl Traffic {
    /// `TPDO 1`, `heartbeat`.
    pub fn words(self) -> String {
        match self {
            Self::Sync => "SYNC".to_owned(),
            Self::Time => "TIME".to_owned(),
            Self::Emergency => "EMCY".to_owned(),
            Self::Pdo(direction, number) => format!("{} {number}", direction.pdo()),
            Self::Request => "SDO requests".to_owned(),
            Self::Answer => "SDO answers".to_owned(),
            Self::Channel => "an SDO channel".to_owned(),
            Self::Heartbeat => "heartbeat".to_owned(),
        }
    }
}

/// A message that a node sends or receives.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Message {
    /// What it is.
    pub traffic: Traffic,
    /// Its identifier, with bit 29 for one of 29 bits.
    pub id: u32,
    /// Whether the node sends it.
    pub is_sent: bool,
    /// Position of the node in its plant.
    pub node: usize,
    /// The entry that holds its identifier.
    pub entry: Option<EntryId>,
    /// Where its identifier is set, if a level of the plant does that.
    pub set_at: Option<Span>,
}

/// What a node sends and receives once it has its values.
pub(crate) fn messages(device: &Dictionary, id: u8) -> Vec<Message> {
    let mut found = Vec::new();
    let mut push = |traffic, raw: i128, is_sent, from: Option<Parameter>| {
        let id = raw & IDENTIFIER & if raw & WIDE == 0 { 0x7FF } else { IDENTIFIER };
        if let Ok(id) = u32::try_from(id)
            && id != 0
        {
            let (entry, set_at) = (from.as_ref().map(|from| from.id), from.and_then(|from| from.set_at));
            found.push(Message { traffic, id, is_sent, node: 0, entry, set_at });
        }
    };
    let value = |index: u16, sub: u8| Parameter::of(device, id, index, sub);
    for (index, traffic) in [(0x1005, Traffic::Sync), (0x1012, Traffic::Time)] {
        if let Some(cob_id) = value(index, 0) {
            let listens = traffic == Traffic::Sync || cob_id.raw & NOT_VALID != 0;
            let sends = cob_id.raw & PRODUCER != 0;
            if sends || listens {
                push(traffic, cob_id.raw & !(NOT_VALID | PRODUCER), sends, Some(cob_id));
            }
        }
    }
    if let Some(cob_id) = value(0x1014, 0).filter(|cob_id| cob_id.raw & NOT_VALID == 0) {
        push(Traffic::Emergency, cob_id.raw, true, Some(cob_id));
    }
    for pdo in &device.pdos {
        if let Some(cob_id) = value(pdo.communication_index(), 1).filter(|one| one.raw & NOT_VALID == 0) {
            let is_sent = pdo.direction == Direction::Transmit;
            push(Traffic::Pdo(pdo.direction, pdo.number), cob_id.raw & !PRODUCER, is_sent, Some(cob_id));
        }
    }
    for (index, server) in
        (0x1201..=0x127F).map(|index| (index, true)).chain((0x1280..=0x12FF).map(|index| (index, false)))
    {
        let (Some(to_server), Some(to_client)) = (value(index, 1), value(index, 2)) else { continue };
        if to_server.raw & NOT_VALID == 0 && to_client.raw & NOT_VALID == 0 {
            push(Traffic::Channel, to_server.raw & !PRODUCER, !server, Some(to_server));
            push(Traffic::Channel, to_client.raw & !PRODUCER, server, Some(to_client));
        }
    }
    let own = i128::from(id);
    // They follow from the node-ID, whatever a file says of them.
    let first_channel = |sub: u8, cob_id: i128| value(0x1200, sub).filter(|stated| stated.raw == cob_id);
    push(Traffic::Request, 0x600 + own, false, first_channel(1, 0x600 + own));
    push(Traffic::Answer, 0x580 + own, true, first_channel(2, 0x580 + own));
    push(Traffic::Heartbeat, 0x700 + own, true, None);
    found
}

/// A communication parameter of a configured node.
#[derive(Debug, Clone)]
pub(crate) struct Parameter {
    /// Its entry.
    pub id: EntryId,
    /// Its value.
    pub raw: i128,
    /// Where it is set.
    pub set_at: Option<Span>,
}

impl Parameter {
    pub(crate) fn of(device: &Dictionary, node: u8, index: u16, sub: u8) -> Option<Self> {
        let id = EntryId { index: Index(index), sub: SubIndex(sub) };
        let entry = device.entry(id)?;
        let raw = entry.default.as_ref().and_then(|value: &Value| value.integer_for(node))?;
        Some(Self { id, raw, set_at: entry.is_set().then(|| entry.place(Fact::Default)) })
    }
}

/// An identifier as people write it.
pub(crate) fn shown(id: u32) -> String {
    format!("{:03X}h", id & 0x1FFF_FFFF)
}
