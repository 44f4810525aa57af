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
    use od_spec::source::{SourceMap, Span};
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

    /// All three forms of some messages.
    fn forms(diagnostics: &Diagnostics, sources: &SourceMap) -> [String; 3] {
        let findings = Findings { name: "a.eds", diagnostics, sources };
        [json(diagnostics, sources), github(diagnostics, sources), sarif("1", |_| String::new(), &[findings])]
    }

    #[test]
    fn a_flood_of_messages_of_one_code_is_cut_and_counted() {
        let mut sources = SourceMap::new();
        let file = sources.add("a.eds", "x\n".repeat(MOST_MESSAGES + 2));
        let letter = |at: usize| sources.whole(file).part(2 * at, 1);
        for (messages, more) in [(MOST_MESSAGES, None), (MOST_MESSAGES + 2, Some("2 more messages"))] {
            let mut diagnostics = Diagnostics::new();
            diagnostics.push(Diagnostic::new(codes::BAD_NOTATION, letter(0), "of another code"));
            for at in 0..messages {
                diagnostics.push(Diagnostic::new(
                    codes::UNKNOWN_KEY,
                    letter(at),
                    format!("letter {at} of it"),
                ));
            }
            for text in forms(&diagnostics, &sources) {
                let said = text.matches(" of it").count();
                assert_eq!((said, text.contains("of another code")), (MOST_MESSAGES, true));
                assert_eq!(text.contains("more messages"), more.is_some());
                assert!(more.is_none_or(|more| text.contains(more)));
            }
        }
    }

    #[test]
    fn changes_of_a_message_are_written_whole_or_not_at_all() {
        let mut sources = SourceMap::new();
        let file = sources.add("a.eds", "x\n".repeat(MOST_EDITS + 1));
        let letter = |at: usize| -> Span { sources.whole(file).part(2 * at, 1) };
        for (changes, is_written) in [(MOST_EDITS, true), (MOST_EDITS + 1, false)] {
            let message = Diagnostic::new(codes::UNKNOWN_KEY, letter(0), "found it");
            let mut diagnostics = Diagnostics::new();
            diagnostics.push((0..changes).fold(message, |message, at| message.edit(letter(at), "new word")));
            let [json, _, sarif] = forms(&diagnostics, &sources);
            let expected = if is_written { MOST_EDITS } else { 0 };
            assert_eq!([json, sarif].map(|text| text.matches("new word").count()), [expected; 2]);
        }
    }
}
