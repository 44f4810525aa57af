//! What one rule finds in one device.

use std::collections::BTreeSet;

use crate::diag::{Diagnostic, Diagnostics};
use crate::model::Dictionary;
use crate::source::{FileId, Span};

/// What one rule finds.
pub(crate) struct Findings {
    /// The place of the device, where many different findings may be.
    device: Option<Span>,
    blamed: BTreeSet<Span>,
    list: Diagnostics,
}

impl Findings {
    /// For a rule over what the devices share.
    pub(super) const fn anywhere() -> Self {
        Self { device: None, blamed: BTreeSet::new(), list: Diagnostics::new() }
    }

    /// For a rule over a device.
    pub(super) const fn of(device: &Dictionary) -> Self {
        Self { device: Some(device.span), blamed: BTreeSet::new(), list: Diagnostics::new() }
    }

    /// Adds one of several findings that may have one place: a setting can break two conditions.
    pub(super) fn push_each(&mut self, diagnostic: Diagnostic) {
        self.list.push(diagnostic);
    }

    /// Adds a finding about a fact, unless another entry that has the fact from the same place was blamed already.
    pub(super) fn push(&mut self, diagnostic: Diagnostic) {
        let place = diagnostic.labels.first().map(|label| label.span);
        let is_new = place.is_none_or(|place| Some(place) == self.device || self.blamed.insert(place));
        if is_new {
            self.list.push(diagnostic);
        }
    }

    pub(super) fn into_diagnostics(self) -> Diagnostics {
        self.list
    }

    /// The findings that are at one of these places.
    pub(super) fn standing_at(self, places: &BTreeSet<Span>) -> Diagnostics {
        let mut standing = Diagnostics::new();
        for diagnostic in &self.list {
            if diagnostic.labels.first().is_some_and(|label| places.contains(&label.span)) {
                standing.push(diagnostic.clone());
            }
        }
        standing
    }

    /// The findings that have a place in one of these files.
    pub(super) fn touching(self, files: &BTreeSet<FileId>) -> Diagnostics {
        let mut touching = Diagnostics::new();
        for diagnostic in &self.list {
            if diagnostic.labels.iter().any(|label| files.contains(&label.span.file)) {
                touching.push(diagnostic.clone());
            }
        }
        touching
    }
}

/// `1 more entry of the object`, `2 more entries of the object`: where one finding represents several.
pub(super) fn others(more: usize) -> String {
    format!("{more} more {} of the object", if more == 1 { "entry" } else { "entries" })
}
