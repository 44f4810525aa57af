//! What a code means: what `odgen explain` prints and the book's pages of messages hold.

use std::fmt::Write as _;

use od_readers::stumbling;
use od_spec::diag::Code;
use od_spec::diag::readers::Evidence;

/// What `odgen explain` prints about a code, as Markdown: its title, and its [`explanation`].
pub fn explained(code: &Code) -> String {
    format!("{code} ({}): {}\n\n{}", code.severity.word(), code.title, explanation(code))
}

/// What a code means, as Markdown: explanation, clause, and an example before and after.
pub fn explanation(code: &Code) -> String {
    let mut out = format!("{}\n", code.explanation);
    if let Some(clause) = code.clause {
        let _ = write!(out, "\nSee {clause}.\n");
    }
    out.push_str(&stumblers(code));
    if let Some(example) = code.example {
        let language = example.language.highlighting();
        let _ = write!(out, "\nRefused:\n\n```{language}\n{}\n```\n", visible(example.before));
        let _ = write!(out, "\nAccepted:\n\n```{language}\n{}\n```\n", visible(example.after));
    }
    out
}

/// A text in which invisible characters, such as a carriage return, are written as their numbers.
fn visible(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if c == '\n' || !(c.is_control() || c == '\u{FEFF}') {
            out.push(c);
        } else {
            let _ = write!(out, "<{:02X}>", u32::from(c));
        }
    }
    out
}

/// Which readers of other people stumble over what a code is about, and why.
fn stumblers(code: &Code) -> String {
    let line = |evidence| {
        let of = stumbling(code).iter().filter(move |one| one.reader.evidence() == evidence);
        of.fold(String::new(), |lines, one| format!("{lines}- {}: {}\n", one.reader, one.reason))
    };
    let (tested, reported) = (line(Evidence::Tested), line(Evidence::Reported));
    let mut out = String::new();
    if !tested.is_empty() {
        let _ = write!(out, "\nWho may refuse an EDS or DCF for it; each finding says who does:\n\n{tested}");
    }
    if !reported.is_empty() {
        let _ = write!(out, "\nWho is reported to stumble:\n\n{reported}");
    }
    out
}
