//! What the page of a device calculates with.

use std::collections::BTreeMap;

use od_spec::model::{
    BitField, BitPattern, BitUsage, Dictionary, Entry, EntryId, EnumValue, NamedType, Object, PatternBit,
    PdoMapping, PdoTarget, Role, SpecialValue, StateMachine, TypeKind, Unit, Value,
};
use od_spec::wording::Language;

use crate::source::Source;
use crate::view::workbench::{
    Whole, WorkEntry, WorkField, WorkLimit, WorkMachine, WorkType, WorkValue, Workbench,
};

/// The units and types that entries of a device have.
#[derive(Default)]
struct Found<'a> {
    units: Numbered<'a, Unit>,
    types: Numbered<'a, NamedType>,
}

/// Things with names, each once, in the order in which they were found.
struct Numbered<'a, T> {
    list: Vec<&'a T>,
    by_name: BTreeMap<&'a str, usize>,
}

impl<T> Default for Numbered<'_, T> {
    fn default() -> Self {
        Self { list: Vec::new(), by_name: BTreeMap::new() }
    }
}

impl<'a, T> Numbered<'a, T> {
    /// The position of a thing, counted from 1.
    fn position(&mut self, name: &'a str, one: &'a T) -> usize {
        let next = self.list.len() + 1;
        let position = *self.by_name.entry(name).or_insert(next);
        if position == next {
            self.list.push(one);
        }
        position
    }
}

impl Source<'_> {
    /// What the page of a device calculates with.
    pub(crate) fn workbench(&self, device: &Dictionary) -> Workbench {
        let mut found = Found::default();
        let of_object = |object| (object, self.work_entries(device, object, &mut found));
        let lines: Vec<(&Object, Vec<WorkEntry>)> = device.objects.values().map(of_object).collect();
        let texts = |section: &'static str| {
            let keys = Language::ENGLISH.section(section);
            keys.map(|(key, _)| (key, self.language.words.text(section, key))).collect()
        };
        let machines = self.system.machines.values().filter(|machine| machine.devices.includes(&device.key));
        let frames = device.pdos.iter().map(|pdo| {
            let map = pdo.map.iter().map(|mapped| match mapped.target {
                PdoTarget::Entry(EntryId { index, sub }) => (index.0, sub.0, mapped.bits),
                PdoTarget::Dummy(data_type) => (data_type.code(), 0, mapped.bits),
            });
            (format!("{} {}", pdo.direction.pdo(), pdo.number), pdo.communication_index(), map.collect())
        });
        Workbench {
            decimal_sign: self.language.words.text("language", "decimal_sign"),
            phrases: texts("workbench"),
            aborts: texts("abort codes"),
            scales: found.units.list.iter().map(|unit| scale(unit)).collect(),
            named_types: found.types.list.iter().map(|named| named_type(named)).collect(),
            machines: machines.map(machine).collect(),
            frames: frames.collect(),
            lines: lines.into_iter().map(|(object, entries)| (object.index.0, entries)).collect(),
        }
    }

    fn work_entries<'d>(
        &self,
        device: &Dictionary,
        object: &'d Object,
        found: &mut Found<'d>,
    ) -> Vec<WorkEntry> {
        let entries = object.entries.iter().map(|entry| {
            let id = EntryId { index: object.index, sub: entry.sub };
            let names = self.code_names(&device.key, id);
            let (unit, named) = (entry.unit.as_deref(), entry.named_type.as_deref());
            WorkEntry {
                id,
                code: entry.data_type.code(),
                rights: rights(entry),
                names: [names.rust, names.c, names.structured_text],
                scale: unit.map_or(0, |unit| found.units.position(&unit.name, unit)),
                named_type: named.map_or(0, |named| found.types.position(&named.name, named)),
                default: default(entry),
                low: limit(entry.limits().0),
                high: limit(entry.limits().1)
                    .or_else(|| entry.capacity.map(|bytes| WorkLimit::Whole(Whole(bytes.into())))),
                special: entry.special.iter().map(special).collect(),
                part: part(object.role(), id),
            }
        });
        entries.collect()
    }
}

fn scale(unit: &Unit) -> (String, [Whole; 4]) {
    let parts = [
        unit.scale.numerator(),
        unit.scale.denominator(),
        unit.offset.numerator(),
        unit.offset.denominator(),
    ];
    (unit.symbol.clone(), parts.map(Whole))
}

