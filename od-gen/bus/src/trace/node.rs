//! A node on the bus: its device, and what its parameters are by now, as far as the trace shows it.

use std::collections::BTreeMap;

use od_formats::concise::words;
use od_spec::model::{
    DataType, Dictionary, EntryId, Index, Mapped, Pdo, StateMachine, SubIndex, System, Value,
};

use super::transfer::Transfer;

/// Bit 31 of the COB-ID of a PDO or an SDO: it does not exist. Bit 29: its identifier has 29 bits.
const NOT_VALID: u32 = 1 << 31;
const EXTENDED: u32 = 1 << 29;
/// The signature of "store parameters".
const SAVE: u32 = 0x6576_6173;

/// A node, by its node-ID, with the device that it is.
#[derive(Debug)]
pub struct Node<'a> {
    /// Its node-ID, 1 to 127.
    pub id: u8,
    /// What its device belongs to.
    pub system: &'a System,
    /// Its device.
    pub device: &'a Dictionary,
    /// Parameters that the trace shows to be others than the defaults.
    written: BTreeMap<EntryId, u32>,
    /// Those that the node has stored.
    stored: BTreeMap<EntryId, u32>,
    /// What each of its SDO servers is at, by the index of its parameters.
    pub(super) transfers: BTreeMap<u16, Transfer>,
}

/// Whose frames come with an identifier.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum SdoSide {
    Client,
    Server,
}

impl<'a> Node<'a> {
    /// A node whose parameters are the defaults of its device.
    pub fn new(id: u8, system: &'a System, device: &'a Dictionary) -> Self {
        Self {
            id,
            system,
            device,
            written: BTreeMap::new(),
            stored: BTreeMap::new(),
            transfers: BTreeMap::new(),
        }
    }

    /// `pmc (node 5)`.
    pub fn name(&self) -> String {
        format!("{} (node {})", self.device.key, self.id)
    }

    /// A parameter as it is now.
    pub(crate) fn parameter(&self, index: u16, sub: u8) -> Option<u32> {
        let id = EntryId { index: Index(index), sub: SubIndex(sub) };
        if let Some(written) = self.written.get(&id) {
            return Some(*written);
        }
        let default = self.device.entry(id)?.default.as_ref()?;
        u32::try_from(default.integer_for(self.id)?).ok()
    }

    /// A parameter as the trace shows it; nothing where it is as specified, as far as is known.
    pub(crate) fn seen(&self, index: u16, sub: u8) -> Option<u32> {
        self.written.get(&EntryId { index: Index(index), sub: SubIndex(sub) }).copied()
    }

    /// The identifier in a parameter, if it is valid and has 11 bits.
    pub(super) fn cob_id(&self, index: u16, sub: u8) -> Option<u16> {
        let cob_id = self.parameter(index, sub).filter(|cob_id| cob_id & (NOT_VALID | EXTENDED) == 0)?;
        u16::try_from(cob_id & 0x7FF).ok()
    }

    /// Its PDOs with an identifier.
    pub(super) fn pdos_at(&self, id: u16) -> impl Iterator<Item = &'a Pdo> {
        let pdos = self.device.pdos.iter();
        pdos.filter(move |pdo| self.cob_id(pdo.communication_index(), 1) == Some(id))
    }

    /// What a PDO carries by now.
    pub(super) fn mapping(&self, pdo: &Pdo) -> Vec<Mapped> {
        let index = pdo.mapping_index();
        let count = self.parameter(index, 0).and_then(|count| u8::try_from(count).ok()).unwrap_or(0);
        let parameters = (1..=count).map_while(|sub| self.parameter(index, sub));
        parameters.filter_map(Mapped::from_parameter).collect()
    }

    /// The SDO server whose channel has an identifier: the index of its parameters, and who sends.
    pub(super) fn sdo_at(&self, id: u16) -> Option<(u16, SdoSide)> {
        let own = u16::from(self.id);
        let first = [(0x1200, SdoSide::Client, 0x600 + own), (0x1200, SdoSide::Server, 0x580 + own)];
        let more = self.device.objects.range(Index(0x1201)..=Index(0x127F)).flat_map(|(index, _)| {
            let side = |sub, side| Some((index.0, side, self.cob_id(index.0, sub)?));
            [side(1, SdoSide::Client), side(2, SdoSide::Server)].into_iter().flatten()
        });
        let mut channels = first.into_iter().chain(more);
        channels.find(|(_, _, cob_id)| *cob_id == id).map(|(index, side, _)| (index, side))
    }

    /// Takes note of a value that a client has written and the node has accepted.
    pub(super) fn accept(&mut self, index: u16, sub: u8, bytes: &[u8]) {
        let mut wide = [0; 4];
        let Some(place) = wide.get_mut(..bytes.len()) else { return };
        place.copy_from_slice(bytes);
        let value = u32::from_le_bytes(wide);
        match (index, sub) {
            (0x1010, 1 | 2) if value == SAVE => self.stored.clone_from(&self.written),
            (0x1011, 1 | 2) => self.stored.clear(),
            (0x1005..=0x1FFF, _) => {
                self.written.insert(EntryId { index: Index(index), sub: SubIndex(sub) }, value);
            }
            _ => {}
        }
    }

    /// Takes note of a reset: what was not stored is lost.
    pub(super) fn reset(&mut self) {
        self.written.clone_from(&self.stored);
        self.transfers.clear();
    }

    /// `6064h position actual value`, `3020h.5 battery: voltage`.
    pub fn entry(&self, id: EntryId) -> String {
        let number = id.to_string();
        match self.device.objects.get(&id.index) {
            None => format!("{number} (no such object)"),
            Some(object) => match object.entry(id.sub) {
                None => format!("{number} {} (no such sub-index)", object.name),
                Some(entry) if object.is_structured() => format!("{number} {}: {}", object.name, entry.name),
                Some(_) => format!("{number} {}", object.name),
            },
        }
    }

    /// A value in words: in its unit, by its name, with the bits that it sets and the state that it shows; bytes where
    /// the type has no such value.
    pub fn value(&self, id: EntryId, bytes: &[u8]) -> String {
        let object = self.device.objects.get(&id.index);
        let found = object.and_then(|object| Some((object, object.entry(id.sub)?)));
        let Some((object, entry)) = found else { return hexadecimal(bytes) };
        let Some(value) = Value::from_bytes(entry.data_type, unpadded(entry.data_type, bytes)) else {
            return format!("{} (no value of its type, {})", hexadecimal(bytes), entry.data_type.name());
        };
        let text = match &value {
            Value::Text(text) => format!("\"{text}\""),
            value => words(object, entry, value),
        };
        let raw = value.integer().and_then(|raw| u64::try_from(raw).ok());
        let mut described = raw.map(|raw| self.machines(id, raw)).unwrap_or_default();
        described.insert(0, text);
        described.join(", ")
    }

    /// The states or commands that state machines know by a value.
    fn machines(&self, id: EntryId, raw: u64) -> Vec<String> {
        let matches = |(mask, value): (u64, u64)| raw & mask == value;
        let of_device = |machine: &&StateMachine| machine.devices.includes(&self.device.key);
        let mut described = Vec::new();
        for machine in self.system.machines.values().filter(of_device) {
            if machine.status == id {
                let states = machine.states.iter().filter(|state| matches(state.pattern.mask_and_value()));
                described.extend(states.map(|state| format!("state: {}", state.name)));
            }
            if machine.command == id {
                let commands = machine.commands.iter();
                let commands = commands.filter(|command| matches(command.pattern.mask_and_value()));
                described.extend(commands.map(|command| format!("command: {}", command.name)));
            }
        }
        described
    }
}

