//! Devices built from modules (CiA 306 6): the objects that the connected modules bring, and those that they extend.

use std::collections::{BTreeMap, BTreeSet};

use super::Form;
use super::entry::{self, Context};
use super::made;
use super::node_texts;
use super::objects::object;
use super::shape::{declaration, with_shape};
use crate::ast::{EntryDecl, ObjectDecl};
use crate::diag::Diagnostic;
use crate::eds::codes;
use crate::eds::names::{ModuleTopic, Topic};
use crate::eds::number::lenient_integer;
use crate::eds::view::{ObjectPart, Part, View};
use crate::model::{Access, DataType, EntryId, Index, ObjectKind, SubIndex};
use crate::source::{Span, Spanned};

type Module<'d> = BTreeMap<ModuleTopic, Part<'d>>;

/// Adds the objects of the connected modules, in the order in which these are plugged in.
pub(super) fn add(view: &View<'_>, objects: &mut Vec<ObjectDecl>, context: &mut Context<'_>) {
    let Some(supported) = view.section(Topic::SupportedModules).filter(|_| !view.modules.is_empty()) else {
        return;
    };
    let connected = connected(view);
    let message = format!("modules described: {}, connected: {}", view.modules.len(), connected.len());
    context.push(
        Diagnostic::new(codes::MODULES, supported.place(), message)
            .help("name the modules that are plugged in under `[ConnectedModules]` of a DCF"),
    );
    let (mut fixed, mut brought) = (BTreeSet::new(), BTreeSet::new());
    let mut extensions: BTreeMap<Index, Extension> = BTreeMap::new();
    let mut objects = Objects::of(objects);
    for number in connected {
        let Some(module) = view.modules.get(&number) else { continue };
        // Every module of a kind brings the same objects.
        let fixed_objects = if fixed.insert(number) { fixed_objects(module) } else { BTreeMap::new() };
        for (index, part) in fixed_objects {
            if brought.insert(index)
                && objects.get(index).is_none()
                && let Some(object) = object(index, &part, context)
            {
                objects.push(object);
            }
        }
        for (topic, section) in module {
            if let ModuleTopic::SubExtension(index) = topic {
                let extension =
                    extensions.entry(*index).or_insert_with(|| Extension::new(*index, &mut objects));
                extension.extend(section, &mut objects, context);
            }
        }
    }
}

/// The numbers of the connected modules, in order. Two in one place are two modules, unless a line only repeats another.
fn connected(view: &View<'_>) -> Vec<u32> {
    let Some(section) = view.section(Topic::ConnectedModules) else { return Vec::new() };
    let slots = section.entries().filter_map(|entry| {
        let slot = lenient_integer(entry.key.value)?;
        let module = lenient_integer(entry.value.value)?;
        Some((slot, u32::try_from(module).ok()?))
    });
    let mut by_slot: BTreeMap<i128, Vec<u32>> = BTreeMap::new();
    for (slot, module) in slots {
        let modules = by_slot.entry(slot).or_default();
        if modules.as_slice() != [module] {
            modules.push(module);
        }
    }
    by_slot.into_values().flatten().collect()
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
        let object = objects.get(index);
        let object = object.as_deref();
        let members = object.and_then(|object| object.array.as_ref().map(|array| &array.elements));
        let members = members.or_else(|| object?.record.as_ref().map(|record| &record.members));
        let last = members.and_then(|members| members.last()).map_or(0, |(sub, _)| sub.value.0);
        Self { index, last, bits: u16::MAX }
    }

    /// Adds what one module adds.
    fn extend(&mut self, section: &Part<'_>, objects: &mut Objects<'_>, context: &mut Context<'_>) {
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
        match count {
            Count::Subs(count) => {
                for _ in 0..count {
                    self.add(&entry, highest, section.place(), objects);
                }
            }
            Count::Bits(bits) if self.bits.saturating_add(u16::from(bits)) <= width => {
                self.bits += u16::from(bits);
            }
            Count::Bits(bits) => {
                self.add(&entry, highest, section.place(), objects);
                self.bits = u16::from(bits);
            }
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
