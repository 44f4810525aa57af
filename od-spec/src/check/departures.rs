//! Where devices depart from the standards whose objects they take.

use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::System;
use crate::wording::{Notation, Wording};

/// A note for each object that says something else than the library it is taken from. Objects that devices share are noted
/// once.
pub fn departures(system: &System) -> Diagnostics {
    let words = Wording::english(Notation::Diagnostic);
    let mut notes = Diagnostics::new();
    let mut seen = std::collections::BTreeSet::new();
    for object in system.devices.iter().flat_map(|device| device.objects.values()) {
        let Some(profile) = object.profile.as_ref().filter(|_| !object.departures.is_empty()) else {
            continue;
        };
        if seen.insert((object.index, object.span.start)) {
            let departures: Vec<String> =
                object.departures.iter().map(|departure| words.departure(*departure)).collect();
            notes.push(Diagnostic::new(
                codes::DEPARTURE,
                object.span,
                format!("{} {} departs from {profile}: {}", object.index, object.name, departures.join(", ")),
            ));
        }
    }
    notes.sort();
    notes
}
