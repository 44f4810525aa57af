//! Objects that are as others (`like:`): what they do not say themselves, the other says.

use std::collections::{BTreeMap, BTreeSet};

use super::declared::{Decl, Declared};
use super::keys_have_effect;
use super::refs::Broken;
use crate::ast::{ArrayDecl, EntryDecl, ObjectDecl, RecordDecl, Spec, adopted};
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::limits::{ENTRIES_OF_FILE, Room};
use crate::model::{Index, Origin, SubIndex};
use crate::source::{FileId, Span, Spanned};

/// What to do where a device has no such object.
pub(super) const OF_DEVICE: &str = "name an object that is described for the same devices";
/// What to do where a library has no such object.
pub(super) const OF_LIBRARY: &str = "name an object of the library";

/// Objects that are like others, by index.
pub(super) type Waiting<'a> = BTreeMap<Index, &'a ObjectDecl>;

/// Whose objects are looked up.
pub(super) struct Owner<'a> {
    /// In a message: "`pmc`".
    pub name: String,
    /// Which objects it has.
    pub help: &'static str,
    /// The maker's file.
    pub file: FileId,
    /// What is written for it, but cannot be used.
    pub written: BTreeSet<Index>,
    /// What only others have.
    pub others: &'a Broken,
}

/// Adds the objects of a device that are like others of it.
pub(super) fn resolve(
    waiting: &Waiting<'_>,
    owner: &Owner<'_>,
    room: &mut Room,
    declared: &mut BTreeMap<Index, Declared<'_>>,
    diagnostics: &mut Diagnostics,
) {
    if waiting.is_empty() {
        return;
    }
    let there: Vec<Index> = declared.keys().copied().collect();
    let is_there = |like: Spanned<Index>, over: &ObjectDecl, diagnostics: &mut Diagnostics| {
        let found = there.binary_search(&like.value).is_ok();
        let is_broken = owner.written.contains(&like.value);
        if !found && !is_broken && diagnostics.is_new(codes::UNKNOWN_ENTRY, like.span) {
            diagnostics.push(missing(like, over, (&owner.name, owner.help), owner.others));
        }
        found
    };
    for over in in_order(waiting, is_there, diagnostics) {
        let Some(below) = over.like.and_then(|like| Some((like, declared.get(&like.value)?))) else {
            continue;
        };
        let (like, below) = (below.0, &below.1.decl);
        let Some(decl) = made(over, below, like, owner.file, room, diagnostics) else { continue };
        let decl = Decl::Made(Box::new(decl));
        let one = Declared { decl, origin: Origin::Manual, profile: None, departures: Vec::new() };
        declared.insert(over.index.value, one);
    }
}

/// Puts the objects of a library in full that are like others of it.
pub(crate) fn expand(library: &mut Spec, diagnostics: &mut Diagnostics) {
    if library.objects.iter().all(|decl| decl.like.is_none()) {
        return;
    }
    let mut room = Room::new(ENTRIES_OF_FILE);
    let place: BTreeMap<Index, usize> =
        library.objects.iter().enumerate().map(|(at, decl)| (decl.index.value, at)).collect();
    let waiting = waiting(library.objects.iter());
    let is_there = |like: Spanned<Index>, over: &ObjectDecl, diagnostics: &mut Diagnostics| {
        let found = place.contains_key(&like.value);
        if !found && diagnostics.is_new(codes::UNKNOWN_ENTRY, like.span) {
            diagnostics.push(missing(like, over, ("the library", OF_LIBRARY), &Broken::default()));
        }
        found
    };
    let order: Vec<Index> =
        in_order(&waiting, is_there, diagnostics).iter().map(|decl| decl.index.value).collect();
    for at in order.iter().filter_map(|index| place.get(index).copied()) {
        let over = &library.objects[at];
        let Some(like) = over.like else { continue };
        let Some(below) = place.get(&like.value).map(|below| &library.objects[*below]) else { continue };
        if let Some(decl) = made(over, below, like, library.file, &mut room, diagnostics) {
            library.objects[at] = ObjectDecl { like: None, ..decl };
        }
    }
}

/// Those of some objects that are like others.
pub(super) fn waiting<'a>(objects: impl Iterator<Item = &'a ObjectDecl>) -> Waiting<'a> {
    objects.filter(|decl| decl.like.is_some()).map(|decl| (decl.index.value, decl)).collect()
}

/// How far an object is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum State {
    /// What it is like is being looked for.
    Asked,
    /// What it is like is there.
    Found,
    /// What it is like is not there; that was said.
    Refused,
}

