//! What comments say of an entry's relations to others.

use std::fmt::Write as _;

use od_gen::plan::{Plan, PlannedEntry};

/// When the entry can be written, and what carries it: sentences, each with a space before it.
pub(super) fn relations(plan: &Plan<'_>, entry: &PlannedEntry<'_>) -> String {
    let mut text = String::new();
    if let Some(condition) = &entry.entry.writable_when {
        let _ = write!(text, " Writable while {}.", condition.text);
    }
    let row = plan.row(entry.id);
    let carriers = plan.pdos.iter().filter(|pdo| pdo.fields.iter().any(|field| Some(field.row) == row));
    let carriers: Vec<String> = carriers
        .map(|pdo| {
            let off = if pdo.pdo.valid { "" } else { " (off by default)" };
            format!("{} {}{off}", pdo.pdo.direction.pdo(), pdo.pdo.number)
        })
        .collect();
    if !carriers.is_empty() {
        let _ = write!(text, " In {}.", carriers.join(", "));
    }
    text
}
