//! The device that is made of the listed objects, and what has to be there for that.

use std::collections::BTreeMap;

use super::super::python::{Ini, Section, int};
use super::super::refusal::{Cause, Place, Refusals};
use super::implied::{Implied, implied};
use super::values::{self, Value, can_be_kept, value};

/// The node-ID that is given on the command line.
const NODE: i128 = 5;

/// What is kept of an entry.
#[derive(Debug, Clone, Copy)]
struct Entry<'t> {
    data_type: i128,
    value: &'t str,
    place: Place,
}

/// Entries by sub-index.
type Object<'t> = BTreeMap<u8, Entry<'t>>;

pub(super) fn device(ini: &Ini<'_>, refusals: &mut Refusals) {
    let implied = implied(ini, refusals);
    let mut objects = BTreeMap::new();
    for list in ["MandatoryObjects", "OptionalObjects", "ManufacturerObjects"] {
        let Some(section) = ini.section(list) else {
            refusals.add(ini.place(list), Cause::Missing, "one of the three lists of objects");
            continue;
        };
        // What is wrong with the list itself is the lint's affair.
        let count = section.value("SupportedObjects").and_then(|text| int(text, 10)).unwrap_or(0);
        for entry in 1..=count {
            let Some(value) = section.value(&entry.to_string()) else { break };
            let Some(index) = int(value, 0).and_then(|index| u16::try_from(index).ok()) else { continue };
            if let Some(section) = ini.object(index) {
                objects.insert(index, object(ini, section, index, refusals));
            }
        }
    }
    identity(ini, &objects, refusals);
    for (sub, entry) in objects.get(&0x1029).into_iter().flatten() {
        if *sub != 0 {
            parse(*entry, refusals);
        }
    }
    pdos(ini, &objects, &implied, refusals);
}

fn object<'t>(ini: &'t Ini<'_>, section: &'t Section<'_>, index: u16, refusals: &mut Refusals) -> Object<'t> {
    let number = |key| section.filled(key).and_then(|item| int(&item.value, 0)).unwrap_or(0);
    let (subs, elements) = (number("SubNumber"), number("CompactSubObj"));
    let mut object = Object::new();
    if subs != 0 {
        for (sub, section) in ini.subs(index) {
            object.extend(entry(section, refusals).map(|entry| (sub, entry)));
        }
        return object;
    }
    let Some(first) = entry(section, refusals) else { return object };
    if elements == 0 {
        object.insert(0, first);
        return object;
    }
    let lists_values = ini.section(&format!("{index:04X}Value"));
    if let Some(item) = section.filled("ParameterValue").filter(|_| lists_values.is_none()) {
        refusals.add(item.place, Cause::Value, "`ParameterValue` of a compact array");
    }
    let count = section.filled("CompactSubObj").map_or("0", |item| item.value.as_ref());
    object.insert(0, Entry { data_type: 5, value: count, place: section.header });
    for element in 1..=u8::try_from(elements).unwrap_or(u8::MAX) {
        let own = lists_values.and_then(|list| list.filled(&element.to_string()));
        let value = own.map_or(first.value, |item| item.value.as_ref());
        object.insert(element, Entry { value, ..first });
    }
    object
}

/// An entry: access and type have to be there, and values have to look like such.
fn entry<'t>(section: &'t Section<'_>, refusals: &mut Refusals) -> Option<Entry<'t>> {
    if section.item("AccessType").is_none() {
        refusals.add(section.header, Cause::Missing, "the access type of a listed entry");
    }
    if section.value("AccessType").is_some_and(str::is_empty) {
        refusals.add(section.place("AccessType"), Cause::Value, "not a valid access type");
    }
    let Some(data_type) = section.value("DataType").and_then(|text| int(text, 0)) else {
        refusals.add(section.place("DataType"), Cause::Missing, "the data type of a listed entry");
        return None;
    };
    for item in ["LowLimit", "HighLimit", "DefaultValue", "ParameterValue"]
        .iter()
        .filter_map(|key| section.filled(key))
    {
        if !can_be_kept(data_type, &item.value) {
            refusals.add(
                item.place,
                Cause::Number,
                "a value or limit of a listed entry that is not a number",
            );
        }
    }
    if let Some(item) = section.filled("PDOMapping").filter(|item| int(&item.value, 0).is_none()) {
        refusals.add(item.place, Cause::Number, "`PDOMapping` that is not a number");
    }
    let item = section.filled("ParameterValue").or_else(|| section.filled("DefaultValue"));
    let otherwise = if values::is_basic(data_type) { "0" } else { "" };
    Some(Entry {
        data_type,
        value: item.map_or(otherwise, |item| item.value.as_ref()),
        place: item.map_or(section.header, |item| item.place),
    })
}

