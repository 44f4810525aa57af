//! Objects and entries: where they are described, and which one a reference means.

use std::cell::OnceCell;
use std::collections::BTreeMap;

use super::definitions::{Known, definition, one_or_more, subs};
use super::{Definition, DefinitionId, Kind, Spelling};
use crate::expr::PLACEHOLDER;
use crate::model::{Dictionary, EntryId, Fact, Index, SubIndex, System};
use crate::resolve::NamesOfDevice;
use crate::source::{FileId, Span, Spanned};
use crate::yaml::Node;

/// What a file says of an object or a run of objects.
struct Described<'t> {
    first: Index,
    last: Index,
    id: DefinitionId,
    /// The devices that have it; `None` for all.
    devices: Option<Vec<&'t str>>,
    /// The library that it is taken from.
    from: Option<&'t str>,
    name: Option<&'t str>,
    /// Members and elements with their sub-indices and names.
    members: Vec<(SubIndex, SubIndex, DefinitionId, Option<&'t str>)>,
    /// What stands for the elements of an array that have no description of their own.
    elements: Option<(DefinitionId, Option<&'t str>)>,
}

impl Described<'_> {
    fn is_for(&self, scope: Devices<'_>) -> bool {
        match (&self.devices, scope) {
            (None, _) | (_, Devices::All) => true,
            (Some(on), Devices::Only(list)) => list.iter().any(|device| on.contains(device)),
        }
    }
}

/// All descriptions of objects.
#[derive(Default)]
pub(super) struct Objects<'t> {
    described: Vec<Described<'t>>,
    pdos: Vec<(Index, &'t str, DefinitionId)>,
    /// How far the last index of a run is from its first, at most.
    longest_run: u16,
}

/// What a name of an entry consists of: ranges of the text, with what they name.
pub(super) struct NamedParts {
    /// The object.
    pub object: (std::ops::Range<usize>, Vec<DefinitionId>),
    /// Its entry, where one is named.
    pub entry: Option<(std::ops::Range<usize>, Vec<DefinitionId>)>,
}

impl<'t> Objects<'t> {
    /// Adds what stands at a key of `objects:`.
    pub(super) fn add(known: &mut Known<'t>, (first, last): (Index, Index), place: Span, node: &'t Node) {
        let devices = node.get("devices").map(one_or_more);
        let devices: Option<Vec<&str>> =
            devices.map(|list| list.iter().filter_map(|one| Some(one.text()?.value)).collect());
        let name = node.get("name").and_then(Node::text);
        let number = || Spanned::new("", place);
        let owned = devices.as_ref().map(|list| list.iter().map(|key| (*key).to_owned()).collect());
        let object = Definition {
            indices: Some((first, last)),
            devices: owned,
            ..definition(Kind::Object, name.unwrap_or_else(number), place)
        };
        let id = known.add(spelt(object, name.is_some(), || index_text(first, last)));
        let array = node.get("array");
        let lists = [node.get("record"), array.and_then(|array| array.get("elements"))];
        let mut members = Vec::new();
        for (key, member) in lists.into_iter().flatten().flat_map(Node::entries) {
            let Some((from, to)) = subs(&key.value) else { continue };
            let name = member.get("name").and_then(Node::text);
            let entry = entry(id, name, key.span, (from, to));
            let entry = spelt(entry, name.is_some(), || key.value.clone());
            members.push((from, to, known.add(entry), name.map(|name| name.value)));
        }
        if let Some(sub0) = node.get("sub0") {
            let name = sub0.get("name").and_then(Node::text);
            let zero = (SubIndex(0), SubIndex(0));
            let entry = spelt(entry(id, name, sub0.span, zero), name.is_some(), || "0".to_owned());
            members.push((zero.0, zero.1, known.add(entry), name.map(|name| name.value)));
        }
        let elements = array.map(|array| {
            let name = array.get("name").and_then(Node::text);
            let all = (SubIndex(1), SubIndex(254));
            let place = name.map_or_else(|| array.span.part(0, 1), |name| name.span);
            let entry = entry(id, name, place, all);
            let entry = spelt(entry, name.is_some(), || "elements".to_owned());
            (known.add(Definition { spelling: Spelling::Pattern, ..entry }), name.map(|name| name.value))
        });
        known.objects.longest_run = known.objects.longest_run.max(last.0 - first.0);
        known.objects.described.push(Described {
            first,
            last,
            id,
            devices,
            from: node.get("from").and_then(Node::text).map(|from| from.value),
            name: name.map(|name| name.value),
            members,
            elements,
        });
    }

