//! Which declarations make up a device: its own objects, laid over a library's where `from:` says so, and the objects
//! that its features bring.

use std::collections::{BTreeMap, BTreeSet};

use super::channels::{self, Elements};
use super::declared::{Decl, Declared};
use super::features::{self, Selected};
use super::keys_have_effect;
use super::libraries::{self, Libraries};
use super::likes::{self, Owner};
use super::refs::Broken;
use super::scope::Scope;
use crate::ast::{ArrayDecl, DeviceDecl, EntryDecl, Name, ObjectDecl, RecordDecl, Spec};
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::limits::{ENTRIES_OF_FILE, Room};
use crate::model::{DataType, Departure, Fact, Index, Origin, Part, SubIndex};
use crate::source::Spanned;

/// All declarations of a device by index.
pub(super) fn of_device<'a>(
    written: &[&'a ObjectDecl],
    libraries: &Libraries<'a>,
    device: &DeviceDecl,
    others: &Broken,
    room: &mut Room,
    scope: &Scope,
    diagnostics: &mut Diagnostics,
) -> BTreeMap<Index, Declared<'a>> {
    let selected = features::of_device(libraries, device, diagnostics);
    let elements = channels::elements(&selected, device, diagnostics);
    let mut declared = of_specification(written, libraries, &elements, scope, diagnostics);
    let waiting = likes::waiting(written.iter().copied());
    for Selected { library, feature, axis, .. } in selected {
        for index in &feature.objects {
            let Some(decl) = libraries.written(library, index.value) else {
                diagnostics.push(
                    Diagnostic::new(
                        codes::NOT_IN_LIBRARY,
                        index.span,
                        format!(
                            "feature `{}` names {}, which the library does not define",
                            feature.name.value, index.value
                        ),
                    )
                    .help("define the object in the library, or correct the index"),
                );
                continue;
            };
            let decl = match (library.axes.filter(|_| axis > 1), elements.of(library, index.value)) {
                (Some(axes), _) => {
                    libraries::on_axis(decl, axes, axis).map(|decl| Decl::Made(Box::new(decl)))
                }
                (None, Some(count)) => Some(Decl::Made(Box::new(channels::with_elements(decl, count)))),
                (None, None) => Some(Decl::Written(decl)),
            };
            let Some(decl) = decl.filter(|decl| !waiting.contains_key(&decl.index.value)) else { continue };
            declared.entry(decl.index.value).or_insert_with(|| Declared {
                decl,
                origin: Origin::Profile,
                profile: library.profile.as_ref().map(|name| name.value.clone()),
                departures: Vec::new(),
            });
        }
    }
    let name = format!("`{}`", device.key.value);
    let owner =
        Owner { name, help: likes::OF_DEVICE, file: device.key.span.file, written: indices(written), others };
    likes::resolve(&waiting, &owner, room, &mut declared, diagnostics);
    declared
}

/// All declarations of a library that is compiled by itself.
pub(super) fn of_library<'a>(
    root: &'a Spec,
    libraries: &Libraries<'a>,
    scope: &Scope,
    diagnostics: &mut Diagnostics,
) -> BTreeMap<Index, Declared<'a>> {
    let written = root.objects.iter().collect::<Vec<_>>();
    let mut declared = of_specification(&written, libraries, &Elements::default(), scope, diagnostics);
    let (none, waiting) = (Broken::default(), likes::waiting(written.iter().copied()));
    let owner = Owner {
        name: "the library".to_owned(),
        help: likes::OF_LIBRARY,
        file: root.file,
        written: indices(&written),
        others: &none,
    };
    likes::resolve(&waiting, &owner, &mut Room::new(ENTRIES_OF_FILE), &mut declared, diagnostics);
    declared
}

fn indices(written: &[&ObjectDecl]) -> BTreeSet<Index> {
    written.iter().map(|decl| decl.index.value).collect()
}

/// The declarations that are in the specification itself.
fn of_specification<'a>(
    written: &[&'a ObjectDecl],
    libraries: &Libraries<'a>,
    elements: &Elements,
    scope: &Scope,
    diagnostics: &mut Diagnostics,
) -> BTreeMap<Index, Declared<'a>> {
    let mut declared = BTreeMap::new();
    for decl in written.iter().copied().filter(|decl| decl.like.is_none()) {
        let one = match &decl.from {
            Some(from) => from_library(decl, from, libraries, elements, scope, diagnostics),
            None => match Some(decl)
                .filter(|decl| is_departure(decl))
                .and_then(|decl| libraries.defining(decl.index.value))
            {
                Some(library) => {
                    diagnostics.push(not_taken(decl, library));
                    None
                }
                None => Some(as_written(decl, diagnostics)),
            },
        };
        if let Some(one) = one {
            declared.insert(decl.index.value, one);
        }
    }
    declared
}

