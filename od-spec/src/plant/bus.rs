//! The messages on a bus: who sends and who receives which COB-ID.

use super::{Plant, Settled};
use crate::model::{Dictionary, Direction, EntryId, Fact, Index, Object, SubIndex, Value};
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
    /// Position of the node in the plant.
    pub node: usize,
    /// Where its identifier is set, if a level of the plant does that.
    pub set_at: Option<Span>,
}

/// The bus of a machine.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Bus<'a> {
    /// The plant.
    pub plant: &'a Plant,
    /// Position of the machine.
    pub machine: usize,
    /// Its nodes: the position of each in the plant, and what it is set to.
    pub nodes: Vec<(usize, &'a Settled)>,
    /// What they send and receive.
    pub messages: Vec<Message>,
}

impl<'a> Bus<'a> {
    /// The bus of a machine, of whose plant every class is settled.
    pub fn of(plant: &'a Plant, settled: &'a [Settled], machine: usize) -> Option<Self> {
        let nodes = plant.machines.get(machine)?.nodes.clone();
        let nodes: Vec<(usize, &Settled)> =
            nodes.filter_map(|at| Some((at, settled.get(plant.nodes.get(at)?.class)?))).collect();
        let of_node = |(at, settled): &(usize, &'a Settled)| {
            let at = *at;
            settled.on_the_bus.messages.iter().map(move |message| Message { node: at, ..message.clone() })
        };
        let messages = nodes.iter().flat_map(of_node).collect();
        Some(Self { plant, machine, nodes, messages })
    }
}

/// What nodes of a class have to do with others on their bus.
#[derive(Debug, Clone)]
pub(super) struct OnTheBus {
    /// What they send and receive; of no node in particular.
    messages: Vec<Message>,
    /// How often they send a heartbeat (1017h).
    pub heartbeat: Option<Parameter>,
    /// Whose heartbeats they wait for (1016h).
    pub watched: Vec<Parameter>,
}

impl OnTheBus {
    /// Of a device with its values.
    pub(super) fn of(configured: &Dictionary, node: u8) -> Self {
        let consumers = configured.objects.get(&Index(0x1016)).into_iter().flat_map(Object::counted);
        Self {
            messages: messages(configured, node),
            heartbeat: Parameter::of(configured, node, 0x1017, 0),
            watched: consumers
                .filter_map(|entry| Parameter::of(configured, node, 0x1016, entry.sub.0))
                .collect(),
        }
    }
}

/// What a node sends and receives once it has its values.
fn messages(device: &Dictionary, id: u8) -> Vec<Message> {
    let mut found = Vec::new();
    let mut push = |traffic, raw: i128, is_sent, set_at| {
        let id = raw & IDENTIFIER & if raw & WIDE == 0 { 0x7FF } else { IDENTIFIER };
        if let Ok(id) = u32::try_from(id)
            && id != 0
        {
            found.push(Message { traffic, id, is_sent, node: 0, set_at });
        }
    };
    let value = |index: u16, sub: u8| Parameter::of(device, id, index, sub);
    for (index, traffic) in [(0x1005, Traffic::Sync), (0x1012, Traffic::Time)] {
        if let Some(cob_id) = value(index, 0) {
            let listens = traffic == Traffic::Sync || cob_id.raw & NOT_VALID != 0;
            let sends = cob_id.raw & PRODUCER != 0;
            if sends || listens {
                push(traffic, cob_id.raw & !(NOT_VALID | PRODUCER), sends, cob_id.set_at);
            }
        }
    }
    if let Some(cob_id) = value(0x1014, 0).filter(|cob_id| cob_id.raw & NOT_VALID == 0) {
        push(Traffic::Emergency, cob_id.raw, true, cob_id.set_at);
    }
    for pdo in &device.pdos {
        if let Some(cob_id) = value(pdo.communication_index(), 1).filter(|one| one.raw & NOT_VALID == 0) {
            let is_sent = pdo.direction == Direction::Transmit;
            push(Traffic::Pdo(pdo.direction, pdo.number), cob_id.raw & !PRODUCER, is_sent, cob_id.set_at);
        }
    }
    for (index, server) in
        (0x1201..=0x127F).map(|index| (index, true)).chain((0x1280..=0x12FF).map(|index| (index, false)))
    {
        let (Some(to_server), Some(to_client)) = (value(index, 1), value(index, 2)) else { continue };
        if to_server.raw & NOT_VALID == 0 && to_client.raw & NOT_VALID == 0 {
            push(Traffic::Channel, to_server.raw & !PRODUCER, !server, to_server.set_at);
            push(Traffic::Channel, to_client.raw & !PRODUCER, server, to_client.set_at);
        }
    }
    let own = i128::from(id);
    push(Traffic::Request, 0x600 + own, false, None);
    push(Traffic::Answer, 0x580 + own, true, None);
    push(Traffic::Heartbeat, 0x700 + own, true, None);
    found
}

/// A communication parameter of a configured node.
#[derive(Debug, Clone)]
pub(super) struct Parameter {
    /// Its value.
    pub raw: i128,
    /// Where it is set.
    pub set_at: Option<Span>,
}

impl Parameter {
    pub(super) fn of(device: &Dictionary, node: u8, index: u16, sub: u8) -> Option<Self> {
        let entry = device.entry(EntryId { index: Index(index), sub: SubIndex(sub) })?;
        let raw = entry.default.as_ref().and_then(|value: &Value| value.integer_for(node))?;
        Some(Self { raw, set_at: entry.is_set().then(|| entry.place(Fact::Default)) })
    }
}

impl Message {
    /// Where somebody can change it: where its identifier is set, or else where the node has its node-ID.
    pub(super) fn place(&self, plant: &Plant) -> Option<Span> {
        self.set_at.or_else(|| plant.nodes.get(self.node).map(|node| node.node.span))
    }

    /// `TPDO 1 of pmc at position B (node 22)`: a bus has one machine, which is said beside it.
    pub(super) fn short(&self, plant: &Plant) -> String {
        let Some(node) = plant.nodes.get(self.node) else { return self.traffic.words() };
        let key = plant.devices.get(node.device).map_or("", |device| &device.key);
        format!("{} of {key} at position {} (node {})", self.traffic.words(), node.position, node.node.value)
    }
}

/// An identifier as people write it.
pub(super) fn shown(id: u32) -> String {
    format!("{:03X}h", id & 0x1FFF_FFFF)
}
