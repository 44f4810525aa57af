//! The JSON Schema of the parameter files of one device: its entries by name and index, with their units, limits and values.
//!
//! An editor completes and explains with it. What it cannot see is the compiler's: limits of values in units, scales, conditions
//! between entries, and names in other capitals.

mod keys;
mod values;

use super::{Json, SCALARS, any_of, definition, members, object, reference, scalar, text, texts};
use crate::keys::{PARAMETER_FILE, Shape};
use crate::model::{Dictionary, Entry, EntryId, Object, System};
use keys::Spellings;

/// Prints the JSON Schema of the parameter files of a device.
///
/// ```
/// use od_spec::source::SourceMap;
/// use od_spec::{NoFiles, compile, parameter_schema};
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
                    "parameters" => parameters(device),
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
    let entries = settable(device)
        .map(|(id, object, entry)| (name_of(id), values::entry(id, object, entry, device, language)));
    root.push(("definitions", Json::Object(scalars.chain(entries).collect())));
    let mut out = String::new();
    object(root).print(0, &mut out);
    out.push('\n');
    out
}

/// The entries that a parameter file may set: commands are none of them, locked ones are, as they can be unlocked.
fn settable(device: &Dictionary) -> impl Iterator<Item = (EntryId, &Object, &Entry)> {
    device.entries().filter(|(.., entry)| {
        let is_for_tools = entry.eds.access.is_writable() && !entry.eds.no_write;
        entry.access.is_writable() && (entry.locked || is_for_tools) && values::has_values(entry)
    })
}

/// What the definition of an entry is called.
fn name_of(id: EntryId) -> String {
    format!("{:04X}.{}", id.index.0, id.sub)
}

fn bit_rates(device: &Dictionary) -> Json {
    let rates = &device.info.bit_rates;
    let numbers = rates.iter().map(|rate| Json::Number(i128::from(*rate)));
    let words = rates.iter().map(|rate| text(rate.to_string()));
    object([("enum", Json::List(numbers.chain(words).collect()))])
}

/// The entries by name, which an editor completes, and by index in every notation.
fn parameters(device: &Dictionary) -> Json {
    let mut named: Vec<(String, Json)> = Vec::new();
    for object in device.objects.values() {
        let settable: Vec<&Entry> =
            settable(device).filter(|(id, ..)| id.index == object.index).map(|(.., entry)| entry).collect();
        let id = |entry: &Entry| EntryId { index: object.index, sub: entry.sub };
        let mut add = |name: String, schema: Json| {
            if named.iter().all(|(known, _)| *known != name) {
                named.push((name, schema));
            }
        };
        if !object.is_structured() {
            for entry in settable {
                add(object.name.clone(), reference(&name_of(id(entry))));
            }
        } else if !settable.is_empty() {
            add(object.name.clone(), whole(object, &settable));
            for entry in settable {
                add(format!("{}.{}", object.name, entry.name), reference(&name_of(id(entry))));
            }
        }
    }
    let Spellings { exact, patterns } = keys::spellings(device);
    for (key, ids) in exact {
        let of_ids: Vec<Json> = ids.into_iter().map(|of| of.schema(device)).collect();
        named.push((key, any_of(of_ids)));
    }
    let patterns = patterns.into_iter().map(|(pattern, of)| (pattern, of.schema(device)));
    object([
        ("type", texts(["object", "null"])),
        ("properties", Json::Object(named)),
        ("patternProperties", Json::Object(patterns.collect())),
        ("additionalProperties", Json::Bool(false)),
    ])
}

/// An object with values of its entries below it.
fn whole(of: &Object, settable: &[&Entry]) -> Json {
    let mut properties: Vec<(String, Json)> = Vec::new();
    for entry in settable {
        let schema = || reference(&name_of(EntryId { index: of.index, sub: entry.sub }));
        for name in [entry.name.clone(), entry.sub.to_string(), format!("0x{:02X}", entry.sub.0)] {
            if properties.iter().all(|(known, _)| *known != name) {
                properties.push((name, schema()));
            }
        }
    }
    object([
        ("description", text(format!("{} {}, with entries below it", of.index, of.name))),
        ("type", text("object")),
        ("properties", Json::Object(properties)),
        ("additionalProperties", Json::Bool(false)),
    ])
}

/// The locked entries by name, and anything that looks like an index.
fn unlock(device: &Dictionary) -> Json {
    let locked: Vec<EntryId> =
        device.entries().filter(|(.., entry)| entry.locked).map(|(id, ..)| id).collect();
    let names: Vec<String> = locked.iter().filter_map(|id| device.entry_name(*id)).collect();
    let index = object([
        ("type", texts(["string", "integer", "number"])),
        ("pattern", text("^(0[xX])?[0-9A-Fa-f]{4}")),
    ]);
    let items = any_of([object([("enum", texts(names.iter().map(String::as_str)))]), index]);
    object([("type", text("array")), ("items", items)])
}

/// What stands under a key: an entry, or an object as a whole.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Named {
    Entry(EntryId),
    Object(crate::model::Index),
}

impl Named {
    fn schema(self, device: &Dictionary) -> Json {
        match self {
            Named::Entry(id) => reference(&name_of(id)),
            Named::Object(index) => {
                let settable: Vec<&Entry> =
                    settable(device).filter(|(id, ..)| id.index == index).map(|(.., entry)| entry).collect();
                device.objects.get(&index).map_or_else(|| object([]), |object| whole(object, &settable))
            }
        }
    }
}
