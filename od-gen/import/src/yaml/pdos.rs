//! `pdos:`: PDOs of which the parameter objects are made.

use std::collections::{BTreeMap, BTreeSet};

use od_spec::model::{DataType, Direction, EntryId, Index, Pdo, PdoTarget, SubIndex, Value};

use super::context::Context;
use super::node::{Item, Node};
use super::pdo_obstacles::obstacle;
use super::pdo_parameters::{self, Parameters};
use super::scalar::spelled;
use super::texts::described;

/// The PDOs that are under `pdos:`; the parameter objects of any other are written in full.
pub(super) fn short<'a>(context: &Context<'a>) -> Vec<&'a Pdo> {
    if !context.style.short {
        return Vec::new();
    }
    let in_full = |pdo: &Pdo| context.style.pdos_in_full.contains(&(pdo.direction, pdo.number));
    let pdos = context.device.pdos.iter().filter(|pdo| !in_full(pdo));
    pdos.filter(|pdo| obstacle(context.device, pdo).is_none()).collect()
}

/// The value of `pdos:`.
pub(super) fn items(context: &Context<'_>, pdos: &[&Pdo]) -> Vec<Item> {
    let names = Names::of(context, pdos);
    let (mut parameters, mut directions) = (Vec::new(), Vec::new());
    for direction in [Direction::Receive, Direction::Transmit] {
        let of: Vec<&Pdo> = pdos.iter().copied().filter(|pdo| pdo.direction == direction).collect();
        if of.is_empty() {
            continue;
        }
        let Parameters { common, mut own } = pdo_parameters::of(context, direction, &of);
        if !common.is_empty() {
            parameters.push(Item::new(direction.word(), Node::Block(common)));
        }
        let mut own = |pdo: &Pdo| own.remove(&pdo.number).unwrap_or_default();
        let items = of.iter().map(|pdo| item(context, &names, pdo, own(pdo)));
        directions.push(Item::new(direction.word(), Node::Block(items.collect())));
    }
    if directions.is_empty() {
        return Vec::new();
    }
    let mut items = Vec::new();
    let stored = pdo_parameters::stored(context, pdos);
    items.extend(stored.map(|storage| Item::new("stored", Node::plain(storage.word()))));
    if !parameters.is_empty() {
        items.push(Item::new("parameters", Node::Block(parameters)));
    }
    items.extend(directions);
    vec![Item::new(context.device.key.clone(), Node::Block(items))]
}

fn item(context: &Context<'_>, names: &Names, pdo: &Pdo, parameters: Vec<Item>) -> Item {
    let mut items = Vec::new();
    let flag = |bit: u32| {
        pdo.cob_id.as_ref().and_then(|id| id.integer_for(0)).is_some_and(|raw| raw >> bit & 1 == 1)
    };
    let cob_id = pdo.cob_id.as_ref().map(without_flags).filter(|id| Some(id) != usual_cob_id(pdo).as_ref());
    items.extend(cob_id.map(|id| Item::new("cob-id", id_node(&id))));
    if flag(31) {
        items.push(Item::new("valid", Node::yes_no(false)));
    }
    if flag(30) {
        items.push(Item::new("no-rtr", Node::yes_no(true)));
    }
    let numbers = [
        ("transmission", pdo.transmission.filter(|transmission| *transmission != 255).map(u16::from)),
        ("inhibit-time", pdo.inhibit_time),
        ("event-timer", pdo.event_timer),
        ("sync-start", pdo.sync_start.map(u16::from)),
    ];
    for (key, number) in numbers {
        items.extend(number.map(|number| Item::new(key, Node::plain(number))));
    }
    if !pdo.variable_mapping {
        items.push(Item::new("mapping", Node::plain("fixed")));
    } else if pdo.capacity != 64 / context.device.info.granularity.max(1) {
        items.push(Item::new("capacity", Node::plain(pdo.capacity)));
    }
    let map = pdo.map.iter().map(|mapped| match mapped.target {
        PdoTarget::Entry(id) => names.node(id),
        PdoTarget::Dummy(data_type) => Node::plain(data_type.name()),
    });
    items.push(Item::new("map", Node::List(map.collect())));
    if !parameters.is_empty() {
        items.push(Item::new("parameters", Node::Map(parameters)));
    }
    items.extend(described(&pdo.about, context.language()));
    let above = [pdo.communication_index(), pdo.mapping_index()].map(Index);
    let above = above.into_iter().flat_map(|index| comments(context, index)).collect();
    Item { above, ..Item::new(pdo.number.to_string(), Node::Map(items)) }
}

