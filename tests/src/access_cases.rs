//! What every access to a dictionary has to answer, worked out from the JSON dump alone: the generator's own tables are what
//! is tested. The cases are bytes, see `tests/shared/cases.rs`.

use serde_json::Value as Json;

use crate::Failure;

/// Abort codes of CiA 301, as the dump's reader knows them.
const READ_ONLY: u32 = 0x0601_0002;
const WRITE_ONLY: u32 = 0x0601_0001;
const NO_OBJECT: u32 = 0x0602_0000;
const TOO_LONG: u32 = 0x0607_0012;
const TOO_SHORT: u32 = 0x0607_0013;
const NO_SUB_INDEX: u32 = 0x0609_0011;
const INVALID_VALUE: u32 = 0x0609_0030;
const TOO_HIGH: u32 = 0x0609_0031;
const TOO_LOW: u32 = 0x0609_0032;
const DEVICE_STATE: u32 = 0x0800_0022;
const UNSUPPORTED: u32 = 0x0601_0000;
const NO_DATA: u32 = 0x0800_0024;

const NODE: i128 = 5;
const READ: u8 = 0;
const WRITE: u8 = 1;
const WRITE_UNLOCKED: u8 = 2;
const ANYTHING: u8 = 0xFF;

/// The cases of one device of a dump.
///
/// # Errors
/// The dump has no such device, or lacks a fact.
pub fn of_device<'a>(dump: &'a Json, key: &str) -> Result<Cases<'a>, Failure> {
    let devices = dump["devices"].as_array().ok_or("the dump has no devices")?;
    let device = devices.iter().find(|device| device["key"] == key).ok_or("no such device")?;
    let mut cases = Cases { bytes: Vec::new(), count: 0, dump, device };
    cases.all();
    Ok(cases)
}

/// Cases of a device.
pub struct Cases<'a> {
    /// The cases, for `tests/shared/cases.rs`.
    pub bytes: Vec<u8>,
    /// Their number.
    pub count: usize,
    dump: &'a Json,
    device: &'a Json,
}

/// One entry of the dump.
struct Entry<'a> {
    index: u16,
    sub: u8,
    json: &'a Json,
    /// Bytes, or the capacity of a string.
    size: usize,
    range: Option<(i128, i128)>,
}

impl<'a> Cases<'a> {
    fn all(&mut self) {
        let objects: Vec<&Json> = self.device["objects"].as_array().into_iter().flatten().collect();
        let indices: Vec<u16> = objects.iter().map(|object| index(&object["index"])).collect();
        // Before, between and after the objects there is nothing.
        for index in indices.iter().flat_map(|index| [index - 1, index.wrapping_add(1)]).chain([0, 1, 0xFFFF])
        {
            if !indices.contains(&index) {
                self.read(index, 0, NO_OBJECT, None);
                self.push(WRITE, index, 0, &[0], NO_OBJECT, None);
            }
        }
        for object in objects {
            let index = index(&object["index"]);
            let entries: Vec<&Json> = object["entries"].as_array().into_iter().flatten().collect();
            let subs: Vec<u64> = entries.iter().filter_map(|entry| entry["sub"].as_u64()).collect();
            for sub in 0..=255u8 {
                if !subs.contains(&sub.into()) {
                    self.read(index, sub, NO_SUB_INDEX, None);
                    self.push(WRITE_UNLOCKED, index, sub, &[0], NO_SUB_INDEX, None);
                }
            }
            for json in entries {
                self.entry(&Entry::of(index, json));
            }
        }
    }

    fn entry(&mut self, entry: &Entry<'_>) {
        let Entry { index, sub, json, size, .. } = *entry;
        let access = json["access"].as_str().unwrap_or_default();
        if json["type"] == "domain" {
            self.read(index, sub, if access == "wo" { WRITE_ONLY } else { UNSUPPORTED }, None);
            let refused = if matches!(access, "ro" | "const") { READ_ONLY } else { UNSUPPORTED };
            self.push(WRITE, index, sub, &[0], refused, None);
            return;
        }
        if access == "wo" {
            self.read(index, sub, WRITE_ONLY, None);
        } else if index == 0x1003 && sub > 0 {
            self.read(index, sub, NO_DATA, None);
        } else {
            let value = default_bytes(entry);
            self.read(index, sub, 0, value.as_deref());
        }
        if matches!(access, "ro" | "const") {
            for data in [&[][..], &vec![0; size], &vec![0; size + 1]] {
                self.push(WRITE, index, sub, data, READ_ONLY, None);
                self.push(WRITE_UNLOCKED, index, sub, data, READ_ONLY, None);
            }
            return;
        }
        if json["locked"] == true {
            self.push(WRITE, index, sub, &vec![0; size], DEVICE_STATE, None);
            self.push(WRITE, index, sub, &[], DEVICE_STATE, None);
        }
        self.push(WRITE_UNLOCKED, index, sub, &vec![0; size + 1], TOO_LONG, None);
        if entry.range.is_some() || !is_string(json) {
            self.push(WRITE_UNLOCKED, index, sub, &vec![0; size - 1], TOO_SHORT, None);
        }
        // Communication objects have rules of their own; write conditions depend on other entries. Both have their own tests.
        if entry.range.is_some() && !(0x1000..0x2000).contains(&index) && json.get("writable-when").is_none()
        {
            self.values(entry);
        }
    }

