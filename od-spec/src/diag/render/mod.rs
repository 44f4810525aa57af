//! Diagnostics as text for people: with their source lines, and as one line each.

mod human;
mod short;

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::{Code, Diagnostics};
use crate::source::SourceMap;

/// How diagnostics are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Format {
    /// With the source lines and marks, as rustc does.
    #[default]
    Human,
    /// `file:line:column: error[OD0301]: message`.
    Short,
}

/// Messages of one code that people are shown with their source lines; a number tells of the others.
const MOST: usize = 100;

/// All diagnostics in the given format, each ended by a line break; for people, after a hundred of one code, only how many more
/// there are.
pub fn render(diagnostics: &Diagnostics, sources: &SourceMap, format: Format, colour: bool) -> String {
    let mut out = String::new();
    let mut shown: BTreeMap<&Code, usize> = BTreeMap::new();
    for diagnostic in diagnostics {
        let of_code = shown.entry(diagnostic.code).or_default();
        *of_code += 1;
        if format == Format::Human && *of_code > MOST {
            continue;
        }
        let (text, end) = match format {
            Format::Human => (human::human(diagnostic, sources, colour), "\n\n"),
            Format::Short => (short::short(diagnostic, sources), "\n"),
        };
        out.push_str(&text);
        out.push_str(end);
    }
    for (code, count) in shown.into_iter().filter(|(_, count)| format == Format::Human && *count > MOST) {
        let _ = write!(out, "and {} more like these ({code})\n\n", count - MOST);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diag::{Diagnostic, codes};

    #[test]
    fn people_are_shown_a_hundred_of_a_kind() {
        let mut sources = SourceMap::new();
        let file = sources.add("a", "x".repeat(300));
        let mut diagnostics = Diagnostics::new();
        for at in 0..150 {
            diagnostics.push(Diagnostic::new(
                codes::UNKNOWN_KEY,
                sources.whole(file).part(at, at + 1),
                "found",
            ));
        }
        let text = render(&diagnostics, &sources, Format::Human, false);
        assert_eq!(text.matches("error[OD0201]").count(), 100);
        assert!(text.ends_with("and 50 more like these (OD0201)\n\n"), "{text}");
        assert_eq!(render(&diagnostics, &sources, Format::Short, false).lines().count(), 150);
    }
}
