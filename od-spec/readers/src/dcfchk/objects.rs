//! Sections of objects and sub-indices.

use super::super::python::{Ini, Section, int};
use super::super::refusal::{Cause, Refusals};
use super::values;

const KEYS: [&str; 16] = [
    "subnumber",
    "parametername",
    "objecttype",
    "datatype",
    "accesstype",
    "lowlimit",
    "highlimit",
    "defaultvalue",
    "pdomapping",
    "objflags",
    "compactsubobj",
    "parametervalue",
    "uploadfile",
    "downloadfile",
    "denotation",
    "paramrefd",
];
const ACCESS: [&str; 6] = ["ro", "wo", "rw", "rwr", "rww", "const"];

pub(super) fn object(ini: &Ini<'_>, section: &Section<'_>, index: u16, refusals: &mut Refusals) {
    keys(section, refusals);
    let object_type = number(section, "ObjectType", 7, refusals);
    let is_structured = matches!(object_type, 8 | 9);
    if matches!(object_type, 5 | 7) && section.filled("DataType").is_none() {
        refusals.add(section.place("DataType"), Cause::Missing, "the data type of a VAR");
    }
    let (subs, elements) =
        (number(section, "SubNumber", 0, refusals), number(section, "CompactSubObj", 0, refusals));
    match section.filled("AccessType") {
        Some(access) if matches!(object_type, 6 | 8 | 9) && elements == 0 => {
            refusals.add(access.place, Cause::Value, "an access type of an ARRAY or RECORD");
        }
        None if object_type != 2 && elements != 0 => {
            refusals.add(section.header, Cause::Missing, "the access type of a compact array");
        }
        Some(_) | None => {}
    }
    if subs != 0 && elements != 0 {
        let what = "`SubNumber` together with `CompactSubObj`";
        refusals.add(section.place("SubNumber"), Cause::Value, what);
    } else if (subs != 0 || elements != 0) && !is_structured {
        let key = if subs != 0 { "SubNumber" } else { "CompactSubObj" };
        let what = "a number of sub-indices of what is neither ARRAY nor RECORD";
        refusals.add(section.place(key), Cause::Value, what);
    }
    if subs != 0 && elements == 0 {
        count(ini, section, index, subs, refusals);
    }
    if subs == 0 {
        values::data_type(section, refusals);
        values::values(section, refusals);
    }
}

fn count(ini: &Ini<'_>, section: &Section<'_>, index: u16, subs: i128, refusals: &mut Refusals) {
    let described = ini.subs(index).count();
    if i128::try_from(described) != Ok(subs) {
        refusals.add(section.place("SubNumber"), Cause::Value, "a wrong number of sub-indices");
    }
    if let Some(first) = ini.sub(index, 0)
        && number(first, "DataType", 0, refusals) != 5
    {
        refusals.add(first.place("DataType"), Cause::Value, "a sub-index 0 that is no UNSIGNED8");
    }
}

pub(super) fn sub_index(ini: &Ini<'_>, section: &Section<'_>, index: u16, sub: u32, refusals: &mut Refusals) {
    if ini.object(index).is_none() {
        refusals.add(section.header, Cause::Reference, "a sub-index without its object");
    }
    if sub > 254 {
        return refusals.add(section.header, Cause::Value, "a sub-index above FEh");
    }
    keys(section, refusals);
    values::data_type(section, refusals);
    values::values(section, refusals);
    if section.filled("AccessType").is_none() {
        refusals.add(section.place("AccessType"), Cause::Missing, "the access type of a sub-index");
    }
}

fn keys(section: &Section<'_>, refusals: &mut Refusals) {
    for item in &section.items {
        if !is_one_of(item.key, &KEYS) {
            refusals.add(item.place, Cause::Unknown, "a key of this name of an object");
        } else if item.key.eq_ignore_ascii_case("AccessType") && !is_one_of(&item.value, &ACCESS) {
            refusals.add(item.place, Cause::Value, "not a valid access type");
        }
    }
    if section.item("ParameterName").is_none() {
        refusals.add(section.header, Cause::Missing, "`ParameterName`");
    }
}

/// Whether a word is among words in lower case.
fn is_one_of(word: &str, known: &[&str]) -> bool {
    let is_ascii = known.iter().any(|one| one.eq_ignore_ascii_case(word));
    is_ascii || !word.is_ascii() && known.contains(&word.to_lowercase().as_str())
}

/// A number, if the key is there and not empty.
fn number(section: &Section<'_>, key: &str, otherwise: i128, refusals: &mut Refusals) -> i128 {
    let Some(item) = section.filled(key) else { return otherwise };
    let read = refusals.wants(
        int(&item.value, 0),
        item.place,
        Cause::Number,
        "a number in another notation than `10` or `0xA`",
    );
    read.unwrap_or(otherwise)
}
