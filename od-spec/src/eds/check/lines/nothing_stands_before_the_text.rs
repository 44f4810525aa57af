//! Nothing comes before the text: no byte order mark.

use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Example, Severity};
use crate::eds::view::View;
use crate::encoding::Encoding;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

pub(crate) const CODE: &Code = &Code {
    id: "EDS102",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "a byte order mark",
    explanation: "Three bytes before the text say that it is UTF-8; the standard has no such mark. lely's tools and \
        python-canopen take it as part of the first section's name and refuse the file. Store the file as ASCII or as \
        UTF-8 without a mark.",
    clause: Some("CiA 306 4.2"),
    example: Some(Example::eds("﻿[Comments]\nLines=0", "[Comments]\nLines=0")),
};

/// The text of a file that is read comes without its mark, which `encoding` remembers.
fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let start = view.start();
    let in_the_text = view.document.lines().first().is_some_and(|line| line.text().starts_with('\u{FEFF}'));
    let marked = match view.facts.encoding {
        Encoding::Utf8WithMark => "the file begins with a byte order mark",
        Encoding::Utf16Le | Encoding::Utf16Be | Encoding::Utf16LeUnmarked | Encoding::Utf16BeUnmarked => {
            "the file is UTF-16, two bytes for each character"
        }
        Encoding::Ascii
        | Encoding::Utf8
        | Encoding::Windows1252
        | Encoding::Windows1251
        | Encoding::Cp850
        | Encoding::Cp437 => {
            if !in_the_text {
                return;
            }
            "the text begins with a byte order mark"
        }
    };
    let mut diagnostic =
        Diagnostic::new(CODE, start, marked).help("store it as ASCII; `odgen fix` does where it can");
    if in_the_text {
        let mark = crate::source::Span { file: view.file, start: 0, end: 3 };
        diagnostic = diagnostic.edit(mark, "");
    }
    diagnostics.push(diagnostic);
}