    /// Values at every boundary, in and out of range.
    fn values(&mut self, entry: &Entry<'_>) {
        let Some((lowest, highest)) = entry.range else { return };
        let (low, high) = limits(entry.json);
        let mut candidates = vec![lowest, lowest + 1, -1, 0, 1, highest - 1, highest];
        candidates.extend([low, high].into_iter().flatten().flat_map(|end| [end - 1, end, end + 1]));
        candidates.extend(specials(entry.json).iter().flat_map(|value| [value - 1, *value, value + 1]));
        candidates.extend(
            self.enum_values(entry.json)
                .iter()
                .flatten()
                .flat_map(|(value, _)| [value - 1, *value, value + 1]),
        );
        let target = self.target(entry.json);
        if let Some((target, factor)) = &target {
            let (low, high) = limits(target.json);
            let through = [low, high].into_iter().flatten().map(|end| end * factor.0 / factor.1);
            candidates.extend(through.flat_map(|end| [end - 1, end, end + 1]));
        }
        candidates.sort_unstable();
        candidates.dedup();
        for value in candidates.into_iter().filter(|value| (lowest..=highest).contains(value)) {
            let mut code = self.verdict(entry.json, value);
            if let (0, Some((target, factor))) = (code, &target) {
                let product = value * factor.1;
                code = if product % factor.0 != 0 || !inside(target, product / factor.0) {
                    INVALID_VALUE
                } else {
                    self.verdict(target.json, product / factor.0)
                };
            }
            let bytes = value.to_le_bytes()[..entry.size].to_vec();
            let readable = entry.json["access"] != "wo";
            let after = (code == 0 && readable).then_some(bytes.as_slice());
            self.push(WRITE_UNLOCKED, entry.index, entry.sub, &bytes, code, after);
        }
    }

    /// What a value of the right length gets.
    fn verdict(&self, json: &Json, value: i128) -> u32 {
        if json["type"] == "boolean" {
            return if (0..=1).contains(&value) { 0 } else { INVALID_VALUE };
        }
        if specials(json).contains(&value) {
            return 0;
        }
        if let Some(values) = self.enum_values(json) {
            return if values.contains(&(value, true)) { 0 } else { INVALID_VALUE };
        }
        match limits(json) {
            (_, Some(high)) if value > high => TOO_HIGH,
            (Some(low), _) if value < low => TOO_LOW,
            _ => 0,
        }
    }

    /// Values of an enum, and whether the device supports them.
    fn enum_values(&self, json: &Json) -> Option<Vec<(i128, bool)>> {
        let name = json.get("named-type")?;
        let named = match &self.dump["types"] {
            Json::Array(types) => types.iter().find(|named| named["name"] == *name)?,
            types => types.get(name.as_str()?)?,
        };
        let values = named.get("values")?.as_array()?;
        Some(values.iter().map(|value| (number(&value["value"]), value["supported"] != false)).collect())
    }

    /// The target of an alias, and the factor: raw alias per raw target.
    fn target(&self, json: &Json) -> Option<(Entry<'a>, (i128, i128))> {
        let alias = json.get("alias")?;
        let (index, sub) = id(alias["of"].as_str()?)?;
        let objects = self.device["objects"].as_array()?;
        let object = objects.iter().find(|object| self::index(&object["index"]) == index)?;
        let entry = object["entries"].as_array()?.iter().find(|entry| entry["sub"] == sub)?;
        Some((Entry::of(index, entry), ratio(&alias["factor"])?))
    }

    fn read(&mut self, index: u16, sub: u8, code: u32, expected: Option<&[u8]>) {
        self.push(READ, index, sub, &[], code, expected);
    }

