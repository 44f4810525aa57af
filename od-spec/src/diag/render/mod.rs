//! Diagnostics as text: for people, as one line each, and for programs.

mod github;
mod human;
mod json;
mod sarif;
mod short;

pub use sarif::{Findings, sarif};

use super::Diagnostics;
use crate::source::SourceMap;

/// How diagnostics are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Format {
    /// With the source lines and marks, as rustc does.
    #[default]
    Human,
    /// `file:line:column: error[OD0301]: message`.
    Short,
    /// One JSON object per line.
    Json,
    /// One workflow command of GitHub Actions per line, which shows the message beside the source line.
    Github,
}

/// All diagnostics in the given format, each ended by a line break.
pub fn render(diagnostics: &Diagnostics, sources: &SourceMap, format: Format, colour: bool) -> String {
    let mut out = String::new();
    for diagnostic in diagnostics {
        let (text, end) = match format {
            Format::Human => (human::human(diagnostic, sources, colour), "\n\n"),
            Format::Short => (short::short(diagnostic, sources), "\n"),
            Format::Json => (json::json(diagnostic, sources), "\n"),
            Format::Github => (github::command(diagnostic, sources), "\n"),
        };
        out.push_str(&text);
        out.push_str(end);
    }
    out
}

/// `3 errors, 1 warning`; empty when there is nothing to count.
pub fn summary(diagnostics: &Diagnostics) -> String {
    let (errors, warnings) = diagnostics.count();
    [plural(errors, "error"), plural(warnings, "warning")]
        .into_iter()
        .flatten()
        .collect::<Vec<_>>()
        .join(", ")
}

/// `1 error`, `3 errors`; nothing for none.
pub fn plural(count: usize, word: &str) -> Option<String> {
    match count {
        0 => None,
        1 => Some(format!("1 {word}")),
        _ => Some(format!("{count} {word}s")),
    }
}
