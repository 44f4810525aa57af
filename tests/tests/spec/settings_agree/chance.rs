//! Settings by chance, of values where mistakes are made: at limits and next to them, identifiers, counts, mappings.

use od_spec::model::{DataType, Dictionary, Entry, EntryId, Index, Object, Role, SubIndex, TypeKind, Value};
use od_tests::fuzz::Random;

/// A setting, as it is written and as the model holds it.
pub(crate) struct Setting {
    pub(crate) id: EntryId,
    pub(crate) text: String,
    pub(crate) value: Value,
}

impl Setting {
    fn new(id: EntryId, value: Value) -> Self {
        let text = format!("{:04X}.{}={}", id.index.0, id.sub.0, written(&value));
        Self { id, text, value }
    }

    pub(crate) fn number(index: u16, sub: u8, number: i128) -> Self {
        Self::new(EntryId { index: Index(index), sub: SubIndex(sub) }, Value::Integer(number))
    }

    pub(crate) fn text(index: u16, sub: u8, text: &str) -> Self {
        Self::new(EntryId { index: Index(index), sub: SubIndex(sub) }, Value::Text(text.to_owned()))
    }
}

/// One to five settings of different entries; often several of one object, or of one PDO.
pub(crate) fn settings(device: &Dictionary, random: &mut Random) -> Vec<Setting> {
    let objects: Vec<&Object> = device.objects.values().collect();
    if random.chance(15) {
        return mapping(device, random);
    }
    let wanted = random.small(5);
    let mut settings: Vec<Setting> = Vec::new();
    let mut object = None;
    for _ in 0..wanted * 4 {
        if settings.len() == wanted {
            break;
        }
        if object.is_none() || random.chance(50) {
            object =
                if random.chance(30) { pdo_object(device, random) } else { random.pick(&objects).copied() };
        }
        let Some(object) = object else { break };
        let Some(entry) = random.pick(&object.entries) else { break };
        // What cannot be written says little, and there is much of it.
        if !entry.access.is_writable() && random.chance(95) {
            continue;
        }
        let id = EntryId { index: object.index, sub: entry.sub };
        if settings.iter().any(|before| before.id == id) {
            continue;
        }
        settings.extend(value(device, object, entry, random).map(|value| Setting::new(id, value)));
    }
    settings
}

/// A whole mapping of a PDO, of entries that can be mapped into it; its number may be wrong, and its length.
fn mapping(device: &Dictionary, random: &mut Random) -> Vec<Setting> {
    let Some(pdo) = random.pick(&device.pdos) else { return Vec::new() };
    let mappable: Vec<_> = device.entries().filter(|(.., entry)| entry.pdo.allows(pdo.direction)).collect();
    let count = random.small(usize::from(pdo.capacity.min(10))).max(1);
    let index = pdo.mapping_index();
    let mut settings = Vec::new();
    for sub in (1..).take(count) {
        let Some((id, _, entry)) = random.pick(&mappable) else { break };
        let bits = i128::from(entry.data_type.bits().unwrap_or(8));
        let parameter = i128::from(id.index.0) << 16 | i128::from(id.sub.0) << 8 | bits;
        settings.push(Setting::number(index, sub, parameter));
    }
    let number = if random.chance(90) { settings.len() } else { random.below(12) };
    settings.push(Setting::number(index, 0, i128::try_from(number).unwrap_or_default()));
    settings
}

/// One of the two parameter objects of a PDO.
fn pdo_object<'d>(device: &'d Dictionary, random: &mut Random) -> Option<&'d Object> {
    let pdo = random.pick(&device.pdos)?;
    let index = if random.chance(50) { pdo.communication_index() } else { pdo.mapping_index() };
    device.objects.get(&Index(index))
}

/// As a setting writes it.
fn written(value: &Value) -> String {
    match value {
        Value::Integer(number) => number.to_string(),
        Value::NodeId(offset) => format!("$NODEID+0x{offset:X}"),
        Value::Real(real) => real.number().to_string(),
        Value::Text(text) => text.clone(),
        Value::Bytes(octets) => {
            let digits: Vec<String> = octets.iter().map(|octet| format!("{octet:02X}")).collect();
            digits.concat()
        }
    }
}

fn value(device: &Dictionary, object: &Object, entry: &Entry, random: &mut Random) -> Option<Value> {
    let data_type = entry.data_type;
    if data_type.is_integer() || data_type == DataType::Boolean {
        return Some(number(device, object, entry, random));
    }
    match data_type {
        DataType::Real32 | DataType::Real64 => {
            let numbers = [0.0, 0.5, -1.0, 1e9, f64::from(f32::MAX)];
            random.pick(&numbers).map(|number| Value::Real((*number).into()))
        }
        DataType::VisibleString => Some(Value::Text(text(entry, 1, random))),
        DataType::UnicodeString => Some(Value::Text(text(entry, 2, random))),
        DataType::OctetString => Some(Value::Bytes(vec![0xA5; length(entry, 1, random)])),
        // Nothing that could be written in a setting is such a value.
        _ => None,
    }
}

/// Around the capacity, in characters of so many bytes.
fn length(entry: &Entry, size: usize, random: &mut Random) -> usize {
    let capacity = usize::from(entry.capacity.unwrap_or(8)) / size;
    (capacity + 1).saturating_sub(random.below(capacity.min(3) + 2))
}

