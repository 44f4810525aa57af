//! Objects and entries: where they are described, and which one a reference means.

use super::definitions::{Known, definition, one_or_more, subs};
use super::{Definition, DefinitionId, Kind, Spelling};
use crate::expr::PLACEHOLDER;
use crate::model::{EntryId, Index, SubIndex};
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
    type_name: Option<&'t str>,
    /// Members, elements and sub-index 0.
    members: Vec<Member<'t>>,
    /// What stands for the elements of an array that have no description of their own.
    elements: Option<Member<'t>>,
}

/// What a file says of an entry or a run of entries.
struct Member<'t> {
    first: SubIndex,
    last: SubIndex,
    id: DefinitionId,
    name: Option<&'t str>,
    type_name: Option<&'t str>,
}

impl Member<'_> {
    fn has_any(&self, first: SubIndex, last: SubIndex) -> bool {
        self.first <= last && first <= self.last
    }

    fn is_called(&self, name: &str) -> bool {
        self.name.is_some_and(|known| fits(known, name))
    }
}

impl<'t> Described<'t> {
    /// What describes some of its entries: what is about them alone, and where that has no name, what is about all.
    fn about(&self, first: SubIndex, last: SubIndex) -> Vec<&Member<'t>> {
        let mut found: Vec<_> = self.members.iter().filter(|member| member.has_any(first, last)).collect();
        if found.iter().all(|member| member.name.is_none()) {
            found.extend(self.elements.iter().filter(|all| all.has_any(first, last)));
        }
        found
    }

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

/// What a name of an entry names, where no model says it.
pub(super) struct NamedParts {
    /// The first entry that it may be.
    pub first: EntryId,
    /// How many bytes of it are the name of the object.
    pub object_length: usize,
    pub objects: Vec<DefinitionId>,
    /// Its entries, where some are named.
    pub entries: Vec<DefinitionId>,
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
        let members = lists.into_iter().flatten().flat_map(Node::entries);
        let members = members.filter_map(|(key, member)| Some((key, subs(&key.value)?, member)));
        let mut members: Vec<Member<'_>> = members
            .map(|(key, range, node)| Member::add(known, id, Spanned::new(&key.value, key.span), range, node))
            .collect();
        if let Some(sub0) = node.get("sub0") {
            let number = Spanned::new("0", sub0.span.part(0, 1));
            members.push(Member::add(known, id, number, (SubIndex(0), SubIndex(0)), sub0));
        }
        let elements = array.map(|array| {
            let place = array.get("name").map_or_else(|| array.span.part(0, 1), |name| name.span);
            let all =
                Member::add(known, id, Spanned::new("elements", place), (SubIndex(1), SubIndex(254)), array);
            known.definition_mut(all.id).spelling = Spelling::Pattern;
            all
        });
        known.objects.longest_run = known.objects.longest_run.max(last.0 - first.0);
        known.objects.described.push(Described {
            first,
            last,
            id,
            devices,
            from: text_of(node, "from"),
            name: name.map(|name| name.value),
            type_name: text_of(node, "type"),
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
        let members = self.members(known, file, (index, first, last), scope);
        let mut found: Vec<DefinitionId> = members.iter().map(|member| member.id).collect();
        found.sort_unstable();
        found.dedup();
        found
    }

    /// What describes entries of an object; what the maker takes from a library as it is, the library describes.
    fn members<'s>(
        &'s self,
        known: &Known<'_>,
        file: FileId,
        (index, first, last): (Index, SubIndex, SubIndex),
        scope: Devices<'_>,
    ) -> Vec<&'s Member<'t>> {
        let mut found = Vec::new();
        for one in self.of(known, file, index, scope) {
            let of_maker = one.about(first, last);
            if of_maker.is_empty() {
                found.extend(self.below(known, one, index).flat_map(|below| below.about(first, last)));
            }
            found.extend(of_maker);
        }
        found
    }

    /// What a library says of an object that is taken from it.
    fn below<'s>(
        &'s self,
        known: &Known<'_>,
        over: &Described<'_>,
        index: Index,
    ) -> impl Iterator<Item = &'s Described<'t>> {
        let library = over.from.and_then(|from| known.library(from));
        let files: Vec<FileId> = self.at(index).map(|one| known.definition(one.id).key.file).collect();
        let all = self.at(index).zip(files);
        all.filter(move |(_, file)| Some(*file) == library).map(|(one, _)| one)
    }

    /// The name of the type of an entry, as the texts say it.
    pub(super) fn type_of(
        &self,
        known: &Known<'_>,
        file: FileId,
        EntryId { index, sub }: EntryId,
        scope: Devices<'_>,
    ) -> Option<&'t str> {
        let members = self.members(known, file, (index, sub, sub), scope);
        let of_member = || members.iter().find_map(|member| member.type_name);
        let objects = self.of(known, file, index, scope);
        let of_object = objects.iter().find_map(|one| {
            one.type_name.or_else(|| self.below(known, one, index).find_map(|below| below.type_name))
        });
        of_member().or(of_object)
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
        let whole: Vec<&Described<'_>> = self.by_name(name, scope).collect();
        if let Some(one) = whole.first() {
            return Some(NamedParts {
                first: EntryId { index: one.first, sub: SubIndex(0) },
                object_length: name.len(),
                objects: whole.iter().map(|one| one.id).collect(),
                entries: Vec::new(),
            });
        }
        name.match_indices('.').find_map(|(dot, _)| {
            let (object, entry) = (&name[..dot], &name[dot + 1..]);
            let found = self.by_name(object, scope).flat_map(|one| {
                let all = one.members.iter().chain(&one.elements);
                all.filter(|member| member.is_called(entry)).map(move |member| (one, member))
            });
            let found: Vec<(&Described<'_>, &Member<'_>)> = found.collect();
            let (one, member) = found.first()?;
            Some(NamedParts {
                first: EntryId { index: one.first, sub: member.first },
                object_length: dot,
                objects: found.iter().map(|(one, _)| one.id).collect(),
                entries: found.iter().map(|(_, member)| member.id).collect(),
            })
        })
    }
}

/// The text of a key.
fn text_of<'t>(node: &'t Node, key: &str) -> Option<&'t str> {
    node.get(key).and_then(Node::text).map(|text| text.value)
}

impl<'t> Member<'t> {
    /// Adds what describes entries of an object; without a name, a number stands for it.
    fn add(
        known: &mut Known<'t>,
        owner: DefinitionId,
        number: Spanned<&str>,
        (first, last): (SubIndex, SubIndex),
        node: &'t Node,
    ) -> Self {
        let name = node.get("name").and_then(Node::text);
        let entry = Definition {
            owner: Some(owner),
            subs: Some((first, last)),
            ..definition(Kind::Entry, name.unwrap_or(Spanned::new("", number.span)), number.span)
        };
        let id = known.add(spelt(entry, name.is_some(), || number.value.to_owned()));
        Self { first, last, id, name: name.map(|name| name.value), type_name: text_of(node, "type") }
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
    pub(super) fn has(self, key: &str) -> bool {
        match self {
            Devices::All => true,
            Devices::Only(list) => list.contains(&key),
        }
    }
}