/// A declaration that no library has a part in.
fn as_written<'a>(decl: &'a ObjectDecl, diagnostics: &mut Diagnostics) -> Declared<'a> {
    if decl.array.is_some() {
        keys_have_effect::check_omitted(decl, decl, diagnostics);
    }
    Declared { decl: Decl::Written(decl), origin: Origin::Manual, profile: None, departures: Vec::new() }
}

/// Whether an object lacks what only a library could say.
const fn is_departure(decl: &ObjectDecl) -> bool {
    let entry = &decl.entry;
    entry.name.is_none() && entry.type_name.is_none() && decl.alias.is_none() && !entry.unsure
}

/// An object says what differs from the library's, and not that it is the library's.
fn not_taken(decl: &ObjectDecl, library: &str) -> Diagnostic {
    let index = decl.index.value;
    let message = format!("object {index} has neither a name nor `from: {library}`");
    Diagnostic::new(codes::MISSING_KEY, decl.index.span, message)
        .help(format!("write `from: {library}` next to what differs from the library's, or describe the object with `name:` and `type:`"))
}

fn from_library<'a>(
    decl: &ObjectDecl,
    from: &Name,
    libraries: &Libraries<'_>,
    elements: &Elements,
    scope: &Scope,
    diagnostics: &mut Diagnostics,
) -> Option<Declared<'a>> {
    let library = libraries.named(from, diagnostics)?;
    let Some(below) = libraries.object(library, decl.index.value) else {
        let what = decl.index.value.to_string();
        diagnostics.push(libraries::not_there(from, &what).help("write the object in full, without `from:`"));
        return None;
    };
    let below = match elements.of(library, decl.index.value) {
        Some(count) => channels::with_elements(&below, count),
        None => below,
    };
    let (merged, departures) = lay_over(decl, &below, scope);
    check_own_keys(decl, &merged, diagnostics);
    let merged = Decl::Made(Box::new(merged));
    Some(Declared { decl: merged, origin: Origin::Manual, profile: Some(from.value.clone()), departures })
}

/// Checks that what the declaration itself says has an effect on the object that it makes with the library's.
fn check_own_keys(decl: &ObjectDecl, merged: &ObjectDecl, diagnostics: &mut Diagnostics) {
    let shaped = ObjectDecl { entry: decl.entry.clone(), ..merged.clone() };
    keys_have_effect::check_object(&shaped, diagnostics);
    let structured = merged.array.is_some() || merged.record.is_some();
    if let Some(sub0) = decl.sub0.as_ref().filter(|_| !structured) {
        keys_have_effect::refuse_sub0(sub0, diagnostics);
    }
    if let (Some(from), Some(alias)) = (&decl.from, &decl.alias) {
        diagnostics.push(
            Diagnostic::new(codes::CONFLICTING_KEYS, alias.span, "an alias takes nothing from a library")
                .with(from.span, "the library")
                .help("keep one of `alias:` and `from:`"),
        );
    }
    keys_have_effect::check_omitted(decl, merged, diagnostics);
}

/// The declaration over the library's, and the facts in which they differ.
fn lay_over(over: &ObjectDecl, below: &ObjectDecl, scope: &Scope) -> (ObjectDecl, Vec<Departure>) {
    let mut departures = Vec::new();
    let differences = |over: &EntryDecl, below: &EntryDecl| differences(over, below, scope);
    let mut note = |part: Part, facts: Vec<Fact>| {
        let departing = facts.into_iter().filter(|fact| is_fixed_by_standards(*fact));
        departures.extend(departing.map(|fact| Departure { part, fact }));
    };
    note(Part::Object, differences(&over.entry, &below.entry));
    let array = match (&over.array, &below.array) {
        (Some(over), Some(below)) => {
            note(Part::Elements, differences(&over.entry, &below.entry));
            let elements = within(&below.elements, over.count);
            for (sub, element) in &elements {
                // What the array says of all elements, and the library of this one.
                let of_both = over.entry.without(&over.entry.without(element));
                note(Part::Entry(sub.value), differences(&of_both, element));
            }
            if over.count.is_some() && over.count != below.count {
                note(Part::Object, vec![Fact::Count]);
            }
            Some(Box::new(ArrayDecl {
                span: over.span,
                count: over.count.or(below.count),
                entry: over.entry.over(&below.entry),
                elements: merge_members(&over.elements, &elements, &over.entry, scope, &mut note),
            }))
        }
        // An object that says it is something else than the library's object is that.
        (over_array, below_array) => {
            over_array.clone().or_else(|| below_array.clone().filter(|_| over.record.is_none()))
        }
    };
    let record = match (&over.record, &below.record) {
        (Some(over), Some(below)) => Some(RecordDecl {
            span: over.span,
            members: merge_members(
                &over.members,
                &below.members,
                &EntryDecl::empty(over.span),
                scope,
                &mut note,
            ),
        }),
        (over_record, below_record) => {
            over_record.clone().or_else(|| below_record.clone().filter(|_| over.array.is_none()))
        }
    };
    let sub0 = match (&over.sub0, &below.sub0) {
        (Some(over), Some(below)) => {
            note(Part::Entry(SubIndex(0)), differences(over, below));
            Some(Box::new(over.over(below)))
        }
        (over, below) => over.clone().or_else(|| below.clone()),
    };
    if over.array.is_some() != below.array.is_some() && (over.array.is_some() || over.record.is_some()) {
        note(Part::Object, vec![Fact::ObjectType]);
    }
    let merged = ObjectDecl {
        index: over.index,
        weight: over.weight,
        devices: over.devices.clone(),
        from: over.from.clone(),
        like: over.like,
        alias: over.alias.clone(),
        outside: over.outside,
        rounding: over.rounding,
        array,
        record,
        sub0,
        omit: over.omit.clone(),
        links: over.links.clone().or_else(|| below.links.clone()),
        editor: over.editor.clone(),
        entry: over.entry.over(&below.entry),
    };
    (merged, departures)
}

