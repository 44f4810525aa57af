//! Objects and entries: their names, and their rows in the table.

use od_spec::diag::Diagnostics;
use od_spec::model::{
    Alias, DataType, Direction, Entry, EntryId, Family, Object, Real, RealLimits, SubIndex, TypeKind,
};

use super::condition::{self, Condition, Unusable};
use super::language::{Companion, Role, ScopeKind};
use super::layout::{Layout, Place, Placed};
use super::names::{Scope, Words};
use super::{
    Attributes, Flags, NONE, PlaceKind, Plan, PlannedAlias, PlannedEntry, PlannedObject, Shape, too_large,
};

/// The scopes in which objects and entries have names.
#[derive(Default)]
struct Scopes {
    accessors: Scope,
    groups: Scope,
    entries: Scope,
    fields: Scope,
}

/// The object of the entries that are being planned.
struct Parent<'a> {
    object: &'a Object,
    /// Its position in the plan.
    position: usize,
    words: Words,
}

impl<'a> Plan<'a> {
    pub(super) fn objects(&mut self, diagnostics: &mut Diagnostics) {
        let mut scopes = Scopes::default();
        for object in self.device.objects.values() {
            let what = format!("{} ({})", object.index, object.name);
            let words = Words::of(object.label());
            let name = self.language.identifier(ScopeKind::Accessors, Role::Function, &words);
            // What follows from a name that is refused is refused with it.
            if !scopes.accessors.claim(&name, &what, object.span, diagnostics) {
                continue;
            }
            let shape = self.shape(object, &words);
            self.claim_shape(&shape, &name, object, &mut scopes, diagnostics);
            let first = object.entries.first().map(|entry| EntryId { index: object.index, sub: entry.sub });
            let Some(first_row) = first.and_then(|id| self.row(id)) else { continue };
            let parent = Parent { object, position: self.objects.len(), words };
            let mut members = Scope::default();
            for entry in &object.entries {
                self.push_entry(&parent, entry, &mut members, &mut scopes, diagnostics);
            }
            self.objects.push(PlannedObject { object, name, first_row, shape });
        }
        self.plan_runs(&mut scopes.accessors);
    }

    /// Claims what is printed with the accessor of an object.
    fn claim_shape(
        &self,
        shape: &Shape,
        accessor: &str,
        object: &Object,
        scopes: &mut Scopes,
        diagnostics: &mut Diagnostics,
    ) {
        let what = format!("{} ({})", object.index, object.name);
        let companion = match shape {
            Shape::Var | Shape::Indexed { .. } => Companion::Setter,
            Shape::Group { .. } => Companion::Mutable,
        };
        let elements = matches!(shape, Shape::Indexed { .. }).then_some(Companion::Elements);
        for companion in [Some(companion), elements].into_iter().flatten() {
            if let Some(name) = self.language.companion(companion, accessor) {
                scopes.accessors.claim(&name, &companion.describe(&what), object.span, diagnostics);
            }
        }
        match shape {
            Shape::Var | Shape::Indexed { count: None } => {}
            Shape::Indexed { count: Some(count) } => {
                let setter = self.language.companion(Companion::Setter, count);
                for name in [Some(count), setter.as_ref()].into_iter().flatten() {
                    let sub0 = format!("sub-index 0 of {what}");
                    scopes.accessors.claim(name, &sub0, object.span, diagnostics);
                }
            }
            Shape::Group { type_name } => {
                scopes.groups.claim(type_name, &what, object.span, diagnostics);
            }
        }
    }

