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

/// The entry that an element of an XDD or XDC describes, by the last model without errors.
pub(super) fn of_element(snapshot: &Snapshot, position: Position) -> Option<(String, Span)> {
    let system = snapshot.system()?;
    let offset = snapshot.offset(position);
    let (good, file, earlier) = snapshot.earlier(offset)?;
    let earlier = u32::try_from(earlier).ok()?;
    let holds = |span: Span| span.file == file && (span.start..=span.end).contains(&earlier);
    let entries = system.devices.iter().flat_map(od_spec::model::Dictionary::entries);
    let found = entries.filter(|(_, object, entry)| holds(entry.span) || holds(object.span));
    // The innermost element.
    let (id, object, one) = found.min_by_key(|(_, object, entry)| {
        let span = if holds(entry.span) { entry.span } else { object.span };
        (span.end - span.start, entry.sub)
    })?;
    let span = if holds(one.span) { one.span } else { object.span };
    let span = snapshot.span_now(good, span)?;
    Some((entry::of_entry(system, id, &[], Words::of(Some(system)))?, span))
}
