//! The findings of one file as text.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use od_spec::diag::render::{Format, render};
use od_spec::diag::{Code, Diagnostic, Diagnostics, Severity};

use super::checked::{Checked, Kind};
use crate::args::{CheckArgs, CheckFormat};

/// How many places of one finding are shown to people, where there may be hundreds.
const SHOWN_PLACES: usize = 3;

/// The findings in a format; nothing in one that is about the whole run.
pub(super) fn of_file(checked: &Checked, format: CheckFormat, args: &CheckArgs, colour: bool) -> String {
    let all = |format| render(&checked.shown, &checked.sources, format, colour);
    match format {
        CheckFormat::Human => for_people(checked, args.all, colour),
        CheckFormat::Short => all(Format::Short),
        CheckFormat::Json => all(Format::Json),
        CheckFormat::Github => all(Format::Github),
        CheckFormat::Sarif => String::new(),
    }
}

/// Findings in full, then notes, a line each. A tool that wrote an EDS made one mistake in a hundred places: the first few tell.
fn for_people(checked: &Checked, all: bool, colour: bool) -> String {
    let most = if all || checked.kind != Kind::Eds { usize::MAX } else { SHOWN_PLACES };
    let mut counts: BTreeMap<&Code, usize> = BTreeMap::new();
    for diagnostic in &checked.shown {
        *counts.entry(diagnostic.code).or_default() += 1;
    }
    let mut seen: BTreeMap<&Code, usize> = BTreeMap::new();
    let (mut findings, mut notes) = (String::new(), String::new());
    for diagnostic in &checked.shown {
        let seen = seen.entry(diagnostic.code).or_default();
        *seen += 1;
        if *seen > most {
            continue;
        }
        let more = counts.get(diagnostic.code).map_or(0, |count| count - *seen);
        let rest = if *seen == most && more > 0 { Some(more) } else { None };
        match diagnostic.severity {
            Severity::Error | Severity::Warning => {
                findings.push_str(&one(diagnostic, checked, Format::Human, colour));
                if let Some(more) = rest {
                    let _ = writeln!(findings, "{}\n", like_it(more, diagnostic.code));
                }
            }
            Severity::Note => {
                notes.push_str(&one(diagnostic, checked, Format::Short, colour));
                if let Some(more) = rest {
                    let _ = writeln!(notes, "{}", like_it(more, diagnostic.code));
                }
            }
        }
    }
    findings + &notes
}

fn one(diagnostic: &Diagnostic, checked: &Checked, format: Format, colour: bool) -> String {
    let mut only = Diagnostics::new();
    only.push(diagnostic.clone());
    render(&only, &checked.sources, format, colour)
}

fn like_it(more: usize, code: &Code) -> String {
    format!("and {more} more like it ({code}); `--all` shows them")
}
