//! An object as a library has it, and what is different.

use od_spec::LibraryObject;
use od_spec::model::{
    Author, Entry, EntryId, Fact, Index, NamedType, Object, ObjectKind, SubIndex, Text, TypeKind, Value,
};

use super::compare::same_named;
use super::context::{Context, same_unit};
use super::entry::{self, Keys};
use super::fold::{self, Folded};
use super::node::{Item, Node, Spot};
use super::objects::{facts, key, links_of, single, with_links};
use super::value;

/// `{from: NAME, …}` with what differs; `None` where no library has the object, or has more than the object could undo. What the
/// model leaves open – units, meanings of bits, texts – may come from the library.
pub(super) fn from_library(context: &Context<'_>, object: &Object) -> Option<Item> {
    let libraries = &context.style.libraries;
    let (library, below) =
        libraries.iter().find_map(|library| Some((library, library.objects.get(&object.index)?)))?;
    if below.object.kind != object.kind {
        return None;
    }
    let mut above = context.above_object(object.index);
    let mut items = vec![Item::new("from", Node::plain(&library.name))];
    match object.kind {
        ObjectKind::Var | ObjectKind::Domain => {
            let (below_object, below) = (&below.object, below.object.entries.first()?);
            let entry = object.entries.first()?;
            let id = EntryId { index: object.index, sub: entry.sub };
            above.extend(context.above_entry(id));
            let keys = facts(id, differences(context, object.index, entry, below)?);
            items.extend(with_links(keys, links(object, below_object)));
        }
        ObjectKind::Array => {
            items.extend(whole(object, &below.object, context));
            items.extend(sub0(context, object, &below.object)?);
            items.extend(array(context, object, below, &mut above)?);
        }
        ObjectKind::Record => {
            items.extend(whole(object, &below.object, context));
            items.extend(sub0(context, object, &below.object)?);
            items.extend(record(context, object, &below.object, &mut above)?);
        }
    }
    Some(Item { above, ..Item::new(key(object.index), Node::Map(items)) }.about(Spot::Object(object.index)))
}

/// What is different about the object as a whole.
fn whole(object: &Object, below: &Object, context: &Context<'_>) -> Vec<Item> {
    let item =
        |fact: Fact, node: Node| Item::new(fact.word(), node).about(Spot::ObjectFact(object.index, fact));
    let category = object.category.filter(|category| Some(*category) != below.category);
    let since = object.since.clone().filter(|since| Some(since) != below.since.as_ref());
    let text = |fact: Fact, text: &Text, below: &Text| {
        let words = super::texts::words(text, context.language()).filter(|_| text != below)?;
        Some(item(fact, words))
    };
    let items = [
        (object.name != below.name).then(|| item(Fact::Name, Node::text(object.name.clone()))),
        object.identifier.clone().map(|name| item(Fact::Identifier, Node::Text(name))),
        category.map(|category| item(Fact::Category, Node::plain(category.word()))),
        since.map(|since| item(Fact::Since, Node::Text(since))),
        links(object, below),
        text(Fact::Warning, &object.warning, &below.warning),
        text(Fact::About, &object.about, &below.about),
        super::texts::open(&object.about, context.language())
            .filter(|_| object.about.gap() != below.about.gap())
            .map(|gap| item(Fact::Gap, gap)),
        super::texts::phrases(&object.search)
            .filter(|_| object.search != below.search)
            .map(|phrases| item(Fact::Search, phrases)),
    ];
    items.into_iter().flatten().collect()
}

/// The links, where the library has others.
fn links(object: &Object, below: &Object) -> Option<Item> {
    (!object.linked().eq(below.linked())).then(|| links_of(object))
}

