//! What the workbench of the pages has to show, from the model, the SDO client and virtual nodes: nothing here is made by the script of the pages.

use std::collections::BTreeSet;

use firmware_glue::clock::Instant;
use firmware_glue::frame::Frame;
use firmware_glue::pdo::{pack, unpack};
use firmware_glue::sdo::{Channel, SdoClient};
use firmware_glue::{AbortCode, Application, Dictionary as _, EntryId as Place, NodeId};
use od_bus::runtime::{self, LiveDictionary};
use od_documents::Options;
use od_spec::diag::Diagnostics;
use od_spec::model::{
    DataType, Dictionary, Direction, Entry, EntryId, Family, Object, Pdo, PdoTarget, Real, StateMachine,
    System, TypeKind, Value,
};
use od_spec::wording::{Language, Wording};
use od_tests::Failure;
use od_tests::fuzz::Random;
use serde_json::{Value as Json, json};

/// The node-ID that is typed.
const NODE: u8 = 11;
/// Values by chance for each entry, and frames for each PDO.
const BY_CHANCE: usize = 4;
/// A service lock is open.
struct Unlocked;

impl Application<LiveDictionary<'_>> for Unlocked {
    fn is_unlocked(&self) -> bool {
        true
    }
}

/// What the pages of a system have to show.
pub(crate) fn expected(system: &System, language: &str, options: &Options) -> Result<Vec<u8>, Failure> {
    let mut pages = serde_json::Map::new();
    for device in &system.devices {
        let live = runtime::device(system, device, &mut Diagnostics::new()).ok_or("no table can be made")?;
        let lists = live.lists();
        let table = lists.table().map_err(|error| error.to_string())?;
        let dictionary = LiveDictionary::new(&live, &table, NODE)?;
        let page = Page {
            system,
            device,
            dictionary,
            wording: Wording::manual(Language::of(language)),
            options,
            random: Random::new(1),
        };
        pages.insert(format!("{}.html", device.key), page.expected()?);
    }
    let language = Language::of(language);
    let aborts: Vec<_> = AbortCode::ALL
        .iter()
        .map(|code| {
            let digits = format!("{:08X}", code.0);
            let text = language.section("abort codes").find(|(key, _)| *key == digits);
            (digits, text.map(|(_, text)| text))
        })
        .collect();
    Ok(serde_json::to_vec(
        &json!({"node": NODE, "aborts": aborts, "decimal_sign": language.decimal("."), "pages": pages}),
    )?)
}

struct Page<'a> {
    system: &'a System,
    device: &'a Dictionary,
    /// As after a factory reset.
    dictionary: LiveDictionary<'a>,
    wording: Wording,
    options: &'a Options,
    random: Random,
}

