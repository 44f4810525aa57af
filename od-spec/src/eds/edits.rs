//! Changes of whole lines.

use crate::diag::Edit;
use crate::eds::document::SectionRef;
use crate::eds::line::{Line, LineEnd, LineKind};
use crate::eds::names::{self, Topic};
use crate::eds::view::{Part, View};
use crate::source::Span;

/// The place of a line.
pub(in crate::eds) fn place(view: &View<'_>, line: &Line<'_>) -> Span {
    view.document.place(line).unwrap_or(Span { file: view.file, start: 0, end: 0 })
}

/// A line with its break.
fn with_break(view: &View<'_>, line: &Line<'_>) -> Span {
    let place = place(view, line);
    let length = u32::try_from(line.end().text().len()).unwrap_or_default();
    Span { end: place.end + length, ..place }
}

/// Takes a line out. Below a comment an empty line stays: the comment would be taken for one of the section that follows.
pub(in crate::eds) fn remove(view: &View<'_>, line: &Line<'_>) -> Edit {
    let lines = view.document.lines();
    let above = lines[..lines.partition_point(|other| other.start() < line.start())].last();
    let is_below_comment = above.is_some_and(|above| above.kind() == LineKind::Comment);
    let span = if is_below_comment { place(view, line) } else { with_break(view, line) };
    Edit { span, text: String::new() }
}

/// Gives a key of a section its value, on a line of its own where the section does not have the key.
pub(in crate::eds) fn set(view: &View<'_>, part: &Part<'_>, key: &str, value: &str) -> Option<Edit> {
    if let Some(entry) = part.key(key) {
        return Some(Edit { span: entry.value.span, text: value.to_owned() });
    }
    Some(below(view, last_line(part.sections.first()?), [format!("{key}={value}").as_str()]))
}

/// Puts lines below a line, with its break.
pub(in crate::eds) fn below<'l>(
    view: &View<'_>,
    line: &Line<'_>,
    lines: impl IntoIterator<Item = &'l str>,
) -> Edit {
    let end = with_break(view, line).end;
    let span = Span { file: view.file, start: end, end };
    let is_last = line.end() == LineEnd::EndOfText;
    let line_break = if is_last { usual_break(view).text() } else { line.end().text() };
    let mut text = String::new();
    for line in lines {
        if is_last {
            text.push_str(line_break);
            text.push_str(line);
        } else {
            text.push_str(line);
            text.push_str(line_break);
        }
    }
    Edit { span, text }
}

/// Puts lines above a line, with its break.
pub(in crate::eds) fn above(view: &View<'_>, line: &Line<'_>, text: &str) -> Edit {
    let start = place(view, line).start;
    let line_break =
        if line.end() == LineEnd::EndOfText { usual_break(view).text() } else { line.end().text() };
    Edit { span: Span { file: view.file, start, end: start }, text: format!("{text}{line_break}") }
}

/// A number in the notation in which another one is written.
pub(in crate::eds) fn number_like(old: &str, number: impl Into<i128>) -> String {
    let number = number.into();
    if old.starts_with("0x") { format!("{number:#X}").replacen("0X", "0x", 1) } else { number.to_string() }
}

/// The line break that most lines have, that of the standard's examples where it is undecided.
pub(in crate::eds) fn usual_break(view: &View<'_>) -> LineEnd {
    let of_end = |end| view.document.lines().iter().filter(move |line| line.end() == end);
    let count = |end| of_end(end).map(Line::number).sum::<usize>();
    if count(LineEnd::Lf) > count(LineEnd::CrLf) { LineEnd::Lf } else { LineEnd::CrLf }
}

/// The last line of a section that says something: its last key, or its header.
pub(in crate::eds) fn last_line<'d>(section: &SectionRef<'d, 'd>) -> &'d Line<'d> {
    let says = |line: &&Line<'_>| !matches!(line.kind(), LineKind::Blank | LineKind::Comment);
    section.body().iter().rev().find(says).unwrap_or_else(|| section.header())
}

/// Adds a section at its place in the classical order: after the last section that comes before it.
pub(in crate::eds) fn new_section<'l>(
    view: &View<'_>,
    topic: Topic,
    lines: impl IntoIterator<Item = &'l str>,
) -> Option<Edit> {
    // A section whose name lacks a bracket is there, and gets it.
    let is_there = |line: &Line<'_>| {
        line.kind() == LineKind::Unreadable
            && line.text().trim().strip_suffix(']').is_some_and(|name| names::topic(name) == topic)
    };
    if view.document.lines().iter().any(is_there) {
        return None;
    }
    let before = Topic::OF_EVERY_FILE.iter().take_while(|other| **other != topic);
    let sections = before.filter_map(|other| view.section(*other)?.sections.last());
    let behind = sections.max_by_key(|section| place(view, section.header()).start)?;
    Some(below(view, last_line(behind), lines))
}
