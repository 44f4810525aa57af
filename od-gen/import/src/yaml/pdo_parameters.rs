//! `parameters:` of PDOs: what their parameter objects are called, and what else of them `pdos:` would make otherwise.

use std::collections::BTreeMap;

use od_spec::model::{
    Access, CommunicationParameter, DataType, Dictionary, Direction, Entry, Index, Object, Pdo, Role,
    Storage, SubIndex, Value, usual_pdo_names, usual_pdo_storage,
};
use od_spec::name_pattern::{NamePattern, Numbers};

use super::context::Context;
use super::node::{Item, Node};
use super::pdo_names::{Found, Named, Preferred, most_common};

/// What is said about the parameters of the PDOs of a direction.
#[derive(Default)]
pub(super) struct Parameters {
    /// For all of them.
    pub common: Vec<Item>,
    /// For single ones, by number.
    pub own: BTreeMap<u16, Vec<Item>>,
}

impl Parameters {
    /// Adds what is said under a key.
    fn add(&mut self, key: &str, said: Said) {
        self.common.extend(said.common.map(|node| Item::new(key, node)));
        for (number, node) in said.own {
            self.own.entry(number).or_default().push(Item::new(key, node));
        }
    }

    /// The same as what is said under one key.
    fn nested(self) -> Said {
        let map = |items: Vec<Item>| (!items.is_empty()).then_some(Node::Map(items));
        let own = self.own.into_iter().filter_map(|(number, items)| Some((number, map(items)?)));
        Said { common: map(self.common), own: own.collect() }
    }
}

/// What is said under one key.
#[derive(Default)]
struct Said {
    common: Option<Node>,
    own: BTreeMap<u16, Node>,
}

/// An entry of the parameter objects of a PDO.
#[derive(Clone, Copy)]
struct Parameter<'a> {
    pdo: &'a Pdo,
    index: u16,
    entry: &'a Entry,
    /// What it has where nothing is said.
    usual_access: Access,
}

impl<'a> Parameter<'a> {
    fn named(self) -> Named<'a> {
        let numbers =
            Numbers { pdo: self.pdo.number, index: Index(self.index), entry: Some(self.entry.sub.0) };
        Named { numbers, name: &self.entry.name }
    }

    /// The same where the sub-index is not a number that the name could count.
    fn without_entry(self) -> Named<'a> {
        let Named { numbers, name } = self.named();
        Named { numbers: Numbers { entry: None, ..numbers }, name }
    }
}

/// What is said about the parameters of these PDOs, which are of one direction.
pub(super) fn of(context: &Context<'_>, direction: Direction, pdos: &[&Pdo]) -> Parameters {
    let with = |index: fn(&Pdo) -> u16| -> Vec<(&Pdo, &Object)> {
        let object = |pdo: &Pdo| context.device.objects.get(&Index(index(pdo)));
        pdos.iter().filter_map(|pdo| Some((*pdo, object(pdo)?))).collect()
    };
    let mut parameters = Parameters::default();
    parameters.add("communication", communication(direction, &with(Pdo::communication_index)).nested());
    parameters.add("mapping", mapping(direction, &with(Pdo::mapping_index)).nested());
    parameters
}

fn communication(direction: Direction, objects: &[(&Pdo, &Object)]) -> Parameters {
    let mut inside = Parameters::default();
    inside.add("name", object_names(objects, usual_pdo_names::communication(direction)));
    inside.add("identifier", identifiers(objects));
    for kind in CommunicationParameter::ALL {
        let having = objects.iter().filter_map(|(pdo, object)| {
            let entry = object.entry(SubIndex(kind.sub()))?;
            Some(Parameter { pdo, index: object.index.0, entry, usual_access: kind.usual_access() })
        });
        let having: Vec<Parameter<'_>> = having.collect();
        let said = match kind {
            // That it is there at all has to be said: of all PDOs, or of each that has it.
            CommunicationParameter::Reserved if having.len() == objects.len() => described(&having, None),
            CommunicationParameter::Reserved => {
                let alone = |one: &Parameter<'_>| {
                    Some((one.pdo.number, described(std::slice::from_ref(one), None).common?))
                };
                Said { common: None, own: having.iter().filter_map(alone).collect() }
            }
            _ => described(&having, Some(kind.usual_name(direction))),
        };
        inside.add(kind.key(), said);
    }
    inside
}

