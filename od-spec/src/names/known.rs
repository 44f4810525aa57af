//! All that the texts define, and which of it a text means by a name or a number.

use std::collections::BTreeMap;

use super::objects::{Described, Devices, Member, Objects};
use super::{Definition, DefinitionId, Kind};
use crate::model::{EntryId, Index, SubIndex};
use crate::source::{FileId, Span};

/// In what a name has to be unique.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Scope {
    /// In all files together.
    Everywhere,
    /// In something that is defined.
    In(DefinitionId),
    /// In what is described at a place, which has no name.
    At(Span),
}

/// All definitions, and how they are found.
pub(super) struct Known<'t> {
    /// The maker's file.
    root: FileId,
    list: Vec<Definition>,
    by_name: BTreeMap<(Kind, Scope, &'t str), Vec<DefinitionId>>,
    /// Error codes from the first to the last.
    errors: Vec<(u16, u16, DefinitionId)>,
    pub(super) objects: Objects<'t>,
}

impl<'t> Known<'t> {
    /// Nothing yet.
    pub(super) fn new(root: FileId) -> Self {
        Self {
            root,
            list: Vec::new(),
            by_name: BTreeMap::new(),
            errors: Vec::new(),
            objects: Objects::default(),
        }
    }

    pub(super) fn into_list(self) -> Vec<Definition> {
        self.list
    }

    pub(super) fn definition(&self, id: DefinitionId) -> &Definition {
        &self.list[id.0 as usize]
    }

    pub(super) fn definition_mut(&mut self, id: DefinitionId) -> &mut Definition {
        &mut self.list[id.0 as usize]
    }

    /// What has a name, as a text of `file` means it: what it defines itself, or else the maker, or else the first library.
    pub(super) fn named(&self, kind: Kind, scope: Scope, name: &str, file: FileId) -> Option<DefinitionId> {
        let all = self.by_name.get(&(kind, scope, name))?;
        let is_in = |file: FileId| {
            all.iter().find(move |id| self.definition(**id).span.file.is_one_with(file)).copied()
        };
        is_in(file).or_else(|| is_in(self.root)).or_else(|| all.first().copied())
    }

    /// The file of a library, by the name that `from:` has for it.
    pub(super) fn library(&self, name: &str) -> Option<FileId> {
        let first = self.by_name.get(&(Kind::Library, Scope::Everywhere, name))?.first()?;
        Some(self.definition(*first).span.file)
    }

    /// All that has a name: a state machine of the maker lies over that of a library.
    pub(super) fn all_named(&self, kind: Kind, scope: Scope, name: &str) -> Vec<DefinitionId> {
        self.by_name.get(&(kind, scope, name)).cloned().unwrap_or_default()
    }

    /// The error codes of a run, as a text of `file` means them.
    pub(super) fn errors(&self, first: u16, last: u16, file: FileId) -> Vec<DefinitionId> {
        let found =
            || self.errors.iter().filter(|(from, to, _)| *from <= last && first <= *to).map(|one| one.2);
        let of_file = |file: FileId| -> Vec<DefinitionId> {
            found().filter(|id| self.definition(*id).span.file.is_one_with(file)).collect()
        };
        let of_maker = of_file(file);
        if of_maker.is_empty() { found().collect() } else { of_maker }
    }

    pub(super) fn add(&mut self, definition: Definition) -> DefinitionId {
        // There are fewer definitions than bytes.
        let id = DefinitionId(u32::try_from(self.list.len()).unwrap_or(u32::MAX));
        self.list.push(definition);
        id
    }

    /// Adds something that is found by a name.
    pub(super) fn add_named(
        &mut self,
        (kind, scope, name): (Kind, Scope, &'t str),
        definition: Definition,
    ) -> DefinitionId {
        let id = self.add(definition);
        self.by_name.entry((kind, scope, name)).or_default().push(id);
        id
    }

    /// Adds error codes from the first to the last.
    pub(super) fn add_errors(&mut self, (first, last): (u16, u16), definition: Definition) {
        let id = self.add(definition);
        self.errors.push((first, last, id));
    }
}

/// Objects and entries, by their numbers.
impl<'t> Known<'t> {
    /// What describes an index for some devices, as a text of `file` means it.
    fn described<'s>(&'s self, file: FileId, index: Index, scope: Devices<'_>) -> Vec<&'s Described<'t>> {
        let all: Vec<&Described<'_>> = self.objects.at(index).filter(|one| one.is_for(scope)).collect();
        let written_in = |file: FileId| -> Vec<&Described<'_>> {
            let is_in = |one: &&Described<'_>| one.file.is_one_with(file);
            all.iter().copied().filter(is_in).collect()
        };
        [written_in(file), written_in(self.root)].into_iter().find(|some| !some.is_empty()).unwrap_or(all)
    }

    /// The descriptions of an object.
    pub(super) fn object(&self, file: FileId, index: Index, scope: Devices<'_>) -> Vec<DefinitionId> {
        let described = self.described(file, index, scope);
        if !described.is_empty() {
            return described.iter().map(|one| one.id).collect();
        }
        self.objects.pdo(index, scope)
    }

    /// The descriptions of entries of an object; where none is described by itself, nothing.
    pub(super) fn entries(
        &self,
        file: FileId,
        (index, first, last): (Index, SubIndex, SubIndex),
        scope: Devices<'_>,
    ) -> Vec<DefinitionId> {
        let members = self.members(file, (index, first, last), scope);
        let mut found: Vec<DefinitionId> = members.iter().map(|member| member.id).collect();
        found.sort_unstable();
        found.dedup();
        found
    }

    /// What describes entries of an object; what the maker takes from a library as it is, the library describes.
    fn members<'s>(
        &'s self,
        file: FileId,
        (index, first, last): (Index, SubIndex, SubIndex),
        scope: Devices<'_>,
    ) -> Vec<&'s Member<'t>> {
        let mut found = Vec::new();
        for one in self.described(file, index, scope) {
            let of_maker = one.about(first, last);
            if of_maker.is_empty() {
                found.extend(self.below(one, index).flat_map(|below| below.about(first, last)));
            }
            found.extend(of_maker);
        }
        found
    }

    /// What a library says of an object that is taken from it.
    fn below<'s>(&'s self, over: &Described<'_>, index: Index) -> impl Iterator<Item = &'s Described<'t>> {
        let library = over.from.and_then(|from| self.library(from));
        self.objects.at(index).filter(move |one| Some(one.file) == library)
    }

    /// The name of the type of an entry, as the texts say it.
    pub(super) fn type_of_entry(
        &self,
        file: FileId,
        EntryId { index, sub }: EntryId,
        scope: Devices<'_>,
    ) -> Option<&'t str> {
        let members = self.members(file, (index, sub, sub), scope);
        let of_member = || members.iter().find_map(|member| member.type_name);
        let objects = self.described(file, index, scope);
        let of_object = objects.iter().find_map(|one| {
            one.type_name.or_else(|| self.below(one, index).find_map(|below| below.type_name))
        });
        of_member().or(of_object)
    }
}
