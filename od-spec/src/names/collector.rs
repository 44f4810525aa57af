//! What references are collected with: where a scalar is, and how what it refers to is found and noted.

use std::collections::BTreeSet;
use std::ops::Range;

use super::known::{Known, Scope};
use super::objects::Devices;
use super::resolved::Resolved;
use super::walk::{Step, devices_of};
use super::{By, DefinitionId, DeviceKeys, Kind, Reference};
use crate::decode::inside;
use crate::expr::PLACEHOLDER;
use crate::keys::Keys;
use crate::model::{EntryId, Index, SubIndex};
use crate::source::{FileId, SourceMap, Span, Spanned};
use crate::yaml::Node;

/// A scalar, and what leads to it.
#[derive(Clone, Copy)]
pub(super) struct At<'p, 't> {
    pub text: Spanned<&'t str>,
    pub path: &'p [Step<'t>],
}

impl<'t> At<'_, 't> {
    pub(super) fn file(&self) -> FileId {
        self.text.span.file
    }

    /// The maps with fixed keys around it, from the inside, each with the key that leads to it.
    pub(super) fn maps(&self) -> impl Iterator<Item = (&'t Node, &'static Keys, &'static str)> {
        self.path.iter().rev().filter_map(|step| match step {
            Step::Key { map, keys, key, .. } => Some((*map, *keys, key.name)),
            Step::Data { .. } | Step::Item { .. } => None,
        })
    }

    /// The value of a key of the innermost map, next to it.
    pub(super) fn beside(&self, key: &str) -> Option<&'t Node> {
        self.maps().next().and_then(|(map, ..)| map.get(key))
    }

    /// The innermost map that a key leads into.
    pub(super) fn around(&self, key: &str) -> Option<&'t Node> {
        self.maps().find(|(_, _, name)| *name == key).map(|(map, ..)| map)
    }

    /// The keys of the devices that it speaks of; empty for all.
    pub(super) fn devices(&self) -> Vec<&'t str> {
        devices_of(self.path)
    }
}

