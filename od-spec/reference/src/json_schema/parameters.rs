//! The JSON Schema of the parameter files of one device: its entries by name and index, with their units, limits and values.
//!
//! An editor completes and explains with it. What it cannot see is the compiler's: limits of values in units, scales, conditions
//! between entries, and names in another case.

mod keys;
mod values;

use std::collections::{BTreeMap, BTreeSet};

use super::{Json, SCALARS, any_of, definition, members, object, printed, reference, scalar, text, texts};
use keys::Spellings;
use od_spec::keys::{PARAMETER_FILE, Shape};
use od_spec::model::{Dictionary, Entry, EntryId, Index, Object, System};

/// Prints the JSON Schema of the parameter files of a device.
///
/// ```
/// use od_spec::source::SourceMap;
/// use od_reference::parameter_schema;
/// use od_spec::{NoFiles, compile};
///
/// let mut sources = SourceMap::new();
/// let root = sources.add("lamp.od.yaml", "
/// od-spec: 1
/// title: Lamp
/// uses: [cia301]
/// devices:
///   lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer]}
/// objects:
///   0x2000: {name: brightness, type: unsigned8, access: rw, default: 80, max: 100}
/// ");
/// let system = compile(&mut sources, root, &mut NoFiles).system.expect("no errors");
/// let schema = parameter_schema(&system, &system.devices[0]);
/// assert!(schema.contains("\"maximum\": 100"));
/// ```
pub fn parameter_schema(system: &System, device: &Dictionary) -> String {
    let language = system.language();
    let mut root = vec![
        ("$schema", text("http://json-schema.org/draft-07/schema#")),
        ("title", text(format!("Parameters of {} ({})", device.name, device.key))),
    ];
    root.extend(members(&PARAMETER_FILE));
    for (name, member) in &mut root {
        if let ("properties", Json::Object(properties)) = (*name, member) {
            for (key, schema) in properties {
                let of_device = match key.as_str() {
                    "device" => object([("enum", texts([device.key.as_str()]))]),
                    "bit-rate" => bit_rates(device),
                    "parameters" => parameters(ALONE, device),
                    "unlock" => unlock(device),
                    _ => continue,
                };
                if let (Some(key), Json::Object(of_device)) = (PARAMETER_FILE.get(key), of_device) {
                    let about = ("description".to_owned(), text(key.about));
                    *schema = Json::Object(std::iter::once(about).chain(of_device).collect());
                }
            }
        }
    }
    let used = [Shape::Text, Shape::HeaderText, Shape::Words, Shape::Value];
    let is_used = |shape: &Shape| used.iter().any(|used| definition(*used) == definition(*shape));
    let scalars = SCALARS.iter().filter(|shape| is_used(shape));
    let scalars = scalars.filter_map(|shape| Some((definition(*shape)?.to_owned(), scalar(*shape))));
    let entries = definitions(ALONE, device, language);
    root.push(("definitions", Json::Object(scalars.chain(entries).collect())));
    printed(root)
}

/// A definition of an entry for each that may be set. Where a schema has several devices, `of` distinguishes them.
pub(super) fn definitions(of: &str, device: &Dictionary, language: &str) -> Vec<(String, Json)> {
    let entries = settable(device)
        .map(|(id, object, entry)| (name_of(of, id), values::entry(id, object, entry, device, language)));
    entries.collect()
}

/// What definitions begin with in the schema of one device.
const ALONE: &str = "";

/// The entries that a parameter file may set: commands are not among them, locked ones are, as they can be unlocked.
fn settable(device: &Dictionary) -> impl Iterator<Item = (EntryId, &Object, &Entry)> {
    device.entries().filter(|(.., entry)| {
        let is_for_tools = entry.eds.access.is_writable() && !entry.eds.no_write;
        entry.access.is_writable() && (entry.locked || is_for_tools) && values::has_values(entry)
    })
}

/// The entries that may be set, by object.
type ByObject<'a> = BTreeMap<Index, Vec<&'a Entry>>;

fn by_object(device: &Dictionary) -> ByObject<'_> {
    let mut by_object = ByObject::new();
    for (id, _, entry) in settable(device) {
        by_object.entry(id.index).or_default().push(entry);
    }
    by_object
}

/// Members of a JSON object: of one name, the first.
#[derive(Default)]
struct Members {
    list: Vec<(String, Json)>,
    names: BTreeSet<String>,
}

