//! Objects and entries: their names, and their rows in the table.

use od_spec::diag::Diagnostics;
use od_spec::model::{Alias, DataType, Direction, Entry, EntryId, Object, ObjectKind, SubIndex, TypeKind};

use super::{
    Attributes, Flags, NONE, PRELUDE, PlaceKind, Plan, PlannedAlias, PlannedEntry, PlannedObject, Shape,
    too_large,
};
use crate::rust::condition::{self, Condition, Unusable};
use crate::rust::layout::{Layout, Place};
use crate::rust::names::{Scope, camel, mutable, setter, snake};

/// Names that the dictionary's own methods have, and the methods of its traits: an accessor would hide them.
const METHODS: [&str; 21] = [
    "new",
    "clone",
    "entry",
    "row",
    "image",
    "image_mut",
    "condition",
    "find",
    "info",
    "read",
    "upload",
    "write",
    "upload_domain",
    "download_domain",
    "reset",
    "reset_stored",
    "stored",
    "restore",
    "layout",
    "broken_constraint",
    "write_consistent",
];

impl<'a> Plan<'a> {
    pub(super) fn objects(&mut self, diagnostics: &mut Diagnostics) {
        let device = self.device;
        let mut methods = Scope::with_reserved(&METHODS);
        let mut groups = Scope::with_reserved(&PRELUDE);
        let mut variants = Scope::default();
        for object in device.objects.values() {
            let what = format!("{} ({})", object.index, object.name);
            let name = snake(object.identifier.as_ref().unwrap_or(&object.name));
            // What follows from a name that is refused is refused with it.
            if !methods.claim(&name, &what, object.span, diagnostics) {
                continue;
            }
            let shape = shape(object, &name, &self.layout);
            match &shape {
                Shape::Var => {
                    methods.claim(&setter(&name), &format!("the setter of {what}"), object.span, diagnostics);
                }
                Shape::Indexed { count } => {
                    methods.claim(&setter(&name), &format!("the setter of {what}"), object.span, diagnostics);
                    for name in count.iter().flat_map(|count| [count.clone(), setter(count)]) {
                        methods.claim(&name, &format!("sub-index 0 of {what}"), object.span, diagnostics);
                    }
                }
                Shape::Group { type_name } => {
                    methods.claim(
                        &mutable(&name),
                        &format!("{what} to be changed"),
                        object.span,
                        diagnostics,
                    );
                    groups.claim(type_name, &what, object.span, diagnostics);
                }
            }
            let Some(first_row) = object
                .entries
                .first()
                .and_then(|entry| self.row(EntryId { index: object.index, sub: entry.sub }))
            else {
                continue;
            };
            let position = self.objects.len();
            let mut own = Scope::default();
            for entry in &object.entries {
                self.push_entry(object, position, &name, entry, &mut own, &mut variants, diagnostics);
            }
            self.objects.push(PlannedObject { object, name, first_row, shape });
        }
    }

    #[expect(clippy::too_many_arguments, reason = "an entry with all the scopes in which it has a name")]
    fn push_entry(
        &mut self,
        object: &'a Object,
        position: usize,
        object_name: &str,
        entry: &'a Entry,
        own: &mut Scope,
        variants: &mut Scope,
        diagnostics: &mut Diagnostics,
    ) {
        let id = EntryId { index: object.index, sub: entry.sub };
        let member = snake(entry.identifier.as_ref().unwrap_or(&entry.name));
        let name = if object.is_structured() {
            snake(&format!("{object_name} {}", entry.identifier.as_ref().unwrap_or(&entry.name)))
        } else {
            object_name.to_owned()
        };
        let variant = camel(&name);
        let what = format!("{id} ({})", entry.name);
        let its_setter = format!("the setter of {what}");
        let named = own.claim(&member, &what, entry.span, diagnostics)
            && own.claim(&setter(&member), &its_setter, entry.span, diagnostics)
            && variants.claim(&variant, &what, entry.span, diagnostics);
        if !named {
            return;
        }
        let Some((place, size)) = self.layout.places.get(&id).copied() else { return };
        let attributes = self.attributes(id, object, entry, place, size, diagnostics);
        let kind = self.kind(entry, diagnostics);
        if let Some(alias) = &entry.alias {
            self.push_alias(id, entry, alias, diagnostics);
        }
        self.entries.push(PlannedEntry {
            id,
            object: position,
            entry,
            variant,
            name,
            member,
            place,
            size,
            attributes,
            kind,
        });
    }

    fn push_alias(&mut self, id: EntryId, entry: &Entry, alias: &Alias, diagnostics: &mut Diagnostics) {
        let target = self.device.entry(alias.target);
        let range = target.and_then(|target| target.data_type.range());
        let small = |value: i128| u32::try_from(value).ok();
        let (numerator, denominator) = (small(alias.factor.numerator()), small(alias.factor.denominator()));
        // Twice the product, for rounding to the nearest, stays within 64 bits.
        let fits = range.zip(numerator).is_some_and(|((low, high), numerator)| {
            let fits =
                |end: i128| end.checked_mul(numerator.into()).is_some_and(|end| i64::try_from(end).is_ok());
            fits(low) && fits(high)
        });
        let (Some(row), Some(target)) = (self.row(id), self.row(alias.target)) else { return };
        let (Some(numerator), Some(denominator), true, false) =
            (numerator, denominator, fits, entry.data_type.bits() == Some(64))
        else {
            diagnostics.push(too_large(entry.span, &format!("alias {id}")));
            return;
        };
        self.aliases.push(PlannedAlias {
            row,
            target,
            data_type: entry.data_type,
            numerator,
            denominator,
            rounding: alias.rounding,
            outside: alias.outside,
        });
    }

