//! PDOs: communication and mapping parameters.

use std::collections::BTreeMap;

use super::{DataType, Direction, EntryId, Index, Object, Role, SubIndex, Text, Value};
use crate::source::Span;

/// A PDO with its default communication and mapping parameters.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Pdo {
    /// Direction, seen from the device.
    pub direction: Direction,
    /// Number, 1 to 512; the communication object is `1400h` or `1800h` plus number minus one.
    pub number: u16,
    /// COB-ID entry with its flag bits: 31 not valid, 30 no RTR (TPDO); `None` where it is not stated.
    pub cob_id: Option<Value>,
    /// Whether the PDO exists after start-up; not without a COB-ID.
    pub valid: bool,
    /// Transmission type (CiA 301 table 56), where it is stated.
    pub transmission: Option<u8>,
    /// Inhibit time in multiples of 100 µs, where the device has the entry.
    pub inhibit_time: Option<u16>,
    /// Event timer in ms, where the device has the entry.
    pub event_timer: Option<u16>,
    /// SYNC start value, where the device has the entry.
    pub sync_start: Option<u8>,
    /// Whether the mapping can be changed over the bus.
    pub variable_mapping: bool,
    /// Number of mapping entries the device offers.
    pub capacity: u8,
    /// What is mapped by default.
    pub map: Vec<Mapped>,
    /// Meaning.
    pub about: Text,
    /// Where it is written.
    pub span: Span,
}

impl Pdo {
    /// Index of the communication parameter object.
    pub const fn communication_index(&self) -> u16 {
        self.direction.first_communication_index() + self.number - 1
    }

    /// Index of the mapping parameter object.
    pub const fn mapping_index(&self) -> u16 {
        self.communication_index() + 0x200
    }

    /// The PDO whose communication parameter an object is, as its parameter objects say it; `None` for any other object.
    pub(crate) fn of_objects(object: &Object, objects: &BTreeMap<Index, Object>) -> Option<Self> {
        if object.role() != Role::PdoCommunication {
            return None;
        }
        let direction = match object.index.0 {
            ..0x1800 => Direction::Receive,
            0x1800.. => Direction::Transmit,
        };
        let mut pdo = Self {
            direction,
            number: object.index.0 - direction.first_communication_index() + 1,
            cob_id: None,
            valid: false,
            transmission: None,
            inhibit_time: None,
            event_timer: None,
            sync_start: None,
            variable_mapping: false,
            capacity: 0,
            map: Vec::new(),
            about: object.about.clone(),
            span: object.span,
        };
        if let Some(mapping) = objects.get(&Index(pdo.mapping_index())) {
            let count = mapping.entry(SubIndex(0));
            pdo.variable_mapping =
                mapping.is_structured() && count.is_some_and(|count| count.access.is_writable());
            pdo.capacity = mapping.highest().0;
        }
        pdo.follow(objects);
        Some(pdo)
    }

    /// Takes the values that the parameter objects have.
    pub(crate) fn follow(&mut self, objects: &BTreeMap<Index, Object>) {
        let value = |index: u16, sub: u8| objects.get(&Index(index))?.entry(SubIndex(sub))?.default.as_ref();
        let communication = self.communication_index();
        let number = |sub| value(communication, sub).and_then(Value::integer);
        self.cob_id = value(communication, 1).filter(|cob_id| cob_id.integer_for(0).is_some()).cloned();
        let raw = self.cob_id.as_ref().and_then(|cob_id| cob_id.integer_for(0));
        self.valid = raw.is_some_and(|raw| raw >> 31 & 1 == 0);
        self.transmission = number(2).and_then(|raw| u8::try_from(raw).ok());
        self.inhibit_time = number(3).and_then(|raw| u16::try_from(raw).ok());
        self.event_timer = number(5).and_then(|raw| u16::try_from(raw).ok());
        self.sync_start = number(6).and_then(|raw| u8::try_from(raw).ok());
        let mapping = |sub| value(self.mapping_index(), sub).and_then(Value::integer);
        let count = mapping(0).and_then(|count| u8::try_from(count).ok()).unwrap_or(0);
        let parameters = (1..=count).map_while(mapping).filter_map(|raw| u32::try_from(raw).ok());
        self.map = parameters.filter_map(Mapped::from_parameter).collect();
    }

    /// Mapped bits in all.
    pub fn bits(&self) -> u32 {
        self.map.iter().map(|mapped| u32::from(mapped.bits)).sum()
    }
}

/// One mapping entry.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mapped {
    /// What is mapped.
    pub target: PdoTarget,
    /// Its width.
    pub bits: u8,
}

/// What a mapping entry refers to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PdoTarget {
    /// An entry of the dictionary.
    Entry(EntryId),
    /// A placeholder of a data type; RPDOs only.
    Dummy(DataType),
}

impl Mapped {
    /// What a mapping parameter says; `None` for 0, an empty one.
    pub fn from_parameter(parameter: u32) -> Option<Self> {
        let [bits, sub, low, high] = parameter.to_le_bytes();
        let index = u16::from_le_bytes([low, high]);
        let dummy = DataType::ALL.into_iter().find(|data_type| data_type.code() == index && sub == 0);
        let target = match dummy {
            Some(data_type) => PdoTarget::Dummy(data_type),
            None => PdoTarget::Entry(EntryId { index: Index(index), sub: SubIndex(sub) }),
        };
        (parameter != 0).then_some(Self { target, bits })
    }

    /// The mapping parameter: index, sub-index, length (CiA 301 7.5.2.36).
    pub const fn parameter(&self) -> u32 {
        let (index, sub) = match self.target {
            PdoTarget::Entry(id) => (id.index.0, id.sub.0),
            PdoTarget::Dummy(data_type) => (data_type.code(), 0),
        };
        (index as u32) << 16 | (sub as u32) << 8 | self.bits as u32
    }
}
