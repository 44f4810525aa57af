//! Objects in full: VARs on a line, arrays with what their elements have in common, records by their members.

use od_spec::model::{Entry, EntryId, Fact, Index, Object, ObjectKind};
use od_spec::order::Arrange as _;

use super::context::Context;
use super::entry::{self, Keys};
use super::fold::{self, Folded};
use super::node::{Item, Node, Spot};

/// `0x2000`.
pub(super) fn key(index: Index) -> String {
    index.notation()
}

/// An object with everything that the model says about it.
pub(super) fn in_full(context: &Context<'_>, object: &Object) -> Item {
    let mut above = context.above_object(object.index);
    let fold = context.style.short;
    let items = match object.kind {
        ObjectKind::Var | ObjectKind::Domain => {
            let entries = object.entries.iter();
            above.extend(entries.clone().flat_map(|entry| context.above_entry(id(object, entry))));
            let keys =
                entries.flat_map(|entry| facts(id(object, entry), entry::keys(context, object.index, entry)));
            with_links(keys.collect(), links(object))
        }
        ObjectKind::Array => array(context, object, fold, &mut above),
        ObjectKind::Record => record(context, object, fold, &mut above),
    };
    Item { above, ..Item::new(key(object.index), Node::Map(items)) }.about(Spot::Object(object.index))
}

const fn id(object: &Object, entry: &Entry) -> EntryId {
    EntryId { index: object.index, sub: entry.sub }
}

/// The keys of one entry.
pub(super) fn facts(id: EntryId, keys: Keys) -> Vec<Item> {
    let item = |(fact, node): (Fact, Node)| Item::new(fact.word(), node).about(Spot::EntryFact(id, fact));
    keys.into_iter().map(item).collect()
}

/// What is said about an object as a whole: before its entries, and after them.
fn around(context: &Context<'_>, object: &Object) -> (Vec<Item>, Vec<Item>) {
    let item =
        |fact: Fact, node: Node| Item::new(fact.word(), node).about(Spot::ObjectFact(object.index, fact));
    let before = [
        Some(item(Fact::Name, Node::text(object.name.clone()))),
        object.identifier.clone().map(|name| item(Fact::Identifier, Node::Text(name))),
        object.category.map(|category| item(Fact::Category, Node::plain(category.word()))),
        object.since.clone().map(|since| item(Fact::Since, Node::Text(since))),
        links(object),
    ];
    let after = [(Fact::Warning, &object.warning), (Fact::About, &object.about)];
    let after = after
        .into_iter()
        .filter_map(|(fact, text)| Some(item(fact, super::texts::words(text, context.language())?)))
        .chain(super::texts::open(&object.about, context.language()).map(|gap| item(Fact::Gap, gap)))
        .chain(super::texts::phrases(&object.search).map(|phrases| item(Fact::Search, phrases)));
    (before.into_iter().flatten().collect(), after.collect())
}

/// `links:`, where there are any.
fn links(object: &Object) -> Option<Item> {
    (!object.links.is_empty()).then(|| links_of(object))
}

/// The keys of a VAR with its links, which are before the description.
pub(super) fn with_links(mut items: Vec<Item>, links: Option<Item>) -> Vec<Item> {
    let is_text = |item: &Item| {
        [Fact::Warning, Fact::About, Fact::Gap, Fact::Search].map(Fact::word).contains(&item.key.as_str())
    };
    let texts = items.iter().position(is_text).unwrap_or(items.len());
    items.splice(texts..texts, links);
    items
}

/// `links:`.
pub(super) fn links_of(object: &Object) -> Item {
    let links = object.linked().map(|index| Node::Plain(key(index))).collect();
    Item::new(Fact::Links.word(), Node::List(links)).about(Spot::ObjectFact(object.index, Fact::Links))
}

/// `sub0:`, where it is not the usual one.
fn sub0(context: &Context<'_>, object: &Object, above: &mut Vec<String>) -> Option<Item> {
    let count = object.entries.first().filter(|first| first.sub.0 == 0)?;
    let keys = entry::sub0(context, object, count);
    let comments = context.above_entry(id(object, count));
    if keys.is_empty() {
        above.extend(comments.into_iter().map(|line| format!("sub-index 0: {line}")));
        return None;
    }
    let item =
        Item::new("sub0", Node::Map(facts(id(object, count), keys))).about(Spot::Entry(id(object, count)));
    Some(Item { above: comments, ..item })
}

