//! What python-canopen 2.4 raises for: `canopen.objectdictionary.eds.import_eds` with a node-ID.

use std::collections::BTreeMap;

use super::python::{Ini, Section, int};
use super::refusal::{Cause, Place, Refusals};
use od_spec::diag::readers::Reader;
use od_spec::source::FileId;

const BIT_RATES: [u32; 8] = [10, 20, 50, 125, 250, 500, 800, 1000];
const NUMBERS: [&str; 11] = [
    "VendorNumber",
    "ProductNumber",
    "RevisionNumber",
    "SimpleBootUpMaster",
    "SimpleBootUpSlave",
    "Granularity",
    "DynamicChannelsSupported",
    "GroupMessaging",
    "NrOfRXPDO",
    "NrOfTXPDO",
    "LSS_Supported",
];

/// What the reader keeps of an object: whether it has sub-indices, and whether there is one numbered 1.
#[derive(Clone, Copy)]
enum Object {
    Single,
    Structured { has_first: bool },
}

/// Of a text that is read with regard to case.
pub(super) fn refusals(ini: &Ini<'_>, file: FileId) -> Refusals {
    let mut refusals = Refusals::new(Reader::PythonCanopen, file);
    ini.refuse(&mut refusals);
    information(ini, &mut refusals);
    let mut objects = BTreeMap::new();
    for section in &ini.sections {
        match Kind::of(section.name) {
            Some(Kind::Dummies) => dummies(section, &mut refusals),
            Some(Kind::Object(index)) => {
                if let Some(object) = object(ini, section, &mut refusals) {
                    objects.insert(index, object);
                }
            }
            Some(Kind::Sub(index, sub)) => match objects.get_mut(&index) {
                Some(Object::Structured { has_first }) => {
                    *has_first |= sub == 1;
                    entry(ini, section, &mut refusals);
                }
                Some(Object::Single) => {}
                None => refusals.add(section.header, Cause::Order, "a sub-index before its object"),
            },
            Some(Kind::Names(index)) => names(section, objects.get(&index).copied(), &mut refusals),
            None => {}
        }
    }
    refusals
}

enum Kind {
    Dummies,
    Object(u16),
    Sub(u16, u32),
    /// `[2000Name]`, and whatever begins so.
    Names(u16),
}

impl Kind {
    fn of(name: &str) -> Option<Self> {
        if matches!(name, "DummyUsage" | "dummyUsage" | "Dummyusage" | "dummyusage") {
            return Some(Kind::Dummies);
        }
        let (digits, rest) = name.split_at_checked(4)?;
        let is_hexadecimal =
            |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_hexdigit());
        let index = u16::from_str_radix(digits, 16).ok().filter(|_| is_hexadecimal(digits))?;
        if rest.is_empty() {
            return Some(Kind::Object(index));
        }
        // The expression is `[S|s]ub`, so that a bar passes for an S.
        let sub = rest.strip_prefix(['S', 's', '|']).and_then(|rest| rest.strip_prefix("ub"));
        if let Some(sub) = sub.filter(|sub| is_hexadecimal(sub)) {
            return Some(Kind::Sub(index, u32::from_str_radix(sub, 16).unwrap_or(u32::MAX)));
        }
        rest.starts_with("Name").then_some(Kind::Names(index))
    }
}

fn information(ini: &Ini<'_>, refusals: &mut Refusals) {
    if let Some(section) = ini.section("Comments")
        && let Some(lines) = number(section, "Lines", 0, refusals)
        && (1..=lines).any(|line| section.item(&format!("Line{line}")).is_none())
    {
        refusals.add(section.place("Lines"), Cause::Missing, "a comment line that `Lines` counts");
    }
    if let Some(section) = ini.section("DeviceInfo") {
        let rates = BIT_RATES.iter().map(|rate| format!("BaudRate_{rate}"));
        for key in rates.chain(NUMBERS.map(str::to_owned)) {
            optional(section, &key, 0, refusals);
        }
    }
    if let Some(section) = ini.section("DeviceComissioning") {
        optional(section, "Baudrate", 10, refusals);
    }
}