    fn attributes(
        &mut self,
        id: EntryId,
        object: &Object,
        entry: &Entry,
        place: Place,
        size: usize,
        diagnostics: &mut Diagnostics,
    ) -> u16 {
        let subs = object.entries.iter().map(|entry| usize::from(entry.sub.0));
        let listed = listed_values(entry);
        let (place, offset) = match place {
            Place::Image(at) => (PlaceKind::Image, at),
            Place::Constant(at) => (PlaceKind::Constant, at),
            Place::Alias => (PlaceKind::Alias, 0),
            Place::Application => (PlaceKind::Application, 0),
        };
        let flags = Flags {
            read: entry.access.is_readable(),
            write: entry.access.is_writable(),
            locked: entry.locked,
            receive: entry.pdo.allows(Direction::Receive),
            transmit: entry.pdo.allows(Direction::Transmit),
            sparse: !subs.eq(0..object.entries.len()),
            only_values: matches!(listed, Some((true, _))),
        };
        let limits = limits(entry).map_or(NONE, |limits| self.limits.position(limits));
        let values = listed.map_or(NONE, |(_, values)| self.values.position(values));
        let condition = match entry.writable_when.as_ref().filter(|_| flags.write) {
            None => NONE,
            Some(written) => match condition::plan(written, self.device) {
                Ok(condition) => self.condition(condition),
                // A condition about other devices is theirs to keep.
                Err(Unusable::Elsewhere) => NONE,
                Err(Unusable::TooLarge) => {
                    diagnostics.push(too_large(entry.span, &format!("the write condition of {id}")));
                    NONE
                }
            },
        };
        let attributes = Attributes {
            data_type: entry.data_type,
            flags,
            place,
            storage: entry.stored,
            page: offset >> 16,
            size,
            limits,
            values,
            condition,
        };
        self.attributes.position(attributes)
    }

    fn condition(&mut self, condition: Condition) -> u16 {
        let at = self.conditions.iter().position(|other| *other == condition).unwrap_or_else(|| {
            self.conditions.push(condition);
            self.conditions.len() - 1
        });
        u16::try_from(at).unwrap_or(NONE)
    }
}

/// How code reaches an object: elements whose names differ only by their number are reached by it.
fn shape(object: &Object, name: &str, layout: &Layout) -> Shape {
    if !object.is_structured() {
        return Shape::Var;
    }
    let Some((sub0, elements)) = object.entries.split_first() else { return Shape::Var };
    let pattern = |entry: &Entry| entry.name.replacen(&entry.sub.to_string(), "{n}", 1);
    let alike = elements.split_first().is_some_and(|(first, others)| {
        pattern(first).contains("{n}")
            && others.iter().all(|other| {
                pattern(other) == pattern(first)
                    && other.data_type == first.data_type
                    && other.named_type == first.named_type
                    && other.unit == first.unit
                    && other.special == first.special
                    && other.stored == first.stored
                    && other.access == first.access
                    && other.capacity == first.capacity
            })
    });
    let gapless = elements.iter().zip(1u8..).all(|(entry, sub)| entry.sub == SubIndex(sub));
    let fixed =
        elements.iter().all(|entry| entry.data_type.bits().is_some()) && object.kind != ObjectKind::Domain;
    if alike && gapless && fixed && lies_in_a_row(object, elements, layout) {
        let changes = sub0.access.is_writable() || object.index.0 == 0x1003;
        let count = changes.then(|| snake(&format!("{name} {}", sub0.name)));
        Shape::Indexed { count }
    } else {
        Shape::Group { type_name: camel(name) }
    }
}

/// Whether elements lie one behind the other in the image, or are all constants.
fn lies_in_a_row(object: &Object, elements: &[Entry], layout: &Layout) -> bool {
    let place = |entry: &Entry| layout.places.get(&EntryId { index: object.index, sub: entry.sub }).copied();
    let Some((Place::Image(start), size)) = elements.first().and_then(place) else {
        return elements.iter().all(|entry| matches!(place(entry), Some((Place::Constant(_), _))));
    };
    elements
        .iter()
        .enumerate()
        .all(|(at, entry)| place(entry) == Some((Place::Image(start + at * size), size)))
}

/// The number by which the table compares: of UNSIGNED64 the value minus 2^63.
fn ordered(data_type: DataType, value: i128) -> i64 {
    let number = if data_type == DataType::Unsigned64 { value - (1 << 63) } else { value };
    i64::try_from(number).unwrap_or(if number < 0 { i64::MIN } else { i64::MAX })
}

fn limits(entry: &Entry) -> Option<(i64, i64)> {
    if entry.low.is_none() && entry.high.is_none() {
        return None;
    }
    let (low, high) = entry.data_type.range()?;
    Some((
        ordered(entry.data_type, entry.low.unwrap_or(low)),
        ordered(entry.data_type, entry.high.unwrap_or(high)),
    ))
}

/// Values that can be written beside the limits, or the only ones.
fn listed_values(entry: &Entry) -> Option<(bool, Vec<i64>)> {
    let number = |value: i128| ordered(entry.data_type, value);
    let specials = entry.special.iter().map(|special| special.value);
    if let Some(TypeKind::Enum(values)) = entry.named_type.as_ref().map(|named| &named.kind) {
        let supported = values.iter().filter(|value| value.supported && entry.allows(value.value));
        let mut list: Vec<i64> = supported.map(|value| value.value).chain(specials).map(number).collect();
        list.sort_unstable();
        list.dedup();
        return Some((true, list));
    }
    let limited = entry.low.is_some() || entry.high.is_some();
    (limited && !entry.special.is_empty()).then(|| (false, specials.map(number).collect()))
}
