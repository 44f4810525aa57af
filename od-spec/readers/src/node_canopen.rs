//! What node-canopen 6.2 throws for: `Eds.fromFile`.

use std::collections::BTreeMap;

use super::javascript::{Section, Value, big_int, number, parse_int, sections};
use super::lines::Line;
use super::refusal::{Cause, Place, Refusals};
use od_spec::diag::readers::Reader;
use od_spec::source::FileId;

/// The keys that it looks at.
const KEYS: [&str; 10] = [
    "ParameterName",
    "ObjectType",
    "DataType",
    "AccessType",
    "DefaultValue",
    "PDOMapping",
    "LowLimit",
    "HighLimit",
    "SubNumber",
    "CompactSubObj",
];

pub(super) fn refusals(lines: &[Line<'_>], file: FileId) -> Refusals {
    let mut refusals = Refusals::new(Reader::NodeCanopen, file);
    let sections = sections(lines, |name| index(name).is_some() || sub_index(name).is_some(), &KEYS);
    // Whether an object has sub-indices; one that could not be made has them, as far as is known.
    let mut objects: BTreeMap<u16, bool> = BTreeMap::new();
    for (name, section) in &sections {
        let Some(index) = index(name) else { continue };
        let has_subs = entry(section, &mut refusals);
        if objects.insert(index, has_subs).is_some() {
            let what = "a section that is written twice, in different case";
            refusals.add(section.header, Cause::Text, what);
        }
    }
    for (name, section) in &sections {
        let Some((index, sub)) = sub_index(name) else { continue };
        match objects.get(&index) {
            None => refusals.add(section.header, Cause::Reference, "a sub-index without its object"),
            Some(false) => {
                let what = "a sub-index of an object that is a single value";
                refusals.add(section.header, Cause::Value, what);
            }
            Some(true) if u8::from_str_radix(sub, 16).is_err() => {
                refusals.add(section.header, Cause::Value, "a sub-index above FFh");
            }
            Some(true) => {}
        }
        if number_in(section, "SubNumber").is_some() && u32::from_str_radix(sub, 16) == Ok(0) {
            refusals.add(section.place("SubNumber"), Cause::Value, "`SubNumber` of a sub-index 0");
        }
        entry(section, &mut refusals);
    }
    refusals
}

fn is_hexadecimal(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_hexdigit())
}

fn index(name: &str) -> Option<u16> {
    (name.len() == 4 && is_hexadecimal(name)).then(|| u16::from_str_radix(name, 16).ok())?
}

/// The index and the digits of the sub-index in the name of a section.
fn sub_index(name: &str) -> Option<(u16, &str)> {
    let (index, sub) = name.split_once("sub").filter(|(_, sub)| is_hexadecimal(sub))?;
    Some((self::index(index)?, sub))
}

/// A number other than 0; 0 and what is not a number are as if they were not there.
fn number_in(section: &Section<'_>, key: &str) -> Option<i128> {
    match section.get(key)? {
        (Value::Text(text), _) => parse_int(text).filter(|number| *number != 0),
        (Value::Boolean(_) | Value::Null, _) => None,
    }
}

/// Whether it has sub-indices.
fn entry(section: &Section<'_>, refusals: &mut Refusals) -> bool {
    if section.get("ParameterName").is_none() {
        refusals.add(section.place("ParameterName"), Cause::Missing, "`ParameterName`, spelled so");
    }
    match number_in(section, "ObjectType").unwrap_or(7) {
        5 | 7 => {
            value(section, refusals);
            false
        }
        6 | 8 | 9 => {
            structured(section, refusals);
            true
        }
        2 => {
            domain(section, refusals);
            false
        }
        _ => {
            refusals.add(section.place("ObjectType"), Cause::Unknown, "not a valid object type");
            false
        }
    }
}

fn value(section: &Section<'_>, refusals: &mut Refusals) {
    let data_type = number_in(section, "DataType");
    if data_type.is_none() {
        refusals.add(section.place("DataType"), Cause::Missing, "`DataType`, spelled so, with a number");
    }
    if number_in(section, "CompactSubObj").is_some() {
        let what = "`CompactSubObj` of an object that is a single value";
        refusals.add(section.place("CompactSubObj"), Cause::Value, what);
    }
    if let (Some(low), Some(high)) = (number_in(section, "LowLimit"), number_in(section, "HighLimit"))
        && high < low
    {
        refusals.add(section.place("LowLimit"), Cause::Value, "limits in the wrong order");
    }
    if let (Some(data_type), Some((default, place))) = (data_type, section.get("DefaultValue")) {
        default_value(data_type, default, place, refusals);
    }
}

fn default_value(data_type: i128, value: &Value<'_>, place: Place, refusals: &mut Refusals) {
    let bits = match data_type {
        0x02 | 0x05 => 8,
        0x03 | 0x06 => 16,
        0x10 | 0x16 => 24,
        0x04 | 0x07 => 32,
        0x12 | 0x18 => 40,
        0x13 | 0x19 => 48,
        // 56 bits are held in 64.
        0x14 | 0x15 | 0x1A | 0x1B => 64,
        0x09..=0x0B => {
            if *value == Value::Boolean(true) {
                refusals.add(place, Cause::Value, "the word `true` as a text");
            }
            return;
        }
        _ => return,
    };
    let is_signed = matches!(data_type, 0x02..=0x04 | 0x10 | 0x12..=0x15);
    let (low, high) = if is_signed {
        (-(1_i128 << (bits - 1)), (1_i128 << (bits - 1)) - 1)
    } else {
        (0, (1_i128 << bits) - 1)
    };
    let is_in_range = match value {
        Value::Boolean(_) | Value::Null => true,
        Value::Text(text) if bits == 64 => match big_int(text) {
            Some(number) => (low..=high).contains(&number),
            None => return refusals.add(place, Cause::Number, "a 64-bit value that is not a plain number"),
        },
        // What is not a number is written as 0. These numbers have at most 48 bits, for which 53 are enough.
        #[expect(clippy::cast_precision_loss)]
        Value::Text(text) => number(text).is_none_or(|number| (low as f64..=high as f64).contains(&number)),
    };
    if !is_in_range {
        refusals.add(place, Cause::Value, "a value that its data type does not have");
    }
}

fn structured(section: &Section<'_>, refusals: &mut Refusals) {
    if number_in(section, "CompactSubObj").is_some() {
        if number_in(section, "DataType").is_none() {
            refusals.add(section.place("DataType"), Cause::Missing, "the data type of a compact array");
        }
        return;
    }
    let what = "a key of a single value in an ARRAY or RECORD";
    for key in ["AccessType", "DefaultValue", "PDOMapping"] {
        if section.get(key).is_some() {
            refusals.add(section.place(key), Cause::Value, what);
        }
    }
    for key in ["DataType", "LowLimit", "HighLimit"] {
        if number_in(section, key).is_some() {
            refusals.add(section.place(key), Cause::Value, what);
        }
    }
}

fn domain(section: &Section<'_>, refusals: &mut Refusals) {
    if section.get("PDOMapping").is_some() {
        refusals.add(section.place("PDOMapping"), Cause::Value, "`PDOMapping` of a DOMAIN, also with 0");
    }
    for key in ["LowLimit", "HighLimit", "CompactSubObj"] {
        if number_in(section, key).is_some() {
            refusals.add(section.place(key), Cause::Value, "a limit or an element count of a DOMAIN");
        }
    }
}