/// The seven smallest types have to be named, in decimal or not.
fn dummies(section: &Section<'_>, refusals: &mut Refusals) {
    for data_type in 1..8 {
        let key = format!("Dummy{data_type:04}");
        match section.value(&key) {
            None => return refusals.add(section.header, Cause::Missing, "one of `Dummy0001` to `Dummy0007`"),
            Some(value) if int(value, 10).is_none() => {
                refusals.add(section.place(&key), Cause::Number, "a dummy that is not a decimal number");
            }
            Some(_) => {}
        }
    }
}

fn object(ini: &Ini<'_>, section: &Section<'_>, refusals: &mut Refusals) -> Option<Object> {
    name(section, refusals);
    let object_type = match section.value("ObjectType") {
        None => 7,
        Some(_) => number(section, "ObjectType", 0, refusals)?,
    };
    match object_type {
        2 | 7 => {
            entry(ini, section, refusals);
            Some(Object::Single)
        }
        8 if section.item("CompactSubObj").is_some() => {
            entry(ini, section, refusals);
            Some(Object::Structured { has_first: true })
        }
        8 | 9 => Some(Object::Structured { has_first: false }),
        // It is passed over, and its sub-indices then have no object.
        _ => None,
    }
}

/// A section that describes a value.
fn entry(ini: &Ini<'_>, section: &Section<'_>, refusals: &mut Refusals) {
    name(section, refusals);
    if let Some(data_type) = number(section, "DataType", 0, refusals)
        && data_type > 0x1B
        && let Some(defined) = ini.section(&format!("{data_type:X}sub1"))
    {
        number(defined, "DefaultValue", 0, refusals);
    }
    wants(section, "AccessType", "`AccessType`, spelled so", refusals);
    optional(section, "PDOMapping", 0, refusals);
}

fn name(section: &Section<'_>, refusals: &mut Refusals) {
    wants(section, "ParameterName", "`ParameterName`, spelled so", refusals);
}

fn wants(section: &Section<'_>, key: &str, what: &'static str, refusals: &mut Refusals) {
    if section.item(key).is_none() {
        refusals.add(section.place_in_any_capitals(key), Cause::Missing, what);
    }
}

/// Names of the elements of a compact array: as many as there are, without gaps.
fn names(section: &Section<'_>, object: Option<Object>, refusals: &mut Refusals) {
    let Some(count) = number(section, "NrOfEntries", 10, refusals) else { return };
    match object {
        Some(Object::Structured { has_first: true }) => {}
        Some(Object::Structured { .. } | Object::Single) | None => {
            return refusals.add(
                section.header,
                Cause::Reference,
                "names of elements that no compact array has",
            );
        }
    }
    if (1..=count).any(|element| section.item(&element.to_string()).is_none()) {
        refusals.add(section.place("NrOfEntries"), Cause::Missing, "an element that `NrOfEntries` counts");
    }
}

fn number(section: &Section<'_>, key: &'static str, base: u32, refusals: &mut Refusals) -> Option<i128> {
    let Some(value) = section.value(key) else {
        refusals.add(section.place_in_any_capitals(key), Cause::Missing, missing(key));
        return None;
    };
    let number = int(value, base);
    if number.is_none() {
        refusals.add(section.place(key), Cause::Number, UNREADABLE);
    }
    number
}

fn optional(section: &Section<'_>, key: &str, base: u32, refusals: &mut Refusals) {
    if let Some(value) = section.value(key)
        && int(value, base).is_none()
    {
        let place: Place = section.place(key);
        refusals.add(place, Cause::Number, if value.is_empty() { "an empty number" } else { UNREADABLE });
    }
}

const UNREADABLE: &str = "a number in another notation than `10` or `0xA`";

fn missing(key: &'static str) -> &'static str {
    match key {
        "DataType" => "`DataType`, spelled so",
        "Lines" => "`Lines`, spelled so",
        "NrOfEntries" => "`NrOfEntries`, spelled so",
        _ => "a key that is needed",
    }
}
