//! What the records of a concise DCF say, by the dictionary of the device that gets them.

use std::fmt;

use od_spec::ParameterValues;
use od_spec::model::{Access, Dictionary, Entry, Family, Object, TypeKind, Value};
use od_spec::wording::{Notation, Wording, allowed};

use super::{Concise, Record};

/// A record as the dictionary reads it.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// What the object and the entry are called; of an unknown entry the object alone, of an unknown object nothing.
    pub name: String,
    /// Its value, if the type has one of these bytes.
    pub value: Option<Value>,
    /// The value in words: in its unit, by its name, with the bits that it sets; empty without one.
    pub text: String,
    /// Whether the device has this value anyhow.
    pub is_default: bool,
    /// Why the device refuses it, or may.
    pub remarks: Vec<Remark>,
}

/// Why a device refuses a record, or may.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Remark {
    /// The device has no such object.
    NoObject,
    /// The object has no such sub-index.
    NoEntry,
    /// The type has another number of bytes.
    Length {
        /// How many.
        expected: usize,
    },
    /// There are more bytes than the device can hold.
    TooLong {
        /// How many it can.
        capacity: u16,
    },
    /// The type has no value of these bytes.
    NoValue,
    /// The value lies outside the limits.
    Outside {
        /// What they allow.
        allowed: String,
    },
    /// The value is not one of its enum.
    NotInEnum,
    /// The value is one that the device does not support.
    NotSupported,
    /// The entry cannot be written.
    NotWritable(Access),
    /// The entry is writable only in service.
    Locked,
}

impl Remark {
    /// The word by which programs know it.
    pub const fn word(&self) -> &'static str {
        match self {
            Remark::NoObject => "no-object",
            Remark::NoEntry => "no-entry",
            Remark::Length { .. } => "length",
            Remark::TooLong { .. } => "too-long",
            Remark::NoValue => "no-value",
            Remark::Outside { .. } => "outside-limits",
            Remark::NotInEnum => "not-in-enum",
            Remark::NotSupported => "not-supported",
            Remark::NotWritable(_) => "not-writable",
            Remark::Locked => "locked",
        }
    }
}

impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Remark::NoObject => f.write_str("the device has no such object"),
            Remark::NoEntry => f.write_str("the object has no such sub-index"),
            Remark::Length { expected: 1 } => f.write_str("its type has 1 byte"),
            Remark::Length { expected } => write!(f, "its type has {expected} bytes"),
            Remark::TooLong { capacity } => write!(f, "the device holds {capacity} bytes of it"),
            Remark::NoValue => f.write_str("its type has no such value"),
            Remark::Outside { allowed } => write!(f, "outside {allowed}"),
            Remark::NotInEnum => f.write_str("not a value of its enum"),
            Remark::NotSupported => f.write_str("a value that the device does not support"),
            Remark::NotWritable(access) => write!(f, "it is `{}`", access.word()),
            Remark::Locked => f.write_str("locked: factory-set, writable only in service"),
        }
    }
}

/// A record as the dictionary of the device reads it. With a node-ID, defaults that depend on it are known, too.
pub fn reading(device: &Dictionary, node: Option<u8>, record: &Record<'_>) -> Reading {
    let unknown = |name: String, remark| Reading {
        name,
        value: None,
        text: String::new(),
        is_default: false,
        remarks: vec![remark],
    };
    let Some(object) = device.objects.get(&record.id.index) else {
        return unknown(String::new(), Remark::NoObject);
    };
    let Some(entry) = object.entry(record.id.sub) else {
        return unknown(object.name.clone(), Remark::NoEntry);
    };
    let name =
        if object.is_structured() { format!("{}: {}", object.name, entry.name) } else { object.name.clone() };
    let value = Value::from_bytes(entry.data_type, record.bytes);
    let text = value.as_ref().map_or_else(String::new, |value| words(object, entry, value));
    let remarks = remarks(entry, value.as_ref(), record.bytes);
    let is_default = is_default(entry, node, record.bytes);
    Reading { name, value, text, is_default, remarks }
}