/// The entries after sub-index 0, with the keys of each.
fn entries(context: &Context<'_>, object: &Object) -> Vec<(u8, Keys)> {
    let entries = object.entries.iter().filter(|entry| entry.sub.0 != 0);
    entries.map(|entry| (entry.sub.0, entry::keys(context, object.index, entry))).collect()
}

fn array(context: &Context<'_>, object: &Object, fold: bool, above: &mut Vec<String>) -> Vec<Item> {
    let (mut items, after) = around(context, object);
    items.extend(sub0(context, object, above));
    let list = entries(context, object);
    let highest = list.last().map_or(0, |(sub, _)| *sub);
    let gaps: Vec<Node> =
        (1..=highest).filter(|sub| list.iter().all(|(at, _)| at != sub)).map(Node::plain).collect();
    if !gaps.is_empty() {
        items.push(Item::new("omit", Node::List(gaps)));
    }
    let mut inside = vec![Item::new("count", Node::plain(highest))];
    let patterns = if fold { fold::name_patterns(&list) } else { Vec::new() };
    let Folded { common, mut own } =
        if fold { fold::elements(list) } else { Folded { common: Vec::new(), own: list } };
    for (fact, pattern) in patterns {
        for (sub, keys) in &mut own {
            let name = Node::Text(pattern.replace("{n}", &sub.to_string()));
            keys.retain(|key| *key != (fact, name.clone()));
        }
        inside.push(Item::new(fact.word(), Node::Text(pattern)));
    }
    inside.extend(ordered(common).into_iter().map(|(fact, node)| Item::new(fact.word(), node)));
    let elements = single(context, object, own, above);
    if !elements.is_empty() {
        inside.push(Item::new("elements", Node::Map(elements)));
    }
    items.push(Item::new("array", Node::Map(inside)));
    items.extend(after);
    items
}

fn record(context: &Context<'_>, object: &Object, fold: bool, above: &mut Vec<String>) -> Vec<Item> {
    let (mut items, after) = around(context, object);
    let list = entries(context, object);
    let Folded { common, own } =
        if fold { fold::members(list) } else { Folded { common: Vec::new(), own: list } };
    items.extend(ordered(common).into_iter().map(|(fact, node)| Item::new(fact.word(), node)));
    items.extend(sub0(context, object, above));
    // A member with nothing of its own has at least its name.
    items.push(Item::new("record", Node::Block(single(context, object, own, above))));
    items.extend(after);
    items
}

/// Single entries by sub-index; comments of one that has nothing of its own are above the object.
pub(super) fn single(
    context: &Context<'_>,
    object: &Object,
    list: Vec<(u8, Keys)>,
    above: &mut Vec<String>,
) -> Vec<Item> {
    let mut items = Vec::new();
    for (sub, keys) in list {
        let id = EntryId { index: object.index, sub: od_spec::model::SubIndex(sub) };
        let comments = context.above_entry(id);
        if keys.is_empty() {
            above.extend(comments.into_iter().map(|line| format!("sub-index {sub}: {line}")));
            continue;
        }
        let item = Item::new(sub.to_string(), Node::Map(facts(id, ordered(keys)))).about(Spot::Entry(id));
        items.push(Item { above: comments, ..item });
    }
    items
}

/// Keys in the order of a specification.
fn ordered(mut keys: Keys) -> Keys {
    const ORDER: [Fact; 17] = [
        Fact::Name,
        Fact::Identifier,
        Fact::Type,
        Fact::Unit,
        Fact::Access,
        Fact::Mapping,
        Fact::Default,
        Fact::LowLimit,
        Fact::HighLimit,
        Fact::Special,
        Fact::Storage,
        Fact::Capacity,
        Fact::Category,
        Fact::Since,
        Fact::WriteCondition,
        Fact::BitErrors,
        Fact::Eds,
    ];
    keys.arrange_by_key(|(fact, _)| ORDER.iter().position(|one| one == fact).unwrap_or(ORDER.len()));
    keys
}
