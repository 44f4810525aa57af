//! What the EDS says: its keys, and the comments above each section for what keys cannot say.

use std::collections::BTreeMap;

use od_spec::model::{Access, DataType, Entry, PdoMapping, Storage, TypeKind, Value};

use super::Output;
use super::facts::{Facts, Limits, Reach, Reported};
use super::read;

/// A section with the comments above it.
#[derive(Debug, Default)]
struct Section<'t> {
    comments: Vec<String>,
    keys: BTreeMap<&'t str, &'t str>,
}

/// Reads the EDS of one device.
pub(crate) fn read(text: &str, language: &str, output: &mut Output<'_>) {
    let sections = sections(text);
    for (name, section) in &sections {
        let (index, sub) = name.split_once("sub").unwrap_or((name, "0"));
        let Ok(index) = u16::from_str_radix(index, 16) else { continue };
        // The section of an array or record is about the object.
        if !section.keys.contains_key("SubNumber") {
            output
                .report(index, u8::from_str_radix(sub, 16).unwrap(), |entry| facts(entry, section, language));
        }
    }
}

fn sections(text: &str) -> BTreeMap<&str, Section<'_>> {
    let mut sections = BTreeMap::new();
    let (mut comments, mut name) = (Vec::<String>::new(), "");
    for line in text.lines() {
        if let Some(continued) = line.strip_prefix(";   ") {
            let comment = comments.last_mut().unwrap();
            comment.push(' ');
            comment.push_str(continued);
        } else if let Some(comment) = line.strip_prefix("; ") {
            comments.push(comment.to_owned());
        } else if let Some(header) = line.strip_prefix('[') {
            name = header.strip_suffix(']').unwrap();
            let comments = std::mem::take(&mut comments);
            let earlier = sections.insert(name, Section { comments, ..Section::default() });
            assert!(earlier.is_none(), "[{name}] is there twice");
        } else if let Some((key, value)) = line.split_once('=') {
            sections.get_mut(name).unwrap().keys.insert(key, value);
        }
    }
    sections
}

/// What the comments say.
#[derive(Debug, Default)]
struct Remarks<'t> {
    unit: Option<&'t str>,
    range: Option<&'t str>,
    default: Option<&'t str>,
    storage: Option<Storage>,
    service: Service,
    listed: Vec<read::Listed>,
}

/// Whether only service may write.
#[derive(Debug, Default, PartialEq, Eq)]
enum Service {
    Only,
    #[default]
    NotNeeded,
}

/// The line of facts, whose parts are separated by semicolons; `None` for another line.
fn remark<'t>(remarks: &mut Remarks<'t>, part: &'t str) -> bool {
    if let Some(unit) = part.strip_prefix("unit ") {
        remarks.unit = Some(unit);
    } else if let Some(range) = part.strip_prefix("range ") {
        remarks.range = Some(range);
    } else if let Some(default) = ["factory default ", "default of the standard ", "start value "]
        .into_iter()
        .find_map(|prefix| part.strip_prefix(prefix))
    {
        remarks.default = Some(default);
    } else if let Some(storage) = read::storage(part).filter(|storage| *storage != Storage::No) {
        remarks.storage = Some(storage);
    } else if part == "writable only when unlocked for service" {
        remarks.service = Service::Only;
    } else {
        return part.starts_with("view of ") || part.starts_with("writable only while ");
    }
    true
}

fn remarks<'t>(entry: &Entry, section: &'t Section<'_>, language: &str) -> Remarks<'t> {
    let mut remarks = Remarks::default();
    // Warning and meaning are first.
    let has_warning = entry.warning.get(language).is_some();
    let texts = [has_warning, entry.about.get(language).is_some()].into_iter().filter(|has| *has).count();
    let is_warning = section.comments.first().is_some_and(|line| line.starts_with("Warning: "));
    assert_eq!(is_warning, has_warning, "{}", entry.name);
    for line in section.comments.iter().skip(texts) {
        if let Some(listed) = read::listed(entry, line.trim_end_matches(" (not supported)")) {
            remarks.listed.push(listed);
            continue;
        }
        let parts: Vec<&str> = line.split("; ").collect();
        let is_bit = line.starts_with("bit ") || line.starts_with("bits ");
        for part in parts.iter().filter(|_| !is_bit) {
            assert!(remark(&mut remarks, part), "{}: {part:?} of {line:?} says nothing known", entry.name);
        }
    }
    remarks
}

fn facts(entry: &Entry, section: &Section<'_>, language: &str) -> Facts {
    let remarks = remarks(entry, section, language);
    let access = Access::from_word(section.keys["AccessType"]).unwrap();
    let key = |name: &str| section.keys.get(name).copied();
    let limit = |name: &str| key(name).map(|text| text.parse::<i128>().unwrap());
    let widened = (limit("LowLimit"), limit("HighLimit"));
    assert_eq!(widened, entry.hull(), "{}: the keys hold the limits with the special values", entry.name);
    let limits = match remarks.range {
        Some(range) => {
            let range = range.strip_suffix(", or a special value").unwrap();
            let range = read::range(entry, range).unwrap();
            Limits::Narrowing { low: range.low, high: range.high }
        }
        None => Limits::Exact { low: widened.0, high: widened.1 },
    };
    let written = key("DefaultValue").map(|text| default(entry, text));
    assert!(written.is_none() || remarks.default.is_none(), "{}: two defaults", entry.name);
    let mapping = match (key("PDOMapping"), access) {
        (None | Some("0"), _) => PdoMapping::None,
        (_, Access::Const | Access::Ro | Access::Rwr) => PdoMapping::Transmit,
        (_, Access::Wo | Access::Rww) => PdoMapping::Receive,
        (_, Access::Rw) => PdoMapping::Both,
    };
    let mut special: BTreeMap<i128, String> =
        remarks.listed.iter().map(|listed| (listed.raw, listed.name.clone())).collect();
    remove_values(entry, &mut special);
    Facts {
        default: Reported::Said(written.or_else(|| remarks.default.map(|text| read::value(entry, text)))),
        limits,
        step: remarks.unit.map(read::step),
        special,
        reach: match (remarks.service, access) {
            (Service::NotNeeded, access) => Reach::of(access, false),
            (Service::Only, Access::Wo) => Reach::ServiceWrites,
            // Read-only for a reader that goes by the keys.
            (Service::Only, access) => {
                assert_eq!(access, Access::Ro, "{} is locked", entry.name);
                Reach::ReadAndServiceWrites
            }
        },
        storage: remarks.storage.unwrap_or(Storage::No),
        mapping,
    }
}

/// `DefaultValue`: what a program reads.
fn default(entry: &Entry, text: &str) -> Value {
    match entry.data_type {
        DataType::VisibleString | DataType::UnicodeString => Value::Text(text.to_owned()),
        _ => read::value(entry, text),
    }
}

/// Takes the values of the entry's enum out of a list; up to forty of them are in it.
fn remove_values(entry: &Entry, listed: &mut BTreeMap<i128, String>) {
    let Some(TypeKind::Enum(values)) = entry.named_type.as_ref().map(|named| &named.kind) else { return };
    if values.len() <= 40 {
        for value in values {
            let name = listed.remove(&value.value);
            assert_eq!(
                name,
                Some(od_spec::ascii::transliterate(&value.name)),
                "{} {}",
                entry.name,
                value.value
            );
        }
    }
}
