//! All lines end alike, and with a line feed.

use super::super::edits;
use super::super::rule::FormatRule;
use crate::diag::{Code, Diagnostic, Diagnostics, Edit, Example, Repeated, Severity};
use crate::eds::line::LineEnd;
use crate::eds::view::View;
use crate::source::Span;

pub(in crate::eds::check) const RULE: FormatRule = FormatRule { code: CODE, check };

const CODE: &Code = &Code {
    id: "EDS104",
    severity: Severity::Warning,
    foreign: Severity::Warning,
    title: "different line breaks",
    explanation: "Lines end with a line feed or with carriage return and line feed, and a file uses one of them. A \
        carriage return alone is not a line break for most readers: they take the next key as part of the value before \
        it. Different breaks in one file are often the trace of a text that was pasted in.",
    clause: Some("CiA 306 4.2"),
    example: Some(Example::eds(
        "[Comments]\r\nLines=1\nLine1=Breaks\r\n",
        "[Comments]\nLines=1\nLine1=Breaks\n",
    )),
};

fn check(view: &View<'_>, diagnostics: &mut Diagnostics) {
    let usual = edits::usual_break(view);
    let mut found = Repeated::new();
    for line in view.document.lines() {
        if line.end() == usual || line.end() == LineEnd::EndOfText {
            continue;
        }
        let (whole, number) = (edits::place(view, line), line.number());
        let length = u32::try_from(line.end().text().len()).unwrap_or_default();
        // Empty lines that follow each other have nothing but their breaks.
        let (place, start) = match number {
            1 => (whole, whole.end),
            _ => (Span { end: whole.start, ..whole }, whole.start),
        };
        let span = Span { start, end: whole.end + length, ..whole };
        let mut edit = Some(Edit { span, text: usual.text().repeat(number) });
        for _ in 0..number {
            found.add(place, edit.take(), || {
                let message =
                    format!("the line ends with {}, most end with {}", name(line.end()), name(usual));
                Diagnostic::new(CODE, place, message).help("end all lines alike; `odgen fix` does")
            });
        }
    }
    found.finish("lines", diagnostics);
}

const fn name(end: LineEnd) -> &'static str {
    match end {
        LineEnd::CrLf => "CR LF",
        LineEnd::Lf => "LF",
        LineEnd::Cr => "CR",
        LineEnd::EndOfText => "nothing",
    }
}