fn text(entry: &Entry, size: usize, random: &mut Random) -> String {
    let length = length(entry, size, random);
    let strange = random.pick(&['a', 'a', 'a', ';', '=', '#', ' ', 'é', '~']).copied().unwrap_or('a');
    (0..length).map(|at| if at == length / 2 { strange } else { 'a' }).collect()
}

fn number(device: &Dictionary, object: &Object, entry: &Entry, random: &mut Random) -> Value {
    if random.chance(60)
        && let Some(raw) = of_role(device, object, entry.sub, random)
    {
        return raw;
    }
    let (low, high) = entry.data_type.range().unwrap_or((0, 1));
    let mut numbers = vec![0, 1, low, high];
    // What needs more bytes than the type has is refused by both; once in a while is enough.
    if random.chance(5) {
        numbers.extend([low - 1, high + 1]);
    }
    let limits = [entry.low, entry.high, entry.default.as_ref().and_then(Value::integer)];
    let special = entry.special.iter().map(|special| special.value);
    let listed: Vec<i128> = match entry.named_type.as_ref().map(|named| &named.kind) {
        Some(TypeKind::Enum(values)) => values.iter().map(|value| value.value).collect(),
        Some(TypeKind::Bits(_)) => vec![1 << random.below(8), 1 << random.below(32)],
        None => Vec::new(),
    };
    for number in limits.into_iter().flatten().chain(special).chain(listed) {
        numbers.extend([number - 1, number, number, number + 1]);
    }
    numbers.push(i128::try_from(random.below(400)).unwrap_or_default());
    numbers.retain(|number| (low - 1..=high + 1).contains(number));
    let picked = random.pick(&numbers).copied().unwrap_or_default();
    Value::Integer(picked)
}

/// Bits of a COB-ID.
const FLAGS: [i128; 9] = [0, 0, 0, 0, 1 << 31, 1 << 31, 1 << 30, 1 << 29, 3 << 30];

/// A value of the kind that a communication object has.
fn of_role(device: &Dictionary, object: &Object, sub: SubIndex, random: &mut Random) -> Option<Value> {
    let mut pick = |numbers: &[i128]| random.pick(numbers).copied();
    let raw = match (object.role(), object.index.0, sub.0) {
        (Role::PdoCommunication, _, 1)
        | (_, 0x1005 | 0x1012 | 0x1014, 0)
        | (_, 0x1028, 1..)
        | (_, 0x1201..=0x12FF, 1 | 2) => {
            return Some(cob_id(random));
        }
        (Role::PdoCommunication, _, 2) => pick(&[0, 1, 240, 241, 251, 252, 253, 254, 255])?,
        (Role::PdoCommunication, _, 6) => pick(&[0, 1, 2, 9, 240, 241, 255])?,
        (Role::PdoMapping, _, 0) => pick(&[0, 1, 1, 2, 2, 3, 4, 8, 9, 64, 65, 254, 255])?,
        (Role::PdoMapping, ..) => return Some(Value::Integer(mapped(device, random))),
        (_, 0x1016, 1..) => {
            let node = pick(&[0, 1, 5, 6, 127, 128, 255])?;
            let time = pick(&[0, 1, 1000, 0xFFFF])?;
            node << 16 | time
        }
        (_, 0x1019, 0) => pick(&[0, 1, 2, 3, 240, 241])?,
        _ => return None,
    };
    Some(Value::Integer(raw))
}

fn cob_id(random: &mut Random) -> Value {
    let flags = random.pick(&FLAGS).copied().unwrap_or_default();
    let ids = [
        0x000, 0x07F, 0x080, 0x081, 0x085, 0x100, 0x101, 0x180, 0x181, 0x185, 0x205, 0x285, 0x305, 0x580,
        0x585, 0x600, 0x605, 0x680, 0x6DF, 0x6E0, 0x6E1, 0x6FF, 0x700, 0x705, 0x780, 0x7FF, 0x800,
    ];
    let bases = [0x80, 0x180, 0x200, 0x280, 0x300, 0x580, 0x600, 0x680];
    if random.chance(25) {
        let base: u64 = random.pick(&bases).copied().unwrap_or_default();
        return Value::NodeId(base | u64::try_from(flags).unwrap_or_default());
    }
    Value::Integer(random.pick(&ids).copied().unwrap_or_default() | flags)
}

/// A mapping parameter: mostly an entry that can be mapped somewhere, mostly with its length.
fn mapped(device: &Dictionary, random: &mut Random) -> i128 {
    if random.chance(15) {
        let others =
            [0, 0x0001_0001, 0x0005_0008, 0x0005_0010, 0x0004_0020, 0x0008_0020, 0x7FFF_0008, 0x1017_0010];
        return random.pick(&others).copied().unwrap_or_default();
    }
    let is_mappable = |entry: &Entry| entry.pdo != od_spec::model::PdoMapping::None;
    let all: Vec<_> = device.entries().map(|(id, _, entry)| (id, entry)).collect();
    let mappable: Vec<_> = all.iter().filter(|(_, entry)| is_mappable(entry)).copied().collect();
    let from = if random.chance(90) { &mappable } else { &all };
    let Some((id, entry)) = random.pick(from) else { return 0 };
    let bits = i128::from(entry.data_type.bits().unwrap_or(8));
    let bits = if random.chance(95) { bits } else { bits / 2 };
    i128::from(id.index.0) << 16 | i128::from(id.sub.0) << 8 | bits
}
