//! Where an object says something else than its library: how it comes to say the same.

use od_spec::diag::Edit;
use od_spec::model::{Author, Departure, Entry, Object, Part};
use od_spec::source::Span;
use od_spec::wording::{Notation, Wording};
use od_spec::yaml::Node;

use super::snapshot::Snapshot;

/// For each fact in which the object at a place departs from its library, the change that leaves the fact to the library: its
/// key is taken out. A key that shares its lines with something else has no such change.
pub(super) fn left_to_library(snapshot: &Snapshot, place: Span) -> Vec<(String, Edit)> {
    let Some((system, tree)) = snapshot.now.system().zip(snapshot.tree()) else { return Vec::new() };
    let objects = system.devices.iter().flat_map(|device| device.objects.values());
    let Some(object) = objects.filter(|object| object.span == place).find(|object| object.profile.is_some())
    else {
        return Vec::new();
    };
    let words = Wording::english(Notation::Diagnostic);
    let library = object.profile.as_deref().unwrap_or_default();
    let left = |departure: &Departure| {
        let stated = stated(object, *departure).filter(|span| span.file == snapshot.file)?;
        let (map, at) = pair_with(tree, stated)?;
        let span = without(snapshot.text(), map, at)?;
        let title = format!("Leave to {library}: {}", words.departure(*departure));
        Some((title, Edit { span, text: String::new() }))
    };
    object.departures.iter().filter_map(left).collect()
}

/// Where the maker states a fact of a part.
fn stated(object: &Object, departure: Departure) -> Option<Span> {
    let entry: Option<&Entry> = match departure.part {
        Part::Object => object.entries.first(),
        Part::Elements => object.counted().next(),
        Part::Entry(sub) | Part::Entries { first: sub, .. } => object.entry(sub),
        _ => None,
    };
    let statement = entry?.facts.get(departure.fact)?;
    (statement.author == Author::Maker).then_some(statement.span)
}

/// The map that a value is in, and its position there.
fn pair_with(node: &Node, value: Span) -> Option<(&Node, usize)> {
    if let Some(at) = node.entries().iter().position(|(_, node)| node.span == value) {
        return Some((node, at));
    }
    let below = node.entries().iter().map(|(_, node)| node).chain(node.items());
    below.filter(|node| node.span.start <= value.start).find_map(|node| pair_with(node, value))
}

/// What has to go for a map to be without one of its keys.
fn without(text: &str, map: &Node, at: usize) -> Option<Span> {
    let entries = map.entries();
    let (key, value) = entries.get(at)?;
    let (start, end) = (key.span.start as usize, value.span.end as usize);
    let is_comma =
        |range: std::ops::Range<usize>| text.get(range).is_some_and(|between| between.trim() == ",");
    let (start, end) = if text.get(map.span.start as usize..)?.starts_with('{') {
        // With the comma before it, or with the one after it.
        let before = at.checked_sub(1).map(|before| entries[before].1.span.end as usize);
        let next = entries.get(at + 1).map(|(key, _)| key.span.start as usize);
        match (before, next) {
            (Some(before), _) if is_comma(before..start) => (before, end),
            (_, Some(next)) if is_comma(end..next) => (start, next),
            (_, _) => return None,
        }
    } else {
        // With its lines, if they hold nothing else.
        let line = text[..start].rfind('\n').map_or(0, |at| at + 1);
        let next = text[end..].find('\n').map_or(text.len(), |at| end + at + 1);
        let is_alone = text[line..start].trim().is_empty() && text[end..next].trim().is_empty();
        is_alone.then_some((line, next))?
    };
    Some(Span { file: key.span.file, start: u32::try_from(start).ok()?, end: u32::try_from(end).ok()? })
}