/// A value in words, with the bits that it sets.
pub fn words(object: &Object, entry: &Entry, value: &Value) -> String {
    let wording = Wording::english(Notation::Diagnostic);
    let text = wording.value(Some(object.index), entry, value);
    let named = entry.named_type.as_ref().map(|named| &named.kind);
    if let (Some(TypeKind::Bits(fields)), Some(raw)) = (named, value.integer()) {
        let set = wording.set_bits(fields, raw);
        if !set.is_empty() {
            return format!("{text} ({})", set.join(", "));
        }
    }
    text
}

fn is_default(entry: &Entry, node: Option<u8>, bytes: &[u8]) -> bool {
    let known = entry.default.as_ref().filter(|value| node.is_some() || !matches!(value, Value::NodeId(_)));
    let default = known.and_then(|value| value.bytes_for(entry.data_type, node.unwrap_or_default()));
    default.is_some_and(|default| default == bytes)
}

fn remarks(entry: &Entry, value: Option<&Value>, bytes: &[u8]) -> Vec<Remark> {
    let mut remarks = Vec::new();
    if !entry.access.is_writable() {
        remarks.push(Remark::NotWritable(entry.access));
    } else if entry.locked {
        remarks.push(Remark::Locked);
    }
    let width = entry.data_type.bits().map(|bits| usize::from(bits.div_ceil(8)));
    match (width, entry.capacity) {
        (Some(expected), _) if expected != bytes.len() => {
            remarks.push(Remark::Length { expected });
            return remarks;
        }
        (None, Some(capacity)) if usize::from(capacity) < bytes.len() => {
            remarks.push(Remark::TooLong { capacity });
        }
        (Some(_) | None, _) => {}
    }
    match value {
        Some(value) => remarks.extend(wrong_value(entry, value)),
        // What is in them, the application alone knows.
        None if matches!(entry.data_type.family(), Family::Domain | Family::Time) => {}
        None => remarks.push(Remark::NoValue),
    }
    remarks
}

/// What is wrong with a value of the right type.
fn wrong_value(entry: &Entry, value: &Value) -> Option<Remark> {
    let outside = || Some(Remark::Outside { allowed: allowed(entry) });
    if let Some(real) = value.real() {
        return if entry.real_limits.allow(real, entry.data_type) { None } else { outside() };
    }
    let raw = value.integer()?;
    if !entry.allows(raw) {
        return outside();
    }
    let named = entry.named_type.as_ref().map(|named| &named.kind);
    let Some(TypeKind::Enum(listed)) = named else { return None };
    if entry.special.iter().any(|special| special.value == raw) {
        return None;
    }
    match listed.of(raw) {
        Some(listed) if listed.supported => None,
        Some(_) => Some(Remark::NotSupported),
        None => Some(Remark::NotInEnum),
    }
}

/// The values that a concise DCF leaves in a node.
#[derive(Debug, Clone, PartialEq)]
pub struct Values<'b> {
    /// By entry; of several records of one entry the last counts.
    pub values: ParameterValues,
    /// Records that are not values of the device: their entry is unknown, or its type has no value of their bytes.
    pub left: Vec<Record<'b>>,
}

/// The values that a concise DCF leaves in a node of the device. What is only switched off on the way is on again in the end.
pub fn values<'b>(device: &Dictionary, concise: &Concise<'b>) -> Values<'b> {
    let mut found = Values { values: ParameterValues::new(), left: Vec::new() };
    for record in &concise.records {
        let entry = device.entry(record.id);
        match entry.and_then(|entry| Value::from_bytes(entry.data_type, record.bytes)) {
            Some(value) => drop(found.values.insert(record.id, value)),
            None => found.left.push(*record),
        }
    }
    found
}