fn mapping(direction: Direction, objects: &[(&Pdo, &Object)]) -> Parameters {
    let (mut numbers, mut entries) = (Vec::new(), Vec::new());
    for (pdo, object) in objects {
        let usual_access = if pdo.variable_mapping { Access::Rw } else { Access::Ro };
        for entry in &object.entries {
            let parameter = Parameter { pdo, index: object.index.0, entry, usual_access };
            if entry.sub.0 == 0 { numbers.push(parameter) } else { entries.push(parameter) }
        }
    }
    let mut inside = Parameters::default();
    inside.add("name", object_names(objects, usual_pdo_names::mapping(direction)));
    inside.add("identifier", identifiers(objects));
    inside.add("sub0", described(&numbers, Some(usual_pdo_names::MAPPED)));
    mapped_entries(&mut inside, &entries);
    inside
}

/// `name:` of the objects.
fn object_names<'a>(objects: &[(&Pdo, &'a Object)], usual: &str) -> Said {
    let named = |(pdo, object): &(&Pdo, &'a Object)| {
        let numbers = Numbers { pdo: pdo.number, index: object.index, entry: None };
        Named { numbers, name: &object.name }
    };
    let list: Vec<Named<'a>> = objects.iter().map(named).collect();
    let Some(found) = most_common(&list, Some(usual), Preferred::Pdo) else { return Said::default() };
    let others = list.iter().filter(|named| !found.gives(named));
    Said {
        own: others.map(|named| (named.numbers.pdo, literal(named.name))).collect(),
        common: (found.text != usual).then(|| Node::text(found.text)),
    }
}

/// `identifier:` of the objects.
fn identifiers(objects: &[(&Pdo, &Object)]) -> Said {
    let named = objects.iter().filter_map(|(pdo, object)| {
        let numbers = Numbers { pdo: pdo.number, index: object.index, entry: None };
        Some(Named { numbers, name: object.identifier.as_deref()? })
    });
    let list: Vec<Named<'_>> = named.collect();
    let found = most_common(&list, None, Preferred::Pdo).filter(|_| list.len() == objects.len());
    match found.filter(|found| list.iter().all(|named| found.gives(named))) {
        Some(found) => Said { common: Some(Node::text(found.text)), own: BTreeMap::new() },
        None => {
            let own = list.iter().map(|named| (named.numbers.pdo, literal(named.name)));
            Said { common: None, own: own.collect() }
        }
    }
}

/// The pattern of the identifiers of the entries that one PDO maps; `None` where not all have one that follows it.
pub(super) fn identifier_pattern(pdo: &Pdo, entries: &[&Entry]) -> Option<String> {
    let named = entries.iter().filter_map(|entry| {
        let numbers =
            Numbers { pdo: pdo.number, index: Index(pdo.mapping_index()), entry: Some(entry.sub.0) };
        Some(Named { numbers, name: entry.identifier.as_deref()? })
    });
    let list: Vec<Named<'_>> = named.collect();
    let found = most_common(&list, None, Preferred::Entry).filter(|_| list.len() == entries.len())?;
    list.iter().all(|named| found.gives(named)).then_some(found.text)
}

