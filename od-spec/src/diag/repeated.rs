//! One finding for what a file does on many lines.

use super::{Diagnostic, Diagnostics, Edit, worded};
use crate::source::Span;

/// A finding that may hold for many places of a file. It is said once, at the first of them, with what puts all of them
/// right: a list of hundreds of equal messages is not read.
pub(crate) struct Repeated {
    first: Option<(Span, Diagnostic)>,
    places: usize,
    edits: Vec<Edit>,
}

impl Repeated {
    pub(crate) const fn new() -> Self {
        Self { first: None, places: 0, edits: Vec::new() }
    }

    /// Whether no place was added.
    pub(crate) const fn is_empty(&self) -> bool {
        self.places == 0
    }

    /// Adds a place with what fixes it there; `say` makes the message if the place is the first of the file.
    pub(crate) fn add(
        &mut self,
        place: Span,
        edits: impl IntoIterator<Item = Edit>,
        say: impl FnOnce() -> Diagnostic,
    ) {
        self.places += 1;
        self.edits.extend(edits);
        if self.first.as_ref().is_none_or(|(first, _)| place < *first) {
            self.first = Some((place, say()));
        }
    }

    /// Says it, and of how many more `places` (a plural) it is true.
    pub(crate) fn finish(self, places: &str, diagnostics: &mut Diagnostics) {
        if let Some(diagnostic) = self.into_diagnostic(places) {
            diagnostics.push(diagnostic);
        }
    }

    /// What there is to say: [`finish`](Self::finish), for a rule that has its own list of findings.
    pub(crate) fn into_diagnostic(self, places: &str) -> Option<Diagnostic> {
        let (_, mut diagnostic) = self.first?;
        if self.places > 1 {
            let more = self.places - 1;
            diagnostic.message += &worded(format!("; {more} more {} like this", counted(places, more)));
        }
        diagnostic.edits.extend(self.edits);
        Some(diagnostic)
    }
}

/// A plural, or the singular for one.
fn counted(plural: &str, count: usize) -> String {
    match (count, plural.strip_suffix("ies")) {
        (1, Some(stem)) => format!("{stem}y"),
        (1, None) => plural.strip_suffix('s').unwrap_or(plural).to_owned(),
        _ => plural.to_owned(),
    }
}