/// The objects that can be made, each after the one that it is like.
fn in_order<'a>(
    waiting: &Waiting<'a>,
    mut is_there: impl FnMut(Spanned<Index>, &ObjectDecl, &mut Diagnostics) -> bool,
    diagnostics: &mut Diagnostics,
) -> Vec<&'a ObjectDecl> {
    let mut states: BTreeMap<Index, State> = BTreeMap::new();
    let mut order = Vec::with_capacity(waiting.len());
    for first in waiting.values().copied() {
        let (mut chain, mut next) = (Vec::new(), first);
        let end = loop {
            match states.get(&next.index.value) {
                Some(State::Asked) => {
                    diagnostics.push(circle(&chain, next));
                    break State::Refused;
                }
                Some(known) => break *known,
                None => {}
            }
            states.insert(next.index.value, State::Asked);
            chain.push(next);
            let Some(like) = next.like else { break State::Refused };
            match waiting.get(&like.value) {
                Some(further) => next = *further,
                None if is_there(like, next, diagnostics) => break State::Found,
                None => break State::Refused,
            }
        };
        for decl in chain.into_iter().rev() {
            states.insert(decl.index.value, end);
            if end == State::Found {
                order.push(decl);
            }
        }
    }
    order
}

/// Objects of which each is like the next, and the last like `first`.
fn circle(chain: &[&ObjectDecl], first: &ObjectDecl) -> Diagnostic {
    /// So many of a circle are shown.
    const SHOWN: usize = 4;
    let from = chain.iter().position(|decl| decl.index.value == first.index.value).unwrap_or(0);
    let all = &chain[from..];
    let like = |decl: &ObjectDecl| decl.like.map_or(decl.index.span, |like| like.span);
    let index = first.index.value;
    let (message, help) = if all.len() == 1 {
        (format!("{index} is like itself"), "name another object, or describe this one in full")
    } else {
        let others: Vec<String> =
            all.iter().skip(1).take(SHOWN).map(|decl| decl.index.value.to_string()).collect();
        let more = if all.len() > SHOWN + 1 { " and others" } else { "" };
        let message = format!("{index} is like itself, by way of {}{more}", others.join(", "));
        (message, "describe one of these objects in full")
    };
    let diagnostic = Diagnostic::new(codes::LIKE_ITSELF, like(first), message).about(index).help(help);
    let diagnostic =
        if all.len() == 1 { diagnostic.with(first.index.span, "the object") } else { diagnostic };
    all.iter().skip(1).take(SHOWN).fold(diagnostic, |diagnostic, decl| {
        let other = decl.like.map_or(index, |like| like.value);
        diagnostic.with(like(decl), format!("{} is like {other}", decl.index.value))
    })
}

fn missing(
    like: Spanned<Index>,
    over: &ObjectDecl,
    (owner, otherwise): (&str, &str),
    others: &Broken,
) -> Diagnostic {
    let message = format!("{owner} has no object {} that {} could be like", like.value, over.index.value);
    let diagnostic = Diagnostic::new(codes::UNKNOWN_ENTRY, like.span, message);
    match others.elsewhere(like.value) {
        Some((place, help)) => diagnostic.with(place, "this one is for other devices").help(help),
        None => diagnostic.help(otherwise),
    }
}

/// The object that a declaration makes with the one that it is like.
fn made(
    over: &ObjectDecl,
    below: &ObjectDecl,
    like: Spanned<Index>,
    maker: FileId,
    room: &mut Room,
    diagnostics: &mut Diagnostics,
) -> Option<ObjectDecl> {
    if is_of_another_kind(over, below, like, diagnostics) {
        return None;
    }
    let weight = over.weight.saturating_add(below.weight);
    if let Err(full) = room.take(below.entries(), weight) {
        let message = format!("{} with this object; a file describes less", full.words(ENTRIES_OF_FILE));
        diagnostics.push(
            Diagnostic::new(codes::TOO_MUCH, like.span, message)
                .help("correct the run or the `count`, or describe the objects in several files"),
        );
        return None;
    }
    let below = adopted_object(below, maker, like.span);
    let merged = ObjectDecl { weight, ..laid_over(over, below) };
    let shaped = ObjectDecl { entry: over.entry.clone(), ..merged.clone() };
    keys_have_effect::check_object(&shaped, diagnostics);
    keys_have_effect::check_omitted(over, &merged, diagnostics);
    Some(merged)
}

/// Reports keys that make something else of the object than the one that it is like.
fn is_of_another_kind(
    over: &ObjectDecl,
    below: &ObjectDecl,
    like: Spanned<Index>,
    diagnostics: &mut Diagnostics,
) -> bool {
    let refused = [
        (
            "from",
            over.from.as_ref().map(|from| from.span),
            Some("an object is taken from a library, or is like another"),
        ),
        (
            "alias",
            over.alias.as_ref().map(|alias| alias.span),
            below.alias.is_none().then_some("the object that this one is like is not an alias"),
        ),
        (
            "array",
            over.array.as_ref().map(|array| array.span),
            below.array.is_none().then_some("the object that this one is like is not an array"),
        ),
        (
            "record",
            over.record.as_ref().map(|record| record.span),
            below.record.is_none().then_some("the object that this one is like is not a record"),
        ),
    ];
    let mut refused = refused.into_iter().filter_map(|(key, place, why)| Some((key, place?, why?)));
    let Some((key, place, why)) = refused.next() else { return false };
    let (other, label) =
        if key == "from" { (like.span, "the other one") } else { (below.index.span, "that object") };
    diagnostics.push(
        Diagnostic::new(codes::CONFLICTING_KEYS, place, why)
            .with(other, label)
            .help(format!("remove `{key}:`, or describe the object without `like:`")),
    );
    true
}

