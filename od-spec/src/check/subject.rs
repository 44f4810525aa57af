//! What a rule looks at: one device, as a type that may become any node, or as one configured node.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::RangeInclusive;

use super::standard::Standard;
use crate::diag::{Code, Diagnostic};
use crate::model::{
    Author, Dictionary, Entry, EntryId, EntryRef, Fact, Held, Index, Object, Ratio, SubIndex, System, Value,
    Values,
};
use crate::source::{FileId, Span};
use crate::wording::FileFormat;

/// One device under the rules.
#[derive(Clone, Copy)]
pub(crate) struct Subject<'a> {
    /// Everything that the specification describes.
    pub system: &'a System,
    /// The device, with the settings laid over its defaults where it is a configured node.
    pub device: &'a Dictionary,
    /// The node-ID of a configured node; `None` for a type.
    pub node: Option<u8>,
    /// What CiA 301 says about objects.
    pub standard: Standard,
    /// How the file of the device is written, where it is not a specification.
    pub format: FileFormat,
}

impl<'a> Subject<'a> {
    /// The node-IDs that the device can have.
    pub(super) fn nodes(&self) -> RangeInclusive<u8> {
        self.node.map_or(1..=127, |node| node..=node)
    }

    /// The node-IDs on which a value may differ: one is enough for a value that is not a formula.
    pub(super) fn nodes_of(&self, value: &Value) -> RangeInclusive<u8> {
        match value {
            Value::NodeId(_) => self.nodes(),
            Value::Integer(_) | Value::Real(_) | Value::Text(_) | Value::Bytes(_) => {
                let first = *self.nodes().start();
                first..=first
            }
        }
    }

    /// ` on node 5`, where a value depends on the node-ID and the device may have any.
    pub(super) fn on_node(&self, value: &Value, node: u8) -> String {
        if self.node.is_none() && matches!(value, Value::NodeId(_)) {
            format!(" on node {node}")
        } else {
            String::new()
        }
    }

    /// Adds to a message about an entry that its value was set through a view of it.
    pub(super) fn seen_through(&self, id: EntryId, diagnostic: Diagnostic) -> Diagnostic {
        match self.device.views_of(id).find(|view| view.entry.is_set()) {
            Some(view) => diagnostic.note(format!("{} is a view of {id}", view.id)),
            None => diagnostic,
        }
    }

    /// Entries with a value, and that value.
    pub(super) fn values(&self) -> impl Iterator<Item = (EntryId, &'a Entry, &'a Value)> {
        self.device.entries().filter_map(|(id, _, entry)| Some((id, entry, entry.default.as_ref()?)))
    }

    /// Where a fact of an entry is written; the place of the device for what a library says, which is right.
    pub(super) fn place(&self, entry: &Entry, fact: Fact) -> Span {
        match entry.facts.get(fact) {
            Some(statement) if statement.author == Author::Library => self.device.span,
            Some(statement) => statement.span,
            None if entry.span.file.is_one_with(self.device.span.file) => entry.span,
            None => self.device.span,
        }
    }

    /// Where an object is written; the place of the device for one that a library brings.
    pub(super) fn object_place(&self, object: &Object) -> Span {
        if object.span.file.is_one_with(self.device.span.file) { object.span } else { self.device.span }
    }

    /// The entries that are set by name, with the place of each setting.
    pub(super) fn set_entries(&self) -> impl Iterator<Item = (EntryId, &'a Entry, Span)> {
        let subject = *self;
        let set = self.device.entries().filter(|(.., entry)| entry.is_set());
        set.map(move |(id, _, entry)| (id, entry, subject.place(entry, Fact::Default)))
    }

    /// A finding about a fact of an entry.
    pub(super) fn finding(
        &self,
        code: &'static Code,
        id: EntryId,
        entry: &Entry,
        fact: Fact,
        message: impl Into<String>,
    ) -> Diagnostic {
        Diagnostic::new(code, self.place(entry, fact), message).about((id, fact))
    }

    /// A finding about an object.
    pub(super) fn object_finding(
        &self,
        code: &'static Code,
        object: &Object,
        message: impl Into<String>,
    ) -> Diagnostic {
        Diagnostic::new(code, self.object_place(object), message).about(object.index)
    }

    /// The files in which settings are; none for a type.
    pub(super) fn settings(&self) -> BTreeSet<FileId> {
        if self.node.is_none() {
            return BTreeSet::new();
        }
        self.set_entries().map(|(.., place)| place.file).collect()
    }

    /// The device that a condition means.
    fn named(&self, entry: &EntryRef) -> Option<&'a Dictionary> {
        entry.device.as_deref().map_or(Some(self.device), |key| self.device_of(key))
    }

    /// The device with a key.
    pub(super) fn device_of(&self, key: &str) -> Option<&'a Dictionary> {
        if key == self.device.key { Some(self.device) } else { self.system.device(key) }
    }

    /// The entry that a condition names, and where its value is written.
    pub(super) fn named_entry(&self, entry: &EntryRef) -> Option<(&'a Entry, Span)> {
        let found = self.named(entry)?.entry(entry.id)?;
        Some((found, found.place(Fact::Default)))
    }
}

/// An index and a sub-index.
pub(super) const fn entry_id(index: u16, sub: u8) -> EntryId {
    EntryId { index: Index(index), sub: SubIndex(sub) }
}

/// Nothing is written over the values of the device: settings are laid over its defaults already.
static NOTHING_WRITTEN: BTreeMap<EntryId, i128> = BTreeMap::new();

impl<'a> Subject<'a> {
    const fn held(&self) -> Held<'a> {
        Held { system: self.system, device: self.device, node: self.node, written: &NOTHING_WRITTEN }
    }
}

/// The values of a device, in physical units.
impl Values for Subject<'_> {
    fn value(&self, entry: &EntryRef) -> Option<Ratio> {
        self.held().value(entry)
    }

    fn raw(&self, entry: &EntryRef) -> Option<i128> {
        self.held().raw(entry)
    }
}
