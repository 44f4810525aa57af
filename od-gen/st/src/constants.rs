//! Constants of entries, enums and errors.

use od_spec::model::{Entry, EntryId, EnumValue, ErrorCode, Family, NamedType, TypeKind, Value};
use od_spec::wording::Radix;

use super::device::{Device, capitals, number};
use super::elementary::{Elementary, Kind, real};
use super::enums::note_of;
use super::names::Wanted;
use super::phrases::Phrase;
use super::text::{Declaration, Text};

/// Longest text that is a constant: tools have strings of 80 to 254 characters without more ado.
const LONGEST_TEXT: usize = 80;

/// Constants that belong together, with what is said of them all.
pub(super) struct Group {
    about: Vec<String>,
    constants: Vec<Declaration>,
}

impl Group {
    pub(super) fn new(about: Vec<String>, constants: Vec<Declaration>) -> Self {
        Self { about, constants }
    }

    /// The names of the constants.
    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        self.constants.iter().map(|constant| constant.name.as_str())
    }

    pub(super) fn print(&self, text: &mut Text) {
        text.comment(&self.about);
        text.declarations(&self.constants);
    }
}

/// Constants whose names are not given yet.
#[derive(Default)]
struct Wish {
    wanted: Vec<Wanted>,
    declarations: Vec<Declaration>,
}

impl Wish {
    fn add(
        &mut self,
        name: String,
        number: String,
        of_type: impl Into<String>,
        value: String,
        note: impl Into<String>,
    ) {
        self.wanted.push(Wanted::new(name, number));
        self.declarations.push(Declaration::new("", of_type, note).with_value(Some(value)));
    }
}

/// Gives the names of several groups, as of one, so that none depends on the order of the groups.
fn named(device: &mut Device<'_>, groups: Vec<(Vec<String>, Wish)>) -> Vec<Group> {
    let wanted: Vec<Wanted> = groups.iter().flat_map(|(_, wish)| wish.wanted.clone()).collect();
    let mut names = device.scope.give_all(&wanted).into_iter();
    let groups = groups.into_iter().map(|(about, wish)| {
        let constants = wish.declarations.into_iter().zip(names.by_ref());
        Group::new(about, constants.map(|(one, name)| Declaration { name, ..one }).collect())
    });
    groups.collect()
}

/// Index, sub-index, length and type of each entry, its default, limits and special values.
pub(super) fn of_entries(device: &mut Device<'_>) -> Vec<Group> {
    let entries: Vec<_> = device.dictionary.entries().collect();
    let groups = entries
        .into_iter()
        .map(|(id, object, entry)| (device.comment(id, object, entry), of_entry(device, id, entry)));
    let groups = groups.collect();
    named(device, groups)
}

fn of_entry(device: &Device<'_>, id: EntryId, entry: &Entry) -> Wish {
    let mut wish = Wish::default();
    let name = device.name_of(id);
    let mut add = |behind: &str, of_type: String, value: String, note: String| {
        wish.add(capitals(name, behind), number(id), of_type, value, note);
    };
    add("index", "UINT".to_owned(), format!("16#{:04X}", id.index.0), String::new());
    add("sub", "USINT".to_owned(), id.sub.0.to_string(), String::new());
    if let Some(bits) = entry.data_type.bits() {
        add("length", "UDINT".to_owned(), bits.div_ceil(8).to_string(), String::new());
    } else if let Some(capacity) = entry.capacity {
        add("length", "UDINT".to_owned(), capacity.to_string(), "\u{2264}".to_owned());
    }
    add(
        "datatype",
        "UINT".to_owned(),
        format!("16#{:04X}", entry.data_type.code()),
        entry.data_type.to_string(),
    );
    if let Some((of_type, value)) = entry.default.as_ref().and_then(|value| default(device, id, entry, value))
    {
        add("default", of_type, value, String::new());
    }
    let Some(of_type) = Elementary::of(entry) else { return wish };
    let (low, high) = entry.limits();
    for (limit, behind) in [(low, "low"), (high, "high")] {
        if let Some(value) = limit.and_then(|limit| of_entry_literal(id, entry, of_type, &limit, device.node))
        {
            add(behind, of_type.name().to_owned(), value, String::new());
        }
    }
    for special in &entry.special {
        let about = device.text(&special.about);
        let about = if about.is_empty() { String::new() } else { format!("; {about}") };
        let note = device.phrase(Phrase::Special, &[&special.name]) + &about;
        let number = format!("{}_{}", number(id), special.value.unsigned_abs());
        let value = of_type.literal(special.value);
        wish.add(capitals(name, &special.name), number, of_type.name(), value, note);
    }
    wish
}

