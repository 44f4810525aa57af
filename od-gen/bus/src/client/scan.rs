//! Who is on the bus.

use std::collections::BTreeMap;
use std::ops::RangeInclusive;
use std::time::Duration;

use firmware_glue::frame::{CanId, Frame};
use od_spec::model::{Dictionary, EntryId, Index, SubIndex, Value};

use super::{AccessError, Bus, BusError, Client};

/// A node-ID at which a node was heard.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Heard {
    /// The node-ID.
    pub node: u8,
    /// The state of the last boot-up message or heartbeat, where one came.
    pub state: Option<u8>,
    /// What came to a request.
    pub answer: Answer,
}

/// What a node-ID answers by SDO.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Answer {
    /// Nothing: the node is stopped, or has no SDO server.
    None,
    /// What the node says of itself.
    Of(Identity),
    /// Two answers to one request: two devices have this node-ID.
    Two,
}

/// Device type (1000h), identity (1018h) and name (1008h); what a node does not have or does not report is open.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Identity {
    /// 1000h.
    pub device_type: Option<u32>,
    /// 1018h.1.
    pub vendor: Option<u32>,
    /// 1018h.2.
    pub product: Option<u32>,
    /// 1018h.3.
    pub revision: Option<u32>,
    /// 1018h.4.
    pub serial: Option<u32>,
    /// 1008h.
    pub name: Option<String>,
}

/// So many frames of others are taken between two requests.
const MEANWHILE: usize = 32;

pub(super) const DEVICE_TYPE: EntryId = id(0x1000, 0);
const VENDOR: EntryId = id(0x1018, 1);
const PRODUCT: EntryId = id(0x1018, 2);
const NAME: EntryId = id(0x1008, 0);
pub(super) const REVISION: EntryId = id(0x1018, 3);
pub(super) const SERIAL: EntryId = id(0x1018, 4);
/// What distinguishes devices.
const TELLING: [EntryId; 3] = [DEVICE_TYPE, VENDOR, PRODUCT];

const fn id(index: u16, sub: u8) -> EntryId {
    EntryId { index: Index(index), sub: SubIndex(sub) }
}

impl Identity {
    /// What a device is by its dictionary.
    pub fn of(device: &Dictionary) -> Self {
        let raw = |id| u32::try_from(device.entry(id)?.default.as_ref()?.integer()?).ok();
        Self {
            device_type: raw(DEVICE_TYPE),
            vendor: raw(VENDOR),
            product: raw(PRODUCT),
            revision: raw(REVISION),
            serial: raw(SERIAL),
            name: match device.entry(NAME).and_then(|entry| entry.default.as_ref()) {
                Some(Value::Text(text)) => Some(text.clone()),
                _ => None,
            },
        }
    }

    /// Whether a node can be a device: device type, vendor, product and name are the same, as far as the dictionary states them.
    pub fn fits(&self, device: &Self) -> bool {
        let reported = |(id, stated)| self.number(id).is_some_and(|reported| reported == stated);
        device.stated().next().is_some()
            && device.stated().all(reported)
            && (self.name.is_none() || device.name.is_none() || self.name == device.name)
    }

    /// The numbers by which a dictionary distinguishes a device from others. Vendor or product 0 means that it is
    /// unknown.
    pub(super) fn stated(&self) -> impl Iterator<Item = (EntryId, u32)> {
        TELLING.into_iter().filter_map(|id| {
            let number = self.number(id)?;
            (id == DEVICE_TYPE || number != 0).then_some((id, number))
        })
    }

    pub(super) fn number(&self, id: EntryId) -> Option<u32> {
        match id {
            DEVICE_TYPE => self.device_type,
            VENDOR => self.vendor,
            PRODUCT => self.product,
            REVISION => self.revision,
            SERIAL => self.serial,
            _ => None,
        }
    }
}

/// What was heard at a node-ID.
#[derive(Debug, Default)]
struct Noted {
    state: Option<u8>,
    answers: usize,
}

/// Asks all 127 node-IDs, listens to boot-up messages and heartbeats meanwhile, and asks those that answer for their identity.
///
/// # Errors
/// [`BusError`]: nothing goes over the bus.
pub fn scan<B: Bus>(client: &mut Client<B>, within: Duration) -> Result<Vec<Heard>, BusError> {
    let mut noted = asked(client, 1..=127, within)?;
    // Another master may have asked the same at the same time. Two devices answer twice every time.
    let twice: Vec<u8> = noted.iter().filter(|(_, one)| one.answers > 1).map(|(node, _)| *node).collect();
    for node in twice {
        let answers = asked(client, node..=node, within)?.get(&node).map_or(1, |again| again.answers);
        noted.entry(node).or_default().answers = answers.max(1);
    }
    let mut nodes = Vec::new();
    for (node, Noted { state, answers }) in noted {
        let answer = match answers {
            0 => Answer::None,
            1 => Answer::Of(identity(client, node)?),
            _ => Answer::Two,
        };
        nodes.push(Heard { node, state, answer });
    }
    Ok(nodes)
}

/// What is heard after each of some nodes was asked for its device type.
fn asked<B: Bus>(
    client: &mut Client<B>,
    nodes: RangeInclusive<u8>,
    within: Duration,
) -> Result<BTreeMap<u8, Noted>, BusError> {
    let mut noted: BTreeMap<u8, Noted> = BTreeMap::new();
    let mut note = |frame: &Frame| {
        let id = frame.id().get();
        let Ok(node @ 1..=127) = u8::try_from(id & 0x7F) else { return };
        match (id & 0x780, frame.bytes()) {
            (0x580, Some([_, 0x00, 0x10, 0x00, ..])) => noted.entry(node).or_default().answers += 1,
            // The highest bit belongs to node guarding.
            (0x700, Some([state])) => noted.entry(node).or_default().state = Some(state & 0x7F),
            _ => {}
        }
    };
    for node in nodes {
        let Some(id) = CanId::new(0x600 + u16::from(node)) else { continue };
        client.bus().send(&Frame::full(id, [0x40, 0x00, 0x10, 0, 0, 0, 0, 0]))?;
        // Frames that come meanwhile are taken, so that they do not fill the adapter.
        for _ in 0..MEANWHILE {
            let Some(frame) = client.bus().receive(Duration::from_millis(1))? else { break };
            note(&frame);
        }
    }
    let begin = client.bus().now();
    while u128::from(client.bus().now().saturating_sub(begin)) < within.as_micros() {
        if let Some(frame) = client.bus().receive(Duration::from_millis(20))? {
            note(&frame);
        }
    }
    Ok(noted)
}

/// What a node says of itself.
pub(super) fn identity<B: Bus>(client: &mut Client<B>, node: u8) -> Result<Identity, BusError> {
    let mut bytes = |id| match client.read(node, id) {
        Ok(bytes) => Ok(Some(bytes)),
        Err(AccessError::Bus(error)) => Err(error),
        Err(_) => Ok(None),
    };
    let name = bytes(NAME)?.map(|name| String::from_utf8_lossy(&name).trim_end_matches('\0').to_owned());
    let mut read = |id| Ok(bytes(id)?.and_then(|bytes| Some(u32::from_le_bytes(bytes.try_into().ok()?))));
    Ok(Identity {
        device_type: read(DEVICE_TYPE)?,
        vendor: read(VENDOR)?,
        product: read(PRODUCT)?,
        revision: read(REVISION)?,
        serial: read(SERIAL)?,
        name,
    })
}