/// Whether a standard has a say in a fact. What is stored, how much fits and what things are called in code is the maker's
/// affair.
const fn is_fixed_by_standards(fact: Fact) -> bool {
    !matches!(
        fact,
        Fact::About
            | Fact::Gap
            | Fact::Warning
            | Fact::Search
            | Fact::Since
            | Fact::Storage
            | Fact::Eds
            | Fact::Capacity
            | Fact::Identifier
    )
}

/// The facts in which an entry differs. A type of the same width and sign with other bits or values differs in its meaning
/// only, and not at all where it says the same in its own words.
fn differences(over: &EntryDecl, below: &EntryDecl, scope: &Scope) -> Vec<Fact> {
    let on_the_bus = |entry: &EntryDecl| {
        let name = &entry.type_name.as_ref()?.value;
        DataType::from_name(name).or_else(|| Some(scope.types.get(name)?.base))
    };
    let same = on_the_bus(over).is_some() && on_the_bus(over) == on_the_bus(below);
    let named = |entry: &EntryDecl| scope.types.get(&entry.type_name.as_ref()?.value);
    let agrees = same && named(over).zip(named(below)).is_some_and(|(over, below)| over.agrees_with(below));
    let lower = |entry: &EntryDecl| entry.name.as_ref().map(|name| name.value.to_lowercase());
    // What the library leaves to the device is no difference, nor is a name in another case.
    let left_open = |fact: Fact| match fact {
        Fact::Name => lower(over) == lower(below),
        Fact::Default => below.default.is_none(),
        Fact::LowLimit => below.min.is_none(),
        Fact::HighLimit => below.max.is_none(),
        Fact::Unit => below.unit.is_none(),
        Fact::Special => below.special.is_none(),
        Fact::Type => agrees,
        _ => false,
    };
    let facts = over.differences(below).into_iter().filter(|fact| !left_open(*fact));
    facts.map(|fact| if fact == Fact::Type && same { Fact::Meaning } else { fact }).collect()
}

/// The library's elements that an array with this count still has.
fn within(elements: &Members, count: Option<Spanned<i128>>) -> Members {
    let fits = |sub: SubIndex| count.is_none_or(|count| i128::from(sub.0) <= count.value);
    elements.iter().filter(|(sub, _)| fits(sub.value)).cloned().collect()
}

type Members = Vec<(Spanned<SubIndex>, EntryDecl)>;

/// The entries here over those of the library, of which `stated` goes before what the library says of each.
fn merge_members(
    over: &Members,
    below: &Members,
    stated: &EntryDecl,
    scope: &Scope,
    note: &mut impl FnMut(Part, Vec<Fact>),
) -> Members {
    let mut merged: BTreeMap<SubIndex, (Spanned<SubIndex>, EntryDecl)> =
        below.iter().map(|(sub, entry)| (sub.value, (*sub, likes::taken(entry, stated)))).collect();
    let mut added: Vec<SubIndex> = Vec::new();
    for (sub, entry) in over {
        let laid = match merged.get(&sub.value) {
            Some((_, below)) => {
                note(Part::Entry(sub.value), differences(entry, below, scope));
                entry.over(below)
            }
            None => {
                added.push(sub.value);
                entry.clone()
            }
        };
        merged.insert(sub.value, (*sub, laid));
    }
    match added.as_slice() {
        [] => {}
        [one] => note(Part::Entry(*one), vec![Fact::Presence]),
        [first, .., last] => note(Part::Entries { first: *first, last: *last }, vec![Fact::Presence]),
    }
    merged.into_values().collect()
}
