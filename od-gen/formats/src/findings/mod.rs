//! Messages of `odgen check` for programs: JSON, SARIF for code scanning services, and commands of GitHub Actions.

mod github;
mod json;
mod sarif;

pub use github::github;
pub use json::json;
pub use sarif::{Findings, sarif};

use std::borrow::Cow;

use od_spec::diag::{Diagnostic, Diagnostics, Edit, Severity};

/// Messages of one code, in one file, that are written. The last of them then says how many more there are.
pub const MOST_MESSAGES: usize = 10_000;
/// Changes of one message that are written. Those of a message that has more are left out: a part of them repairs nothing.
pub const MOST_EDITS: usize = 10_000;

/// The messages to be written.
fn written(diagnostics: &Diagnostics) -> impl Iterator<Item = Cow<'_, Diagnostic>> {
    let (shown, more) = diagnostics.first_of_each_code(MOST_MESSAGES);
    let more = more.into_iter().map(|(code, count)| {
        let message = format!("{count} more messages of this code are left out");
        let mut last = Diagnostic::without_place(code, message);
        last.severity = Severity::Note;
        Cow::Owned(last)
    });
    shown.into_iter().map(Cow::Borrowed).chain(more)
}

/// The changes of a message to be written.
fn edits(diagnostic: &Diagnostic) -> &[Edit] {
    if diagnostic.edits.len() > MOST_EDITS { &[] } else { &diagnostic.edits }
}

#[cfg(test)]
mod tests {
    use od_spec::diag::{Diagnostic, Diagnostics, codes};
    use od_spec::source::SourceMap;
    use od_spec::visible::is_hidden;

    use super::*;

    #[test]
    fn nothing_hidden_in_a_text_reaches_a_terminal() {
        const HOSTILE: &str = "\u{1b}[31m\u{7}\u{9b}2J\u{7f}\u{202e}\u{61c}\n::error::x\r\u{2028}";
        let mut sources = SourceMap::new();
        let name = format!("a{HOSTILE}.eds");
        let file = sources.add(name, "Na\u{85}me=\u{9b}31m\u{7f}\u{1b}\u{7}\u{202e}\u{200f}\n");
        let place = sources.whole(file).part(0, 6);
        let mut diagnostics = Diagnostics::new();
        let diagnostic = Diagnostic::new(codes::UNKNOWN_KEY, place, format!("found {HOSTILE}"));
        let diagnostic = diagnostic.label(HOSTILE).help(HOSTILE).note(HOSTILE).edit(place, HOSTILE);
        diagnostics.push(diagnostic.with(place, HOSTILE));
        let commands = |text: &str| text.lines().filter(|line| line.trim_start().starts_with("::")).count();
        for (text, expected) in [(json(&diagnostics, &sources), 0), (github(&diagnostics, &sources), 1)] {
            assert!(!text.contains(|c: char| is_hidden(c) && c != '\n'), "{text:?}");
            assert_eq!(commands(&text), expected, "{text}");
        }
        let text = sarif(
            "1",
            |_| String::new(),
            &[Findings { name: HOSTILE, diagnostics: &diagnostics, sources: &sources }],
        );
        assert!(!text.trim_end().contains(is_hidden), "{text}");
    }
}