/// A parameter that each PDO has once at most; without a usual name, the name is said.
fn described(list: &[Parameter<'_>], usual: Option<&str>) -> Said {
    let named: Vec<Named<'_>> = list.iter().map(|parameter| parameter.without_entry()).collect();
    let found = most_common(&named, usual, Preferred::Nothing);
    let (common, mut own) = facts(list);
    let mut names: BTreeMap<u16, Node> = BTreeMap::new();
    if let Some(found) = &found {
        let others = named.iter().filter(|named| !found.gives(named));
        names.extend(others.map(|named| (named.numbers.pdo, literal(named.name))));
    }
    let name = found.filter(|found| usual != Some(found.text.as_str())).map(|found| Node::text(found.text));
    let numbers: Vec<u16> = list.iter().map(|parameter| parameter.pdo.number).collect();
    let own = numbers.into_iter().filter_map(|number| {
        let facts = own.remove(&number).unwrap_or_default();
        Some((number, composed(names.remove(&number), facts)?))
    });
    Said { own: own.collect(), common: composed(name, common) }
}

/// `entry:` and `entries:`.
fn mapped_entries(inside: &mut Parameters, list: &[Parameter<'_>]) {
    let named: Vec<Named<'_>> = list.iter().map(|parameter| parameter.named()).collect();
    let usual = usual_pdo_names::ENTRY;
    let Some(found) = most_common(&named, Some(usual), Preferred::Entry) else { return };
    let singles = singles(&named, &found);
    let given = |named: &Named<'_>| {
        let sub = named.numbers.entry.unwrap_or_default();
        singles.get(&sub).unwrap_or(&found).gives(named)
    };
    let (mut common, mut own) = facts(list);
    let of_pdos = list.chunk_by(|one, next| one.pdo.number == next.pdo.number);
    let patterns: BTreeMap<u16, Option<String>> = of_pdos
        .filter_map(|of_one| {
            let entries: Vec<&Entry> = of_one.iter().map(|parameter| parameter.entry).collect();
            let pdo = of_one.first()?.pdo;
            Some((pdo.number, identifier_pattern(pdo, &entries)))
        })
        .collect();
    let identifier = |pattern: &String| Item::new("identifier", Node::text(pattern.clone()));
    let first = patterns.values().next().cloned().flatten();
    if patterns.values().all(|pattern| *pattern == first) {
        common.splice(0..0, first.iter().map(identifier));
    } else {
        for (number, pattern) in &patterns {
            own.entry(*number).or_default().splice(0..0, pattern.iter().map(identifier));
        }
    }
    let mut said = Said {
        common: composed((found.text != usual).then(|| Node::text(found.text.clone())), common),
        own: BTreeMap::new(),
    };
    let map = |singles: BTreeMap<u8, Node>| {
        let items = singles.into_iter().map(|(sub, node)| Item::new(sub.to_string(), node));
        Node::Map(items.collect())
    };
    let mut own_singles: BTreeMap<u16, Node> = BTreeMap::new();
    for of_one in list.chunk_by(|one, next| one.pdo.number == next.pdo.number) {
        let Some(number) = of_one.first().map(|parameter| parameter.pdo.number) else { continue };
        let named: Vec<Named<'_>> = of_one.iter().map(|parameter| parameter.named()).collect();
        let others: Vec<&Named<'_>> = named.iter().filter(|named| !given(named)).collect();
        let whole = most_common(&named, None, Preferred::Entry)
            .filter(|whole| others.len() > 1 && named.iter().all(|named| whole.gives(named)));
        if whole.is_none() && !others.is_empty() {
            let singles = others.iter().filter_map(|named| Some((named.numbers.entry?, literal(named.name))));
            own_singles.insert(number, map(singles.collect()));
        }
        let facts = own.remove(&number).unwrap_or_default();
        let node = composed(whole.map(|whole| Node::text(whole.text)), facts);
        said.own.extend(node.map(|node| (number, node)));
    }
    inside.add("entry", said);
    let common = singles.into_iter().map(|(sub, found)| (sub, Node::text(found.text)));
    let common: BTreeMap<u8, Node> = common.collect();
    inside.add("entries", Said { common: (!common.is_empty()).then(|| map(common)), own: own_singles });
}

/// Sub-indices at which most PDOs follow another pattern than the one of all entries.
fn singles(list: &[Named<'_>], found: &Found) -> BTreeMap<u8, Found> {
    let mut by_sub: BTreeMap<u8, Vec<Named<'_>>> = BTreeMap::new();
    for named in list {
        by_sub.entry(named.numbers.entry.unwrap_or_default()).or_default().push(*named);
    }
    let single = |(sub, list): (u8, Vec<Named<'_>>)| {
        let score = |found: &Found| list.iter().filter(|named| found.gives(named)).count();
        if score(found) == list.len() {
            return None;
        }
        let single = most_common(&list, None, Preferred::Nothing)?;
        let count = score(&single);
        (count > score(found) && 2 * count > list.len()).then_some((sub, single))
    };
    by_sub.into_iter().filter_map(single).collect()
}

/// A name as it is.
fn literal(name: &str) -> Node {
    Node::text(NamePattern::escape(name))
}

/// A name alone, or a map with the facts after it.
fn composed(name: Option<Node>, facts: Vec<Item>) -> Option<Node> {
    if facts.is_empty() {
        return name;
    }
    let name = name.map(|name| Item::new("name", name));
    Some(Node::Map(name.into_iter().chain(facts).collect()))
}

/// What is said in addition to names: what all have alike, and by PDO what they have not.
fn facts(list: &[Parameter<'_>]) -> (Vec<Item>, BTreeMap<u16, Vec<Item>>) {
    type Fact = fn(&Parameter<'_>) -> Option<Node>;
    let each: [(&str, Fact); 5] = [
        ("identifier", |one| {
            let is_mapped = Role::of(Index(one.index)) == Role::PdoMapping && one.entry.sub.0 > 0;
            one.entry.identifier.as_deref().filter(|_| !is_mapped).map(literal)
        }),
        ("access", |one| {
            (one.entry.access != one.usual_access).then(|| Node::plain(one.entry.access.word()))
        }),
        ("default", |one| {
            let is_reserved = Role::of(Index(one.index)) == Role::PdoCommunication
                && one.entry.sub.0 == CommunicationParameter::Reserved.sub();
            one.entry.default.as_ref().filter(|_| is_reserved).and_then(Value::integer).map(Node::plain)
        }),
        ("min", |one| one.entry.low.map(|limit| limit_node(one.entry, limit))),
        ("max", |one| one.entry.high.map(|limit| limit_node(one.entry, limit))),
    ];
    let (mut common, mut own) = (Vec::new(), BTreeMap::<u16, Vec<Item>>::new());
    for (key, fact) in each {
        let first = list.first().and_then(fact);
        if list.iter().all(|one| fact(one) == first) {
            common.extend(first.map(|node| Item::new(key, node)));
            continue;
        }
        for of_one in list.chunk_by(|one, next| one.pdo.number == next.pdo.number) {
            let Some(first) = of_one.first() else { continue };
            let item = fact(first).map(|node| Item::new(key, node));
            own.entry(first.pdo.number).or_default().extend(item);
        }
    }
    (common, own)
}

/// A limit: bit by bit where it is as wide as a COB-ID.
fn limit_node(entry: &Entry, limit: i128) -> Node {
    match u32::try_from(limit) {
        Ok(limit) if entry.data_type == DataType::Unsigned32 && limit > 0xFFFF => Node::hex32(limit),
        _ => Node::plain(limit),
    }
}

/// `stored:`: what keeps the parameters of PDOs that can be written, where it does not follow from the device.
pub(super) fn stored(context: &Context<'_>, pdos: &[&Pdo]) -> Option<Storage> {
    let storage = storage(context.device, pdos);
    (storage != usual_pdo_storage(&context.device.objects)).then_some(storage)
}

/// What keeps most of the parameters that can be written.
pub(super) fn storage(device: &Dictionary, pdos: &[&Pdo]) -> Storage {
    let indices = |pdo: &&Pdo| [pdo.communication_index(), pdo.mapping_index()].map(Index);
    let objects = pdos.iter().flat_map(indices).filter_map(|index| device.objects.get(&index));
    let writable: Vec<&Entry> =
        objects.flat_map(|object| &object.entries).filter(|entry| entry.access.is_writable()).collect();
    let count = |storage: Storage| writable.iter().filter(|entry| entry.stored == storage).count();
    let usual = usual_pdo_storage(&device.objects);
    let others = [Storage::Communication, Storage::No];
    others.into_iter().find(|&other| count(other) > count(usual)).unwrap_or(usual)
}