/// The devices of a list, of which an empty one means all.
pub(super) const fn scope<'d>(devices: &'d [&'d str]) -> Devices<'d> {
    if devices.is_empty() { Devices::All } else { Devices::Only(devices) }
}

pub(super) struct Collector<'a, 't> {
    sources: &'a SourceMap,
    pub(super) known: &'a Known<'t>,
    pub(super) resolved: &'a Resolved<'a>,
    /// What parameter files and plants call the devices.
    pub(super) devices: &'a DeviceKeys,
    found: Vec<Reference>,
    /// Scalars that an alias shows a second time.
    seen: BTreeSet<Span>,
}

impl<'a, 't> Collector<'a, 't> {
    pub(super) fn new(
        sources: &'a SourceMap,
        known: &'a Known<'t>,
        resolved: &'a Resolved<'a>,
        devices: &'a DeviceKeys,
    ) -> Self {
        Self { sources, known, resolved, devices, found: Vec::new(), seen: BTreeSet::new() }
    }

    /// How many references there are by now.
    pub(super) fn len(&self) -> usize {
        self.found.len()
    }

    pub(super) fn into_found(self) -> Vec<Reference> {
        self.found
    }

    pub(super) fn type_of(&self, name: &str, file: FileId) -> Option<DefinitionId> {
        self.known.named(Kind::Type, Scope::Everywhere, name, file)
    }

    /// An entry by index; `range` is where it is in the text.
    pub(super) fn numbered(
        &mut self,
        at: At<'_, 't>,
        (index, sub): (Index, SubIndex),
        range: Range<usize>,
        devices: &[&str],
    ) {
        self.numbered_run(at, (index, sub, sub), range, devices);
    }

    pub(super) fn numbered_run(
        &mut self,
        at: At<'_, 't>,
        (index, first, last): (Index, SubIndex, SubIndex),
        range: Range<usize>,
        devices: &[&str],
    ) {
        let text = &at.text.value[range.clone()];
        let object = self.known.object(at.file(), index, scope(devices));
        let end = text.find('.').map_or(range.end, |dot| range.start + dot);
        let before = self.found.len();
        self.add(at, range.start..end, Kind::Object, By::Number, object);
        let sub = end + 1..range.end;
        if sub.start < sub.end {
            let entries = if at.text.value[sub.clone()].contains(PLACEHOLDER) {
                Vec::new()
            } else {
                self.known.entries(at.file(), (index, first, last), scope(devices))
            };
            self.add(at, sub, Kind::Entry, By::Number, entries);
        }
        self.are(before, EntryId { index, sub: first });
    }

    /// The references that were added since are to an entry.
    pub(super) fn are(&mut self, before: usize, id: EntryId) {
        for reference in self.found.iter_mut().skip(before) {
            reference.entry = Some(id);
        }
    }

    /// An entry by name; `range` is where the name is in the text.
    pub(super) fn named_entry(&mut self, at: At<'_, 't>, range: Range<usize>, name: &str, devices: &[&str]) {
        let written = &at.text.value[range.clone()];
        let by = if written == name { By::Name } else { By::Pattern };
        let (mut object_by, mut entry_by) = (by, by);
        let (mut parts, mut objects, mut entries) = (None, Vec::new(), Vec::new());
        let (before, mut first) = (self.found.len(), None);
        for (device, id) in self.resolved.named(name, scope(devices)) {
            first.get_or_insert(id);
            let key = [device.key.as_str()];
            let Some(object) = device.objects.get(&id.index) else { continue };
            let leads = |text: &&str| {
                name.strip_prefix(*text).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
            };
            let texts = [Some(object.name.as_str()), object.identifier.as_deref()];
            let length = texts.into_iter().flatten().find(leads).map_or(name.len(), str::len);
            parts.get_or_insert(length);
            let entry = object.entry(id.sub).filter(|_| length < name.len());
            if by == By::Name && name[..length] != object.name {
                object_by = By::Identifier;
            }
            if by == By::Name && entry.is_some_and(|entry| name[length + 1..] != entry.name) {
                entry_by = By::Identifier;
            }
            objects.extend(self.known.object(at.file(), id.index, Devices::Only(&key)));
            if length < name.len() {
                let subs = (id.index, id.sub, id.sub);
                entries.extend(self.known.entries(at.file(), subs, Devices::Only(&key)));
            }
        }
        if parts.is_none()
            && let Some(found) = self.known.objects.named(name, scope(devices))
        {
            parts = Some(found.object_length);
            first = Some(found.first);
            (objects, entries) = (found.objects, found.entries);
        }
        for list in [&mut objects, &mut entries] {
            list.sort_unstable();
            list.dedup();
        }
        // With placeholders written out, parts have other lengths: both are the whole.
        let object_end = parts.filter(|_| by == By::Name).map_or(range.end, |length| range.start + length);
        self.add(at, range.start..object_end, Kind::Object, object_by, objects);
        if object_end + 1 < range.end || by == By::Pattern && !entries.is_empty() {
            let entry = if by == By::Name { object_end + 1..range.end } else { range };
            self.add(at, entry, Kind::Entry, entry_by, entries);
        }
        if let Some(id) = first {
            self.are(before, id);
        }
    }

    pub(super) fn objects(&self, at: At<'_, 't>, index: Index) -> Vec<DefinitionId> {
        self.known.object(at.file(), index, scope(&at.devices()))
    }

    /// Whether the scalar was not looked at before.
    pub(super) fn is_new(&mut self, at: At<'_, 't>) -> bool {
        self.seen.insert(at.text.span)
    }

    /// The whole scalar refers to something.
    pub(super) fn whole(
        &mut self,
        at: At<'_, 't>,
        kind: Kind,
        by: By,
        targets: impl IntoIterator<Item = DefinitionId>,
    ) {
        if self.is_new(at) {
            self.add(at, 0..at.text.value.len(), kind, by, targets.into_iter().collect());
        }
    }

    /// A part of the scalar refers to something.
    pub(super) fn add(
        &mut self,
        at: At<'_, 't>,
        range: Range<usize>,
        kind: Kind,
        by: By,
        targets: Vec<DefinitionId>,
    ) {
        let scalar = at.text.span;
        let part = if range == (0..at.text.value.len()) { scalar } else { inside(at.text, &range) };
        let is_exact = part == scalar || self.sources.text(part) == &at.text.value[range.clone()];
        let span = if is_exact { part } else { scalar };
        self.found.push(Reference { span, scalar, range, kind, by, targets, entry: None });
    }
}
