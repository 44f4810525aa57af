//! The list of objects, and the dummies and channels after it.

use od_spec::model::{
    Access, DataType, DynamicChannel, Entry, EntryId, Object, ObjectKind, PdoMapping, Value,
};
use od_spec::{Commissioning, Denoted};

use super::Subject;
use super::unique_id::{uid_of_entry, uid_of_object};
use super::xml::{Element, Xml, can_write};
use crate::eds::value::Notation;

/// `CANopenObjectList`, `dummyUsage` and `dynamicChannels`.
pub(super) fn write(xml: &mut Xml, subject: Subject<'_>) {
    let device = subject.device;
    let count = |area: fn(u16) -> Area, wanted: Area| {
        device.objects.keys().filter(|index| area(index.0) == wanted).count()
    };
    let list = Element::new("canopen:CANopenObjectList")
        .with("mandatoryObjects", count(area, Area::Mandatory))
        .with("optionalObjects", count(area, Area::Optional))
        .with("manufacturerObjects", count(area, Area::Manufacturer));
    xml.open(list, |xml| {
        for object in device.objects.values() {
            write_object(xml, subject, object);
        }
    });
    xml.open(Element::new("dummyUsage"), |xml| {
        for data_type in DataType::ALL.into_iter().filter(|data_type| data_type.is_dummy()) {
            let used = u8::from(device.info.dummies.contains(&data_type));
            let entry = format!("Dummy{:04X}={used}", data_type.code());
            xml.empty(Element::new("dummy").with("entry", entry));
        }
    });
    if !device.info.dynamic_channels.is_empty() {
        xml.open(Element::new("dynamicChannels"), |xml| {
            device.info.dynamic_channels.iter().for_each(|channel| xml.empty(dynamic_channel(channel)));
        });
    }
}

/// The lists of an EDS, of which an XDD has the lengths.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Area {
    Mandatory,
    Optional,
    Manufacturer,
}

const fn area(index: u16) -> Area {
    match index {
        0x1000 | 0x1001 | 0x1018 => Area::Mandatory,
        0x2000..=0x5FFF => Area::Manufacturer,
        _ => Area::Optional,
    }
}

fn write_object(xml: &mut Xml, subject: Subject<'_>, object: &Object) {
    let element = Element::new("CANopenObject")
        .with("index", format_args!("{:04X}", object.index.0))
        .with("name", &object.name)
        .with("objectType", object.kind.code());
    let uid = uid_of_object(object.index);
    if !object.is_structured() {
        for entry in &object.entries {
            let element = Element::new("CANopenObject")
                .with("index", format_args!("{:04X}", object.index.0))
                .with("name", &object.name)
                .with("objectType", kind_of(entry).code());
            xml.empty(facts(element, subject, object, entry).with("uniqueIDRef", &uid));
        }
        return;
    }
    let denotation = subject.node.and_then(|node| node.denotations.get(&Denoted::object(object.index)));
    let element = element
        .with_any("denotation", denotation)
        .with("uniqueIDRef", &uid)
        .with("subNumber", object.entries.len());
    xml.open(element, |xml| {
        for entry in &object.entries {
            let element = Element::new("CANopenSubObject")
                .with("subIndex", format_args!("{:02X}", entry.sub.0))
                .with("name", &entry.name)
                .with("objectType", kind_of(entry).code());
            let uid = uid_of_entry(object.index, entry.sub);
            xml.empty(facts(element, subject, object, entry).with("uniqueIDRef", uid));
        }
    });
}

fn kind_of(entry: &Entry) -> ObjectKind {
    if entry.data_type == DataType::Domain { ObjectKind::Domain } else { ObjectKind::Var }
}

/// What an entry is, as its EDS shows it; in an XDC with its value on the node.
fn facts(element: Element, subject: Subject<'_>, object: &Object, entry: &Entry) -> Element {
    let values = Values { object, entry, node: subject.node };
    let shown = subject.shown(object, entry);
    let (low, high) = limits(entry);
    let element = element
        .with("dataType", format_args!("{:04X}", entry.data_type.code()))
        .with_any("lowLimit", low)
        .with_any("highLimit", high)
        .with("accessType", plain_access(shown.access).word())
        .with_any("defaultValue", values.shown_default());
    let id = EntryId { index: object.index, sub: entry.sub };
    let value = subject.node.and_then(|node| node.values.get(&id)).and_then(|value| values.text(value));
    let denoted = if object.is_structured() { Denoted::entry(id) } else { Denoted::object(id.index) };
    element
        .with_any("actualValue", value)
        .with_any("denotation", subject.node.and_then(|node| node.denotations.get(&denoted)))
        .with("PDOmapping", mapping(entry.pdo, shown.access))
        .with_any("objFlags", (shown.flags() != 0).then(|| format!("{:04X}", shown.flags())))
}

/// The values of an entry in text.
pub(super) struct Values<'a> {
    pub object: &'a Object,
    pub entry: &'a Entry,
    /// The node for which formulas are resolved.
    pub node: Option<&'a Commissioning>,
}

impl Values<'_> {
    /// The default, if an EDS shows it to tools.
    pub(super) fn shown_default(&self) -> Option<String> {
        let is_shown = self.entry.eds.default && self.entry.data_type != DataType::Domain;
        self.entry.default.as_ref().filter(|_| is_shown).and_then(|default| self.text(default))
    }

    /// A value; `None` for a text with characters that XML does not have.
    fn text(&self, value: &Value) -> Option<String> {
        let notation = Notation {
            object: self.object,
            entry: self.entry,
            node: self.node.map(|commissioning| commissioning.node),
        };
        Some(notation.text(value)).filter(|text| can_write(text))
    }
}

/// Limits, widened to take in the special values, as an EDS has them.
fn limits(entry: &Entry) -> (Option<String>, Option<String>) {
    let (low, high) = entry.hull();
    let real = &entry.real_limits;
    let of = |raw: Option<i128>, real: Option<&od_spec::model::Real>| {
        raw.map(|raw| raw.to_string()).or_else(|| real.map(|real| format!("{:?}", real.number())))
    };
    (of(low, real.low.as_ref()), of(high, real.high.as_ref()))
}

/// The access without the direction, which the mapping states.
const fn plain_access(access: Access) -> Access {
    match access {
        Access::Const | Access::Ro | Access::Wo | Access::Rw => access,
        Access::Rwr | Access::Rww => Access::Rw,
    }
}

/// Into which PDOs an entry may be mapped; the access of an EDS states the direction, too.
const fn mapping(pdo: PdoMapping, access: Access) -> &'static str {
    match (pdo, access) {
        (PdoMapping::None, _) => "no",
        (_, Access::Rwr) => "TPDO",
        (_, Access::Rww) => "RPDO",
        (PdoMapping::Receive, _) => "RPDO",
        (PdoMapping::Transmit, _) => "TPDO",
        (PdoMapping::Both, _) => "optional",
    }
}

fn dynamic_channel(channel: &DynamicChannel) -> Element {
    let access = match channel.access {
        Access::Const | Access::Ro => "readOnly",
        Access::Wo => "writeOnly",
        Access::Rw | Access::Rwr | Access::Rww => "readWriteOutput",
    };
    let (first, last) = (channel.first.0, channel.last.0);
    Element::new("dynamicChannel")
        .with("dataType", format_args!("{:04X}", channel.data_type.code()))
        .with("accessType", access)
        .with("startIndex", format_args!("{first:04X}"))
        .with("endIndex", format_args!("{last:04X}"))
        .with("maxNumber", u32::from(last) - u32::from(first) + 1)
        .with("addressOffset", format_args!("0x{:08X}", channel.offset))
}
