//! Every code with its meaning: what `odgen explain` prints and `docs/messages.md` holds.

use std::fmt::Write as _;

use crate::check::RULES;
use crate::diag::{Code, codes};
use crate::eds;
use crate::eds::readers::Evidence;
use crate::plant;

/// All codes, ascending: those of reading and looking up, and those of the rules over texts and over the model.
pub fn all_codes() -> Vec<&'static Code> {
    let mut list: Vec<&Code> = codes::ALL.to_vec();
    list.extend(RULES.iter().map(|rule| rule.code));
    list.extend(plant::rules::codes());
    list.extend(eds::codes::ALL);
    list.extend(eds::readers::codes::ALL);
    list.extend(eds::check::RULES.iter().map(|rule| rule.code));
    list.sort();
    // One code may be said by several rules.
    list.dedup();
    list
}

/// The code with this id, in any case.
pub fn code(id: &str) -> Option<&'static Code> {
    all_codes().into_iter().find(|code| code.id.eq_ignore_ascii_case(id))
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

/// A text in which characters that nobody sees, such as a carriage return, stand as their numbers.
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
        let of = eds::readers::stumbling(code).iter().filter(move |one| one.reader.evidence() == evidence);
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