/// Bytes without the zeros that pad a text. Those of an OCTET_STRING belong to it.
fn unpadded(data_type: DataType, bytes: &[u8]) -> &[u8] {
    let width = match data_type {
        DataType::VisibleString => 1,
        DataType::UnicodeString => 2,
        _ => return bytes,
    };
    let padding = bytes.rchunks(width).take_while(|character| character.iter().all(|byte| *byte == 0));
    bytes.get(..bytes.len() - padding.map(<[u8]>::len).sum::<usize>()).unwrap_or(bytes)
}

/// `01 A2 FF`.
pub(super) fn hexadecimal(bytes: &[u8]) -> String {
    if bytes.is_empty() {
        return "no bytes".to_owned();
    }
    bytes.iter().map(|byte| format!("{byte:02X}")).collect::<Vec<_>>().join(" ")
}

/// `1 byte`, `2 bytes`.
pub(super) fn count(bytes: usize) -> String {
    if bytes == 1 { "1 byte".to_owned() } else { format!("{bytes} bytes") }
}

#[cfg(test)]
mod tests {
    use firmware_glue::frame::{CanId, Frame};
    use od_spec::source::SourceMap;
    use od_spec::{NoFiles, compile};

    use super::*;
    use crate::trace::Decoder;

    const LAMP: &str = "
od-spec: 1
title: Lamp
uses: [cia301]
devices:
  lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer, store parameters, restore defaults]}
objects:
  0x2000: {name: key, type: octet-string, capacity: 8, access: rw}
  0x2001: {name: label, type: visible-string, capacity: 8, access: rw}
  0x2002: {name: letters, type: unicode-string, capacity: 8, access: rw}
";

    /// What a decoder of the lamp, as node 5, reports of some frames.
    fn described(frames: &[(u16, &[u8])]) -> Vec<String> {
        let mut sources = SourceMap::new();
        let root = sources.add("lamp.od.yaml", LAMP);
        let compiled = compile(&mut sources, root, &mut NoFiles);
        let system = compiled.system.unwrap_or_else(|| panic!("{:?}", compiled.diagnostics));
        let mut decoder = Decoder::new(vec![Node::new(5, &system, &system.devices[0])]);
        let described = frames.iter().map(|(id, bytes)| {
            let frame = Frame::data(CanId::new(*id).unwrap(), bytes).unwrap();
            decoder.frame(&frame).rsplit("  ").next().unwrap().to_owned()
        });
        described.collect()
    }

    #[test]
    fn zeros_pad_a_text_and_belong_to_octets() {
        assert_eq!(
            described(&[
                (0x585, &[0x43, 0x00, 0x20, 0, 1, 2, 0, 0]),
                (0x585, &[0x43, 0x01, 0x20, 0, b'O', b'K', 0, 0]),
                (0x585, &[0x43, 0x02, 0x20, 0, b'A', 0, 0, 0]),
            ]),
            ["2000h key = 01020000", "2001h label = \"OK\"", "2002h letters = \"A\""]
        );
    }

    #[test]
    fn commands_of_1010h_and_1011h_are_reported_as_such() {
        assert_eq!(
            described(&[
                (0x605, &[0x23, 0x10, 0x10, 1, b's', b'a', b'v', b'e']),
                (0x605, &[0x23, 0x11, 0x10, 1, b'l', b'o', b'a', b'd']),
                (0x605, &[0x23, 0x11, 0x10, 1, 1, 0, 0, 0]),
            ]),
            [
                "write 1010h.1 Store parameters: Save all parameters = \"save\"",
                "write 1011h.1 Restore default parameters: Restore all default parameters = \"load\"",
                "write 1011h.1 Restore default parameters: Restore all default parameters = 0x00000001 (can restore)",
            ]
        );
    }
}