/// The number that an entry has by default.
fn parse(entry: Entry<'_>, refusals: &mut Refusals) -> Option<i128> {
    let read = match value(entry.data_type, entry.value) {
        _ if !values::is_basic(entry.data_type) => None,
        Some(Value::Integer { number, has_node }) => Some(number + if has_node { NODE } else { 0 }),
        // The number of a REAL is not looked at.
        Some(Value::Real(_)) => Some(0),
        None => None,
    };
    refusals.wants(read, entry.place, Cause::Number, "a value that it needs as a number")
}

fn identity(ini: &Ini<'_>, objects: &BTreeMap<u16, Object<'_>>, refusals: &mut Refusals) {
    for (index, sub) in [(0x1000, 0), (0x1018, 1)] {
        match objects.get(&index).and_then(|object| object.get(&sub)) {
            Some(entry) => {
                parse(*entry, refusals);
            }
            None => {
                let place = ini.place(if ini.object(index).is_some() {
                    if index == 0x1000 { "1000" } else { "1018" }
                } else {
                    "MandatoryObjects"
                });
                refusals.add(place, Cause::Missing, "1000h or 1018h sub 1 in a list of objects");
            }
        }
    }
    for sub in 2..=4 {
        if let Some(entry) = objects.get(&0x1018).and_then(|object| object.get(&sub)) {
            parse(*entry, refusals);
        }
    }
    let numbers = [
        ("DeviceInfo", "VendorNumber"),
        ("DeviceInfo", "ProductNumber"),
        ("DeviceInfo", "RevisionNumber"),
        ("DeviceComissioning", "LSS_SerialNumber"),
    ];
    for (section, key) in numbers {
        if let Some(item) = ini.section(section).and_then(|section| section.filled(key))
            && int(&item.value, 0).is_none()
        {
            refusals.add(
                item.place,
                Cause::Number,
                "a number of the device in another notation than `10` or `0xA`",
            );
        }
    }
}

/// PDOs: parameters have to be numbers, and what is mapped has to be there.
fn pdos(ini: &Ini<'_>, objects: &BTreeMap<u16, Object<'_>>, implied: &Implied, refusals: &mut Refusals) {
    let is_communication = |index: &u16| (0x1400..0x1600).contains(index) || (0x1800..0x1A00).contains(index);
    for (index, parameters) in objects.iter().filter(|(index, _)| is_communication(index)) {
        let highest = parameters.get(&0).map_or(0, |entry| parse(*entry, refusals).unwrap_or(0));
        let read: &[u8] = if *index >= 0x1800 { &[1, 2, 3, 5, 6] } else { &[1, 2, 5] };
        for sub in read.iter().filter(|sub| i128::from(**sub) <= highest) {
            if let Some(entry) = parameters.get(sub) {
                parse(*entry, refusals);
            }
        }
        match objects.get(&(index + 0x200)) {
            Some(mapping) => mapped(objects, mapping, implied, refusals),
            None if implied.mapping.contains(&(index + 0x200)) => {}
            None => refusals.add(
                ini.place(&format!("{index:04X}")),
                Cause::Reference,
                "a PDO without its mapping",
            ),
        }
    }
    for index in &implied.communication {
        match objects.get(&(index + 0x200)) {
            Some(mapping) => mapped(objects, mapping, implied, refusals),
            None if implied.mapping.contains(&(index + 0x200)) => {}
            None => {
                let place = ini.place(&format!("{:04X}", index + 0x200));
                refusals.add(place, Cause::Reference, "a PDO whose mapping is in no list");
            }
        }
    }
}

fn mapped(
    objects: &BTreeMap<u16, Object<'_>>,
    mapping: &Object<'_>,
    implied: &Implied,
    refusals: &mut Refusals,
) {
    let count = mapping.get(&0).map_or(0, |entry| parse(*entry, refusals).unwrap_or(0));
    for (_, entry) in mapping.iter().filter(|(sub, _)| **sub != 0 && i128::from(**sub) <= count) {
        let Some(value) = parse(*entry, refusals).filter(|value| *value != 0) else { continue };
        let index = u16::try_from(value >> 16 & 0xFFFF).unwrap_or(0);
        let sub = u8::try_from(value >> 8 & 0xFF).unwrap_or(0);
        let is_there = if index < 0x1000 {
            sub == 0 && (values::is_basic(index.into()) || matches!(index, 0x09..=0x0D | 0x0F))
        } else {
            implied.communication.contains(&index)
                || objects.get(&index).is_some_and(|object| object.contains_key(&sub))
        };
        if !is_there {
            refusals.add(entry.place, Cause::Reference, "a PDO that maps what is not listed");
        }
    }
}
