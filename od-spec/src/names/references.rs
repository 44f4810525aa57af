//! What the scalars of a text refer to.

use std::collections::BTreeSet;
use std::ops::Range;

use super::conditions;
use super::definitions::{Known, Scope};
use super::meant::Meant;
use super::objects::Devices;
use super::walk::{Role, Step, Visitor, devices_of, walk};
use super::{By, DefinitionId, Kind, Reference};
use crate::decode::{inside, lexical};
use crate::eds::file_name;
use crate::expr::{Expr, PLACEHOLDER};
use crate::keys::{COMMAND, KeyKind, Keys, NameOf, PART, PART_OF, SIGNAL, SPEC, Shape};
use crate::model::{DataType, EntryId, Index, SubIndex, System};
use crate::source::{FileId, SourceMap, Span, Spanned};
use crate::yaml::Node;

/// Reads all references, by place.
pub(super) fn collect<'t>(
    sources: &SourceMap,
    root: FileId,
    trees: &[(FileId, &'t Node)],
    known: &Known<'t>,
    system: Option<&System>,
) -> Vec<Reference> {
    let meant = Meant::of(system);
    let mut all = Collector { sources, known, meant: &meant, found: Vec::new(), seen: BTreeSet::new() };
    for (file, tree) in trees {
        let is_part = file.is_one_with(root) && tree.get(PART_OF).is_some();
        walk(tree, if is_part { &PART } else { &SPEC }, &mut all);
    }
    let mut found = all.found;
    found.sort_by_key(|one| (one.span, one.range.start));
    found
}

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
    fn maps(&self) -> impl Iterator<Item = (&'t Node, &'static Keys, &'static str)> {
        self.path.iter().rev().filter_map(|step| match step {
            Step::Key { map, keys, key, .. } => Some((*map, *keys, key.name)),
            Step::Data { .. } | Step::Item { .. } => None,
        })
    }

    /// The value beside it of a key of the innermost map.
    pub(super) fn beside(&self, key: &str) -> Option<&'t Node> {
        self.maps().next().and_then(|(map, ..)| map.get(key))
    }

    /// The innermost map that a key leads into.
    fn around(&self, key: &str) -> Option<&'t Node> {
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
    pub(super) meant: &'a Meant<'a>,
    found: Vec<Reference>,
    /// Scalars that an alias shows a second time.
    seen: BTreeSet<Span>,
}

impl<'t> Visitor<'t> for Collector<'_, 't> {
    fn scalar(&mut self, text: Spanned<&'t str>, role: Role, path: &[Step<'t>]) {
        let at = At { text, path };
        match role {
            Role::Key(KeyKind::Device) => self.device(at),
            Role::FeatureKey | Role::Value(Shape::Feature) => self.feature(at),
            Role::DefaultKey if matches!(path, [.., Step::Item { .. }, Step::Data { .. }]) => self.value(at),
            Role::DefaultKey => self.device(at),
            Role::Value(shape) => self.of_shape(at, shape),
            Role::Key(_) => {}
        }
    }
}

