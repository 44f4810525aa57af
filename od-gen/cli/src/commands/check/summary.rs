//! How much was found: a line for each file, and one for all.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use od_spec::diag::render::{plural, summary};
use od_spec::diag::{Code, Diagnostics, Severity};
use od_spec::order::Arrange as _;
use od_spec::visible::visible;

use super::checked::{Checked, Kind};

/// How many files at most say that nothing was found in them.
const FEW: usize = 5;

/// What is said in place of numbers.
const NOTHING: &str = "nothing found";

/// How many of the most frequent codes are named.
const MOST_FREQUENT: usize = 3;

/// The line of one file of so many; `None` where nothing was found in one of many.
pub(super) fn of_file(checked: &Checked, files: usize) -> Option<String> {
    let is_read = checked.objects.is_some() || checked.kind == Kind::Parameters;
    if checked.shown.is_empty() && (files > FEW || !is_read) {
        return None;
    }
    let counts = match summary(&checked.shown) {
        none if none.is_empty() => NOTHING.to_owned(),
        counts => counts,
    };
    let objects = checked.objects.and_then(|objects| plural(objects, "object"));
    let facts = [Some(counts), objects].into_iter().flatten().collect::<Vec<_>>().join(", ");
    let mut line = format!("{}: {facts}", visible(&checked.name));
    if let Some(repairs) = repairs(&checked.shown).filter(|_| checked.kind.is_fixed()) {
        let _ = write!(line, " ({repairs})");
    }
    if let Some(notes) = plural(checked.hidden_notes, "note") {
        let shows = if checked.hidden_notes == 1 { "shows it" } else { "shows them" };
        let _ = write!(line, "; {notes}, `--notes` {shows}");
        if checked.hidden_repairs > 0 {
            let them = match (checked.hidden_notes, checked.hidden_repairs) {
                (1, _) => "it".to_owned(),
                (all, repairs) if all == repairs => "them".to_owned(),
                (_, repairs) => format!("{repairs} of them"),
            };
            let _ = write!(line, " and `odgen fix` repairs {them}");
        }
    }
    if let (1, Some(first)) = (files, explained(&checked.shown)) {
        let _ = write!(line, "; `odgen explain {first}` says more");
    }
    line.push('\n');
    Some(line)
}

/// How many of the findings can be fixed without a decision.
fn repairs(found: &Diagnostics) -> Option<String> {
    let counted = || found.iter().filter(|diagnostic| diagnostic.severity != Severity::Note);
    let (all, with_edits) = (counted().count(), counted().filter(|one| !one.edits.is_empty()).count());
    let what = match with_edits {
        0 => return None,
        1 if all == 1 => "it".to_owned(),
        2 if all == 2 => "both".to_owned(),
        n if n == all => format!("all {n}"),
        n => format!("{n} of them"),
    };
    Some(format!("`odgen fix` repairs {what}"))
}

/// The code to look up first: an error before a warning, wherever it is.
fn explained(found: &Diagnostics) -> Option<&'static Code> {
    let first = found.iter().min_by_key(|one| one.severity)?;
    (first.severity != Severity::Note).then_some(first.code)
}

/// What was found in all files.
#[derive(Debug, Default)]
pub(super) struct Total {
    files: usize,
    errors: usize,
    warnings: usize,
    hidden_notes: usize,
    objects: usize,
    /// In how many files each code was found.
    codes: BTreeMap<&'static Code, usize>,
}

impl Total {
    pub(super) fn add(&mut self, checked: &Checked) {
        let (errors, warnings) = checked.shown.count();
        self.files += 1;
        self.errors += errors;
        self.warnings += warnings;
        self.hidden_notes += checked.hidden_notes;
        self.objects += checked.objects.unwrap_or(0);
        let mut codes: Vec<&'static Code> = checked.shown.iter().map(|diagnostic| diagnostic.code).collect();
        codes.sort();
        codes.dedup();
        for code in codes {
            *self.codes.entry(code).or_default() += 1;
        }
    }

    pub(super) const fn has_errors(&self) -> bool {
        self.errors > 0
    }

    /// The line for several files; nothing for one, which has said all.
    pub(super) fn text(&self) -> String {
        if self.files < 2 {
            return String::new();
        }
        let counts = [
            plural(self.errors, "error"),
            plural(self.warnings, "warning"),
            plural(self.hidden_notes, "note"),
        ];
        let mut counts: Vec<String> = counts.into_iter().flatten().collect();
        if counts.is_empty() {
            counts.push(NOTHING.to_owned());
        }
        counts.extend(plural(self.objects, "object"));
        let mut line = format!("{} files: {}", self.files, counts.join(", "));
        let mut frequent: Vec<(&Code, usize)> =
            self.codes.iter().map(|(code, files)| (*code, *files)).collect();
        frequent.arrange_by_key(|(_, files)| std::cmp::Reverse(*files));
        if let Some((first, _)) = frequent.first() {
            let most = frequent.iter().take(MOST_FREQUENT);
            let most: Vec<String> = most
                .map(|(code, files)| format!("{code} in {}", plural(*files, "file").unwrap_or_default()))
                .collect();
            let _ = write!(line, "; most frequent: {}; `odgen explain {first}` says more", most.join(", "));
        }
        line.push('\n');
        line
    }
}
