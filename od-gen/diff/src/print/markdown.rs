//! A report for a merge request or a release, in Markdown.

use std::fmt::Write as _;

use super::super::{Change, Difference};
use super::changelog::{self, escape};
use super::row::{Row, row};
use super::{advice, scope, summary, unknown};

/// A table of the changes of each device, the version numbers, and an entry for a changelog.
pub fn markdown(difference: &Difference) -> String {
    let mut text = format!("# Differences\n\n{}.\n", summary(difference));
    if let Some(scope) = scope(difference.scope) {
        let _ = writeln!(text, "\nNote: {scope}.");
    }
    if !difference.system.is_empty() {
        let _ = write!(text, "\n## All devices\n\n{}", table(&difference.system));
    }
    for device in &difference.devices {
        let is_same = device.changes.is_empty();
        if is_same && difference.system.is_empty() {
            continue;
        }
        let _ = writeln!(text, "\n## {}: {}", escape(&device.key), escape(&device.name));
        if !is_same {
            let _ = write!(text, "\n{}", table(&device.changes));
        }
        for one in &device.unknown {
            let _ = writeln!(text, "\nNote: {}.", unknown(*one));
        }
        let sentences = advice::sentences(&device.proposals);
        if !sentences.is_empty() {
            let _ = writeln!(text, "\nProposed:\n\n- {}", sentences.join("\n- "));
        }
        let _ = write!(text, "\nChangelog:\n\n{}", changelog::entry(difference, device));
    }
    text
}

fn table(changes: &[Change]) -> String {
    let mut text = String::from("| | what | change | consequences |\n|---|---|---|---|\n");
    for Row { sign, place, values, consequences } in changes.iter().map(row) {
        let [place, values, consequences] = [place, values, consequences].map(|cell| escape(&cell));
        let _ = writeln!(text, "| `{sign}` | {place} | {values} | {consequences} |");
    }
    text
}