impl Members {
    fn add(&mut self, name: String, schema: Json) {
        if self.names.insert(name.clone()) {
            self.list.push((name, schema));
        }
    }
}

/// What the definition of an entry is called.
fn name_of(of: &str, id: EntryId) -> String {
    format!("{of}{:04X}.{}", id.index.0, id.sub)
}

fn bit_rates(device: &Dictionary) -> Json {
    let rates = &device.info.bit_rates;
    let numbers = rates.iter().map(|rate| Json::Number(i128::from(*rate)));
    let words = rates.iter().map(|rate| text(rate.to_string()));
    object([("enum", Json::List(numbers.chain(words).collect()))])
}

/// The entries by name, which an editor completes, and by index in every notation.
pub(super) fn parameters(of: &str, device: &Dictionary) -> Json {
    let mut named = Members::default();
    let settable = by_object(device);
    for (index, entries) in &settable {
        let Some(object) = device.objects.get(index) else { continue };
        let of_entry = |entry: &Entry| reference(&name_of(of, EntryId { index: *index, sub: entry.sub }));
        if !object.is_structured() {
            for entry in entries {
                named.add(object.name.clone(), of_entry(entry));
                named.add(object.label().to_owned(), of_entry(entry));
            }
            continue;
        }
        named.add(object.name.clone(), whole(of, object, entries));
        named.add(object.label().to_owned(), whole(of, object, entries));
        for entry in entries {
            named.add(format!("{}.{}", object.name, entry.name), of_entry(entry));
            named.add(format!("{}.{}", object.label(), entry.label()), of_entry(entry));
        }
    }
    let Spellings { exact, patterns } = keys::spellings(device);
    for (key, ids) in exact {
        let of_ids: Vec<Json> = ids.into_iter().map(|named| named.schema(of, device, &settable)).collect();
        named.add(key, any_of(of_ids));
    }
    let patterns =
        patterns.into_iter().map(|(pattern, named)| (pattern, named.schema(of, device, &settable)));
    object([
        ("type", texts(["object", "null"])),
        ("properties", Json::Object(named.list)),
        ("patternProperties", Json::Object(patterns.collect())),
        ("additionalProperties", Json::Bool(false)),
    ])
}

/// An object with values of its entries below it.
fn whole(of: &str, whole: &Object, settable: &[&Entry]) -> Json {
    let mut properties = Members::default();
    for entry in settable {
        let schema = || reference(&name_of(of, EntryId { index: whole.index, sub: entry.sub }));
        let texts = [&entry.name, entry.label()].map(ToOwned::to_owned);
        let numbers = [entry.sub.to_string(), format!("0x{:02X}", entry.sub.0)];
        for name in texts.into_iter().chain(numbers) {
            properties.add(name, schema());
        }
    }
    object([
        ("description", text(format!("{} {}, with entries below it", whole.index, whole.name))),
        ("type", text("object")),
        ("properties", Json::Object(properties.list)),
        ("additionalProperties", Json::Bool(false)),
    ])
}

/// The locked entries by name, and anything that looks like an index.
pub(super) fn unlock(device: &Dictionary) -> Json {
    let locked: Vec<EntryId> =
        device.entries().filter(|(.., entry)| entry.locked).map(|(id, ..)| id).collect();
    let mut names: Vec<String> = locked.iter().filter_map(|id| device.entry_name(*id)).collect();
    let labels: Vec<String> = locked.iter().filter_map(|id| device.entry_label(*id)).collect();
    names.extend(labels.into_iter().filter(|label| !names.contains(label)).collect::<Vec<_>>());
    let index = object([
        ("type", texts(["string", "integer", "number"])),
        ("pattern", text("^(0[xX])?[0-9A-Fa-f]{4}")),
    ]);
    let items = any_of([object([("enum", texts(names.iter().map(String::as_str)))]), index]);
    object([("type", text("array")), ("items", items)])
}

/// What is under a key: an entry, or an object as a whole.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Named {
    Entry(EntryId),
    Object(Index),
}

impl Named {
    fn schema(self, of: &str, device: &Dictionary, settable: &ByObject<'_>) -> Json {
        match self {
            Named::Entry(id) => reference(&name_of(of, id)),
            Named::Object(index) => {
                let object = device.objects.get(&index).zip(settable.get(&index));
                object.map_or_else(|| super::object([]), |(object, entries)| whole(of, object, entries))
            }
        }
    }
}
