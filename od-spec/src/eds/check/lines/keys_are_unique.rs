//! Every key of a section is written once.

use super::super::edits;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity, shorten};
use crate::eds::document::SectionRef;
use crate::eds::view::{Entry, View, entry};
use std::collections::BTreeMap;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS111",
    severity: Severity::Error,
    foreign: Severity::Error,
    title: "a key that is written twice",
    explanation: "Readers disagree about a key that is written twice in its section: Python's configparser refuses the \
        file, most others take the last value. Keys are compared without regard to case. In a list of objects one of \
        the two objects is lost, so the entries are renumbered; elsewhere decide which value is right.",
    clause: Some("CiA 306 4.2"),
    example: Some(Example::eds("[Comments]\nLines=0\nLines=0", "[Comments]\nLines=0")),
};

/// Sections with more keys than this are compared through a map.
const FEW: usize = 24;

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    for section in view.document.sections() {
        let entries: Vec<Entry<'_>> = section.keys().filter_map(|line| entry(line, view.file)).collect();
        if entries.len() > FEW || has_duplicate(&entries) {
            compare(view, &section, &entries, diagnostics);
        }
    }
}

/// Most sections are an object's, with a handful of keys that all differ.
fn has_duplicate(entries: &[Entry<'_>]) -> bool {
    entries.iter().enumerate().any(|(at, entry)| {
        entries[..at].iter().any(|before| before.key.value.eq_ignore_ascii_case(entry.key.value))
    })
}

fn compare(
    view: &View<'_>,
    section: &SectionRef<'_, '_>,
    entries: &[Entry<'_>],
    diagnostics: &mut Diagnostics,
) {
    // The first of each key, and whether all so far say the same.
    let mut first: BTreeMap<String, (&Entry<'_>, bool)> = BTreeMap::new();
    for entry in entries {
        let (before, are_equal) = first.entry(entry.key.value.to_ascii_lowercase()).or_insert((entry, true));
        if before.key.span == entry.key.span {
            continue;
        }
        let is_equal = before.value == entry.value;
        *are_equal &= is_equal;
        let message =
            format!("`{}` is written twice in `{}`", shorten(entry.key.value), shorten(section.name()));
        let mut diagnostic = Diagnostic::new(CODE, entry.key.span, message)
            .label("again here")
            .with(before.key.span, "first here");
        // Readers take the last: after another value, an equal one is not superfluous.
        if *are_equal {
            diagnostic = diagnostic.help("remove one of the two, they say the same; `odgen fix` does");
            diagnostic.edits.push(edits::remove(view, entry.line));
        } else if is_equal {
            diagnostic = diagnostic.help("decide which value is right, and remove the others");
        } else {
            diagnostic = diagnostic.help(format!(
                "decide whether `{}` or `{}` is right, and remove the other",
                shorten(before.value.value),
                shorten(entry.value.value)
            ));
        }
        diagnostics.push(diagnostic);
    }
}
