//! The lint: sections and keys that it knows, lists, objects.

use super::super::python::{Ini, Section, int};
use super::super::refusal::{Cause, Refusals};
use super::{objects, values};

const FILE: &[&str] = &[
    "filename",
    "fileversion",
    "filerevision",
    "edsversion",
    "description",
    "creationtime",
    "creationdate",
    "createdby",
    "modificationtime",
    "modificationdate",
    "modifiedby",
    "lasteds",
];
const NODE: &[&str] = &[
    "nodeid",
    "nodename",
    "noderefd",
    "baudrate",
    "netnumber",
    "networkname",
    "netrefd",
    "canopenmanager",
    "lss_serialnumber",
];
const DEVICE: &[&str] = &[
    "vendorname",
    "vendornumber",
    "productname",
    "productnumber",
    "revisionnumber",
    "ordercode",
    "baudrate_10",
    "baudrate_20",
    "baudrate_50",
    "baudrate_125",
    "baudrate_250",
    "baudrate_500",
    "baudrate_800",
    "baudrate_1000",
    "simplebootupmaster",
    "simplebootupslave",
    "granularity",
    "dynamicchannelssupported",
    "groupmessaging",
    "nrofrxpdo",
    "nroftxpdo",
    "lss_supported",
    "compactpdo",
];

pub(super) fn lint(ini: &Ini<'_>, refusals: &mut Refusals) {
    for place in &ini.defaults {
        refusals.add(
            *place,
            Cause::Unknown,
            "a key below `[DEFAULT]`, which it takes for a key of every section",
        );
    }
    for section in &ini.sections {
        match section.number {
            Some((index, None)) => {
                objects::object(ini, section, index, refusals);
                continue;
            }
            Some((index, Some(sub))) => {
                objects::sub_index(ini, section, index, sub.into(), refusals);
                continue;
            }
            None => {}
        }
        match section.name.to_lowercase().as_str() {
            "comments" => {}
            "fileinfo" => keys(section, FILE, refusals),
            "devicecomissioning" => keys(section, NODE, refusals),
            "deviceinfo" => keys(section, DEVICE, refusals),
            "dummyusage" => dummies(section, refusals),
            "mandatoryobjects" | "optionalobjects" | "manufacturerobjects" => list(ini, section, refusals),
            name => match Kind::of(name) {
                Some(Kind::Object(index)) => objects::object(ini, section, index, refusals),
                Some(Kind::Sub(index, sub)) => objects::sub_index(ini, section, index, sub, refusals),
                Some(Kind::Elements(index)) => elements(ini, section, index, refusals),
                None => refusals.add(section.header, Cause::Unknown, "a section of this name"),
            },
        }
    }
}

enum Kind {
    Object(u16),
    Sub(u16, u32),
    /// `[2000Name]` or `[2000Value]`.
    Elements(u16),
}

impl Kind {
    /// From a name in small letters.
    fn of(name: &str) -> Option<Self> {
        let (digits, rest) = name.split_at_checked(4)?;
        let index = u16::from_str_radix(digits, 16).ok().filter(|_| !digits.starts_with('+'))?;
        if let Some(sub) = rest.strip_prefix("sub") {
            let is_hexadecimal = !sub.is_empty() && sub.bytes().all(|byte| byte.is_ascii_hexdigit());
            return is_hexadecimal
                .then(|| Kind::Sub(index, u32::from_str_radix(sub, 16).unwrap_or(u32::MAX)));
        }
        match rest {
            "" => Some(Kind::Object(index)),
            "name" | "value" => Some(Kind::Elements(index)),
            _ => None,
        }
    }
}

fn keys(section: &Section<'_>, known: &[&str], refusals: &mut Refusals) {
    for item in &section.items {
        if !known.contains(&item.key.to_lowercase().as_str()) {
            refusals.add(item.place, Cause::Unknown, "a key of this name about file, device or node");
        }
    }
}

fn dummies(section: &Section<'_>, refusals: &mut Refusals) {
    for item in &section.items {
        let key = item.key.to_lowercase();
        let digits = key.strip_prefix("dummy").filter(|digits| digits.len() == 4);
        if digits.is_none_or(|digits| !digits.bytes().all(|byte| byte.is_ascii_hexdigit())) {
            refusals.add(item.place, Cause::Unknown, "a key of this name about dummies");
        } else if int(&item.value, 2).is_none() {
            refusals.add(item.place, Cause::Number, "a dummy that is neither 0 nor 1");
        }
    }
}