impl Page<'_> {
    fn expected(mut self) -> Result<Json, Failure> {
        let mut entries = Vec::new();
        for (id, object, entry) in self.device.entries() {
            entries.push(self.entry(id, object, entry)?);
        }
        let pdos = self.device.pdos.iter().map(|pdo| self.pdo(pdo)).collect::<Vec<_>>();
        Ok(json!({"entries": entries, "pdos": pdos}))
    }

    fn entry(&mut self, id: EntryId, object: &Object, entry: &Entry) -> Result<Json, Failure> {
        let cases = self.values(entry).into_iter().map(|bytes| self.case(id, entry, &bytes));
        let cases = cases.collect::<Result<Vec<_>, _>>()?;
        let initial = entry.default.as_ref().and_then(|default| default.bytes_for(entry.data_type, NODE));
        let names = self.options.code_names.get(&self.device.key).and_then(|names| names.get(&id));
        Ok(json!({
            "index": id.index.0,
            "sub": id.sub.0,
            "structured": object.is_structured(),
            "readable": entry.access.is_readable(),
            "writable": entry.access.is_writable(),
            // Rules of communication objects, and the limits of what an alias shows, are not those of the entry.
            "ruled": id.index.is_communication_profile() || entry.alias.is_some(),
            "names": names.map(|names| [&names.rust, &names.c, &names.structured_text]),
            "initial": initial.map(|bytes| hexadecimal(&bytes)),
            "cases": cases,
        }))
    }

    /// Bytes that say something: the ends of the type and of the limits and what is next to them, named values, single bits, and some by chance.
    fn values(&mut self, entry: &Entry) -> Vec<Vec<u8>> {
        match entry.data_type.family() {
            Family::Boolean | Family::Signed | Family::Unsigned => {
                let Some((lowest, highest)) = entry.data_type.range() else { return Vec::new() };
                let special = entry.special.iter().map(|special| special.value);
                let mut raw: BTreeSet<i128> = special.collect();
                raw.extend(entry.default.as_ref().and_then(|default| default.integer_for(NODE)));
                raw.extend([Some(lowest), Some(highest), entry.low, entry.high].into_iter().flatten());
                match entry.named_type.as_ref().map(|named| &named.kind) {
                    Some(TypeKind::Enum(values)) => raw.extend(values.iter().map(|value| value.value)),
                    Some(TypeKind::Bits(fields)) => raw.extend(fields.iter().map(|field| 1 << field.first)),
                    None => {}
                }
                raw.extend(raw.clone().into_iter().flat_map(|raw| [raw - 1, raw + 1]));
                raw.extend([0, 1, 9, 10, -1]);
                let size = usize::from(entry.data_type.bits().unwrap_or(64).div_ceil(8));
                for _ in 0..BY_CHANCE {
                    raw.extend(
                        Value::from_bytes(entry.data_type, &self.by_chance(size))
                            .and_then(|value| value.integer()),
                    );
                }
                raw.retain(|raw| (lowest..=highest).contains(raw));
                let bytes = raw.into_iter().map(|raw| Value::Integer(raw).bytes_for(entry.data_type, NODE));
                bytes.flatten().collect()
            }
            Family::Real => {
                let limits = [&entry.real_limits.low, &entry.real_limits.high].into_iter().flatten();
                let mut numbers: Vec<f64> = limits.map(Real::number).collect();
                let beside: Vec<f64> =
                    numbers.iter().flat_map(|number| [number - 0.5, number + 0.5]).collect();
                numbers.extend(beside);
                numbers.extend([
                    0.0,
                    1.0,
                    -1.5,
                    0.1,
                    1.0 / 3.0,
                    123_456.789,
                    1e-5,
                    1e15,
                    1e16,
                    2.5e20,
                    -0.000_123,
                ]);
                let numbers = numbers.into_iter().map(|number| Value::Real(number.into()));
                let mut all: Vec<Vec<u8>> =
                    numbers.filter_map(|value| value.bytes_for(entry.data_type, NODE)).collect();
                let size = usize::from(entry.data_type.bits().unwrap_or(64) / 8);
                all.extend((0..BY_CHANCE).map(|_| self.by_chance(size)));
                all
            }
            Family::VisibleString => ["", "A", "1.09", "Grüße", "a text that is longer than seven bytes"]
                .map(|text| text.as_bytes().to_vec())
                .into(),
            Family::UnicodeString => {
                ["A", "Grüße 𝄞"].map(|text| text.encode_utf16().flat_map(u16::to_le_bytes).collect()).into()
            }
            Family::OctetString | Family::Domain => {
                [1, 4, 5, 7, 8, 14, 15, 23].map(|size| self.by_chance(size)).into()
            }
            Family::Time => (0..BY_CHANCE)
                .map(|_| self.by_chance(6))
                .map(|bytes| [&bytes[..3], &[0], &bytes[4..]].concat())
                .collect(),
        }
    }

    fn case(&self, id: EntryId, entry: &Entry, bytes: &[u8]) -> Result<Json, Failure> {
        let value = Value::from_bytes(entry.data_type, bytes);
        let integer = value.as_ref().and_then(Value::integer);
        let text = value.as_ref().map(|value| self.wording.value(Some(id.index), entry, value));
        let fields = entry.named_type.as_ref().and_then(|named| match &named.kind {
            TypeKind::Bits(fields) => Some(fields),
            TypeKind::Enum(_) => None,
        });
        let set = fields.zip(integer).map(|(fields, raw)| {
            let set = fields.iter().filter(|field| {
                let width = field.last - field.first + 1;
                raw >> field.first & ((1 << width) - 1) != 0
            });
            set.map(|field| field.first).collect::<Vec<_>>()
        });
        Ok(json!({
            "bytes": hexadecimal(bytes),
            "text": text,
            "raw": integer.map(|raw| raw.to_string()),
            "set": set,
            "machines": integer.map(|raw| self.machines(id, entry.data_type, raw)),
            "amount": entry.unit.as_ref().zip(integer).filter(|(unit, _)| !unit.is_plain())
                .map(|(unit, raw)| self.wording.decimal(&unit.amount(raw))),
            "taken": self.is_taken(id, entry, bytes),
            "frames": frames(id, bytes)?,
        }))
    }

    /// What the state machines of the device know by a raw value: states, then commands.
    fn machines(&self, id: EntryId, data_type: DataType, raw: i128) -> [Vec<&str>; 2] {
        let bits = raw.rem_euclid(1 << data_type.bits().unwrap_or(64));
        let matches = |(mask, value): (u64, u64)| bits & i128::from(mask) == i128::from(value);
        let on_device = |machine: &&StateMachine| machine.devices.includes(&self.device.key);
        let of_device = || self.system.machines.values().filter(on_device);
        let states = of_device().filter(|machine| machine.status == id).flat_map(|machine| &machine.states);
        let commands =
            of_device().filter(|machine| machine.command == id).flat_map(|machine| &machine.commands);
        [
            states
                .filter(|state| matches(state.pattern.mask_and_value()))
                .map(|state| state.name.as_str())
                .collect(),
            commands
                .filter(|command| matches(command.pattern.mask_and_value()))
                .map(|command| command.name.as_str())
                .collect(),
        ]
    }

    /// Whether a virtual node takes a value; nothing where something else than the value decides.
    fn is_taken(&self, id: EntryId, entry: &Entry, bytes: &[u8]) -> Option<bool> {
        if !entry.access.is_writable() || entry.data_type == DataType::Domain {
            return None;
        }
        match self.dictionary.clone().write(id.index.0, id.sub.0, bytes, &mut Unlocked) {
            Ok(_) => Some(true),
            Err(
                AbortCode::INVALID_VALUE
                | AbortCode::TOO_HIGH
                | AbortCode::TOO_LOW
                | AbortCode::LENGTH
                | AbortCode::TOO_LONG
                | AbortCode::TOO_SHORT,
            ) => Some(false),
            Err(_) => None,
        }
    }

    /// Frames of a PDO, each with the bytes of every mapped entry: as a node packs them, or has them after it received the frame.
    fn pdo(&mut self, pdo: &Pdo) -> Json {
        let ids: Vec<EntryId> = pdo
            .map
            .iter()
            .filter_map(|mapped| match mapped.target {
                PdoTarget::Entry(id) => Some(id),
                PdoTarget::Dummy(_) => None,
            })
            .collect();
        let size = usize::try_from(pdo.bits().div_ceil(8)).unwrap_or_default();
        let count = if size == 0 { 0 } else { 2 * BY_CHANCE };
        let frames = (0..count).map(|_| {
            let mut node = self.dictionary.clone();
            let carried = match pdo.direction {
                Direction::Transmit => {
                    for id in &ids {
                        let size = node.value(place(*id)).map_or(0, |value| value.len());
                        // What the device never changes stays as it is.
                        let _ = node.hold(place(*id), &self.by_chance(size));
                    }
                    pack(&mut node, pdo.number, &mut ()).ok().map(|frame| frame.to_vec())
                }
                Direction::Receive => {
                    // Small numbers are within more limits.
                    let mut frame = self.by_chance(size);
                    for byte in frame.iter_mut().filter(|_| self.random.chance(70)) {
                        *byte = 0;
                    }
                    let received = unpack(&mut node, pdo.number, &frame, &mut Unlocked);
                    received.is_ok_and(|received| received.refused.is_none()).then_some(frame)
                }
            };
            // What a node does not carry, as the PDO is switched off or a value refused, is cut into pieces here.
            let (frame, values) = match carried {
                Some(frame) => (frame, ids.iter().map(|id| node.value(place(*id))).collect()),
                None => {
                    let frame = self.by_chance(size);
                    let values: Vec<Option<Vec<u8>>> = pieces(&frame, pdo).map(Some).collect();
                    (frame, values)
                }
            };
            let values: Vec<_> = values.iter().map(|value| value.as_deref().map(hexadecimal)).collect();
            json!({"bytes": hexadecimal(&frame), "values": values})
        });
        let frames: Vec<Json> = frames.collect();
        let cob_id = pdo.cob_id.as_ref().and_then(|cob_id| cob_id.integer_for(NODE));
        json!({
            "name": format!("{} {}", pdo.direction.pdo(), pdo.number),
            "places": ids.iter().map(|id| (id.index.0, id.sub.0)).collect::<Vec<_>>(),
            "can_id": cob_id.map(|raw| format!("{:03X}", raw & 0x7FF)),
            "frames": frames,
        })
    }

    fn by_chance(&mut self, size: usize) -> Vec<u8> {
        (0..size).map(|_| u8::try_from(self.random.below(256)).unwrap_or_default()).collect()
    }
}

