//! Object lists and object sections.

use od_spec::model::{
    DataType, Dictionary, Entry, EntryId, Object, ObjectKind, Origin, PdoMapping, System, TypeKind, Value,
    format_value,
};

use super::Commissioning;
use super::comments;
use super::ini::Ini;

/// The list that an object stands in (CiA 306 4.6.3.1).
#[derive(Clone, Copy, PartialEq, Eq)]
enum List {
    Mandatory,
    Optional,
    Manufacturer,
}

impl List {
    const fn of(object: &Object) -> Self {
        match object.index.0 {
            0x1000 | 0x1001 | 0x1018 => Self::Mandatory,
            0x2000..=0x5FFF => Self::Manufacturer,
            _ => Self::Optional,
        }
    }

    const fn section(self) -> &'static str {
        match self {
            Self::Mandatory => "MandatoryObjects",
            Self::Optional => "OptionalObjects",
            Self::Manufacturer => "ManufacturerObjects",
        }
    }
}

/// The three lists, each followed by the sections of its objects.
pub(super) fn write(ini: &mut Ini, system: &System, device: &Dictionary, dcf: Option<&Commissioning>) {
    for list in [List::Mandatory, List::Optional, List::Manufacturer] {
        let objects: Vec<&Object> =
            device.objects.values().filter(|object| List::of(object) == list).collect();
        ini.section(list.section(), &[]);
        ini.key("SupportedObjects", objects.len());
        for (number, object) in (1..).zip(&objects) {
            ini.key(&number.to_string(), format_args!("0x{:04X}", object.index.0));
        }
        for object in objects {
            write_object(ini, system, device, object, dcf);
        }
    }
}

fn write_object(
    ini: &mut Ini,
    system: &System,
    device: &Dictionary,
    object: &Object,
    dcf: Option<&Commissioning>,
) {
    let language = system.language();
    let index = object.index.0;
    if !object.is_structured() {
        for entry in &object.entries {
            ini.section(format_args!("{index:X}"), &comments::entry(device, object.index, entry, language));
            write_entry(ini, object, entry, &object.name, dcf);
        }
        return;
    }
    ini.section(format_args!("{index:X}"), &comments::object(object, language));
    ini.key("SubNumber", object.entries.len());
    ini.key("ParameterName", &object.name);
    ini.key("ObjectType", format_args!("0x{:X}", object.kind.code()));
    for entry in &object.entries {
        let name = format!("{index:X}sub{:X}", entry.sub.0);
        ini.section(name, &comments::entry(device, object.index, entry, language));
        write_entry(ini, object, entry, &entry.name, dcf);
    }
}

fn write_entry(ini: &mut Ini, object: &Object, entry: &Entry, name: &str, dcf: Option<&Commissioning>) {
    let is_domain = entry.data_type == DataType::Domain;
    let kind = if is_domain { ObjectKind::Domain } else { ObjectKind::Var };
    ini.key("ParameterName", name);
    ini.key("ObjectType", format_args!("0x{:X}", kind.code()));
    ini.key("DataType", format_args!("0x{:04X}", entry.data_type.code()));
    let (low, high) = entry.hull();
    if let Some(low) = low {
        ini.key("LowLimit", low);
    }
    if let Some(high) = high {
        ini.key("HighLimit", high);
    }
    ini.key("AccessType", entry.eds.access.word());
    let node = dcf.map(|dcf| dcf.node);
    if let Some(default) = entry.default.as_ref().filter(|_| entry.eds.default && !is_domain) {
        ini.key("DefaultValue", show(object, entry, default, node));
    }
    if !is_domain {
        ini.flag("PDOMapping", entry.pdo != PdoMapping::None);
    }
    if entry.eds.flags() != 0 {
        ini.key("ObjFlags", entry.eds.flags());
    }
    let id = EntryId { index: object.index, sub: entry.sub };
    if let Some(value) = dcf.and_then(|dcf| dcf.values.get(&id)) {
        ini.key("ParameterValue", show(object, entry, value, node));
    }
}

/// A value in EDS notation: bit fields and PDO parameters in hexadecimal, other integers in decimal. For a node, the
/// node-ID formula is resolved.
fn show(object: &Object, entry: &Entry, value: &Value, node: Option<u8>) -> String {
    let bits = entry.data_type.bits().unwrap_or(32);
    let width = usize::from(bits.div_ceil(4));
    let is_bits = matches!(entry.named_type.as_ref().map(|named| &named.kind), Some(TypeKind::Bits(_)));
    let as_hex = entry.data_type.is_unsigned()
        && (is_bits || (object.origin == Origin::Pdo && entry.data_type == DataType::Unsigned32));
    let integer = |raw: i128| if as_hex { format!("0x{raw:0width$X}") } else { raw.to_string() };
    match (value, node) {
        (Value::NodeId(0), None) => "$NODEID".to_owned(),
        (Value::NodeId(offset), None) => format!("$NODEID+0x{offset:X}"),
        (Value::NodeId(offset), Some(node)) => format!("0x{:0width$X}", offset + u64::from(node)),
        (Value::Integer(raw), _) => integer(*raw),
        (Value::Real(_), _) => format_value(entry, value),
        (Value::Text(text), _) => text.clone(),
        (Value::Bytes(_), _) => format_value(entry, value),
    }
}
