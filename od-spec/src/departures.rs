//! Where devices depart from the standards whose objects they take.

use crate::diag::{Code, Diagnostic, Diagnostics};
use crate::model::System;

/// A note for each object that says something else than the library it is taken from. Objects that devices share are noted
/// once.
pub fn departures(system: &System) -> Diagnostics {
    let mut notes = Diagnostics::new();
    let mut seen = std::collections::BTreeSet::new();
    for object in system.devices.iter().flat_map(|device| device.objects.values()) {
        let Some(profile) = object.profile.as_ref().filter(|_| !object.differs.is_empty()) else { continue };
        if seen.insert((object.index, object.span.start)) {
            notes.push(Diagnostic::new(
                Code::Departure,
                object.span,
                format!(
                    "{} {} departs from {profile}: {}",
                    object.index,
                    object.name,
                    object.differs.join(", ")
                ),
            ));
        }
    }
    notes.sort();
    notes
}
