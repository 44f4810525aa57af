//! `ApplicationProcess`: what an entry means. A parameter for each, with its texts in every language, type, default, allowed values, unit
//! and scale; and one for each ARRAY and RECORD.

use std::collections::BTreeSet;

use od_spec::model::{
    Access, DataType, EditorNotes, EditorProperty, Entry, EnumValue, Family, Object, ObjectKind, Ratio,
    Storage, Text, TypeKind, Unit, Value,
};
use od_spec::wording::{Notation, Wording};

use super::objects::Values;
use super::unique_id::{uid_of_entry, uid_of_object, uid_of_type};
use super::xml::{Element, Xml};
use super::{Subject, languages};
use crate::eds::comments;

const WORDING: Wording = Wording::english(Notation::Eds);

/// `ApplicationProcess`.
pub(super) fn write(xml: &mut Xml, subject: Subject<'_>) {
    let device = subject.device;
    xml.open(Element::new("canopen:ApplicationProcess"), |xml| {
        if device.objects.values().any(Object::is_structured) {
            xml.open(Element::new("canopen:dataTypeList"), |xml| {
                let structured =
                    |kind| device.objects.values().filter(move |object: &&Object| object.kind == kind);
                structured(ObjectKind::Array).for_each(|object| array(xml, object));
                structured(ObjectKind::Record).for_each(|object| structure(xml, object));
            });
        }
        xml.open(Element::new("canopen:parameterList"), |xml| {
            for object in device.objects.values() {
                if object.is_structured() {
                    whole(xml, subject, object);
                }
                for entry in &object.entries {
                    parameter(xml, subject, object, entry);
                }
            }
        });
    });
}

/// The type of an ARRAY: that of its elements.
fn array(xml: &mut Xml, object: &Object) {
    let element =
        Element::new("canopen:array").with("name", &object.name).with("uniqueID", uid_of_type(object));
    xml.open(element, |xml| {
        let range =
            Element::new("canopen:subrange").with("lowerLimit", 0).with("upperLimit", object.highest().0);
        xml.empty(range);
        let element = object.counted().next().map_or(DataType::Unsigned8, |entry| entry.data_type);
        xml.empty(Element::new(type_element(element)));
    });
}

/// The type of a RECORD.
fn structure(xml: &mut Xml, object: &Object) {
    let element =
        Element::new("canopen:struct").with("name", &object.name).with("uniqueID", uid_of_type(object));
    xml.open(element, |xml| {
        for entry in &object.entries {
            let uid = format!("UID_RECSUB_{:04X}{:02X}", object.index.0, entry.sub.0);
            let variable =
                Element::new("canopen:varDeclaration").with("name", &entry.name).with("uniqueID", uid);
            xml.open(variable, |xml| xml.empty(Element::new(type_element(entry.data_type))));
        }
    });
}

/// The parameter of an ARRAY or RECORD as a whole.
fn whole(xml: &mut Xml, subject: Subject<'_>, object: &Object) {
    let element = Element::new("canopen:parameter").with("uniqueID", uid_of_object(object.index));
    xml.open(element, |xml| {
        labels(xml, subject, &object.name);
        let language = subject.system.language();
        descriptions(xml, subject, &object.about, &comments::object(object, language));
        xml.empty(Element::new("canopen:dataTypeIDRef").with("uniqueIDRef", uid_of_type(object)));
        object.editor.iter().flat_map(|notes| notes.of_object()).for_each(|one| property(xml, one));
    });
}

/// The parameter of an entry.
fn parameter(xml: &mut Xml, subject: Subject<'_>, object: &Object, entry: &Entry) {
    let (uid, name) = if object.is_structured() {
        (uid_of_entry(object.index, entry.sub), &entry.name)
    } else {
        (uid_of_object(object.index), &object.name)
    };
    let scale = entry.unit.as_deref().and_then(multiplier);
    let element = Element::new("canopen:parameter")
        .with("uniqueID", uid)
        .with("access", access(subject.shown(object, entry).access))
        .with_any("persistent", (entry.stored != Storage::No).then_some(true))
        .with_any("multiplier", scale.filter(|scale| scale != "1"));
    xml.open(element, |xml| {
        labels(xml, subject, name);
        let lines = comments::beyond_values(
            subject.device,
            object.index,
            entry,
            subject.node,
            subject.system.language(),
        );
        descriptions(xml, subject, &entry.about, &lines);
        xml.empty(Element::new(type_element(entry.data_type)));
        let values = Values { object, entry, node: subject.node };
        if let Some(default) = values.shown_default() {
            xml.empty(Element::new("canopen:defaultValue").with("value", default));
        }
        allowed_values(xml, entry);
        if let Some(unit) = &entry.unit {
            xml.open(Element::new("canopen:unit"), |xml| {
                let label = match multiplier(unit) {
                    Some(_) => unit.symbol.clone(),
                    None => WORDING.step(unit),
                };
                xml.text(Element::new("label").with("lang", "en"), &label);
            });
        }
        let notes = object.editor.as_deref();
        let of_object =
            notes.filter(|_| !object.is_structured()).into_iter().flat_map(EditorNotes::of_object);
        let of_entry = notes.and_then(|notes| notes.of_entry(entry.sub));
        of_object.chain(of_entry).for_each(|one| property(xml, one));
        if let Some(length) = length_of_text(entry) {
            property(xml, (EditorProperty::StringLength, &length.to_string()));
        }
    });
}

/// What CANopenEditor keeps of an object or entry.
fn property(xml: &mut Xml, (property, value): (EditorProperty, &str)) {
    xml.empty(Element::new("canopen:property").with("name", property.name()).with("value", value));
}

