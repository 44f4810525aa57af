//! What eds-utils 0.3 raises for: `eds_utils.core.file_io.read_eds`.

use std::collections::BTreeMap;

use super::python::int;
use super::refusal::{Cause, Place, Refusals, Row, rows};
use od_spec::diag::readers::Reader;
use od_spec::source::FileId;

/// Lines between two empty ones: what the reader takes for a section.
struct Block<'t> {
    header: Row<'t>,
    keys: BTreeMap<&'t str, (&'t str, Place)>,
}

/// What the reader keeps of an object.
enum Object<'t> {
    Single,
    Array(Subs<'t>, Option<i128>),
    Record(Subs<'t>),
}

/// Sub-indices with their default value.
type Subs<'t> = BTreeMap<u32, (&'t str, Place)>;

pub(super) fn refusals(text: &str, file: FileId) -> Refusals {
    let mut refusals = Refusals::new(Reader::EdsUtils, file);
    let mut objects: BTreeMap<u32, Object<'_>> = BTreeMap::new();
    // The object of the section before: its storage location is looked at before a sub-index's own object is.
    let mut before = None;
    for block in blocks(text, &mut refusals) {
        let name = block.header.text;
        let Some(name) = name.strip_prefix('[').and_then(|name| name.strip_suffix(']')) else { continue };
        if let Some(index) = hexadecimal(name).filter(|_| name.len() == 4) {
            if let Some(object) = object(&block, &mut refusals)
                && objects.insert(index, object).is_some()
            {
                refusals.add(block.header.place(), Cause::Text, "a section that is written twice");
            }
            before = Some(index);
        } else if let Some((index, sub)) = sub_index(name) {
            add_sub(&mut objects, before.replace(index), (index, sub), &block, &mut refusals);
        } else if matches!(name, "MandatoryObjects" | "OptionalObjects" | "ManufacturerObjects") {
            list(&block, &mut refusals);
        }
    }
    mappings(&objects, &mut refusals);
    refusals
}

/// The sections of a text, of which the reader knows no more than that an empty line is between them.
fn blocks<'t>(text: &'t str, refusals: &mut Refusals) -> Vec<Block<'t>> {
    // A text that ends with several empty lines has a section of one empty line for the reader.
    let ends_empty = text.replace("\r\n", "\n").replace('\r', "\n");
    let trailing = ends_empty.len() - ends_empty.trim_end_matches('\n').len();
    if trailing >= 3 && trailing % 2 == 1 {
        let end = Place { start: text.len(), end: text.len() };
        refusals.add(end, Cause::Text, "empty lines at the end of the file");
    }
    let (mut blocks, mut begun) = (Vec::new(), Vec::new());
    for row in rows(text) {
        // Of three empty lines the third belongs to the next section.
        if row.text.is_empty() && !begun.is_empty() {
            blocks.extend(block(&begun, refusals));
            begun.clear();
        } else {
            begun.push(row);
        }
    }
    blocks.extend(block(&begun, refusals));
    blocks
}

fn block<'t>(rows: &[Row<'t>], refusals: &mut Refusals) -> Option<Block<'t>> {
    let first = rows.iter().find(|row| !row.text.is_empty())?;
    let Some(at) = rows.iter().position(|row| row.text.starts_with('[')) else {
        refusals.add(first.place(), Cause::Text, "lines between two empty lines without a section name");
        return None;
    };
    let mut keys = BTreeMap::new();
    for row in rows[at + 1..].iter().filter(|row| !row.text.is_empty()) {
        match row.text.split_once('=') {
            Some((key, value)) if !value.contains('=') => {
                keys.insert(key, (value, row.place()));
            }
            Some(_) => refusals.add(row.place(), Cause::Text, "a line with a second `=`"),
            None if row.text.starts_with('[') => {
                refusals.add(row.place(), Cause::Text, "a section name without an empty line above");
            }
            None if row.text.starts_with([';', '#']) => {
                refusals.add(row.place(), Cause::Text, "a comment among the keys of a section");
            }
            None => refusals.add(row.place(), Cause::Text, "a line without `=`"),
        }
    }
    Some(Block { header: rows[at], keys })
}

fn hexadecimal(text: &str) -> Option<u32> {
    text.bytes().all(|byte| byte.is_ascii_hexdigit()).then(|| u32::from_str_radix(text, 16).ok())?
}

fn sub_index(name: &str) -> Option<(u32, u32)> {
    let (index, sub) = name.split_once("sub")?;
    let sub = hexadecimal(sub).filter(|_| matches!(sub.len(), 1 | 2))?;
    Some((hexadecimal(index).filter(|_| index.len() == 4)?, sub))
}

