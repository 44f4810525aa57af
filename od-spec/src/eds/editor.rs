//! Lines in which CANopenEditor says more than an EDS has keys for: comments of a form of their own, which follow the keys of
//! their section.

use super::line::{Line, LineKind};
use crate::model::EditorProperty;

/// The property that a line says: `;StorageLocation=PERSIST_COMM`. Some programs write the key without the `;`.
pub(super) fn property<'l>(line: &'l Line<'_>) -> Option<(EditorProperty, &'l str)> {
    let (key, value) = match line.kind() {
        LineKind::Comment => line.comment()?.split_once('=')?,
        LineKind::KeyValue => (line.key()?, line.value()?),
        LineKind::Blank | LineKind::Header | LineKind::Unreadable => return None,
    };
    Some((EditorProperty::of_name(key.trim())?, value.trim()))
}

/// The lines of a section that are about the section itself: up to its last key, and the properties directly after it.
pub(super) fn own_lines<'l, 't>(body: &'l [Line<'t>]) -> &'l [Line<'t>] {
    let is_key = |line: &Line<'_>| !matches!(line.kind(), LineKind::Blank | LineKind::Comment);
    let keys = body.iter().rposition(is_key).map_or(0, |last| last + 1);
    let more = body[keys..].iter().take_while(|line| property(line).is_some()).count();
    &body[..keys + more]
}
