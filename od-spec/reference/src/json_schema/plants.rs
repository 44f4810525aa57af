//! The JSON Schema of plant files: of any, or of those with certain devices, whose entries it then knows.

use super::{
    Json, SCALARS, any_of, definition, key_pattern, members, object, parameters, printed,
    reachable_in_plants, reference, scalar, schema, slug, text,
};
use od_spec::keys::{KeyKind, Keys, PLANT, PLANT_NODE, Shape};
use od_spec::model::{Dictionary, System};

/// Prints the JSON Schema of plant files. Which entries a device has, it does not know.
pub fn plant_schema() -> String {
    let mut root = head("CANopen plant (od-plant)");
    root.extend(members(&PLANT));
    let tables = reachable_in_plants().into_iter().skip(1);
    let tables = tables.map(|keys| (slug(keys.name), object(members(keys))));
    root.push(("definitions", Json::Object(tables.chain(scalars()).collect())));
    printed(root)
}

/// Prints the JSON Schema of plant files with these devices, each by its key in the plant: which entries each has, with their
/// units, limits and meanings, as [`parameter_schema`](super::parameter_schema) does.
///
/// ```
/// use od_spec::source::SourceMap;
/// use od_reference::plant_schema_of;
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
/// let schema = plant_schema_of(&[("hall-lamp", &system, &system.devices[0])]);
/// assert!(schema.contains("\"$ref\": \"#/definitions/hall-lamp:2000.0\""));
/// ```
pub fn plant_schema_of(devices: &[(&str, &System, &Dictionary)]) -> String {
    let keys: Vec<&str> = devices.iter().map(|(key, ..)| *key).collect();
    let mut root = head(&format!("CANopen plant (od-plant) of {}", keys.join(", ")));
    root.extend(of_devices(&PLANT, &keys));
    let tables = reachable_in_plants().into_iter().skip(1).filter(|table| table.name != PLANT_NODE.name);
    let tables = tables.map(|table| (slug(table.name), object(of_devices(table, &keys))));
    let mut definitions: Vec<(String, Json)> = tables.chain(scalars()).collect();
    for (key, system, device) in devices {
        definitions.push((part(key, PARAMETERS), parameters::parameters(&part(key, ""), device)));
        definitions.push((part(key, UNLOCK), parameters::unlock(device)));
        definitions.push((part(key, NODE), object(of_node(key))));
        definitions.extend(parameters::definitions(&part(key, ""), device, system.language()));
    }
    root.push(("definitions", Json::Object(definitions)));
    printed(root)
}

/// The keys that hold what devices have.
const PARAMETERS: &str = "parameters";
const UNLOCK: &str = "unlock";
const POSITIONS: &str = "positions";
/// What a device at a position is called among the definitions.
const NODE: &str = "node";

/// A definition of one device. No other definition has a colon in its name.
fn part(key: &str, of: &str) -> String {
    format!("{key}:{of}")
}

fn head(title: &str) -> Vec<(&'static str, Json)> {
    vec![("$schema", text("http://json-schema.org/draft-07/schema#")), ("title", text(title))]
}

fn scalars() -> impl Iterator<Item = (String, Json)> {
    SCALARS.iter().filter_map(|shape| Some((definition(*shape)?.to_owned(), scalar(*shape))))
}

/// The members of a table, in which what is said by device is said of these.
fn of_devices(table: &Keys, keys: &[&str]) -> Vec<(&'static str, Json)> {
    replaced(table, |name| match name {
        PARAMETERS | UNLOCK => Some(by_device(keys, |key| reference(&part(key, name)))),
        POSITIONS => {
            // A node-ID, or all keys of a node.
            let node = |key: &str| any_of([schema(Shape::Integer(1, 127)), reference(&part(key, NODE))]);
            let place = key_pattern(KeyKind::Place).unwrap_or_default();
            Some(object([
                ("type", text("object")),
                ("patternProperties", object([(format!("^{place}$").as_str(), by_device(keys, node))])),
                ("additionalProperties", Json::Bool(false)),
            ]))
        }
        _ => None,
    })
}

/// The members of a node of one device.
fn of_node(key: &str) -> Vec<(&'static str, Json)> {
    replaced(&PLANT_NODE, |name| matches!(name, PARAMETERS | UNLOCK).then(|| reference(&part(key, name))))
}

/// A map by device.
fn by_device(keys: &[&str], of: impl Fn(&str) -> Json) -> Json {
    object([
        ("type", super::texts(["object", "null"])),
        ("properties", object(keys.iter().map(|key| (*key, of(key))))),
        ("additionalProperties", Json::Bool(false)),
    ])
}

/// The members of a table with other values of some keys; what editors show about a key stays.
fn replaced(table: &Keys, value: impl Fn(&str) -> Option<Json>) -> Vec<(&'static str, Json)> {
    let mut members = members(table);
    for (name, member) in &mut members {
        let ("properties", Json::Object(properties)) = (*name, member) else { continue };
        for (key, schema) in properties {
            if let (Some(known), Some(value)) = (table.get(key), value(key)) {
                // What is next to `$ref` is not looked at.
                *schema = object([("description", text(known.about)), ("allOf", Json::List(vec![value]))]);
            }
        }
    }
    members
}