/// The object as if the maker had said at `place` what a library says of it.
fn adopted_object(decl: &ObjectDecl, maker: FileId, place: Span) -> ObjectDecl {
    if decl.from.is_none() && decl.index.span.file.is_one_with(maker) {
        return decl.clone();
    }
    let span = |written: Span| adopted(written, maker, place);
    let entry = |entry: &EntryDecl| {
        let mut entry = entry.adopted(maker, place);
        if let Some(default) = &mut entry.default {
            default.value = default.value.adopted(maker, place);
        }
        entry
    };
    let members = |members: &[(Spanned<SubIndex>, EntryDecl)]| {
        members.iter().map(|(sub, one)| (Spanned::new(sub.value, span(sub.span)), entry(one))).collect()
    };
    ObjectDecl {
        array: decl.array.as_ref().map(|array| {
            Box::new(ArrayDecl {
                span: span(array.span),
                count: array.count.map(|count| Spanned::new(count.value, span(count.span))),
                entry: entry(&array.entry),
                elements: members(&array.elements),
            })
        }),
        record: decl
            .record
            .as_ref()
            .map(|record| RecordDecl { span: span(record.span), members: members(&record.members) }),
        sub0: decl.sub0.as_ref().map(|sub0| Box::new(entry(sub0))),
        entry: entry(&decl.entry),
        ..decl.clone()
    }
}

/// What the other object says where it is not said here. What goes down to the entries here goes before what the other says of
/// each. Its name, its identifier, the words by which readers look for it, its links and its devices are its own.
fn laid_over(over: &ObjectDecl, below: ObjectDecl) -> ObjectDecl {
    let common = over.entry.inherited();
    let head = EntryDecl { name: None, identifier: None, search: None, ..taken(&below.entry, &over.entry) };
    let array = below.array.map(|below| {
        let Some(over) = &over.array else {
            let elements = all_taken(below.elements, &[&common]);
            return Box::new(ArrayDecl { entry: taken(&below.entry, &common), elements, ..*below });
        };
        let count = over.count.or(below.count);
        let still_there = |sub: SubIndex| count.is_none_or(|count| i128::from(sub.0) <= count.value);
        let elements =
            below.elements.into_iter().filter(|(sub, _)| over.count.is_none() || still_there(sub.value));
        let elements = all_taken(elements.collect(), &[&common, &over.entry]);
        Box::new(ArrayDecl {
            span: over.span,
            count,
            entry: over.entry.over(&taken(&below.entry, &common)),
            elements: joined(&over.elements, elements),
        })
    });
    let record = below.record.map(|below| {
        let members = all_taken(below.members, &[&common]);
        match &over.record {
            Some(over) => RecordDecl { span: over.span, members: joined(&over.members, members) },
            None => RecordDecl { members, ..below },
        }
    });
    let sub0 = match (&over.sub0, below.sub0) {
        (Some(over), Some(below)) => Some(Box::new(over.over(&below))),
        (over, below) => over.clone().or(below),
    };
    // What the other leaves out is left out here, unless it is written here.
    let elements = over.array.iter().flat_map(|array| &array.elements);
    let mut written = elements.chain(over.record.iter().flat_map(|record| &record.members));
    let mut omit = below.omit;
    omit.retain(|omitted| !written.any(|(sub, _)| i128::from(sub.value.0) == omitted.value));
    omit.extend(&over.omit);
    ObjectDecl {
        alias: over.alias.clone().or(below.alias),
        outside: over.outside.or(below.outside),
        rounding: over.rounding.or(below.rounding),
        array,
        record,
        sub0,
        omit,
        entry: over.entry.over(&head),
        ..over.clone()
    }
}

type Members = Vec<(Spanned<SubIndex>, EntryDecl)>;

/// What is taken of entries where others state what goes before it.
fn all_taken(members: Members, stated: &[&EntryDecl]) -> Members {
    let entry = |entry| stated.iter().fold(entry, |entry, stated| taken(&entry, stated));
    members.into_iter().map(|(sub, one)| (sub, entry(one))).collect()
}

/// What is taken of an entry: what is not stated otherwise, and no condition of writing what can only be read.
pub(super) fn taken(below: &EntryDecl, stated: &EntryDecl) -> EntryDecl {
    let mut taken = below.without(stated);
    if stated.access.is_some_and(|access| !access.value.access.is_writable()) {
        taken.writable_when = None;
    }
    taken
}

fn joined(over: &Members, below: Members) -> Members {
    let mut all: BTreeMap<SubIndex, (Spanned<SubIndex>, EntryDecl)> =
        below.into_iter().map(|(sub, entry)| (sub.value, (sub, entry))).collect();
    for (sub, entry) in over {
        let laid = all.get(&sub.value).map(|(_, below)| entry.over(&taken(below, entry)));
        all.insert(sub.value, (*sub, laid.unwrap_or_else(|| entry.clone())));
    }
    all.into_values().collect()
}
