//! What eds-utils 0.3 raises for: `eds_utils.core.file_io.read_eds`.

use std::collections::BTreeMap;

use super::lines::{Line, Signs};
use super::python::int;
use super::refusal::{Cause, Place, Refusals};
use od_spec::diag::readers::Reader;
use od_spec::source::FileId;

/// A value, and the line that it is in.
type Value<'t> = (&'t str, Place);

/// What the reader looks at in the section of an object or sub-index, each with its last value.
#[derive(Default)]
struct Entry<'t> {
    object_type: Option<Value<'t>>,
    data_type: Option<Value<'t>>,
    default: Option<Value<'t>>,
}

/// What the reader keeps of an object.
enum Object<'t> {
    Single,
    Array(Subs<'t>, Option<i128>),
    Record(Subs<'t>),
}

/// Sub-indices with their default value.
type Subs<'t> = BTreeMap<u32, Value<'t>>;

/// A section, by its name.
enum Kind {
    Object(u32),
    Sub(u32, u32),
    /// A list of objects.
    List,
    /// Of which the values are not looked at.
    Other,
}

impl Kind {
    fn of(header: &str) -> Self {
        let Some(name) = header.strip_prefix('[').and_then(|name| name.strip_suffix(']')) else {
            return Kind::Other;
        };
        if let Some(index) = hexadecimal(name).filter(|_| name.len() == 4) {
            Kind::Object(index)
        } else if let Some((index, sub)) = sub_index(name) {
            Kind::Sub(index, sub)
        } else if matches!(name, "MandatoryObjects" | "OptionalObjects" | "ManufacturerObjects") {
            Kind::List
        } else {
            Kind::Other
        }
    }
}

pub(super) fn refusals(text: &str, lines: &[Line<'_>], file: FileId) -> Refusals {
    let mut model =
        Model { objects: BTreeMap::new(), before: None, refusals: Refusals::new(Reader::EdsUtils, file) };
    model.empty_lines_at_the_end(lines, text.len());
    let mut begun = 0;
    for (at, line) in lines.iter().enumerate() {
        // Of three empty lines the third belongs to the next section.
        if line.text.is_empty() && begun < at {
            model.block(&lines[begun..at]);
            begun = at + 1;
        }
    }
    model.block(&lines[begun..]);
    mappings(&model.objects, &mut model.refusals);
    model.refusals
}

/// What the reader knows while it reads.
struct Model<'t> {
    objects: BTreeMap<u32, Object<'t>>,
    /// The object of the section before: its storage location is looked at before a sub-index's own object is.
    before: Option<u32>,
    refusals: Refusals,
}

impl<'t> Model<'t> {
    /// A text that ends with several empty lines has a section of one empty line for the reader.
    fn empty_lines_at_the_end(&mut self, lines: &[Line<'t>], end: usize) {
        let empty = lines.iter().rev().take_while(|line| line.text.is_empty()).count();
        // One break is that of the last line that is not empty.
        let breaks = empty + usize::from(empty < lines.len());
        if breaks >= 3 && breaks % 2 == 1 {
            self.refusals.add(Place { start: end, end }, Cause::Text, "empty lines at the end of the file");
        }
    }

    /// Lines between two empty ones: what the reader takes for a section.
    fn block(&mut self, lines: &[Line<'t>]) {
        let Some(first) = lines.iter().find(|line| !line.text.is_empty()) else { return };
        let Some(at) = lines.iter().position(|line| line.text.starts_with('[')) else {
            let what = "lines between two empty lines without a section name";
            return self.refusals.add(first.place(), Cause::Text, what);
        };
        let (header, lines) = (&lines[at], &lines[at + 1..]);
        for line in lines {
            if let Some(what) = refused(line) {
                self.refusals.add(line.place(), Cause::Text, what);
            }
        }
        let keys = lines
            .iter()
            .filter(|line| !line.has(Signs::SECOND_EQUALS))
            .filter_map(|line| Some((line.pair()?, line.place())));
        match Kind::of(header.text) {
            Kind::Object(index) => {
                if let Some(object) = object(&Entry::of(keys), &mut self.refusals)
                    && self.objects.insert(index, object).is_some()
                {
                    self.refusals.add(header.place(), Cause::Text, "a section that is written twice");
                }
                self.before = Some(index);
            }
            Kind::Sub(index, sub) => {
                let before = self.before.replace(index);
                self.add_sub(before, (index, sub), &Entry::of(keys), header.place());
            }
            Kind::List => {
                let keys = keys.map(|((key, value), place)| (key, (value, place))).collect();
                list(&keys, header.place(), &mut self.refusals);
            }
            Kind::Other => {}
        }
    }

    fn add_sub(&mut self, before: Option<u32>, (index, sub): (u32, u32), entry: &Entry<'t>, header: Place) {
        if before != Some(index)
            && matches!(before.and_then(|before| self.objects.get(&before)), None | Some(Object::Single))
        {
            self.refusals.add(header, Cause::Order, "a sub-index that does not follow its object");
        }
        let data_type = entry.data_type.and_then(|(text, _)| number(text));
        let data_type =
            data_type.filter(|number| matches!(number, 1..=0x0D | 0x0F..=0x16 | 0x18..=0x1B)).unwrap_or(7);
        let value = entry.default.unwrap_or(("0", header));
        let subs = match self.objects.get_mut(&index) {
            None => return self.refusals.add(header, Cause::Order, "a sub-index before its object"),
            Some(Object::Single) => {
                let what = "a sub-index of an object that is a single value";
                return self.refusals.add(header, Cause::Value, what);
            }
            Some(Object::Record(subs)) => subs,
            Some(Object::Array(subs, common)) => {
                if sub != 0 && *common.get_or_insert(data_type) != data_type {
                    let place = entry.data_type.map_or(header, |(_, place)| place);
                    let what = "an ARRAY whose elements differ in their data type";
                    self.refusals.add(place, Cause::Value, what);
                }
                subs
            }
        };
        if subs.insert(sub, value).is_some() && sub != 0 {
            self.refusals.add(header, Cause::Text, "a section that is written twice");
        }
    }
}

/// Why a line of a section is refused.
fn refused(line: &Line<'_>) -> Option<&'static str> {
    if line.pair().is_some() {
        return line.has(Signs::SECOND_EQUALS).then_some("a line with a second `=`");
    }
    match line.text.as_bytes().first()? {
        b'[' => Some("a section name without an empty line above"),
        b';' | b'#' => Some("a comment among the keys of a section"),
        _ => Some("a line without `=`"),
    }
}

impl<'t> Entry<'t> {
    fn of(keys: impl Iterator<Item = ((&'t str, &'t str), Place)>) -> Self {
        let mut entry = Self::default();
        for ((key, value), place) in keys {
            let known = match key {
                "ObjectType" => &mut entry.object_type,
                "DataType" => &mut entry.data_type,
                "DefaultValue" => &mut entry.default,
                _ => continue,
            };
            *known = Some((value, place));
        }
        entry
    }
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

fn object<'t>(entry: &Entry<'t>, refusals: &mut Refusals) -> Option<Object<'t>> {
    let Some((text, place)) = entry.object_type else { return Some(Object::Single) };
    match number(text) {
        Some(7) => Some(Object::Single),
        Some(8) => Some(Object::Array(Subs::new(), None)),
        Some(9) => Some(Object::Record(Subs::new())),
        Some(_) => {
            refusals.add(place, Cause::Unknown, "an object type other than VAR, ARRAY and RECORD");
            None
        }
        None => {
            refusals.add(place, Cause::Number, "an object type that is not a number");
            None
        }
    }
}

fn list(keys: &BTreeMap<&str, Value<'_>>, header: Place, refusals: &mut Refusals) {
    if !keys.contains_key("SupportedObjects") {
        refusals.add(header, Cause::Missing, "`SupportedObjects`, spelled so");
    }
    for (value, place) in keys.iter().filter(|(key, _)| **key != "SupportedObjects").map(|(_, item)| item) {
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