    fn push_entry(
        &mut self,
        parent: &Parent<'a>,
        entry: &'a Entry,
        members: &mut Scope,
        scopes: &mut Scopes,
        diagnostics: &mut Diagnostics,
    ) {
        let id = EntryId { index: parent.object.index, sub: entry.sub };
        let label = entry.label();
        let words =
            if parent.object.is_structured() { parent.words.and(label) } else { parent.words.clone() };
        let member = self.identifier(ScopeKind::GroupMembers, Role::Function, label);
        let name = self.language.identifier(ScopeKind::Fields, Role::Field, &words);
        let variant = self.language.identifier(ScopeKind::Entries, Role::Variant, &words);
        let what = format!("{id} ({})", entry.name);
        let setter = self.language.companion(Companion::Setter, &member);
        let its_setter = Companion::Setter.describe(&what);
        let has_names = members.claim(&member, &what, entry.span, diagnostics)
            && setter.is_none_or(|setter| members.claim(&setter, &its_setter, entry.span, diagnostics))
            && scopes.entries.claim(&variant, &what, entry.span, diagnostics)
            && scopes.fields.claim(&name, &what, entry.span, diagnostics);
        if !has_names {
            return;
        }
        let Some(placed) = self.layout.places.get(&id).copied() else { return };
        let attributes = self.attributes(id, parent.object, entry, placed, diagnostics);
        let kind = self.kind(entry, &words, diagnostics);
        if let Some(alias) = &entry.alias {
            self.push_alias(id, entry, alias, diagnostics);
        }
        self.entries.push(PlannedEntry {
            id,
            object: parent.position,
            entry,
            variant,
            name,
            member,
            place: placed.place,
            size: placed.size,
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
        placed: Placed,
        diagnostics: &mut Diagnostics,
    ) -> u16 {
        let subs = object.entries.iter().map(|entry| usize::from(entry.sub.0));
        let listed = listed_values(entry);
        let (place, offset) = match placed.place {
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
            only_values: matches!(listed, Some(Listed::Only(_))),
        };
        // Of the wrong way round, which an EDS can have them, they would permit no value.
        let limits = limits(entry).filter(|(low, high)| low <= high);
        let limits = limits.map_or(NONE, |limits| self.limits.position(limits));
        let values = listed.map_or(NONE, |listed| self.values.position(listed.into_values()));
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
            size: placed.size,
            limits,
            values,
            condition,
        };
        self.attributes.position(attributes)
    }

    /// How code reaches an object.
    fn shape(&self, object: &Object, words: &Words) -> Shape {
        if !object.is_structured() {
            return Shape::Var;
        }
        let Some((sub0, elements)) = object.entries.split_first() else { return Shape::Var };
        let gapless = elements.iter().zip(1u8..).all(|(entry, sub)| entry.sub == SubIndex(sub));
        let fixed = elements.iter().all(|entry| entry.data_type.bits().is_some());
        if are_alike(elements) && gapless && fixed && lies_in_a_row(object, elements, &self.layout) {
            let changes = sub0.access.is_writable() || object.index.0 == 0x1003;
            let words = words.and(sub0.label());
            let count = || self.language.identifier(ScopeKind::Accessors, Role::Function, &words);
            Shape::Indexed { count: changes.then(count) }
        } else {
            Shape::Group { type_name: self.language.identifier(ScopeKind::Groups, Role::Type, words) }
        }
    }

    fn condition(&mut self, condition: Condition) -> u16 {
        let at = self.conditions.iter().position(|planned| *planned == condition).unwrap_or_else(|| {
            self.conditions.push(condition);
            self.conditions.len() - 1
        });
        u16::try_from(at).unwrap_or(NONE)
    }
}

/// Whether elements differ in nothing but their number, and so are reached by it.
fn are_alike(elements: &[Entry]) -> bool {
    let pattern = |entry: &Entry| entry.name.replacen(&entry.sub.to_string(), "{n}", 1);
    elements.split_first().is_some_and(|(first, rest)| {
        pattern(first).contains("{n}")
            && rest.iter().all(|element| {
                pattern(element) == pattern(first)
                    && element.data_type == first.data_type
                    && element.named_type == first.named_type
                    && element.unit == first.unit
                    && element.special == first.special
                    && element.stored == first.stored
                    && element.access == first.access
                    && element.capacity == first.capacity
            })
    })
}

/// Whether elements lie one after the other in the image, or are all constants.
fn lies_in_a_row(object: &Object, elements: &[Entry], layout: &Layout) -> bool {
    let placed = |entry: &Entry| layout.places.get(&EntryId { index: object.index, sub: entry.sub }).copied();
    let Some(Placed { place: Place::Image(start), size }) = elements.first().and_then(placed) else {
        return elements
            .iter()
            .all(|entry| matches!(placed(entry), Some(Placed { place: Place::Constant(_), .. })));
    };
    let expected = |at: usize| Placed { place: Place::Image(start + at * size), size };
    elements.iter().enumerate().all(|(at, entry)| placed(entry) == Some(expected(at)))
}

/// The number by which the table compares: of UNSIGNED64 the value minus 2^63.
fn ordered(data_type: DataType, value: i128) -> i64 {
    let number = if data_type == DataType::Unsigned64 { value - (1 << 63) } else { value };
    i64::try_from(number).unwrap_or(if number < 0 { i64::MIN } else { i64::MAX })
}

fn limits(entry: &Entry) -> Option<(i64, i64)> {
    if !entry.is_limited() {
        return None;
    }
    if entry.data_type.family() == Family::Real {
        let RealLimits { low, high, .. } = &entry.real_limits;
        let order = |real: &Real| real.order(entry.data_type);
        // Without a limit, up to infinity; beyond it there is what is not a number.
        let infinity = Real::from(f64::INFINITY).order(entry.data_type);
        return Some((low.as_ref().map_or(-infinity, order), high.as_ref().map_or(infinity, order)));
    }
    let (low, high) = entry.data_type.range()?;
    Some((
        ordered(entry.data_type, entry.low.unwrap_or(low)),
        ordered(entry.data_type, entry.high.unwrap_or(high)),
    ))
}

/// Raw values that are named one by one.
enum Listed {
    /// Nothing else can be written.
    Only(Vec<i64>),
    /// They can be written although they may lie outside the limits.
    BesideLimits(Vec<i64>),
}

impl Listed {
    fn into_values(self) -> Vec<i64> {
        match self {
            Listed::Only(values) | Listed::BesideLimits(values) => values,
        }
    }
}

fn listed_values(entry: &Entry) -> Option<Listed> {
    let number = |value: i128| ordered(entry.data_type, value);
    let specials = entry.special.iter().map(|special| special.value);
    if let Some(TypeKind::Enum(values)) = entry.named_type.as_ref().map(|named| &named.kind) {
        let supported = values.iter().filter(|value| value.supported && entry.allows(value.value));
        let mut list: Vec<i64> = supported.map(|value| value.value).chain(specials).map(number).collect();
        list.sort_unstable();
        list.dedup();
        return Some(Listed::Only(list));
    }
    let limited = entry.low.is_some() || entry.high.is_some();
    (limited && !entry.special.is_empty()).then(|| Listed::BesideLimits(specials.map(number).collect()))
}