/// What is different about sub-index 0.
fn sub0(context: &Context<'_>, object: &Object, below: &Object) -> Option<Vec<Item>> {
    let (count, below_count) = (object.entries.first()?, below.entries.first()?);
    let own = entry::sub0(context, object, count);
    let theirs = entry::sub0(context, below, below_count);
    let mut keys: Keys = own.iter().filter(|key| !theirs.contains(key)).cloned().collect();
    for (fact, _) in theirs.iter().filter(|(fact, _)| fold::get(&own, *fact).is_none()) {
        let node = match fact {
            Fact::Name => Node::text(count.name.clone()),
            Fact::Access => entry::access(count),
            Fact::Mapping => Node::plain("none"),
            Fact::Storage => Node::plain("no"),
            Fact::Eds => no_flags(),
            Fact::Default => value(object.index, count, count.default.as_ref()?),
            Fact::Warning | Fact::About | Fact::Search => continue,
            _ => return None,
        };
        keys.push((*fact, node));
    }
    let id = EntryId { index: object.index, sub: count.sub };
    let comments = context.above_entry(id);
    if keys.is_empty() && comments.is_empty() {
        return Some(Vec::new());
    }
    let item = Item::new("sub0", Node::Map(facts(id, keys))).about(Spot::Entry(id));
    Some(vec![Item { above: comments, ..item }])
}

/// `eds:` that says nothing.
fn no_flags() -> Node {
    Node::Map(vec![Item::new("flags", Node::List(Vec::new()))])
}

/// What undoes a fact.
fn neutral() -> impl Iterator<Item = (Fact, Node)> {
    [(Fact::Mapping, Node::plain("none")), (Fact::Storage, Node::plain("no")), (Fact::Eds, no_flags())]
        .into_iter()
}

fn array(
    context: &Context<'_>,
    object: &Object,
    below: &LibraryObject,
    above: &mut Vec<String>,
) -> Option<Vec<Item>> {
    let highest = object.entries.last()?.sub;
    let mut items = Vec::new();
    let missing = (1..=highest.0).filter(|sub| object.entry(SubIndex(*sub)).is_none());
    let missing: Vec<Node> = missing.map(Node::plain).collect();
    if !missing.is_empty() {
        items.push(Item::new("omit", Node::List(missing)));
    }
    let mut inside = Vec::new();
    if below.object.entries.last().map(|last| last.sub) != Some(highest) {
        inside.push(Item::new("count", Node::plain(highest)));
    }
    let theirs = || below.object.entries.iter().chain(&below.further);
    let mut list = Vec::new();
    for element in object.entries.iter().filter(|element| element.sub.0 != 0) {
        let keys = match theirs().find(|one| one.sub == element.sub) {
            Some(one) => differences(context, object.index, element, one)?,
            None => {
                let keys = entry::keys(context, object.index, element);
                let has = |fact: Fact| {
                    theirs().any(|one| fold::get(&entry::keys(context, object.index, one), fact).is_some())
                };
                neutral()
                    .filter(|(fact, _)| has(*fact) && fold::get(&keys, *fact).is_none())
                    .chain(keys.clone())
                    .collect()
            }
        };
        list.push((element.sub.0, keys));
    }
    // What all elements have otherwise is said once; but the library may say names and defaults of each, which go before.
    let alike = list.iter().all(|(_, keys)| Some(keys) == list.first().map(|(_, first)| first));
    let is_said = |fact: Fact| list.iter().any(|(_, keys)| fold::get(keys, fact).is_some());
    let has_defaults = theirs().any(|one| stated_default(one).is_some());
    let Folded { common, own } = if alike && !is_said(Fact::Name) && !(is_said(Fact::Default) && has_defaults)
    {
        fold::elements(list)
    } else {
        Folded { common: Vec::new(), own: list }
    };
    inside.extend(common.into_iter().map(|(fact, node)| Item::new(fact.word(), node)));
    let elements = single(context, object, own, above);
    if !elements.is_empty() {
        inside.push(Item::new("elements", Node::Map(elements)));
    }
    if !inside.is_empty() {
        items.push(Item::new("array", Node::Map(inside)));
    }
    Some(items)
}

