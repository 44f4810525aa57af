//! The text of a parameter file.

use std::fmt::Write as _;

use od_spec::keys::PARAMETERS_VERSION;
use od_spec::model::{BitField, Dictionary, Entry, EntryId, Index, Object, Storage, TypeKind, Value};
use od_spec::source::SourceMap;
use od_spec::wording::{Notation, Wording, allowed};
use od_spec::{Commissioning, SettingNames, parameter_file};

use super::About;
use crate::yaml::{Item, Node, spelled, value, written};

const WORDING: Wording = Wording::english(Notation::Diagnostic);

/// The whole file.
pub(super) fn text(
    about: About<'_>,
    node: &Commissioning,
    left_out: &[String],
    findings: &[String],
) -> String {
    let device = about.device;
    let names = SettingNames::of(device);
    let mut items = vec![Item::new(PARAMETERS_VERSION, Node::plain(1))];
    if about.names_device {
        items.push(Item::new("device", Node::text(device.key.clone())));
    }
    items.extend(about.node_id.map(|id| Item::new("node", Node::plain(id))));
    // One that the device does not support is said below.
    if device.info.bit_rates.contains(&node.bit_rate) {
        items.push(Item::new("bit-rate", Node::plain(node.bit_rate)));
    }
    let usual = Commissioning::of_node(device, node.node);
    if node.node_name != usual.node_name {
        items.push(Item::new("node-name", Node::text(node.node_name.clone())));
    }
    if node.net_number != usual.net_number {
        items.push(Item::new("net-number", Node::plain(node.net_number)));
    }
    if node.net_name != usual.net_name {
        items.push(Item::new("net-name", Node::text(node.net_name.clone())));
    }
    if let Some(number) = node.serial_number {
        items.push(Item::new("serial-number", Node::hex32(number)));
    }
    let parameters = parameters(device, &names, node);
    if !parameters.is_empty() {
        items.push(Item::new("parameters", Node::Block(parameters)));
    }
    let locked: Vec<Node> = node.unlocked.iter().map(|id| Node::text(name(device, &names, *id))).collect();
    if !locked.is_empty() {
        let mut unlock = Item::new("unlock", Node::List(locked));
        unlock.above.push(
            "Factory data: the device takes these only while it is unlocked for service. Remove what is not meant."
                .to_owned(),
        );
        items.push(unlock);
    }
    let mut text = written(&items);
    for (title, lines) in [
        ("What this file cannot say, or does not take over:", left_out),
        ("What is wrong with the values:", findings),
    ] {
        if lines.is_empty() {
            continue;
        }
        let _ = writeln!(text, "\n# {title}");
        for line in lines {
            let _ = writeln!(text, "# - {}", one_line(line));
        }
    }
    text
}

/// A comment ends with its line.
fn one_line(text: &str) -> String {
    od_spec::visible::visible(&text.replace(['\n', '\r', '\t'], " ")).into_owned()
}

/// The values by object, in the order of the dictionary.
fn parameters(device: &Dictionary, names: &SettingNames<'_>, node: &Commissioning) -> Vec<Item> {
    let mut items = Vec::new();
    for object in device.objects.values() {
        let id = |entry: &Entry| EntryId { index: object.index, sub: entry.sub };
        let set: Vec<(EntryId, &Entry, &Value)> = object
            .entries
            .iter()
            .filter_map(|entry| Some((id(entry), entry, node.values.get(&id(entry))?)))
            .collect();
        if set.is_empty() {
            continue;
        }
        if object.is_structured() {
            let below =
                set.iter().map(|(id, entry, value)| below(names, object, *id, entry, value, node.node));
            let key = object_key(names, object);
            items.push(Item::new(key, Node::Block(below.collect())));
        } else {
            items.extend(
                set.iter().map(|(id, entry, value)| alone(names, object, *id, entry, value, node.node)),
            );
        }
    }
    items
}

/// An entry that is its object.
fn alone(
    names: &SettingNames<'_>,
    object: &Object,
    id: EntryId,
    entry: &Entry,
    set: &Value,
    node: u8,
) -> Item {
    let by_index = id.index.notation();
    let keys = [spelled(&object.name), spelled(object.label()), by_index];
    let ways = ways(id, entry, set);
    let found = pairs(&keys, &ways).find(|(key, way)| reads(names, node, key, way, None, id, set));
    item(found.unwrap_or_else(|| (keys[2].clone(), raw(set))), id, entry)
}

/// An entry below its object.
fn below(
    names: &SettingNames<'_>,
    object: &Object,
    id: EntryId,
    entry: &Entry,
    set: &Value,
    node: u8,
) -> Item {
    let key_of_object = object_key(names, object);
    let keys = [spelled(&entry.name), spelled(entry.label()), id.sub.to_string()];
    let ways = ways(id, entry, set);
    let found =
        pairs(&keys, &ways).find(|(key, way)| reads(names, node, key, way, Some(&key_of_object), id, set));
    item(found.unwrap_or_else(|| (keys[2].clone(), raw(set))), id, entry)
}

/// Every key with every way to write the value, the nicest first.
fn pairs<'a>(keys: &'a [String], ways: &'a [Node]) -> impl Iterator<Item = (String, Node)> + 'a {
    keys.iter().flat_map(move |key| ways.iter().map(move |way| (key.clone(), way.clone())))
}

