//! Diagnostics as text for people: with their source lines, and as one line each.

mod human;
mod short;

use std::fmt::Write as _;

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
}

impl Format {
    /// Messages of one code that are written; a number represents the others.
    const fn most(self) -> usize {
        match self {
            Format::Human => 100,
            Format::Short => 1_000,
        }
    }
}

/// The diagnostics in the given format, each ended by a line break; of a code that has very many, the first of them and how
/// many more there are.
pub fn render(diagnostics: &Diagnostics, sources: &SourceMap, format: Format, colour: bool) -> String {
    let mut out = String::new();
    let (shown, more) = diagnostics.first_of_each_code(format.most());
    let end = match format {
        Format::Human => "\n\n",
        Format::Short => "\n",
    };
    for diagnostic in shown {
        let text = match format {
            Format::Human => human::human(diagnostic, sources, colour),
            Format::Short => short::short(diagnostic, sources),
        };
        out.push_str(&text);
        out.push_str(end);
    }
    for (code, count) in more {
        let _ = write!(out, "and {count} more like these ({code}){end}");
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
    fn the_first_of_a_kind_are_shown_and_the_others_counted() {
        let mut sources = SourceMap::new();
        let file = sources.add("a", "x".repeat(1_300));
        let mut diagnostics = Diagnostics::new();
        for at in 0..1_150 {
            diagnostics.push(Diagnostic::new(
                codes::UNKNOWN_KEY,
                sources.whole(file).part(at, at + 1),
                "found",
            ));
        }
        let text = render(&diagnostics, &sources, Format::Human, false);
        assert_eq!(text.matches("error[OD0201]").count(), 100);
        assert!(text.ends_with("and 1050 more like these (OD0201)\n\n"), "{text}");
        let text = render(&diagnostics, &sources, Format::Short, false);
        assert_eq!(text.lines().count(), 1_001);
        assert!(text.ends_with("\nand 150 more like these (OD0201)\n"), "{text}");
    }
}