fn record(
    context: &Context<'_>,
    object: &Object,
    below: &Object,
    above: &mut Vec<String>,
) -> Option<Vec<Item>> {
    let mut items = Vec::new();
    let missing = below.entries.iter().filter(|member| object.entry(member.sub).is_none());
    let missing: Vec<Node> = missing.map(|member| Node::plain(member.sub)).collect();
    if !missing.is_empty() {
        items.push(Item::new("omit", Node::List(missing)));
    }
    let mut list = Vec::new();
    for member in object.entries.iter().filter(|member| member.sub.0 != 0) {
        let keys = match below.entry(member.sub) {
            Some(one) => differences(context, object.index, member, one)?,
            None => entry::keys(context, object.index, member),
        };
        list.push((member.sub.0, keys));
    }
    let members = single(context, object, list, above);
    if !members.is_empty() {
        items.push(Item::new("record", Node::Map(members)));
    }
    Some(items)
}

/// The default that a library says; what the device fills in is not said by it.
fn stated_default(below: &Entry) -> Option<&Value> {
    below.default.as_ref().filter(|_| !below.facts.is_said_by(Fact::Default, Author::Derived))
}

/// The keys of an entry that the library's entry does not have so; `None` where it has one that cannot be undone.
fn differences(context: &Context<'_>, index: Index, own: &Entry, below: &Entry) -> Option<Keys> {
    // Where the model names no bits and no unit, they are those of the library.
    let mut own = own.clone();
    if own.unit.is_none() {
        own.unit.clone_from(&below.unit);
    }
    // Values with a name of their own cannot be undone.
    let fits = |raw: i128| own.data_type.range().is_none_or(|(low, high)| (low..=high).contains(&raw));
    if own.special.is_empty() && !below.special.iter().all(|special| fits(special.value)) {
        return None;
    }
    let is_silent = own.named_type.is_none() && own.data_type == below.data_type;
    if let Some(NamedType { kind: TypeKind::Bits(_), .. }) = below.named_type.as_deref().filter(|_| is_silent)
    {
        own.named_type.clone_from(&below.named_type);
    }
    let own = &own;
    let stated = stated_default(below);
    let theirs = entry::keys(context, index, below);
    let condition = |entry: &Entry| entry.writable_when.as_ref().map(|condition| condition.text.clone());
    let mut keys = entry::keys(context, index, own);
    let id = EntryId { index, sub: own.sub };
    // Where a rule is broken, it is allowed at what the device says itself.
    let breaks = |fact: Fact| context.remarks.broken_with.contains(&Spot::EntryFact(id, fact));
    let differs = |fact: &Fact| {
        breaks(*fact)
            || match fact {
                Fact::Name => own.name != below.name,
                // An enum restricts the values, so that it counts only where the model has it, too.
                Fact::Type => own.data_type != below.data_type || !same_named(own, below),
                Fact::Unit => !own
                    .unit
                    .as_ref()
                    .zip(below.unit.as_ref())
                    .is_some_and(|(one, other)| same_unit(other, one)),
                Fact::Access => (own.access, own.locked) != (below.access, below.locked),
                Fact::Default => own.default.as_ref() != stated,
                Fact::LowLimit => own.limits().0 != below.limits().0,
                Fact::HighLimit => own.limits().1 != below.limits().1,
                Fact::WriteCondition => condition(own) != condition(below),
                Fact::Warning => own.warning != below.warning,
                Fact::About => own.about != below.about,
                Fact::Search => own.search != below.search,
                other => fold::get(&theirs, *other) != fold::get(&keys, *other),
            }
    };
    let different: Vec<Fact> = keys.iter().map(|(fact, _)| *fact).filter(differs).collect();
    let has = |fact: Fact| fold::get(&keys, fact).is_some();
    let undone = |fact: Fact| fold::get(&theirs, fact).is_some() && !has(fact);
    let mut more: Keys = Vec::new();
    if undone(Fact::LowLimit) || undone(Fact::HighLimit) || undone(Fact::WriteCondition) {
        return None;
    }
    if stated.is_some() && !has(Fact::Default) {
        more.push((Fact::Default, value(index, own, own.default.as_ref()?)));
    }
    more.extend(neutral().filter(|(fact, _)| undone(*fact)));
    if undone(Fact::Special) {
        let mut with_theirs = own.clone();
        with_theirs.special.clone_from(&below.special);
        if with_theirs.hull() != own.hull() {
            return None;
        }
    }
    keys.retain(|(fact, _)| different.contains(fact));
    keys.extend(more);
    Some(keys)
}
