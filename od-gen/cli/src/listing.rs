//! Findings as text for people, where one mistake may be in hundreds of places.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use od_spec::diag::render::{Format, render};
use od_spec::diag::{Code, Diagnostic, Diagnostics, Severity};
use od_spec::source::SourceMap;

/// How many findings of one code are shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Most {
    /// All, as far as people read.
    All,
    /// Of an EDS: a tool wrote it, and made one mistake everywhere.
    OfEds,
    /// Of a specification: a person wrote it, and wants to mend all in one go.
    OfSpecification,
}

impl Most {
    const fn number(self, severity: Severity) -> usize {
        match (self, severity) {
            (Self::OfEds, _) => 3,
            (Self::OfSpecification, Severity::Error | Severity::Warning) => 10,
            // Notes of a specification are a list that the user asked for; a list of more is one for programs.
            (Self::OfSpecification, Severity::Note) | (Self::All, _) => 1_000,
        }
    }
}

/// Findings in full, then notes, a line each. `shows` is the command or option that shows all places.
pub(crate) fn for_people(
    found: &Diagnostics,
    sources: &SourceMap,
    most: Most,
    shows: &str,
    colour: bool,
) -> String {
    let one = |diagnostic: &Diagnostic, format| {
        let mut only = Diagnostics::new();
        only.push(diagnostic.clone());
        render(&only, sources, format, colour)
    };
    let like_it = |more: usize, code: &Code| format!("and {more} more like it ({code}); {shows} shows them");
    let mut counts: BTreeMap<&Code, usize> = BTreeMap::new();
    for diagnostic in found {
        *counts.entry(diagnostic.code).or_default() += 1;
    }
    let mut seen: BTreeMap<&Code, usize> = BTreeMap::new();
    let (mut findings, mut notes) = (String::new(), String::new());
    for diagnostic in found {
        let seen = seen.entry(diagnostic.code).or_default();
        *seen += 1;
        let most = most.number(diagnostic.severity);
        if *seen > most {
            continue;
        }
        let more = counts.get(diagnostic.code).map_or(0, |count| count - *seen);
        let rest = if *seen == most && more > 0 { Some(more) } else { None };
        match diagnostic.severity {
            Severity::Error | Severity::Warning => {
                findings.push_str(&one(diagnostic, Format::Human));
                if let Some(more) = rest {
                    let _ = writeln!(findings, "{}\n", like_it(more, diagnostic.code));
                }
            }
            Severity::Note => {
                notes.push_str(&one(diagnostic, Format::Short));
                if let Some(more) = rest {
                    let _ = writeln!(notes, "{}", like_it(more, diagnostic.code));
                }
            }
        }
    }
    findings + &notes
}
