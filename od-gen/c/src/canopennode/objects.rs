//! Objects as the stack has them: a VAR, an ARRAY of equal elements, or a RECORD, and where their values lie.

use od_spec::model::{Dictionary, Entry, EntryId, Object, ObjectKind, Storage, SubIndex};

use super::attributes::Attributes;
use super::cell::Cell;
use super::groups::Group;
use super::names;
use super::srdos::Srdos;

/// An object and its values.
pub(super) struct StackObject<'a> {
    pub object: &'a Object,
    /// After the index: `deviceType`.
    pub name: String,
    pub shape: Shape<'a>,
}

/// The kinds of objects that the stack has.
pub(super) enum Shape<'a> {
    Var(Slot<'a>),
    /// Equal elements, sub-indices 1 and up without a gap.
    Array {
        count: Slot<'a>,
        elements: Vec<Slot<'a>>,
    },
    /// Any entries, by ascending sub-index.
    Record(Vec<Slot<'a>>),
}

/// One entry as the stack has it.
pub(super) struct Slot<'a> {
    pub id: EntryId,
    pub entry: &'a Entry,
    pub attributes: Attributes,
    /// Its name among the entries of a RECORD.
    pub name: String,
    /// The length that the stack knows.
    pub length: u32,
    pub memory: Memory<'a>,
}

/// Where a value lies.
pub(super) enum Memory<'a> {
    /// In the variable of a group.
    Variable { group: Group<'a>, cell: Cell },
    /// Nowhere, as the stack itself or the application has it: the history of errors, a DOMAIN.
    Stack,
    /// Nowhere, as it is another view of another entry.
    View,
}

/// All objects of a device, ascending. Their names are those of another form of it: with its index in it, a name needs nothing that distinguishes it from
/// those of other objects.
pub(super) fn of_device<'a>(
    device: &'a Dictionary,
    named: &Dictionary,
    srdos: &Srdos,
) -> Vec<StackObject<'a>> {
    let named = |object: &'a Object| named.objects.get(&object.index).unwrap_or(object);
    device.objects.values().map(|object| StackObject::of(object, named(object), srdos)).collect()
}

/// The groups in which values of a device lie, in the order of the files.
pub(super) fn groups_of<'a>(objects: &[StackObject<'a>]) -> Vec<Group<'a>> {
    let slots = objects.iter().flat_map(StackObject::slots);
    Group::in_order(slots.filter_map(|slot| Some(slot.variable()?.0)))
}

impl<'a> StackObject<'a> {
    fn of(object: &'a Object, named: &Object, srdos: &Srdos) -> Self {
        let name = names::of_object(named);
        let members = names::of_members(&named.entries);
        let group_of_rest = group_of_rest(object);
        let slot = |(entry, name): (&'a Entry, String)| Slot::of(object, entry, name, srdos, group_of_rest);
        let mut slots: Vec<Slot<'a>> = object.entries.iter().zip(members).map(slot).collect();
        let shape = if !object.is_structured() && slots.len() == 1 {
            slots.pop().map_or_else(|| Shape::Record(Vec::new()), Shape::Var)
        } else if object.kind == ObjectKind::Array && are_elements(&slots) {
            let elements = slots.split_off(1);
            match slots.pop() {
                Some(count) => Shape::Array { count, elements },
                None => Shape::Record(elements),
            }
        } else {
            Shape::Record(slots)
        };
        Self { object, name, shape }
    }

    /// `x1000_deviceType`, the variable of the object in its group.
    pub(super) fn variable(&self) -> String {
        format!("x{:04X}_{}", self.object.index.0, self.name)
    }

    /// `o_1000_deviceType`, what the stack knows of the object.
    pub(super) fn constant(&self) -> String {
        format!("o_{:04X}_{}", self.object.index.0, self.name)
    }

    /// All entries, ascending.
    pub(super) fn slots(&self) -> Vec<&Slot<'a>> {
        match &self.shape {
            Shape::Var(slot) => vec![slot],
            Shape::Array { count, elements } => [count].into_iter().chain(elements).collect(),
            Shape::Record(slots) => slots.iter().collect(),
        }
    }

