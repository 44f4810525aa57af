//! What an entry is, where a section of an EDS or DCF says it.

use lsp_types::Position;
use od_spec::eds::{Document, LineKind, Owner};
use od_spec::model::{EntryId, SubIndex};
use od_spec::source::Span;

use super::{Words, entry};
use crate::snapshot::Snapshot;

/// The entry that a header or a key belongs to, and the line. Of an object with entries, sub-index 0.
pub(super) fn of_section(snapshot: &Snapshot, position: Position) -> Option<(String, Span)> {
    let offset = u32::try_from(snapshot.offset(position)).ok()?;
    let document = Document::scan(snapshot.file, snapshot.text());
    let lines = document.lines().iter();
    let spoken = lines.filter(|line| matches!(line.kind(), LineKind::Header | LineKind::KeyValue));
    let mut places = spoken.filter_map(|line| document.place(line));
    let place = places.find(|place| (place.start..=place.end).contains(&offset))?;
    let id = match document.owner(place) {
        Owner::File => return None,
        Owner::Object(index) => EntryId { index, sub: SubIndex(0) },
        Owner::Entry(id) => id,
    };
    let system = snapshot.system()?;
    Some((entry::of_entry(system, id, &[], Words::of(Some(system)))?, place))
}