/// The key of an object: its name or identifier, where that names this object.
fn object_key(names: &SettingNames<'_>, object: &Object) -> String {
    let label =
        [&object.name, object.label()].into_iter().find(|text| names.object(text) == Some(object.index));
    label.map_or_else(|| object.index.notation(), spelled)
}

/// What a file is read as.
fn read(names: &SettingNames<'_>, node: u8, text: &str) -> Vec<(EntryId, Value)> {
    let mut sources = SourceMap::new();
    let file = sources.add("parameters", text);
    let read = parameter_file(&sources, file, &mut od_spec::diag::Diagnostics::new());
    read.map(|file| names.read(node, &file.layer.settings)).unwrap_or_default()
}

/// Whether a key with a value is read as what is meant.
fn reads(
    names: &SettingNames<'_>,
    node: u8,
    key: &str,
    way: &Node,
    object: Option<&str>,
    id: EntryId,
    set: &Value,
) -> bool {
    let one = Item::new(key, way.clone());
    let below = match object {
        Some(object) => Node::Block(vec![Item::new(object, Node::Block(vec![one]))]),
        None => Node::Block(vec![one]),
    };
    let text = written(&[Item::new(PARAMETERS_VERSION, Node::plain(1)), Item::new("parameters", below)]);
    read(names, node, &text) == [(id, set.clone())]
}

/// The ways to write a value, the nicest first.
fn ways(id: EntryId, entry: &Entry, set: &Value) -> Vec<Node> {
    let bits = match (entry.named_type.as_ref().map(|named| &named.kind), set) {
        (Some(TypeKind::Bits(fields)), Value::Integer(raw)) => bits(fields, *raw, entry),
        _ => None,
    };
    let special = entry.special.iter().find(|special| set.integer() == Some(special.value));
    let special = special.map(|special| Node::plain(special.value));
    consumer(id, set)
        .into_iter()
        .chain(special)
        .chain(bits)
        .chain([value(id.index, entry, set), raw(set)])
        .collect()
}

/// A heartbeat consumer by node and time; another object's entry is not read from it.
fn consumer(id: EntryId, set: &Value) -> Option<Node> {
    let raw = set.integer().filter(|raw| id.index == Index(0x1016) && *raw > 0)?;
    let (node, time) = (raw >> 16, raw & 0xFFFF);
    let time = Node::Plain(format!("{time} ms"));
    Some(Node::Map(vec![Item::new("node", Node::plain(node)), Item::new("time", time)]))
}

/// A value as every reader takes it.
fn raw(set: &Value) -> Node {
    match set {
        Value::Integer(raw) => Node::plain(raw),
        Value::NodeId(offset) => Node::Plain(format!("$NODEID + 0x{offset:X}")),
        Value::Real(real) => Node::Plain(format!("{:?}", real.number())),
        Value::Text(text) => Node::text(text.clone()),
        Value::Bytes(bytes) => {
            let pairs: Vec<String> = bytes.iter().map(|byte| format!("{byte:02X}")).collect();
            Node::text(pairs.concat())
        }
    }
}

/// The bits that are 1, by name; `None` where one of them has none, or none is 1.
fn bits(fields: &[BitField], raw: i128, entry: &Entry) -> Option<Node> {
    let width = entry.data_type.bits()?;
    let pattern = raw.rem_euclid(1i128.checked_shl(u32::from(width))?);
    let mut left = pattern;
    let mut list = Vec::new();
    for field in fields {
        let highest = (1i128 << (field.last - field.first + 1)) - 1;
        let of_field = (pattern >> field.first) & highest;
        if of_field == 0 {
            continue;
        }
        left &= !(highest << field.first);
        if field.name.is_empty() {
            return None;
        }
        list.push(if field.first == field.last {
            Node::text(field.name.clone())
        } else {
            let named = field.values.iter().find(|value| value.value == of_field);
            let value = named.map_or_else(|| Node::plain(of_field), |value| Node::text(value.name.clone()));
            Node::Map(vec![Item::new(spelled(&field.name), value)])
        });
    }
    (left == 0 && !list.is_empty()).then_some(Node::List(list))
}

/// A line with what a person has to know to change it.
fn item((key, way): (String, Node), id: EntryId, entry: &Entry) -> Item {
    let mut facts = vec![id.to_string()];
    let is_listed = matches!(
        entry.named_type.as_ref().map(|named| &named.kind),
        Some(TypeKind::Enum(_) | TypeKind::Bits(_))
    );
    if entry.data_type.range().is_some() && !is_listed || entry.is_limited() {
        facts.push(allowed(entry));
    }
    facts.extend(entry.special.iter().map(|special| WORDING.special(entry, special)));
    if let Some(default) = &entry.default {
        facts.push(format!("default {}", WORDING.value(Some(id.index), entry, default)));
    }
    if entry.locked {
        facts.push("LOCKED".to_owned());
    } else if entry.stored != Storage::No {
        facts.push(WORDING.storage(entry.stored).to_owned());
    }
    let mut item = Item::new(key, way);
    item.above.push(one_line(&facts.join("; ")));
    item
}

/// How a person names an entry, if that is clear; else its index.
fn name(device: &Dictionary, names: &SettingNames<'_>, id: EntryId) -> String {
    let called = [device.entry_name(id), device.entry_label(id)];
    let name = called.into_iter().flatten().find(|name| names.entry(name) == Some(id));
    name.unwrap_or_else(|| format!("{:04X}.{}", id.index.0, id.sub))
}