impl<'t> Collector<'_, 't> {
    fn of_shape(&mut self, at: At<'_, 't>, shape: Shape) {
        match shape {
            Shape::NameOf(of) => self.name_of(at, of),
            Shape::Type => self.type_name(at),
            Shape::Entry | Shape::Entries => self.entry(at),
            Shape::Index => {
                let before = self.found.len();
                let index = lexical::index(at.text.value);
                let targets = index.map(|index| self.objects(at, index)).unwrap_or_default();
                self.whole(at, Kind::Object, By::Number, targets);
                if let Some(index) = index {
                    self.are(before, EntryId { index, sub: SubIndex(0) });
                }
            }
            Shape::ErrorCode => self.errors(at),
            Shape::Condition if self.is_new(at) => conditions::condition(self, at),
            Shape::Formula if self.is_new(at) => {
                let term = Expr::parse_term(at.text.value).ok();
                for (entry, range) in
                    term.iter().flat_map(|term| term.entries().into_iter().zip(term.places.iter().cloned()))
                {
                    self.numbered(at, (entry.id.index, entry.id.sub), range, &[]);
                }
            }
            Shape::Value | Shape::Default => self.value(at),
            Shape::Integer(..)
                if at
                    .maps()
                    .next()
                    .is_some_and(|(_, keys, key)| keys.name == COMMAND.name && key == "transitions") =>
            {
                self.of_machine(at, Kind::Transition, By::Number);
            }
            _ => {}
        }
    }

    fn name_of(&mut self, at: At<'_, 't>, of: NameOf) {
        let text = at.text.value;
        let everywhere = |kind| self.known.named(kind, Scope::Everywhere, text, at.file());
        match of {
            NameOf::Unit => self.whole(at, Kind::Unit, By::Name, everywhere(Kind::Unit)),
            NameOf::NamedType => self.whole(at, Kind::Type, By::Name, everywhere(Kind::Type)),
            NameOf::DataType => self.whole(at, Kind::Type, By::Word, None),
            NameOf::Library => self.whole(at, Kind::Library, By::Name, everywhere(Kind::Library)),
            NameOf::LibraryFile | NameOf::File => {
                let file = self.known.named(Kind::File, Scope::Everywhere, file_name(text), at.file());
                let kind = if of == NameOf::File { Kind::File } else { Kind::Library };
                self.whole(at, kind, By::Word, file);
            }
            NameOf::Device => self.device(at),
            NameOf::Feature => self.feature(at),
            NameOf::Bit => {
                let by = if crate::scalar::integer(text).is_ok() { By::Number } else { By::Name };
                let owner = at
                    .beside("type")
                    .and_then(Node::text)
                    .and_then(|name| self.type_of(name.value, at.file()));
                let bit =
                    owner.and_then(|owner| self.known.named(Kind::Bit, Scope::In(owner), text, at.file()));
                self.whole(at, Kind::Bit, by, bit);
            }
            NameOf::State if matches!(text, "start" | "any") => self.whole(at, Kind::State, By::Word, None),
            NameOf::State => self.of_machine(at, Kind::State, By::Name),
            NameOf::Machine => self.whole(at, Kind::Machine, By::Name, everywhere(Kind::Machine)),
            NameOf::Constraint => self.whole(at, Kind::Constraint, By::Name, everywhere(Kind::Constraint)),
            NameOf::Errors if text == "all" => self.whole(at, Kind::Error, By::Word, None),
            NameOf::Errors => self.errors(at),
            NameOf::Block | NameOf::Mark => {
                let (kind, key) = match of {
                    NameOf::Mark => (Kind::Mark, "axis"),
                    _ => (Kind::Block, "flow"),
                };
                let picture = at.around(key).map(|content| Scope::At(content.span));
                let found = picture.and_then(|scope| self.known.named(kind, scope, text, at.file()));
                self.whole(at, kind, By::Name, found);
            }
        }
    }

    fn device(&mut self, at: At<'_, 't>) {
        let device = self.known.named(Kind::Device, Scope::Everywhere, at.text.value, at.file());
        self.whole(at, Kind::Device, By::Name, device);
    }

    fn feature(&mut self, at: At<'_, 't>) {
        let feature = self.known.named(Kind::Feature, Scope::Everywhere, at.text.value, at.file());
        self.whole(at, Kind::Feature, By::Name, feature);
    }

    fn errors(&mut self, at: At<'_, 't>) {
        let codes = lexical::error_codes(at.text.value);
        let found = codes.map(|codes| self.known.errors(codes.first, codes.last, at.file()));
        self.whole(at, Kind::Error, By::Number, found.unwrap_or_default());
    }

    fn type_name(&mut self, at: At<'_, 't>) {
        match DataType::from_name(at.text.value) {
            Some(_) => self.whole(at, Kind::Type, By::Word, None),
            None => {
                let found = self.type_of(at.text.value, at.file());
                self.whole(at, Kind::Type, By::Name, found);
            }
        }
    }

    pub(super) fn type_of(&self, name: &str, file: FileId) -> Option<DefinitionId> {
        self.known.named(Kind::Type, Scope::Everywhere, name, file)
    }

    /// Something of the state machine around: the maker's, or that of the library that it lies over.
    fn of_machine(&mut self, at: At<'_, 't>, kind: Kind, by: By) {
        let machine = at.path.iter().find_map(|step| match step {
            Step::Data { kind: KeyKind::Name, name, .. } => Some(name.value.as_str()),
            Step::Data { .. } | Step::Key { .. } | Step::Item { .. } => None,
        });
        let machine = machine.unwrap_or_default();
        let machines = self.known.all_named(Kind::Machine, Scope::Everywhere, machine);
        let own = |id: &&DefinitionId| self.known.definition(**id).span.file.is_one_with(at.file());
        let in_order = machines.iter().filter(own).chain(machines.iter().filter(|id| !own(id)));
        let mut found =
            in_order.filter_map(|id| self.known.named(kind, Scope::In(*id), at.text.value, at.file()));
        let found = found.next();
        self.whole(at, kind, by, found);
    }

    /// The name of a value or bit, where the type is a named one; a number names nothing.
    fn value(&mut self, at: At<'_, 't>) {
        let Some(owner) = self.type_around(at) else { return };
        let of = |kind| self.known.named(kind, Scope::In(owner), at.text.value, at.file());
        // `{mode: homing}`: a value of a run of bits.
        let run = match at.path {
            [.., Step::Item { .. }, Step::Data { name, .. }] if name.span != at.text.span => {
                self.known.named(Kind::Bit, Scope::In(owner), &name.value, at.file())
            }
            _ => None,
        };
        if let Some(run) = run {
            let value = self.known.named(Kind::Value, Scope::In(run), at.text.value, at.file());
            if value.is_some() {
                self.whole(at, Kind::Value, By::Name, value);
            }
        } else if let Some(value) = of(Kind::Value) {
            self.whole(at, Kind::Value, By::Name, Some(value));
        } else if let Some(bit) = of(Kind::Bit) {
            self.whole(at, Kind::Bit, By::Name, Some(bit));
        }
    }

    /// The named type, or the run of bits, that a value is of.
    fn type_around(&self, at: At<'_, 't>) -> Option<DefinitionId> {
        let named = |node: &Node| self.type_of(node.text()?.value, at.file());
        for (map, keys, _) in at.maps() {
            if keys.name == SIGNAL.name {
                let owner = map.get("type").and_then(named)?;
                let bit = map.get("bit").and_then(Node::text)?;
                return self.known.named(Kind::Bit, Scope::In(owner), bit.value, at.file());
            }
            if let Some(node) = map.get("type").filter(|_| keys.get("type").is_some()) {
                return named(node);
            }
        }
        let meant = self.meant.type_of_value(at.text.span)?;
        self.type_of(meant, at.file())
    }

    /// An entry by index or by name, or a run of entries, or a data type that fills a PDO.
    fn entry(&mut self, at: At<'_, 't>) {
        let text = at.text.value;
        if !self.is_new(at) {
            return;
        }
        let devices = at.devices();
        if let Some(run) = lexical::run_by_index(text) {
            self.numbered_run(at, (run.index, run.subs.first, run.subs.last), 0..text.len(), &devices);
        } else if let Some(one) = lexical::entry_by_index(text) {
            let id = one.id();
            self.numbered_run(at, (id.index, id.sub, id.sub), 0..text.len(), &devices);
        } else if DataType::from_name(text).is_some()
            && at.maps().next().is_some_and(|(_, _, key)| key == "map")
        {
            self.add(at, 0..text.len(), Kind::Type, By::Word, Vec::new());
        } else {
            self.named_entry(at, 0..text.len(), text, &devices);
        }
    }

    /// An entry by index; `range` is where it stands in the text.
    pub(super) fn numbered(
        &mut self,
        at: At<'_, 't>,
        (index, sub): (Index, SubIndex),
        range: Range<usize>,
        devices: &[&str],
    ) {
        self.numbered_run(at, (index, sub, sub), range, devices);
    }

    fn numbered_run(
        &mut self,
        at: At<'_, 't>,
        (index, first, last): (Index, SubIndex, SubIndex),
        range: Range<usize>,
        devices: &[&str],
    ) {
        let text = &at.text.value[range.clone()];
        let object = self.known.objects.object(self.known, at.file(), index, scope(devices));
        let end = text.find('.').map_or(range.end, |dot| range.start + dot);
        let before = self.found.len();
        self.add(at, range.start..end, Kind::Object, By::Number, object);
        let sub = end + 1..range.end;
        if sub.start < sub.end {
            let entries = if at.text.value[sub.clone()].contains(PLACEHOLDER) {
                Vec::new()
            } else {
                self.known.objects.entries(self.known, at.file(), (index, first, last), scope(devices))
            };
            self.add(at, sub, Kind::Entry, By::Number, entries);
        }
        self.are(before, EntryId { index, sub: first });
    }

    /// The references that were added since are to an entry.
    fn are(&mut self, before: usize, id: EntryId) {
        for reference in self.found.iter_mut().skip(before) {
            reference.entry = Some(id);
        }
    }

    /// An entry by name; `range` is where the name stands in the text.
    pub(super) fn named_entry(&mut self, at: At<'_, 't>, range: Range<usize>, name: &str, devices: &[&str]) {
        let written = &at.text.value[range.clone()];
        let by = if written == name { By::Name } else { By::Pattern };
        let (mut parts, mut objects, mut entries) = (None, Vec::new(), Vec::new());
        let (before, mut first) = (self.found.len(), None);
        for (device, id) in self.meant.named(name, scope(devices)) {
            first.get_or_insert(id);
            let key = [device.key.as_str()];
            let Some(object) = device.objects.get(&id.index) else { continue };
            parts.get_or_insert(object.name.len().min(name.len()));
            objects.extend(self.known.objects.object(self.known, at.file(), id.index, Devices::Only(&key)));
            if object.name.len() < name.len() {
                let subs = (id.index, id.sub, id.sub);
                entries.extend(self.known.objects.entries(self.known, at.file(), subs, Devices::Only(&key)));
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
        self.add(at, range.start..object_end, Kind::Object, by, objects);
        if object_end + 1 < range.end || by == By::Pattern && !entries.is_empty() {
            let entry = if by == By::Name { object_end + 1..range.end } else { range };
            self.add(at, entry, Kind::Entry, by, entries);
        }
        if let Some(id) = first {
            self.are(before, id);
        }
    }

    fn objects(&self, at: At<'_, 't>, index: Index) -> Vec<DefinitionId> {
        self.known.objects.object(self.known, at.file(), index, scope(&at.devices()))
    }

    /// Whether the scalar was not looked at before.
    fn is_new(&mut self, at: At<'_, 't>) -> bool {
        self.seen.insert(at.text.span)
    }

    /// The whole scalar refers to something.
    fn whole(&mut self, at: At<'_, 't>, kind: Kind, by: By, targets: impl IntoIterator<Item = DefinitionId>) {
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
