//! Objects and their entries, paired by index and sub-index.

use std::collections::BTreeSet;

use od_spec::model::{
    Dictionary, Entry, EntryId, Fact, Index, Object, Pdo, PdoTarget, Role, SubIndex, Value,
};

use super::change::{Change, Class, Place};
use super::editor::editor;
use super::entries::Pair;
use super::rules;
use super::scope::Scope;
use super::texts::{phrases, texts};
use super::words::{self, WORDS};

/// Two devices that are compared.
#[derive(Clone, Copy)]
pub(super) struct Devices<'a> {
    pub old: &'a Dictionary,
    pub new: &'a Dictionary,
    /// The maker's number on both sides.
    pub vendors: [u32; 2],
    pub scope: Scope,
    pub language: &'a str,
}

impl Devices<'_> {
    /// What differs in objects and entries.
    pub(super) fn objects(self) -> Vec<Change> {
        let indices: BTreeSet<Index> =
            self.old.objects.keys().chain(self.new.objects.keys()).copied().collect();
        let mut changes = Vec::new();
        for index in indices {
            match (self.old.objects.get(&index), self.new.objects.get(&index)) {
                (Some(old), Some(new)) => changes.extend(self.object(old, new)),
                (Some(old), None) => changes.push(
                    Change::removed(Place::Object(index), object(old))
                        .named(&old.name)
                        .so(Class::Plc, "access is aborted, a mapping that holds it is refused"),
                ),
                (None, Some(new)) => changes.push(
                    Change::added(Place::Object(index), object(new))
                        .named(&new.name)
                        .so(Class::Addition, "nothing uses it yet"),
                ),
                (None, None) => {}
            }
        }
        changes.extend(self.pdos());
        changes
    }

    /// Texts about PDOs; everything else about them is in their parameter objects.
    fn pdos(self) -> Vec<Change> {
        let mut changes = Vec::new();
        for new in &self.new.pdos {
            let is_same = |old: &&Pdo| (old.direction, old.number) == (new.direction, new.number);
            let Some(old) = self.old.pdos.iter().find(is_same) else { continue };
            let place = Place::Object(Index(new.communication_index()));
            let name = format!("{} {}", new.direction.pdo(), new.number);
            let found = texts(&place, Fact::About, &old.about, &new.about, self.language);
            changes.extend(found.into_iter().map(|change| change.named(&name)));
        }
        changes
    }

    /// An object that both devices have.
    fn object(self, old: &Object, new: &Object) -> Vec<Change> {
        let mut changes = self.own_facts(old, new);
        let is_structured = old.is_structured() || new.is_structured();
        let subs: BTreeSet<SubIndex> =
            old.entries.iter().chain(&new.entries).map(|entry| entry.sub).collect();
        let map = self.map(old, new);
        for sub in subs {
            let id = EntryId { index: new.index, sub };
            match (old.entry(sub), new.entry(sub)) {
                (Some(before), Some(after)) => {
                    let pair = Pair {
                        id,
                        old: before,
                        new: after,
                        is_structured,
                        scope: self.scope,
                        language: self.language,
                    };
                    let found = pair.changes().into_iter();
                    changes.extend(found.filter(|change| {
                        change.fact != Fact::Default
                            || !(map.is_some() || is_count(old, new, sub) || self.is_told_by_device(id))
                    }));
                }
                (Some(entry), None) => changes.push(
                    Change::removed(Place::entry(id), words::entry(entry))
                        .so(Class::Plc, "access is aborted, a mapping that holds it is refused"),
                ),
                (None, Some(entry)) => changes.push(
                    Change::added(Place::entry(id), words::entry(entry))
                        .so(Class::Addition, "nothing uses it yet"),
                ),
                (None, None) => {}
            }
        }
        changes.extend(map);
        changes.extend(editor(old, new));
        for change in &mut changes {
            if change.name.is_empty() {
                change.name = name(old, new, &change.place);
            }
        }
        changes
    }

    /// What is said about an object and not about its entries.
    fn own_facts(self, old: &Object, new: &Object) -> Vec<Change> {
        let place = Place::Object(new.index);
        let (before, after) = (self.scope.name(&old.name), self.scope.name(&new.name));
        let name = Change::text(place.clone(), Fact::Name, &before, &after);
        let kind = Change::text(place.clone(), Fact::ObjectType, old.kind.name(), new.kind.name());
        let word = |object: &Object| object.category.map(|category| WORDS.category(category).to_owned());
        let category = Change::of(place.clone(), Fact::Category, word(old), word(new));
        let since = Change::of(place.clone(), Fact::Since, old.since.clone(), new.since.clone());
        let identifiers = (old.identifier.clone(), new.identifier.clone());
        let identifier = Change::of(place.clone(), Fact::Identifier, identifiers.0, identifiers.1);
        let links = |object: &Object| {
            let links: Vec<String> = object.linked().map(|index| index.to_string()).collect();
            (!links.is_empty()).then(|| links.join(", "))
        };
        let links = Change::of(place.clone(), Fact::Links, links(old), links(new));
        let facts = [
            name.map(|change| change.with(rules::parameter_name(&before, &after))),
            kind.map(|change| change.with(rules::object_kind(old.kind, new.kind))),
            category.map(|change| change.so(Class::Documents, "the device has it either way")),
            since.map(|change| change.so(Class::Documents, "a remark about the manual")),
            identifier.map(|change| change.so(Class::Documents, "generated code has the same names")),
            links.map(|change| change.so(Class::Documents, "a hint where to look; access is the same")),
        ];
        let warning = texts(&place, Fact::Warning, &old.warning, &new.warning, self.language);
        // What is said about a PDO is reported with its number.
        let is_pdo = |object: &Object| object.role() == Role::PdoCommunication;
        let about = if is_pdo(old) && is_pdo(new) {
            Vec::new()
        } else {
            texts(&place, Fact::About, &old.about, &new.about, self.language)
        };
        let search = phrases(&place, &old.search, &new.search, self.language);
        facts.into_iter().flatten().chain(warning).chain(about).chain(search).collect()
    }

    /// What a PDO carries, in one change instead of one for each mapping entry.
    fn map(self, old: &Object, new: &Object) -> Option<Change> {
        if old.role() != Role::PdoMapping {
            return None;
        }
        let (before, after) = (mapped(old)?, mapped(new)?);
        let names = |device: &Dictionary, map: &[u32]| {
            let fields = map.iter().map(|parameter| field(device, *parameter)).collect::<Vec<_>>();
            if fields.is_empty() { "nothing".to_owned() } else { fields.join(", ") }
        };
        if before == after {
            return None;
        }
        let place = Place::Object(new.index);
        let change = Change::text(place, Fact::Map, &names(self.old, &before), &names(self.new, &after))?;
        Some(change.with(rules::map()))
    }

    /// Whether a default is a fact of the device or of its maker, and changes with it: device type and identity.
    fn is_told_by_device(self, id: EntryId) -> bool {
        let agrees = |device: &Dictionary, vendor: u32| {
            let fact = match (Role::of(id.index), id.sub.0) {
                (Role::DeviceType, 0) => device.info.device_type,
                (Role::Identity, 1) => vendor,
                (Role::Identity, 2) => device.info.product,
                (Role::Identity, 3) => device.info.product_revision,
                _ => return false,
            };
            let default = device.entry(id).and_then(|entry| entry.default.as_ref()).and_then(Value::integer);
            default == Some(fact.into())
        };
        let [before, after] = self.vendors;
        agrees(self.old, before) && agrees(self.new, after)
    }
}