    pub(super) fn add_pdo(&mut self, index: Index, device: &'t str, id: DefinitionId) {
        self.pdos.push((index, device, id));
    }

    /// Puts the descriptions in the order of their indices.
    pub(super) fn sort(&mut self) {
        self.described.sort_by_key(|one| one.first);
    }

    /// What describes an index.
    fn at(&self, index: Index) -> impl Iterator<Item = &Described<'t>> {
        let earliest = Index(index.0.saturating_sub(self.longest_run));
        let first = self.described.partition_point(|one| one.first < earliest);
        self.described[first..]
            .iter()
            .take_while(move |one| one.first <= index)
            .filter(move |one| one.last >= index)
    }

    /// What describes an index for some devices, as a text of `file` means it.
    fn of<'s>(
        &'s self,
        known: &Known<'_>,
        file: FileId,
        index: Index,
        scope: Devices<'_>,
    ) -> Vec<&'s Described<'t>> {
        let all: Vec<&Described<'_>> = self.at(index).filter(|one| one.is_for(scope)).collect();
        let written_in = |file: FileId| -> Vec<&Described<'_>> {
            let is_in = |one: &&Described<'_>| known.definition(one.id).key.file.is_one_with(file);
            all.iter().copied().filter(is_in).collect()
        };
        [written_in(file), written_in(known.root)].into_iter().find(|some| !some.is_empty()).unwrap_or(all)
    }

    /// The descriptions of an object.
    pub(super) fn object(
        &self,
        known: &Known<'_>,
        file: FileId,
        index: Index,
        scope: Devices<'_>,
    ) -> Vec<DefinitionId> {
        let described = self.of(known, file, index, scope);
        if !described.is_empty() {
            return described.iter().map(|one| one.id).collect();
        }
        let is_pdo = |(communication, device, _): &&(Index, &str, DefinitionId)| {
            scope.has(device) && (*communication == index || communication.0 + 0x200 == index.0)
        };
        self.pdos.iter().filter(is_pdo).map(|(_, _, id)| *id).collect()
    }

    /// The descriptions of entries of an object; where nobody describes one by itself, nothing.
    pub(super) fn entries(
        &self,
        known: &Known<'_>,
        file: FileId,
        (index, first, last): (Index, SubIndex, SubIndex),
        scope: Devices<'_>,
    ) -> Vec<DefinitionId> {
        let mut found = Vec::new();
        for one in self.of(known, file, index, scope) {
            let before = found.len();
            let members = one.members.iter().filter(|(from, to, ..)| *from <= last && first <= *to);
            found.extend(members.map(|(_, _, id, _)| *id));
            if found.len() == before && first.0 > 0 {
                found.extend(one.elements.map(|(id, _)| id));
            }
            // What the maker takes from a library as it is, the library describes.
            if found.len() == before
                && let Some(from) = one.from
            {
                let library = self.at(index).filter(|other| {
                    let file = known.definition(other.id).key.file;
                    known.library(from) == Some(file)
                });
                for other in library {
                    let members = other.members.iter().filter(|(from, to, ..)| *from <= last && first <= *to);
                    found.extend(members.map(|(_, _, id, _)| *id));
                    found.extend(other.elements.filter(|_| first.0 > 0).map(|(id, _)| id));
                }
            }
        }
        found.sort_unstable();
        found.dedup();
        found
    }

    /// The objects that are written with a name, or with one that it fits.
    fn by_name<'s>(&'s self, name: &'s str, scope: Devices<'s>) -> impl Iterator<Item = &'s Described<'t>> {
        self.described
            .iter()
            .filter(move |one| one.is_for(scope))
            .filter(move |one| one.name.is_some_and(|known| fits(known, name)))
    }

    /// What a name stands for where no model says it.
    pub(super) fn named(&self, name: &str, scope: Devices<'_>) -> Option<NamedParts> {
        let whole: Vec<DefinitionId> = self.by_name(name, scope).map(|one| one.id).collect();
        if !whole.is_empty() {
            return Some(NamedParts { object: (0..name.len(), whole), entry: None });
        }
        name.match_indices('.').find_map(|(dot, _)| {
            let (object, entry) = (&name[..dot], &name[dot + 1..]);
            let (mut objects, mut entries) = (Vec::new(), Vec::new());
            for one in self.by_name(object, scope) {
                let members =
                    one.members.iter().filter(|(_, _, _, name)| name.is_some_and(|known| fits(known, entry)));
                let before = entries.len();
                entries.extend(members.map(|(_, _, id, _)| *id));
                let elements = one.elements.filter(|(_, name)| name.is_some_and(|known| fits(known, entry)));
                entries.extend(elements.map(|(id, _)| id));
                if entries.len() > before {
                    objects.push(one.id);
                }
            }
            (!entries.is_empty()).then(|| NamedParts {
                object: (0..dot, objects),
                entry: Some((dot + 1..name.len(), entries)),
            })
        })
    }
}