const fn place(id: EntryId) -> Place {
    Place { index: id.index.0, sub: id.sub.0 }
}

/// The bytes of each entry in a frame of up to eight bytes.
fn pieces(frame: &[u8], pdo: &Pdo) -> impl Iterator<Item = Vec<u8>> {
    let whole = frame.iter().rev().fold(0_u128, |whole, byte| whole << 8 | u128::from(*byte));
    let mut first = 0;
    let pieces = pdo.map.iter().map(move |mapped| {
        let piece = whole >> first & ((1 << mapped.bits) - 1);
        first += u32::from(mapped.bits);
        (mapped.target, piece.to_le_bytes()[..usize::from(mapped.bits.div_ceil(8))].to_vec())
    });
    pieces.filter_map(|(target, bytes)| match target {
        PdoTarget::Entry(_) => Some(bytes),
        PdoTarget::Dummy(_) => None,
    })
}

/// What the SDO client sends to write a value, in segments where it has more than four bytes.
fn frames(id: EntryId, bytes: &[u8]) -> Result<Vec<String>, Failure> {
    let channel = Channel::predefined(NodeId::new(NODE).ok_or("a node-ID")?);
    let client = SdoClient::new(channel);
    let start = client.start_write(place(id), bytes, Instant::ZERO);
    let (mut writing, mut sent) = start.map_err(|code| code.to_string())?;
    let mut frames = Vec::new();
    let mut answer = [0x60, 0, 0, id.sub.0, 0, 0, 0, 0];
    answer[1..3].copy_from_slice(&id.index.0.to_le_bytes());
    loop {
        frames.push(format!(
            "{:03X} {}",
            0x600 + u16::from(NODE),
            hexadecimal(sent.bytes().unwrap_or_default())
        ));
        let step = writing.handle(&Frame::full(channel.answer, answer), Instant::ZERO);
        match (step.send, step.outcome) {
            (Some(next), None) => {
                let toggle = next.bytes().and_then(|bytes| bytes.first().copied()).unwrap_or_default() & 0x10;
                answer = [0x20 | toggle, 0, 0, 0, 0, 0, 0, 0];
                sent = next;
            }
            (None, Some(Ok(_))) => return Ok(frames),
            (send, outcome) => return Err(format!("{id}: {send:?}, {outcome:?}").into()),
        }
    }
}

fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02X}")).collect::<Vec<_>>().join(" ")
}
