//! Objects and entries, as files describe them.

use super::DefinitionId;
use crate::expr::PLACEHOLDER;
use crate::model::{EntryId, Index, SubIndex};
use crate::order::Arrange as _;
use crate::source::FileId;

/// What a file says of an object or a run of objects.
pub(super) struct Described<'t> {
    pub first: Index,
    pub last: Index,
    pub id: DefinitionId,
    /// The file that says it.
    pub file: FileId,
    /// The devices that have it; `None` for all.
    pub devices: Option<Vec<&'t str>>,
    /// The library that it is taken from.
    pub from: Option<&'t str>,
    pub name: Option<&'t str>,
    pub identifier: Option<&'t str>,
    pub type_name: Option<&'t str>,
    /// Members, elements and sub-index 0.
    pub members: Vec<Member<'t>>,
    /// What represents the elements of an array that have no description of their own.
    pub elements: Option<Member<'t>>,
}

/// What a file says of an entry or a run of entries.
pub(super) struct Member<'t> {
    pub first: SubIndex,
    pub last: SubIndex,
    pub id: DefinitionId,
    pub name: Option<&'t str>,
    pub identifier: Option<&'t str>,
    pub type_name: Option<&'t str>,
}

impl Member<'_> {
    fn has_any(&self, first: SubIndex, last: SubIndex) -> bool {
        self.first <= last && first <= self.last
    }

    fn is_called(&self, name: &str) -> bool {
        [self.name, self.identifier].into_iter().flatten().any(|known| fits(known, name))
    }
}

impl<'t> Described<'t> {
    /// What describes some of its entries: what is about them alone, and where that has no name, what is about all.
    pub(super) fn about(&self, first: SubIndex, last: SubIndex) -> Vec<&Member<'t>> {
        let mut found: Vec<_> = self.members.iter().filter(|member| member.has_any(first, last)).collect();
        if found.iter().all(|member| member.name.is_none()) {
            found.extend(self.elements.iter().filter(|all| all.has_any(first, last)));
        }
        found
    }

    pub(super) fn is_for(&self, scope: Devices<'_>) -> bool {
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
    pub(super) fn add(&mut self, one: Described<'t>) {
        self.longest_run = self.longest_run.max(one.last.0 - one.first.0);
        self.described.push(one);
    }

    pub(super) fn add_pdo(&mut self, index: Index, device: &'t str, id: DefinitionId) {
        self.pdos.push((index, device, id));
    }

    /// Where the PDO is that an index is a parameter of.
    pub(super) fn pdo(&self, index: Index, scope: Devices<'_>) -> Vec<DefinitionId> {
        let is_of_pdo = |(communication, device, _): &&(Index, &str, DefinitionId)| {
            scope.has(device) && (*communication == index || communication.0 + 0x200 == index.0)
        };
        self.pdos.iter().filter(is_of_pdo).map(|(_, _, id)| *id).collect()
    }

    /// Puts the descriptions in the order of their indices.
    pub(super) fn sort(&mut self) {
        self.described.arrange_by_key(|one| one.first);
    }

    /// What describes an index.
    pub(super) fn at(&self, index: Index) -> impl Iterator<Item = &Described<'t>> {
        let earliest = Index(index.0.saturating_sub(self.longest_run));
        let first = self.described.partition_point(|one| one.first < earliest);
        self.described[first..]
            .iter()
            .take_while(move |one| one.first <= index)
            .filter(move |one| one.last >= index)
    }

    /// The objects that are written with a name or identifier, or with one that it fits.
    fn by_name<'s>(&'s self, name: &'s str, scope: Devices<'s>) -> impl Iterator<Item = &'s Described<'t>> {
        self.described.iter().filter(move |one| one.is_for(scope)).filter(move |one| {
            [one.name, one.identifier].into_iter().flatten().any(|known| fits(known, name))
        })
    }

    /// What a name means where no model states it.
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

/// Whether a name is one that may have a placeholder.
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
