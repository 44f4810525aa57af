//! The keys of an entry.

use od_spec::model::{
    Access, BitErrors, DataType, Dictionary, Entry, Fact, Index, Object, PdoMapping, Role, Storage, SubIndex,
    System, TypeKind, Value,
};

use super::context::Context;
use super::eds;
use super::node::{Item, Node};
use super::texts::{named, one_or_more, open, phrases, words};
use super::types::bits;
use super::value::value;

/// Facts with what is written about them, in the order of a specification.
pub(super) type Keys = Vec<(Fact, Node)>;

/// The keys of an entry that inherits nothing.
pub(super) fn keys(context: &Context<'_>, index: Index, entry: &Entry) -> Keys {
    let mut keys: Keys = vec![(Fact::Name, Node::text(entry.name.clone()))];
    let mut add = |fact, node: Option<Node>| keys.extend(node.map(|node| (fact, node)));
    let (low, high) = entry.limits();
    let limit = |limit: Option<Value>| limit.map(|limit| value(index, entry, &limit));
    add(Fact::Identifier, entry.identifier.clone().map(Node::Text));
    add(Fact::Type, Some(type_node(context, entry)));
    add(Fact::Unit, entry.unit.as_ref().map(|unit| Node::Text(context.unit_name(unit))));
    add(Fact::Access, Some(access(entry)));
    add(Fact::Mapping, (entry.pdo != PdoMapping::None).then(|| Node::plain(entry.pdo.word())));
    add(Fact::Default, default(context, index, entry));
    add(Fact::LowLimit, limit(low));
    add(Fact::HighLimit, limit(high));
    add(Fact::Special, special(context, entry));
    add(Fact::Storage, (entry.stored != Storage::No).then(|| Node::plain(entry.stored.word())));
    add(Fact::Capacity, capacity(entry).map(Node::plain));
    add(Fact::Category, entry.category.map(|category| Node::plain(category.word())));
    add(Fact::Since, entry.since.clone().map(Node::Text));
    add(
        Fact::WriteCondition,
        entry.writable_when.as_ref().map(|condition| Node::text(condition.text.clone())),
    );
    add(Fact::BitErrors, bit_errors(&entry.bit_errors, entry));
    let eds = eds::keys(entry, context.eds);
    add(Fact::Eds, (!eds.is_empty()).then_some(Node::Map(eds)));
    add(Fact::Warning, words(&entry.warning, context.language()));
    add(Fact::About, words(&entry.about, context.language()));
    add(Fact::Gap, open(&entry.about, context.language()));
    add(Fact::Search, phrases(&entry.search));
    keys
}

/// The type by which an entry is known.
pub(super) fn type_node(context: &Context<'_>, entry: &Entry) -> Node {
    match &entry.named_type {
        Some(named) => Node::Text(context.type_name(named)),
        None => Node::plain(entry.data_type.name()),
    }
}

/// `rw`, `rw locked`.
pub(super) fn access(entry: &Entry) -> Node {
    let lock = if entry.locked { " locked" } else { "" };
    Node::Plain(format!("{}{lock}", entry.access.word()))
}

/// The default, unless the device fills it in.
fn default(context: &Context<'_>, index: Index, entry: &Entry) -> Option<Node> {
    let default = entry.default.as_ref()?;
    let filled_in = device_value(context.system, context.device, index, entry.sub);
    (filled_in.as_ref() != Some(default)).then(|| value(index, entry, default))
}

/// What the device fills in where an entry states no value: type, identity and name.
pub(super) fn device_value(
    system: &System,
    device: &Dictionary,
    index: Index,
    sub: SubIndex,
) -> Option<Value> {
    let info = &device.info;
    let number = |number: u32| Some(Value::Integer(number.into()));
    match (index.0, sub.0) {
        (0x1000, 0) => number(info.device_type),
        (0x1018, 1) => number(system.vendor.number),
        (0x1018, 2) => number(info.product),
        (0x1018, 3) => number(info.product_revision),
        (0x1008, 0) => Some(Value::Text(info.product_name.clone())),
        _ => None,
    }
}

/// The capacity of a string, where it does not follow from a constant.
pub(super) fn capacity(entry: &Entry) -> Option<u16> {
    entry.capacity.filter(|_| entry.data_type.is_string() && entry.facts.get(Fact::Capacity).is_some())
}

fn special(context: &Context<'_>, entry: &Entry) -> Option<Node> {
    let pattern = |raw: i128| entry.data_type.is_unsigned() && raw >= 0x1000_0000;
    let items = entry.special.iter().map(|special| {
        let key =
            if pattern(special.value) { format!("0x{:X}", special.value) } else { special.value.to_string() };
        Item::new(key, named(&special.name, Vec::new(), &special.about, context.language()))
    });
    let items: Vec<Item> = items.collect();
    (!items.is_empty()).then_some(Node::Map(items))
}

fn bit_errors(list: &[BitErrors], entry: &Entry) -> Option<Node> {
    let fields = match entry.named_type.as_ref().map(|named| &named.kind) {
        Some(TypeKind::Bits(fields)) => fields.as_slice(),
        Some(TypeKind::Enum(_)) | None => &[],
    };
    let items = list.iter().filter_map(|errors| {
        let field = fields.iter().find(|field| field.first == errors.bit)?;
        let codes = errors.error_codes().map(|code| Node::Plain(format!("0x{code:04X}"))).collect();
        Some(Item::new(bits(field), one_or_more(codes)))
    });
    let items: Vec<Item> = items.collect();
    (!items.is_empty()).then_some(Node::Map(items))
}

/// What sub-index 0 of an array or record says where nothing is stated: the highest sub-index, unless it can change.
pub(super) fn derived_count(object: &Object) -> Option<Value> {
    let is_counted_at_run_time = matches!(object.role(), Role::PdoMapping | Role::ErrorHistory);
    let can_change = object.entries.first().is_some_and(|count| count.access.is_writable());
    (!is_counted_at_run_time && !can_change).then(|| Value::Integer(object.highest().0.into()))
}

/// The keys of sub-index 0 of an array or record, as far as they are not the usual ones.
pub(super) fn sub0(context: &Context<'_>, object: &Object, entry: &Entry) -> Keys {
    let follows = entry.default == derived_count(object);
    let is_written = |fact: Fact| match fact {
        Fact::Name => entry.name != "number of elements",
        Fact::Access => entry.access != Access::Ro || entry.locked,
        Fact::Default => !follows,
        Fact::Identifier
        | Fact::Mapping
        | Fact::LowLimit
        | Fact::HighLimit
        | Fact::Storage
        | Fact::Eds
        | Fact::About => true,
        // It is an UNSIGNED8, and has no other keys.
        _ => false,
    };
    // Its values are not written in a unit, by name or as those of another type, either.
    let mut plain = entry.clone();
    (plain.unit, plain.named_type, plain.data_type) = (None, None, DataType::Unsigned8);
    let keys = keys(context, object.index, &plain);
    keys.into_iter().filter(|(fact, _)| is_written(*fact)).collect()
}