fn named_type(named: &NamedType) -> WorkType {
    match &named.kind {
        TypeKind::Bits(fields) => WorkType::Bits(fields.iter().map(field).collect()),
        TypeKind::Enum(values) => WorkType::Values(values.iter().map(value).collect()),
    }
}

fn field(field: &BitField) -> WorkField {
    WorkField {
        first: field.first,
        last: field.last,
        name: field.name.clone(),
        usage: match field.usage {
            BitUsage::Used => "used",
            BitUsage::Reserved => "reserved",
            BitUsage::Unused => "unused",
        },
        active: field.active,
        values: field.values.iter().map(value).collect(),
        modes: field.modes.iter().map(|mode| (mode.mode.value.clone(), mode.name.clone())).collect(),
    }
}

fn value(value: &EnumValue) -> WorkValue {
    WorkValue { raw: Whole(value.value), name: value.name.clone(), is_supported: value.supported }
}

fn special(special: &SpecialValue) -> WorkValue {
    WorkValue { raw: Whole(special.value), name: special.name.clone(), is_supported: true }
}

fn machine(machine: &StateMachine) -> WorkMachine {
    let place = |id: EntryId| (id.index.0, id.sub.0);
    let states = machine.states.iter().map(|state| (pattern(&state.pattern), state.name.clone()));
    let commands = machine.commands.iter().map(|command| (pattern(&command.pattern), command.name.clone()));
    WorkMachine {
        status: place(machine.status),
        command: place(machine.command),
        states: states.collect(),
        commands: commands.collect(),
    }
}

fn pattern(pattern: &BitPattern) -> String {
    let sign = |bit: &PatternBit| match bit {
        PatternBit::Zero => '0',
        PatternBit::One => '1',
        PatternBit::Any => 'x',
        PatternBit::Rising => 'r',
        PatternBit::Falling => 'f',
    };
    pattern.0.iter().map(sign).collect()
}

fn rights(entry: &Entry) -> u8 {
    let (receive, transmit) = match entry.pdo {
        PdoMapping::None => (false, false),
        PdoMapping::Receive => (true, false),
        PdoMapping::Transmit => (false, true),
        PdoMapping::Both => (true, true),
    };
    let rights = [
        entry.access.is_readable(),
        entry.access.is_writable(),
        receive,
        transmit,
        entry.locked,
        entry.writable_when.is_some(),
    ];
    rights.iter().enumerate().map(|(at, has)| u8::from(*has) << at).sum()
}

fn default(entry: &Entry) -> Option<String> {
    match entry.default.as_ref()? {
        Value::NodeId(offset) => Some(format!("${offset:X}")),
        default @ (Value::Integer(_) | Value::Real(_) | Value::Text(_) | Value::Bytes(_)) => {
            let bytes = default.bytes_for(entry.data_type, 0)?;
            Some(bytes.iter().map(|byte| format!("{byte:02X}")).collect::<Vec<_>>().concat())
        }
    }
}

fn limit(limit: Option<Value>) -> Option<WorkLimit> {
    match limit? {
        Value::Integer(raw) => Some(WorkLimit::Whole(Whole(raw))),
        Value::Real(real) => Some(WorkLimit::Real(format!("{:?}", real.number()))),
        Value::NodeId(_) | Value::Text(_) | Value::Bytes(_) => None,
    }
}

/// What the value of an entry consists of (CiA 301 7.5.2).
const fn part(role: Role, id: EntryId) -> &'static str {
    match (role, id.index.0, id.sub.0) {
        (Role::PdoMapping, _, 1..) => "mapping",
        (Role::PdoCommunication, ..0x1800, 1) => "rpdo",
        (Role::PdoCommunication, _, 1) => "tpdo",
        (Role::SdoServer | Role::SdoClient, _, 1 | 2)
        | (Role::Communication, 0x1014, 0)
        | (Role::Communication, 0x1028, 1..) => "channel",
        (Role::Communication, 0x1005, 0) => "sync",
        (Role::Communication, 0x1012, 0) => "time",
        (
            Role::DeviceType
            | Role::ErrorRegister
            | Role::ErrorHistory
            | Role::StoreParameters
            | Role::RestoreDefaults
            | Role::Identity
            | Role::SdoServer
            | Role::SdoClient
            | Role::PdoCommunication
            | Role::PdoMapping
            | Role::Communication
            | Role::Manufacturer
            | Role::DeviceProfile
            | Role::InterfaceProfile
            | Role::Reserved,
            _,
            _,
        ) => "",
    }
}