fn list(ini: &Ini<'_>, section: &Section<'_>, refusals: &mut Refusals) {
    for item in &section.items {
        if !item.key.eq_ignore_ascii_case("SupportedObjects") && int(item.key, 10).is_none() {
            refusals.add(item.place, Cause::Unknown, "a key of a list of objects that is not a number");
        }
    }
    let Some(count) = section.item("SupportedObjects") else {
        return refusals.add(section.header, Cause::Missing, "`SupportedObjects`");
    };
    let Some(number) = int(&count.value, 10) else {
        return refusals.add(count.place, Cause::Number, "a number of objects that is not decimal");
    };
    if usize::try_from(number).map_or(true, |number| number + 1 < section.items.len()) {
        refusals.add(count.place, Cause::Value, "more entries than `SupportedObjects` counts");
    }
    for entry in 1..=number {
        let Some(item) = section.item(&entry.to_string()) else {
            return refusals.add(count.place, Cause::Missing, "an entry that `SupportedObjects` counts");
        };
        match int(&item.value, 0) {
            None => refusals.add(item.place, Cause::Number, "an index in another notation than `0x1000`"),
            Some(index) => {
                let object = match u16::try_from(index) {
                    Ok(index) => ini.object(index),
                    Err(_) => ini.section(&format!("{index:X}")),
                };
                if object.is_none() {
                    refusals.add(item.place, Cause::Reference, "a listed object without a section");
                }
                if let Some(what) = misplaced(section.name, index) {
                    refusals.add(item.place, Cause::Value, what);
                }
            }
        }
    }
}

/// Why an object does not belong into a list.
fn misplaced(list: &str, index: i128) -> Option<&'static str> {
    let is_of_maker = (0x2000..0x6000).contains(&index);
    let fits = match list.to_lowercase().as_str() {
        _ if index < 0x1000 => return Some("a data type in a list of objects"),
        "mandatoryobjects" => matches!(index, 0x1000 | 0x1001 | 0x1018),
        "optionalobjects" => !is_of_maker,
        _ => is_of_maker,
    };
    (!fits).then_some("an object in the wrong list")
}

/// Names or values of the elements of a compact array.
fn elements(ini: &Ini<'_>, section: &Section<'_>, index: u16, refusals: &mut Refusals) {
    let object = ini.object(index);
    let mut count = 0;
    if let Some(object) = object {
        match object.filled("CompactSubObj").map(|item| (int(&item.value, 0), item.place)) {
            Some((Some(number), _)) => count = number,
            Some((None, place)) => refusals.add(place, Cause::Number, "not a valid number of elements"),
            None => {
                refusals.add(
                    section.header,
                    Cause::Reference,
                    "a list for elements that no compact array has",
                );
            }
        }
        values::data_type(object, refusals);
    } else {
        refusals.add(
            section.header,
            Cause::Reference,
            "a list for the elements of an object without a section",
        );
    }
    for item in section.items.iter().filter(|item| !item.key.eq_ignore_ascii_case("NrOfEntries")) {
        match int(item.key, 10) {
            Some(element) if element <= count => {}
            Some(_) | None => {
                refusals.add(item.place, Cause::Unknown, "an element that the compact array does not have");
            }
        }
    }
    let Some(entries) = section.item("NrOfEntries") else {
        return refusals.add(section.header, Cause::Missing, "`NrOfEntries`");
    };
    let there_are = i128::try_from(section.items.len()).unwrap_or(i128::MAX) - 1;
    if int(&entries.value, 10) != Some(there_are) {
        refusals.add(entries.place, Cause::Value, "another number of elements than `NrOfEntries` counts");
    }
    if let Some(object) = object.filter(|_| section.name.to_lowercase().ends_with("value")) {
        for item in section.items.iter().filter(|item| !item.key.eq_ignore_ascii_case("NrOfEntries")) {
            values::check_value(object, item, refusals);
        }
    }
}
