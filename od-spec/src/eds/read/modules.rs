//! Devices built from modules (CiA 306 6): the objects that the connected modules bring, and those that they extend.

use std::collections::{BTreeMap, BTreeSet};

use super::Form;
use super::entry::{self, Context};
use super::further::{self, KeysBySection};
use super::made;
use super::node_texts;
use super::objects::object;
use super::shape::{declaration, with_shape};
use crate::ast::{DefaultDecl, EntryDecl, ObjectDecl};
use crate::diag::Diagnostic;
use crate::eds::codes;
use crate::eds::names::{ModuleTopic, Topic};
use crate::eds::number::lenient_integer;
use crate::eds::view::{ObjectPart, Part, View};
use crate::model::{Access, DataType, EntryId, Index, Mapped, ObjectKind, PdoTarget, Role, SubIndex};
use crate::source::{Span, Spanned};

/// The list of the modules that are plugged in (CiA 301).
const MODULE_LIST: Index = Index(0x1027);

type Module<'d> = BTreeMap<ModuleTopic, Part<'d>>;

/// Adds the objects of the connected modules, in the order in which these are plugged in; returns what is at them
/// beyond their facts.
pub(super) fn add(
    view: &View<'_>,
    objects: &mut Vec<ObjectDecl>,
    context: &mut Context<'_>,
) -> KeysBySection {
    let mut keys = KeysBySection::new();
    let of_modules = || view.modules.values().flat_map(BTreeMap::values);
    let Some(first) = view.section(Topic::SupportedModules).or_else(|| of_modules().next()) else {
        return keys;
    };
    if view.modules.is_empty() {
        return keys;
    }
    let message = format!("modules described: {}, connected: {}", view.modules.len(), view.connected.len());
    context.push(
        Diagnostic::new(codes::MODULES, first.place(), message)
            .help("name the modules that are plugged in under `[ConnectedModules]` of a DCF; `odgen dcf --modules` does"),
    );
    let (mut fixed, mut brought) = (BTreeSet::new(), BTreeSet::new());
    let mut extensions: BTreeMap<Index, Extension> = BTreeMap::new();
    let mut objects = Objects::of(objects);
    let is_in_full = objects.are_in_full(view);
    for number in &view.connected {
        let Some(module) = view.modules.get(number) else { continue };
        // Every module of a kind brings the same objects.
        let fixed_objects = if fixed.insert(number) { fixed_objects(module) } else { BTreeMap::new() };
        for (index, part) in fixed_objects {
            if brought.insert(index)
                && objects.get(index).is_none()
                && let Some(object) = object(index, &part, context)
            {
                objects.push(object);
                keep(index, &part, &mut keys);
            }
        }
        for (topic, section) in module {
            if let ModuleTopic::SubExtension(index) = topic
                && !is_in_full
            {
                let extension =
                    extensions.entry(*index).or_insert_with(|| Extension::new(*index, &mut objects));
                extension.extend(section, &mut objects, &mut keys, context);
            }
        }
    }
    if !view.connected.is_empty() && !is_in_full {
        objects.shorten_mappings();
    }
    keys
}

/// Keeps what is at an object that a module brings.
fn keep(index: Index, part: &ObjectPart<'_>, keys: &mut KeysBySection) {
    if let Some(own) = &part.object {
        let name = further::name(Topic::Object(index), own);
        further::add(keys, name, further::further_keys_of(index, own, further::has_subs(part, own)));
    }
    for (sub, section) in &part.subs {
        let topic = Topic::Sub(index, *sub);
        further::add(keys, further::name(topic, section), further::further_keys(topic, section));
    }
}

/// The objects that a module brings as they are.
fn fixed_objects<'d>(module: &Module<'d>) -> BTreeMap<Index, ObjectPart<'d>> {
    let mut objects: BTreeMap<Index, ObjectPart<'d>> = BTreeMap::new();
    for (topic, section) in module {
        match topic {
            ModuleTopic::Fixed(index, None) => {
                objects.entry(*index).or_default().object = Some(section.clone());
            }
            ModuleTopic::Fixed(index, Some(sub)) => {
                objects.entry(*index).or_default().subs.insert(*sub, section.clone());
            }
            ModuleTopic::ModuleInfo
            | ModuleTopic::Comments
            | ModuleTopic::FixedObjects
            | ModuleTopic::SubExtends
            | ModuleTopic::SubExtension(_) => {}
        }
    }
    objects
}