    fn push(&mut self, kind: u8, index: u16, sub: u8, data: &[u8], code: u32, expected: Option<&[u8]>) {
        let length = |bytes: &[u8]| u8::try_from(bytes.len()).unwrap_or(u8::MAX - 1);
        self.bytes.push(kind);
        self.bytes.extend(index.to_le_bytes());
        self.bytes.extend([sub, length(data)]);
        self.bytes.extend(&data[..length(data).into()]);
        self.bytes.extend(code.to_le_bytes());
        self.bytes.push(expected.map_or(ANYTHING, length));
        self.bytes.extend(expected.unwrap_or_default());
        self.count += 1;
    }
}

impl<'a> Entry<'a> {
    fn of(index: u16, json: &'a Json) -> Self {
        let sub = json["sub"].as_u64().and_then(|sub| u8::try_from(sub).ok()).unwrap_or_default();
        let (bits, range) = width(json["type"].as_str().unwrap_or_default());
        let text = json["default"]["text"].as_str().map_or(0, str::len);
        let capacity =
            json["capacity"].as_u64().and_then(|bytes| usize::try_from(bytes).ok()).unwrap_or(text);
        Self { index, sub, json, size: if bits == 0 { capacity } else { bits / 8 }, range }
    }
}

/// Bits and, of integers and BOOLEAN, the range of a data type.
fn width(name: &str) -> (usize, Option<(i128, i128)>) {
    let number = |prefix: &str| name.strip_prefix(prefix).and_then(|bits| bits.parse::<usize>().ok());
    if let Some(bits) = number("unsigned") {
        (bits, Some((0, (1 << bits) - 1)))
    } else if let Some(bits) = number("integer") {
        (bits, Some((-(1 << (bits - 1)), (1 << (bits - 1)) - 1)))
    } else {
        match name {
            "boolean" => (8, Some((0, 255))),
            "real32" => (32, None),
            "real64" => (64, None),
            "time-of-day" | "time-difference" => (48, None),
            _ => (0, None),
        }
    }
}

fn is_string(json: &Json) -> bool {
    json["type"].as_str().is_some_and(|name| name.ends_with("-string"))
}

fn is_integer(json: &Json) -> bool {
    width(json["type"].as_str().unwrap_or_default()).1.is_some()
}

fn inside(entry: &Entry<'_>, value: i128) -> bool {
    entry.range.is_some_and(|(low, high)| (low..=high).contains(&value))
}

/// The limits without the special values.
fn limits(json: &Json) -> (Option<i128>, Option<i128>) {
    let end = |stated: &str, of_the_type: &str| {
        json.get(stated).or_else(|| json.get(of_the_type)).filter(|value| !value.is_null()).map(number)
    };
    (end("min", "low"), end("max", "high"))
}

fn specials(json: &Json) -> Vec<i128> {
    json["special"].as_array().into_iter().flatten().map(|special| number(&special["value"])).collect()
}

fn number(json: &Json) -> i128 {
    let wide = json.as_i64().map(i128::from).or_else(|| json.as_u64().map(i128::from));
    wide.or_else(|| json.as_str()?.parse().ok()).unwrap_or_default()
}

fn index(json: &Json) -> u16 {
    json.as_str().and_then(id).map_or(0, |(index, _)| index)
}

/// `0x6040` or `0x30FA.3`.
fn id(text: &str) -> Option<(u16, u8)> {
    let (index, sub) = text.split_once('.').unwrap_or((text, "0"));
    Some((u16::from_str_radix(index.strip_prefix("0x")?, 16).ok()?, sub.parse().ok()?))
}

/// Numerator and denominator.
fn ratio(json: &Json) -> Option<(i128, i128)> {
    match json.as_array()?.as_slice() {
        [numerator, denominator] => Some((number(numerator), number(denominator))),
        _ => None,
    }
}

/// What reading an entry gives after a factory reset.
fn default_bytes(entry: &Entry<'_>) -> Option<Vec<u8>> {
    if entry.json.get("alias").is_some() {
        // The default of the target, as the alias shows it, if the dump has one.
        let raw = entry.json["default"].get("raw").map(number)?;
        return Some(raw.to_le_bytes()[..entry.size].to_vec());
    }
    let default = &entry.json["default"];
    if default.is_null() {
        return is_integer(entry.json).then(|| vec![0; entry.size]);
    }
    match (default.get("raw"), entry.range) {
        (Some(raw), Some(_)) => {
            let node = if default.get("formula").is_some() { NODE } else { 0 };
            Some((number(raw) + node).to_le_bytes()[..entry.size].to_vec())
        }
        (None, _) if entry.json["type"] == "visible-string" => {
            default["text"].as_str().map(|text| text.as_bytes().to_vec())
        }
        _ => None,
    }
}
