//! What an entry is, in the section of an EDS or DCF or the element of an XDD or XDC that describes it.

use lsp_types::Position;
use od_spec::eds::{Document, LineKind, Owner};
use od_spec::model::{EntryId, SubIndex};
use od_spec::source::Span;

use super::{Words, entry};
use crate::eds::referring;
use crate::snapshot::Snapshot;

/// The entry that a header or a key belongs to, and the line. Of an object with entries, sub-index 0.
pub(super) fn of_section(snapshot: &Snapshot, position: Position) -> Option<(String, Span)> {
    let offset = u32::try_from(snapshot.offset(position)).ok()?;
    let document = Document::scan(snapshot.file, snapshot.text());
    let lines = document.lines().iter();
    let spoken = lines.filter(|line| matches!(line.kind(), LineKind::Header | LineKind::KeyValue));
    let mut places = spoken.filter_map(|line| document.place(line));
    let place = places.find(|place| (place.start..=place.end).contains(&offset))?;
    let mut values = referring(snapshot.file, snapshot.text()).into_iter();
    let meant = values.find(|one| (one.value.start..=one.value.end).contains(&offset));
    let id = match (meant, document.owner(place)) {
        (Some(meant), _) => meant.id,
        (None, Owner::File) => return None,
        (None, Owner::Object(index)) => EntryId { index, sub: SubIndex(0) },
        (None, Owner::Entry(id)) => id,
    };
    let system = snapshot.system()?;
    Some((entry::of_entry(system, id, &[], Words::of(Some(system)))?, place))
}

/// The entry that the element at a position of an XDD or XDC describes, by the last model without errors.
pub(super) fn of_element(snapshot: &Snapshot, position: Position) -> Option<(String, Span)> {
    let (good, system) = snapshot.good.as_ref().zip(snapshot.system())?;
    let (text, offset) = (snapshot.text(), snapshot.offset(position));
    let start = text[..offset].rfind('<')?;
    let end = offset + text[offset..].find('>')? + 1;
    let byte = |at: usize| u32::try_from(at).ok();
    let element = Span { file: snapshot.file, start: byte(start)?, end: byte(end)? };
    let is_there = |span| snapshot.span_now(good, span).is_some_and(|span| element.contains(span));
    let mut entries = system.devices.iter().flat_map(od_spec::model::Dictionary::entries);
    let (id, ..) = entries.find(|(_, object, entry)| is_there(entry.span) || is_there(object.span))?;
    Some((entry::of_entry(system, id, &[], Words::of(Some(system)))?, element))
}