/// An entry of an object.
fn entry(
    owner: DefinitionId,
    name: Option<Spanned<&str>>,
    place: Span,
    subs: (SubIndex, SubIndex),
) -> Definition {
    Definition {
        owner: Some(owner),
        subs: Some(subs),
        ..definition(Kind::Entry, name.unwrap_or(Spanned::new("", place)), place)
    }
}

/// A definition that has its number for a name where none is written.
fn spelt(definition: Definition, is_named: bool, number: impl FnOnce() -> String) -> Definition {
    if is_named {
        return definition;
    }
    Definition { name: number(), spelling: Spelling::Elsewhere, ..definition }
}

fn index_text(first: Index, last: Index) -> String {
    if first == last { format!("0x{:04X}", first.0) } else { format!("0x{:04X}..0x{:04X}", first.0, last.0) }
}

/// Whether a name is one that may stand with a placeholder.
fn fits(written: &str, name: &str) -> bool {
    match written.split_once(PLACEHOLDER) {
        None => written == name,
        Some((before, behind)) => name
            .strip_prefix(before)
            .and_then(|rest| rest.strip_suffix(behind))
            .is_some_and(|number| !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit())),
    }
}

/// The devices that a place speaks of.
#[derive(Debug, Clone, Copy)]
pub(super) enum Devices<'d> {
    /// All of them.
    All,
    /// Those with these keys.
    Only(&'d [&'d str]),
}

impl Devices<'_> {
    fn has(self, key: &str) -> bool {
        match self {
            Devices::All => true,
            Devices::Only(list) => list.contains(&key),
        }
    }
}

/// The devices of a model, each with its names, which are looked up as compiling looks them up.
pub(super) struct Meant<'a> {
    devices: Vec<(&'a Dictionary, OnceCell<NamesOfDevice<'a>>)>,
    /// The names of the types of values, by the places of the values.
    types: OnceCell<BTreeMap<Span, &'a str>>,
}

impl<'a> Meant<'a> {
    pub(super) fn of(system: Option<&'a System>) -> Self {
        let devices = system.map(|system| system.devices.as_slice()).unwrap_or_default();
        Self {
            devices: devices.iter().map(|device| (device, OnceCell::new())).collect(),
            types: OnceCell::new(),
        }
    }

    /// The entries that a name stands for, each on its device.
    pub(super) fn named<'s>(
        &'s self,
        name: &'s str,
        scope: Devices<'s>,
    ) -> impl Iterator<Item = (&'a Dictionary, EntryId)> + use<'s, 'a> {
        let devices = self.devices.iter().filter(move |(device, _)| scope.has(&device.key));
        devices.filter_map(move |(device, names)| {
            let names = names.get_or_init(|| NamesOfDevice::new(device.objects.values()));
            Some((*device, names.get(name)?))
        })
    }

    /// The name of the named type of the value that stands at a place, or in the list there.
    pub(super) fn type_of_value(&self, place: Span) -> Option<&'a str> {
        let types = self.types.get_or_init(|| {
            let entries = self.devices.iter().flat_map(|(device, _)| device.entries());
            entries
                .filter_map(|(_, _, entry)| Some((entry, entry.named_type.as_ref()?)))
                .flat_map(|(entry, named)| {
                    let facts = [Fact::Default, Fact::LowLimit, Fact::HighLimit];
                    let places = facts.into_iter().filter_map(|fact| entry.facts.get(fact));
                    places.map(|statement| (statement.span, named.name.as_str()))
                })
                .collect()
        });
        let (span, name) = types.range(..=Span { end: u32::MAX, ..place }).next_back()?;
        (span.file == place.file && place.end <= span.end).then_some(*name)
    }

    /// The devices.
    pub(super) fn devices<'s>(
        &'s self,
        scope: Devices<'s>,
    ) -> impl Iterator<Item = &'a Dictionary> + use<'s, 'a> {
        self.devices.iter().map(|(device, _)| *device).filter(move |device| scope.has(&device.key))
    }
}