/// What a place is called: of an entry that came or went, on the side that has it.
pub(super) fn name(old: &Object, new: &Object, place: &Place) -> String {
    let Place::Entries { first, .. } = place else { return new.name.clone() };
    match (new.entry(*first), old.entry(*first)) {
        (Some(entry), _) => format!("{}.{}", new.name, entry.name),
        (None, Some(entry)) => format!("{}.{}", old.name, entry.name),
        (None, None) => new.name.clone(),
    }
}

/// What an object is: `unsigned16 rw`, `ARRAY of 8`.
fn object(object: &Object) -> String {
    match object.entries.as_slice() {
        [entry] if !object.is_structured() => words::entry(entry),
        entries => {
            let entries = words::counted(entries.len(), "entry", "entries");
            format!("{} with {entries}", object.kind.name())
        }
    }
}

/// Whether the default of sub-index 0 is on both sides the highest sub-index, which the entries show.
fn is_count(old: &Object, new: &Object, sub: SubIndex) -> bool {
    let counts = |object: &Object| {
        let highest = object.entries.last().map(|entry| i128::from(entry.sub.0));
        let stated = |entry: &Entry| entry.default.as_ref().and_then(Value::integer);
        object.is_structured() && object.entry(sub).and_then(stated) == highest
    };
    sub.0 == 0 && counts(old) && counts(new)
}

/// The mapping parameters that count; `None` where the object does not say them.
fn mapped(object: &Object) -> Option<Vec<u32>> {
    let value = |sub: u8| {
        let raw = object.entry(SubIndex(sub))?.default.as_ref().and_then(Value::integer)?;
        u32::try_from(raw).ok()
    };
    let count = u8::try_from(value(0)?).ok()?;
    (1..=count).map(value).collect()
}

/// One entry of a PDO with its bits: `6041h statusword (16)`.
fn field(device: &Dictionary, parameter: u32) -> String {
    let Some(mapped) = od_spec::model::Mapped::from_parameter(parameter) else { return "nothing".to_owned() };
    match mapped.target {
        PdoTarget::Entry(id) => {
            let name = device.entry_name(id).unwrap_or_default();
            format!("{id} {name} ({})", mapped.bits)
        }
        PdoTarget::Dummy(data_type) => format!("placeholder {} ({})", data_type.name(), mapped.bits),
    }
}