/// Type and literal of a default; `None` for what no constant can be.
fn default(device: &Device<'_>, id: EntryId, entry: &Entry, value: &Value) -> Option<(String, String)> {
    if let Some(of_type) = Elementary::of(entry) {
        return Some((of_type.name().to_owned(), of_entry_literal(id, entry, of_type, value, device.node)?));
    }
    let Value::Text(text) = value else { return None };
    let is_plain = text.len() <= LONGEST_TEXT && text.bytes().all(|byte| matches!(byte, b' '..=b'~'));
    if entry.data_type.family() != Family::VisibleString || !is_plain || text.is_empty() {
        return None;
    }
    let quoted = text.replace('$', "$$").replace('\'', "$'");
    Some((format!("STRING[{}]", text.len()), format!("'{quoted}'")))
}

/// The literal of a raw value; `None` where it depends on a node that is not known.
pub(super) fn literal(of_type: Elementary, value: &Value, node: Option<u8>) -> Option<String> {
    match value {
        Value::Integer(_) | Value::NodeId(_) => raw(value, node).map(|raw| of_type.literal(raw)),
        Value::Real(number) => Some(real(number.number())),
        Value::Text(_) | Value::Bytes(_) => None,
    }
}

/// The literal of an entry's raw value: in hexadecimal, where its numbers are not used in decimal, such as a COB-ID.
fn of_entry_literal(
    id: EntryId,
    entry: &Entry,
    of_type: Elementary,
    value: &Value,
    node: Option<u8>,
) -> Option<String> {
    match (Radix::of(Some(id.index), entry), of_type.kind()) {
        (Radix::Hexadecimal, Kind::Unsigned) => raw(value, node).map(|raw| format!("16#{raw:08X}")),
        (Radix::Hexadecimal | Radix::Decimal, _) => literal(of_type, value, node),
    }
}

/// The raw value, where it is a whole number and depends on no node that is not known.
pub(super) fn raw(value: &Value, node: Option<u8>) -> Option<i128> {
    match value {
        Value::NodeId(_) => value.integer_for(node?),
        Value::Integer(_) | Value::Real(_) | Value::Text(_) | Value::Bytes(_) => value.integer(),
    }
}

/// The values of the enums that entries have.
pub(super) fn of_enums(device: &mut Device<'_>) -> Vec<Group> {
    let groups = device.types().into_iter().filter_map(|named| {
        let TypeKind::Enum(values) = &named.kind else { return None };
        let of_type = Elementary::of_type(named.base)?;
        let about =
            vec![device.phrase(Phrase::ValuesOf, &[&named.name]), device.text(&named.about).to_owned()];
        Some((about, of_enum(device, named, of_type, values)))
    });
    let groups = groups.collect();
    named(device, groups)
}

fn of_enum(device: &Device<'_>, named: &NamedType, of_type: Elementary, values: &[EnumValue]) -> Wish {
    let mut wish = Wish::default();
    for value in values {
        let name = capitals(device.name_of_type(named), &value.name);
        let sign = if value.value < 0 { "m" } else { "" };
        let number = format!("{sign}{}", value.value.unsigned_abs());
        wish.add(name, number, of_type.name(), of_type.literal(value.value), note_of(device, value));
    }
    wish
}

/// The error codes that the device reports.
pub(super) fn of_errors(device: &mut Device<'_>) -> Option<Group> {
    let key = device.dictionary.key.as_str();
    let errors: Vec<&ErrorCode> =
        device.system.errors.iter().filter(|error| error.devices.includes(key)).collect();
    if errors.is_empty() {
        return None;
    }
    let mut wish = Wish::default();
    for error in errors {
        let name = capitals(&device.prefixed("error"), &error.name);
        let mut notes = vec![error.name.clone()];
        notes.extend([device.text(&error.reaction), device.text(&error.about)].map(str::to_owned));
        notes.retain(|note| !note.is_empty());
        let code = format!("{:04X}", error.code);
        wish.add(name, code.clone(), "UINT", format!("16#{code}"), notes.join("; "));
    }
    let about = vec![device.phrase(Phrase::ErrorCodes, &[])];
    named(device, vec![(about, wish)]).pop()
}