/// What is to be said about a parameter object that is not written.
fn comments(context: &Context<'_>, index: Index) -> Vec<String> {
    let named =
        |place: String, lines: Vec<String>| lines.into_iter().map(move |line| format!("{place}: {line}"));
    let mut lines: Vec<String> = named(index.to_string(), context.above_object(index)).collect();
    for entry in context.device.objects.get(&index).iter().flat_map(|object| &object.entries) {
        let id = EntryId { index, sub: entry.sub };
        lines.extend(named(id.to_string(), context.above_entry(id)));
    }
    lines
}

/// Bits 31 and 30 have keys of their own.
const FLAGS: u32 = 0b11 << 30;

fn without_flags(id: &Value) -> Value {
    match id {
        Value::NodeId(offset) => Value::NodeId(offset & !u64::from(FLAGS)),
        Value::Integer(raw) => Value::Integer(raw & !i128::from(FLAGS)),
        Value::Real(_) | Value::Text(_) | Value::Bytes(_) => id.clone(),
    }
}

/// The COB-ID that a PDO has without `cob-id:`.
fn usual_cob_id(pdo: &Pdo) -> Option<Value> {
    let base = match pdo.direction {
        Direction::Receive => 0x200,
        Direction::Transmit => 0x180,
    };
    match pdo.number {
        1..=4 => Some(Value::NodeId(base + 0x100 * u64::from(pdo.number - 1))),
        _ if !pdo.valid => Some(Value::Integer(0)),
        _ => None,
    }
}

fn id_node(id: &Value) -> Node {
    match id {
        Value::NodeId(0) => Node::plain("$NODEID"),
        Value::NodeId(offset) => Node::Plain(format!("$NODEID + 0x{offset:X}")),
        Value::Integer(raw) => super::value::hex(*raw),
        // No COB-ID is one of these.
        Value::Real(_) | Value::Text(_) | Value::Bytes(_) => Node::plain(0),
    }
}

/// How entries are referred to.
struct Names {
    by_id: BTreeMap<EntryId, String>,
}

impl Names {
    /// The names that mean one entry only, and need no quotes.
    fn of(context: &Context<'_>, pdos: &[&Pdo]) -> Self {
        let is_made = |index: u16| {
            pdos.iter().any(|pdo| [pdo.communication_index(), pdo.mapping_index()].contains(&index))
        };
        let mut ids: BTreeMap<String, BTreeSet<EntryId>> = BTreeMap::new();
        for object in context.device.objects.values().filter(|object| !is_made(object.index.0)) {
            let mut add = |text: String, sub| {
                ids.entry(text).or_default().insert(EntryId { index: object.index, sub });
            };
            for name in [&object.name, object.label()] {
                add(name.to_owned(), SubIndex(0));
            }
            for entry in object.entries.iter().filter(|_| object.is_structured()) {
                add(format!("{}.{}", object.name, entry.name), entry.sub);
                add(format!("{}.{}", object.label(), entry.label()), entry.sub);
            }
        }
        let looks_like_index = |name: &str| {
            name.starts_with("0x")
                || name.starts_with("0X")
                || name.bytes().all(|b| b.is_ascii_digit() || matches!(b, b'.' | b'_'))
        };
        let is_plain = |name: &str| {
            name.chars().count() <= 60
                && spelled(name) == name
                && !looks_like_index(name)
                && DataType::from_name(name).is_none()
        };
        let named = |text: &String| ids.get(text).filter(|ids| ids.len() == 1 && is_plain(text));
        let mut by_id = BTreeMap::new();
        for (id, ..) in context.device.entries() {
            let called = [context.device.entry_name(id), context.device.entry_label(id)];
            let text =
                called.into_iter().flatten().find(|text| named(text).is_some_and(|ids| ids.contains(&id)));
            by_id.extend(text.map(|text| (id, text)));
        }
        Self { by_id }
    }

    fn node(&self, id: EntryId) -> Node {
        match self.by_id.get(&id) {
            Some(name) => Node::text(name.clone()),
            None => Node::Plain(id.notation()),
        }
    }
}
