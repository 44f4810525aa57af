//! What node-canopen 6.2 throws for: `Eds.fromFile`.

use std::collections::BTreeMap;

use super::javascript::{Keys, Value, big_int, number, parse_int, sections};
use super::refusal::{Cause, Place, Refusals};
use od_spec::diag::readers::Reader;
use od_spec::source::FileId;

pub(super) fn refusals(text: &str, file: FileId) -> Refusals {
    let mut refusals = Refusals::new(Reader::NodeCanopen, file);
    let sections = sections(text);
    // Whether an object has sub-indices; one that could not be made has them, as far as is known.
    let mut objects: BTreeMap<u16, bool> = BTreeMap::new();
    for (name, (header, keys)) in &sections {
        let Some(index) = index(name) else { continue };
        let object = Section { header: *header, keys };
        let has_subs = entry(&object, &mut refusals);
        if objects.insert(index, has_subs).is_some() {
            refusals.add(*header, Cause::Text, "a section that is written twice, in different case");
        }
    }
    for (name, (header, keys)) in &sections {
        let Some((index, sub)) = name.split_once("sub").filter(|(_, sub)| is_hexadecimal(sub)) else {
            continue;
        };
        let Some(index) = self::index(index) else { continue };
        match objects.get(&index) {
            None => refusals.add(*header, Cause::Reference, "a sub-index without its object"),
            Some(false) => {
                refusals.add(*header, Cause::Value, "a sub-index of an object that is a single value");
            }
            Some(true) if u8::from_str_radix(sub, 16).is_err() => {
                refusals.add(*header, Cause::Value, "a sub-index above FFh");
            }
            Some(true) => {}
        }
        let section = Section { header: *header, keys };
        if section.number("SubNumber").is_some() && u32::from_str_radix(sub, 16) == Ok(0) {
            refusals.add(section.place("SubNumber"), Cause::Value, "`SubNumber` of a sub-index 0");
        }
        entry(&section, &mut refusals);
    }
    refusals
}

fn is_hexadecimal(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_hexdigit())
}

fn index(name: &str) -> Option<u16> {
    (name.len() == 4 && is_hexadecimal(name)).then(|| u16::from_str_radix(name, 16).ok())?
}

struct Section<'s> {
    header: Place,
    keys: &'s Keys,
}

impl Section<'_> {
    /// A number other than 0; 0 and what is not a number are as if they were not there.
    fn number(&self, key: &str) -> Option<i128> {
        match self.keys.get(key)? {
            (Value::Text(text), _) => parse_int(text).filter(|number| *number != 0),
            (Value::Boolean(_) | Value::Null, _) => None,
        }
    }

    /// Where a key is, also in another case, or the section.
    fn place(&self, key: &str) -> Place {
        let named =
            || self.keys.iter().find(|(name, _)| name.eq_ignore_ascii_case(key)).map(|(_, found)| found);
        self.keys.get(key).or_else(named).map_or(self.header, |(_, place)| *place)
    }

    fn has(&self, key: &str) -> bool {
        self.keys.contains_key(key)
    }
}

/// Whether it has sub-indices.
fn entry(section: &Section<'_>, refusals: &mut Refusals) -> bool {
    if !section.has("ParameterName") {
        refusals.add(section.place("ParameterName"), Cause::Missing, "`ParameterName`, spelled so");
    }
    match section.number("ObjectType").unwrap_or(7) {
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
    let data_type = section.number("DataType");
    if data_type.is_none() {
        refusals.add(section.place("DataType"), Cause::Missing, "`DataType`, spelled so, with a number");
    }
    if section.number("CompactSubObj").is_some() {
        let what = "`CompactSubObj` of an object that is a single value";
        refusals.add(section.place("CompactSubObj"), Cause::Value, what);
    }
    if let (Some(low), Some(high)) = (section.number("LowLimit"), section.number("HighLimit"))
        && high < low
    {
        refusals.add(section.place("LowLimit"), Cause::Value, "limits in the wrong order");
    }
    if let (Some(data_type), Some((default, place))) = (data_type, section.keys.get("DefaultValue")) {
        default_value(data_type, default, *place, refusals);
    }
}

fn default_value(data_type: i128, value: &Value, place: Place, refusals: &mut Refusals) {
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
    if section.number("CompactSubObj").is_some() {
        if section.number("DataType").is_none() {
            refusals.add(section.place("DataType"), Cause::Missing, "the data type of a compact array");
        }
        return;
    }
    let what = "a key of a single value in an ARRAY or RECORD";
    for key in ["AccessType", "DefaultValue", "PDOMapping"] {
        if section.has(key) {
            refusals.add(section.place(key), Cause::Value, what);
        }
    }
    for key in ["DataType", "LowLimit", "HighLimit"] {
        if section.number(key).is_some() {
            refusals.add(section.place(key), Cause::Value, what);
        }
    }
}

fn domain(section: &Section<'_>, refusals: &mut Refusals) {
    if section.has("PDOMapping") {
        refusals.add(section.place("PDOMapping"), Cause::Value, "`PDOMapping` of a DOMAIN, also with 0");
    }
    for key in ["LowLimit", "HighLimit", "CompactSubObj"] {
        if section.number(key).is_some() {
            refusals.add(section.place(key), Cause::Value, "a limit or an element count of a DOMAIN");
        }
    }
}