/// How many characters or bytes a text has room for, if that is more than its default has.
fn length_of_text(entry: &Entry) -> Option<u16> {
    let width = match entry.data_type.family() {
        Family::VisibleString | Family::OctetString => 1,
        Family::UnicodeString => 2,
        Family::Boolean
        | Family::Signed
        | Family::Unsigned
        | Family::Real
        | Family::Time
        | Family::Domain => return None,
    };
    let default = entry.default.as_ref().and_then(|value| value.bytes_for(entry.data_type, 0));
    let capacity = entry.capacity?;
    (usize::from(capacity) > default.map_or(0, |bytes| bytes.len())).then_some(capacity / width)
}

/// One raw step in the unit's symbol, where a decimal says it and raw values count from 0. What else a scale may be, the label says:
/// how the format takes an offset into account is not certain enough.
fn multiplier(unit: &Unit) -> Option<String> {
    if unit.offset != Ratio::ZERO {
        return None;
    }
    unit.scale.to_decimal(unit.scale.decimal_places()?)
}

fn labels(xml: &mut Xml, subject: Subject<'_>, name: &str) {
    xml.text(Element::new("label").with("lang", subject.system.language()), name);
}

/// What an entry is for, in each language; in the main one with what no element says.
fn descriptions(xml: &mut Xml, subject: Subject<'_>, about: &Text, lines: &[String]) {
    let main = subject.system.language();
    for language in languages(subject.system) {
        let text = if language == main {
            lines.join("\n")
        } else {
            let text = about.iter().find(|(code, _)| *code == language);
            text.map_or_else(String::new, |(_, text)| text.to_owned())
        };
        if !text.is_empty() {
            xml.text(Element::new("description").with("lang", language), &text);
        }
    }
}

/// Named values, then the range. Each value once: what is special may be a value of the enum, too.
fn allowed_values(xml: &mut Xml, entry: &Entry) {
    let named = match entry.named_type.as_ref().map(|named| &named.kind) {
        Some(TypeKind::Enum(values)) => values.as_ref(),
        Some(TypeKind::Bits(_)) | None => &[],
    };
    let special = entry.special.iter().map(|special| (special.value, special.name.clone()));
    let known: BTreeSet<i128> = entry.special.iter().map(|special| special.value).collect();
    let values: Vec<(i128, String)> = special
        .chain(
            named
                .iter()
                .filter(|value| !known.contains(&value.value))
                .map(|value| (value.value, name_of(value))),
        )
        .collect();
    let end = |limit: Option<Value>| limit.map(|limit| number(&limit));
    let (low, high) = entry.limits();
    let (low, high) = (end(low), end(high));
    // Who sees a list and no range takes the list for everything. So special values come with all others; those of an enum are all.
    let has_range = low.is_some() || high.is_some() || (!entry.special.is_empty() && named.is_empty());
    let ends = entry.data_type.range().filter(|_| has_range);
    let low = low.or_else(|| ends.map(|(low, _)| low.to_string()));
    let high = high.or_else(|| ends.map(|(_, high)| high.to_string()));
    if values.is_empty() && low.is_none() && high.is_none() {
        return;
    }
    xml.open(Element::new("canopen:allowedValues"), |xml| {
        for (raw, name) in &values {
            xml.open(Element::new("value").with("value", raw), |xml| {
                xml.text(Element::new("label").with("lang", "en"), name);
            });
        }
        // A REAL that is limited on one side has no other end.
        if let (Some(low), Some(high)) = (low, high) {
            xml.open(Element::new("canopen:range"), |xml| {
                xml.empty(Element::new("minValue").with("value", low));
                xml.empty(Element::new("maxValue").with("value", high));
            });
        }
    });
}

/// A limit, which is a number.
fn number(limit: &Value) -> String {
    match limit {
        Value::Real(real) => format!("{:?}", real.number()),
        limit => limit.integer().map_or_else(String::new, |raw| raw.to_string()),
    }
}

fn name_of(value: &EnumValue) -> String {
    if value.supported { value.name.clone() } else { format!("{}{}", value.name, comments::NOT_SUPPORTED) }
}

/// The element of a data type. Types without one, which the object names exactly, are strings of bits.
const fn type_element(data_type: DataType) -> &'static str {
    match data_type {
        DataType::Boolean => "BOOL",
        DataType::Integer8 => "SINT",
        DataType::Integer16 => "INT",
        DataType::Integer32 => "DINT",
        DataType::Integer64 => "LINT",
        DataType::Unsigned8 => "USINT",
        DataType::Unsigned16 => "UINT",
        DataType::Unsigned32 => "UDINT",
        DataType::Unsigned64 => "ULINT",
        DataType::Real32 => "REAL",
        DataType::Real64 => "LREAL",
        DataType::VisibleString => "STRING",
        DataType::UnicodeString => "WSTRING",
        DataType::Integer24
        | DataType::Integer40
        | DataType::Integer48
        | DataType::Integer56
        | DataType::Unsigned24
        | DataType::Unsigned40
        | DataType::Unsigned48
        | DataType::Unsigned56
        | DataType::OctetString
        | DataType::TimeOfDay
        | DataType::TimeDifference
        | DataType::Domain => "BITSTRING",
    }
}

const fn access(access: Access) -> &'static str {
    match access {
        Access::Const => "const",
        Access::Ro => "read",
        Access::Wo => "write",
        Access::Rw => "readWrite",
        Access::Rwr => "readWriteInput",
        Access::Rww => "readWriteOutput",
    }
}