/// The objects of a device, with their positions.
struct Objects<'a> {
    list: &'a mut Vec<ObjectDecl>,
    /// Of objects of one index, the first.
    positions: BTreeMap<Index, usize>,
}

impl<'a> Objects<'a> {
    fn of(list: &'a mut Vec<ObjectDecl>) -> Self {
        let positions = list.iter().enumerate().rev().map(|(at, object)| (object.index.value, at)).collect();
        Self { list, positions }
    }

    fn get(&mut self, index: Index) -> Option<&mut ObjectDecl> {
        self.list.get_mut(*self.positions.get(&index)?)
    }

    /// The sub-indices of an object from 1 on.
    fn members(&mut self, index: Index) -> &[(Spanned<SubIndex>, EntryDecl)] {
        let Some(object) = self.get(index) else { return &[] };
        match (&object.array, &object.record) {
            (Some(array), _) => &array.elements,
            (None, Some(record)) => &record.members,
            (None, None) => &[],
        }
    }

    /// Whether the file describes what the connected modules add to objects: a DCF may have the sub-indices of all modules,
    /// with their values, or leave them to its reader. 1027h has nothing else, and shows this; without it, the last
    /// sub-index of what they extend does.
    fn are_in_full(&mut self, view: &View<'_>) -> bool {
        let modules = view.connected.iter().filter_map(|number| view.modules.get(number));
        let extensions: BTreeMap<Index, &Part<'_>> = modules
            .flatten()
            .filter_map(|(topic, section)| match topic {
                ModuleTopic::SubExtension(index) => Some((*index, section)),
                _ => None,
            })
            .collect();
        if extensions.contains_key(&MODULE_LIST) {
            return !self.members(MODULE_LIST).is_empty();
        }
        extensions.into_iter().any(|(index, section)| {
            let name = section.value("ParameterName").map_or("", |name| name.value);
            let described = self.members(index).last().and_then(|(_, last)| last.name.as_ref());
            described.is_some_and(|described| described.value.starts_with(name))
        })
    }

    /// A bus coupler may map more than its modules bring: a mapping ends before the first entry that is not there, and its
    /// sub-index 0 says so (CiA 306 6.5).
    fn shorten_mappings(&mut self) {
        let is_mapping = |index: &&Index| Role::of(**index) == Role::PdoMapping;
        let mappings: Vec<Index> = self.positions.keys().filter(is_mapping).copied().collect();
        for index in mappings {
            let value = |entry: &EntryDecl| {
                let default = entry.default.as_ref()?;
                crate::scalar::integer(default.value.text()?).ok()
            };
            let count = self.get(index).and_then(|object| value(object.sub0.as_deref()?));
            let targets: Vec<Option<Mapped>> = self
                .members(index)
                .iter()
                .map(|(_, entry)| Mapped::from_parameter(u32::try_from(value(entry)?).ok()?))
                .collect();
            let is_there =
                |mapped: Option<Mapped>, objects: &mut Self| match mapped.map(|mapped| mapped.target) {
                    Some(PdoTarget::Entry(id)) => objects.has(id),
                    Some(PdoTarget::Dummy(_)) | None => true,
                };
            let used = usize::try_from(count.unwrap_or(0)).unwrap_or(0);
            let missing = targets.into_iter().take(used).position(|mapped| !is_there(mapped, self));
            if let Some((missing, object)) = missing.zip(self.get(index))
                && let Some(sub0) = &mut object.sub0
            {
                sub0.default = Some(DefaultDecl::one(made(missing.to_string(), sub0.span)));
            }
        }
    }

    /// Whether there is an entry.
    fn has(&mut self, id: EntryId) -> bool {
        id.sub.0 == 0 && self.get(id.index).is_some()
            || self.members(id.index).iter().any(|(sub, _)| sub.value == id.sub)
    }

    fn push(&mut self, object: ObjectDecl) {
        self.positions.entry(object.index.value).or_insert(self.list.len());
        self.list.push(object);
    }
}

/// An object that grows with every module.
struct Extension {
    index: Index,
    /// The sub-index that was added last.
    last: u8,
    /// Bits of that sub-index that modules have taken.
    bits: u16,
}

