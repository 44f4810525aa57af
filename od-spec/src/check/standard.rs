//! What rules compare with.

use crate::model::{Entry, Index, Object, ObjectKind, SubIndex};

/// What the standards say about objects. The caller that has read the standards passes them in: reading them needs what
/// is computed before rules.
#[derive(Clone, Copy)]
pub(crate) struct Standard {
    /// The object that it defines at an index; for one of a run, the first of the run.
    pub object: fn(Index) -> Option<&'static Object>,
    /// Whether the library `cia301` has the object at an index.
    pub is_in_library: fn(Index) -> bool,
    /// The object that a library of another standard has at an index, as the first axis has it.
    pub in_library: fn(&str, Index) -> Option<&'static Object>,
}

impl Standard {
    /// The entry of an object at a sub-index.
    pub(super) fn entry(self, index: Index, sub: SubIndex) -> Option<&'static Entry> {
        continued((self.object)(index)?, sub)
    }
}

/// The entry of a described object at a sub-index: an array goes on as its last element that is described.
pub(crate) fn continued(object: &Object, sub: SubIndex) -> Option<&Entry> {
    let goes_on = object.kind == ObjectKind::Array && sub.0 > 0 && sub != SubIndex::STRUCTURE;
    object.entry(sub).or_else(|| object.entries.last().filter(|_| goes_on))
}
