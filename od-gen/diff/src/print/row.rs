//! A change as the row of a table.

use super::super::Change;
use super::line::{Style, place, values};

const STYLE: Style = Style { arrow: "→", longest: None };

/// The cells of a change in a table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Row {
    /// `+`, `-` or `~`.
    pub sign: char,
    /// What it is about: `3005h test status, bit 5`.
    pub place: String,
    /// The fact before and after: `type: unsigned8 → unsigned16`.
    pub values: String,
    /// What follows, the heaviest first: `breaks PLC projects: …; …`.
    pub consequences: String,
}

/// A change as the row of a table.
pub fn row(change: &Change) -> Row {
    let consequences: Vec<String> = change
        .consequences
        .iter()
        .map(|consequence| format!("{}: {}", consequence.class.phrase(), consequence.because))
        .collect();
    Row {
        sign: change.kind().sign(),
        place: place(change),
        values: values(change, STYLE),
        consequences: consequences.join("; "),
    }
}