/// Numbers in decimal, or in hexadecimal after `0x`.
fn number(text: &str) -> Option<i128> {
    int(text, if text.starts_with("0x") { 16 } else { 10 })
}

fn object<'t>(block: &Block<'t>, refusals: &mut Refusals) -> Option<Object<'t>> {
    let Some((text, place)) = block.keys.get("ObjectType") else { return Some(Object::Single) };
    match number(text) {
        Some(7) => Some(Object::Single),
        Some(8) => Some(Object::Array(Subs::new(), None)),
        Some(9) => Some(Object::Record(Subs::new())),
        Some(_) => {
            refusals.add(*place, Cause::Unknown, "an object type other than VAR, ARRAY and RECORD");
            None
        }
        None => {
            refusals.add(*place, Cause::Number, "an object type that is not a number");
            None
        }
    }
}

fn add_sub<'t>(
    objects: &mut BTreeMap<u32, Object<'t>>,
    before: Option<u32>,
    (index, sub): (u32, u32),
    block: &Block<'t>,
    refusals: &mut Refusals,
) {
    let header = block.header.place();
    if before != Some(index)
        && matches!(before.and_then(|before| objects.get(&before)), None | Some(Object::Single))
    {
        refusals.add(header, Cause::Order, "a sub-index that does not follow its object");
    }
    let data_type = block.keys.get("DataType").and_then(|(text, _)| number(text));
    let data_type =
        data_type.filter(|number| matches!(number, 1..=0x0D | 0x0F..=0x16 | 0x18..=0x1B)).unwrap_or(7);
    let value = block.keys.get("DefaultValue").copied().unwrap_or(("0", header));
    let subs = match objects.get_mut(&index) {
        None => return refusals.add(header, Cause::Order, "a sub-index before its object"),
        Some(Object::Single) => {
            return refusals.add(header, Cause::Value, "a sub-index of an object that is a single value");
        }
        Some(Object::Record(subs)) => subs,
        Some(Object::Array(subs, common)) => {
            if sub != 0 && *common.get_or_insert(data_type) != data_type {
                let place = block.keys.get("DataType").map_or(header, |(_, place)| *place);
                refusals.add(place, Cause::Value, "an ARRAY whose elements differ in their data type");
            }
            subs
        }
    };
    if subs.insert(sub, value).is_some() && sub != 0 {
        refusals.add(header, Cause::Text, "a section that is written twice");
    }
}

fn list(block: &Block<'_>, refusals: &mut Refusals) {
    if !block.keys.contains_key("SupportedObjects") {
        refusals.add(block.header.place(), Cause::Missing, "`SupportedObjects`, spelled so");
    }
    for (value, place) in
        block.keys.iter().filter(|(key, _)| **key != "SupportedObjects").map(|(_, item)| item)
    {
        refusals.wants(
            number(value),
            *place,
            Cause::Number,
            "an entry of a list of objects that is not a number",
        );
    }
}

/// What PDOs map has to be there, dummies too.
fn mappings(objects: &BTreeMap<u32, Object<'_>>, refusals: &mut Refusals) {
    let is_mapping = |index: &u32| (0x1600..0x1800).contains(index) || (0x1A00..0x1C00).contains(index);
    for (_, object) in objects.iter().filter(|(index, _)| is_mapping(index)) {
        let (Object::Array(subs, _) | Object::Record(subs)) = object else {
            let everything = Place::default();
            refusals.add(everything, Cause::Value, "a PDO mapping without sub-indices");
            continue;
        };
        for (value, place) in subs.iter().filter(|(sub, _)| **sub != 0).map(|(_, entry)| entry) {
            let Some(mapped) =
                value.strip_prefix("0x").filter(|digits| digits.len() == 8).and_then(hexadecimal)
            else {
                // The reader itself corrects it.
                continue;
            };
            let (index, sub) = (mapped >> 16, mapped >> 8 & 0xFF);
            let is_there = mapped == 0
                || match objects.get(&index) {
                    None => false,
                    Some(Object::Single) => true,
                    Some(Object::Array(subs, _) | Object::Record(subs)) => {
                        sub == 0 || subs.contains_key(&sub)
                    }
                };
            if !is_there && index < 0x20 {
                refusals.add(*place, Cause::Reference, "a dummy in a PDO");
            } else if !is_there {
                refusals.add(*place, Cause::Reference, "a PDO that maps what is not there");
            }
        }
    }
}