    /// How many elements an ARRAY has, also one that the stack has as a RECORD; `None` where sub-indices are missing.
    pub(super) fn elements(&self) -> Option<usize> {
        let gapless = self.object.entries.iter().zip(0u8..).all(|(entry, sub)| entry.sub == SubIndex(sub));
        let is_array = self.object.kind == ObjectKind::Array && gapless;
        self.object.entries.len().checked_sub(1).filter(|count| is_array && *count > 0)
    }

    /// `ODT_VAR` and its like.
    pub(super) const fn kind(&self) -> &'static str {
        match self.shape {
            Shape::Var(_) => "ODT_VAR",
            Shape::Array { .. } => "ODT_ARR",
            Shape::Record(_) => "ODT_REC",
        }
    }

    /// The value of an entry in its group: `x1018_identity.vendor_ID`.
    pub(super) fn path(&self, slot: &Slot<'_>) -> Option<String> {
        slot.variable()?;
        let variable = self.variable();
        Some(match &self.shape {
            Shape::Var(_) => variable,
            Shape::Array { .. } if slot.id.sub == SubIndex(0) => format!("{variable}_sub0"),
            Shape::Array { .. } => format!("{variable}[{}]", slot.id.sub.0 - 1),
            Shape::Record(_) => format!("{variable}.{}", slot.name),
        })
    }
}

impl<'a> Slot<'a> {
    fn of(
        object: &'a Object,
        entry: &'a Entry,
        name: String,
        srdos: &Srdos,
        group_of_rest: Option<Storage>,
    ) -> Self {
        let id = EntryId { index: object.index, sub: entry.sub };
        let cell = Cell::of(entry);
        // What describes the shape of an object is with the object.
        let tells_shape = object.is_structured() && entry.sub == SubIndex(0) && entry.stored == Storage::No;
        let storage = group_of_rest.filter(|_| tells_shape).unwrap_or(entry.stored);
        let memory = match cell {
            _ if entry.alias.is_some() => Memory::View,
            _ if object.index.0 == 0x1003 => Memory::Stack,
            None => Memory::Stack,
            Some(cell) => Memory::Variable { group: Group::of(object, entry, storage), cell },
        };
        Self {
            id,
            entry,
            attributes: Attributes::of(object, entry, srdos),
            name,
            length: cell.map_or(0, Cell::length),
            memory,
        }
    }

    /// The group and the variable of the value.
    pub(super) const fn variable(&self) -> Option<(Group<'a>, Cell)> {
        match &self.memory {
            Memory::Variable { group, cell } => Some((*group, *cell)),
            Memory::Stack | Memory::View => None,
        }
    }
}

/// What stores the entries after sub-index 0, where one command stores all of them.
fn group_of_rest(object: &Object) -> Option<Storage> {
    let (first, rest) =
        object.counted().map(|entry| entry.stored).fold((None, true), |(first, same), stored| {
            (first.or(Some(stored)), same && first.is_none_or(|first| first == stored))
        });
    first.filter(|_| rest)
}

/// Whether entries are the number of elements and the elements: all of one type, length, attributes and group, without a gap. The stack has
/// one row for all elements of an ARRAY; one whose elements differ is a RECORD to it.
fn are_elements(slots: &[Slot<'_>]) -> bool {
    let Some((count, [first, rest @ ..])) = slots.split_first() else { return false };
    let gapless = slots.iter().zip(0u8..).all(|(slot, sub)| slot.id.sub == SubIndex(sub));
    let is_count = count.length == 1 && !matches!(count.memory, Memory::View);
    let are_views = matches!(first.memory, Memory::View);
    gapless
        && is_count
        && !are_views
        && rest.iter().all(|element| {
            element.entry.data_type == first.entry.data_type
                && element.length == first.length
                && element.attributes == first.attributes
                && element.variable() == first.variable()
                && !matches!(element.memory, Memory::View)
        })
}