impl Extension {
    fn new(index: Index, objects: &mut Objects<'_>) -> Self {
        let last = objects.members(index).last().map_or(0, |(sub, _)| sub.value.0);
        Self { index, last, bits: u16::MAX }
    }

    /// Adds what one module adds.
    fn extend(
        &mut self,
        section: &Part<'_>,
        objects: &mut Objects<'_>,
        keys: &mut KeysBySection,
        context: &mut Context<'_>,
    ) {
        let id = EntryId { index: self.index, sub: SubIndex(0) };
        let count = count(section);
        let entries = match count {
            Count::Subs(count) => usize::from(count),
            Count::Bits(_) => 1,
        };
        if !context.fits(self.index, entries.max(1), section.size(), section.place()) {
            return;
        }
        let entry = entry::entry(section, id, Form::Elements, context);
        node_texts::leave_out(section, id, context);
        let width = entry::type_of(&entry).and_then(DataType::bits).unwrap_or(8);
        let highest = section.value("ObjExtend").and_then(|text| lenient_integer(text.value));
        let highest = highest.and_then(|sub| u8::try_from(sub).ok()).filter(|sub| *sub > 0).unwrap_or(254);
        let added = match count {
            Count::Subs(count) => count,
            Count::Bits(bits) if self.bits.saturating_add(u16::from(bits)) <= width => {
                self.bits += u16::from(bits);
                0
            }
            Count::Bits(bits) => {
                self.bits = u16::from(bits);
                1
            }
        };
        let topic = ModuleTopic::SubExtension(id.index);
        let further = further::further_keys(Topic::Module(0, topic), section);
        for _ in 0..added {
            self.add(&entry, highest, section.place(), objects);
            let topic = Topic::Sub(self.index, self.last.into());
            further::add(keys, further::name(topic, section), further.clone());
        }
    }

    fn add(&mut self, entry: &EntryDecl, highest: u8, place: Span, objects: &mut Objects<'_>) {
        if self.last >= highest {
            let Some(next) = self.index.0.checked_add(1) else { return };
            (self.index, self.last) = (Index(next), 0);
        }
        self.last += 1;
        let sub = Spanned::new(SubIndex(self.last), place);
        let name = entry.name.as_ref().map_or(String::new(), |name| name.value.clone());
        let member = EntryDecl { name: Some(made(format!("{name}{}", self.last), place)), ..entry.clone() };
        if let Some(object) = objects.get(self.index) {
            count_to(object, self.last, place);
            if let Some(array) = &mut object.array {
                array.elements.push((sub, member));
                array.count = Some(Spanned::new(i128::from(self.last), place));
            } else if let Some(record) = &mut object.record {
                record.members.push((sub, member));
            }
            return;
        }
        let head = EntryDecl { name: Some(made(name, place)), ..EntryDecl::empty(place) };
        let sub0 = entry::made_up("NrOfObjects", DataType::Unsigned8, Access::Ro, place);
        let object = ObjectDecl { sub0: Some(Box::new(sub0)), ..declaration(self.index, place, head) };
        objects.push(with_shape(object, ObjectKind::Array, vec![(sub, member)]));
    }
}

/// Lets sub-index 0 say which sub-index is the highest, unless it says something else.
fn count_to(object: &mut ObjectDecl, last: u8, place: Span) {
    let varies = matches!(Role::of(object.index.value), Role::PdoMapping | Role::ErrorHistory);
    if let Some(sub0) = object.sub0.as_mut().filter(|_| !varies) {
        sub0.default = Some(DefaultDecl::one(made(last.to_string(), place)));
    }
}

/// What one module adds to an object.
#[derive(Clone, Copy)]
enum Count {
    /// This many sub-indices.
    Subs(u8),
    /// This many bits of a sub-index, which several modules share.
    Bits(u8),
}

/// `Count=2`, or `Count=0;4`. What cannot be read is one sub-index.
fn count(section: &Part<'_>) -> Count {
    let Some(text) = section.value("Count") else { return Count::Subs(1) };
    let number = |text: &str| lenient_integer(text.trim()).and_then(|number| u8::try_from(number).ok());
    match text.split_once(';') {
        Some((subs, bits)) if number(subs) == Some(0) => number(bits).map_or(Count::Subs(1), Count::Bits),
        Some((subs, _)) => number(subs).map_or(Count::Subs(1), Count::Subs),
        None => number(text.value).map_or(Count::Subs(1), Count::Subs),
    }
}
