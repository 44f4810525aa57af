//! The layout that `odgen fmt` gives, as changes that are as small as they can be.

use std::ops::Range as Bytes;

use lsp_types::{Range, TextEdit};
use od_spec::layout;
use similar::DiffOp;

use super::analysis::Kind;
use super::snapshot::Snapshot;
use crate::line_diff::line_diff;

/// What is replaced in a text, and by what.
type Change = (Bytes<usize>, String);

/// The changes that lay out a document; none where it cannot be laid out, for which the diagnostics have the reason.
pub(super) fn document(snapshot: &Snapshot) -> Vec<TextEdit> {
    edits(snapshot, changes(snapshot))
}

/// The changes in the lines of a range, unless the others are needed for the text to say the same.
pub(super) fn range(snapshot: &Snapshot, range: Range) -> Vec<TextEdit> {
    let lines = snapshot.lines();
    let text = snapshot.text();
    let wanted = |(place, _): &Change| {
        let (first, last) = (lines.line_of(place.start), lines.line_of(place.end));
        range.start.line as usize <= last && first <= range.end.line as usize
    };
    let all = changes(snapshot);
    let some: Vec<Change> = all.iter().filter(|change| wanted(change)).cloned().collect();
    // Texts that are laid out alike say the same.
    let name = snapshot.now.sources.file(snapshot.file).name();
    let of_some = layout(name, applied(text, &some)).ok();
    let of_all = layout(name, applied(text, &all)).ok();
    if of_some.is_some() && of_some == of_all { edits(snapshot, some) } else { Vec::new() }
}

/// What changes in a text that becomes another, line by line: lines that differ only in spaces are the same line.
pub(super) fn between(old: &str, new: &str) -> Vec<Change> {
    let old_lines: Vec<&str> = old.split_inclusive('\n').collect();
    let new_lines: Vec<&str> = new.split_inclusive('\n').collect();
    let mut starts = vec![0];
    starts.extend(old_lines.iter().scan(0, |at, line| {
        *at += line.len();
        Some(*at)
    }));
    let (old_words, new_words) = (without_blanks(&old_lines), without_blanks(&new_lines));
    let mut changes = Vec::new();
    for op in line_diff(&borrowed(&old_words), &borrowed(&new_words)) {
        let (gone, come) = (op.old_range(), op.new_range());
        match op {
            DiffOp::Equal { .. } => {
                for (at, line) in gone.zip(come) {
                    changes.extend(of_blanks(starts[at], old_lines[at], new_lines[line]));
                }
            }
            // As many lines as before: each for itself.
            DiffOp::Replace { .. } if gone.len() == come.len() => {
                for (at, line) in gone.zip(come) {
                    changes.extend(smallest(starts[at], old_lines[at], new_lines[line]));
                }
            }
            DiffOp::Replace { .. } | DiffOp::Insert { .. } | DiffOp::Delete { .. } => {
                let old = &old[starts[gone.start]..starts[gone.end]];
                changes.extend(smallest(starts[gone.start], old, &new_lines[come].concat()));
            }
        }
    }
    changes
}

fn without_blanks(lines: &[&str]) -> Vec<String> {
    lines.iter().map(|line| line.split_whitespace().collect()).collect()
}

fn borrowed(lines: &[String]) -> Vec<&str> {
    lines.iter().map(String::as_str).collect()
}

/// The changes between two lines that differ only in spaces.
fn of_blanks(start: usize, old: &str, new: &str) -> Vec<Change> {
    let mut changes = Vec::new();
    let (mut i, mut j) = (0, 0);
    while i < old.len() || j < new.len() {
        let run = |text: &str| text.len() - text.trim_start().len();
        let (gone, come) = (run(&old[i..]), run(&new[j..]));
        changes.extend(smallest(start + i, &old[i..i + gone], &new[j..j + come]));
        (i, j) = (i + gone, j + come);
        let same = old[i..]
            .chars()
            .zip(new[j..].chars())
            .take_while(|(old, new)| old == new && !old.is_whitespace());
        let width: usize = same.map(|(c, _)| c.len_utf8()).sum();
        (i, j) = (i + width, j + width);
    }
    changes
}

/// A change without what is equal at its beginning and its end.
fn smallest(start: usize, old: &str, new: &str) -> Option<Change> {
    let mut same_start = old.bytes().zip(new.bytes()).take_while(|(old, new)| old == new).count();
    while !old.is_char_boundary(same_start) {
        same_start -= 1;
    }
    let (old, new) = (&old[same_start..], &new[same_start..]);
    let mut same_end = old.bytes().rev().zip(new.bytes().rev()).take_while(|(old, new)| old == new).count();
    while !old.is_char_boundary(old.len() - same_end) {
        same_end -= 1;
    }
    let (old, new) = (&old[..old.len() - same_end], &new[..new.len() - same_end]);
    let start = start + same_start;
    (!old.is_empty() || !new.is_empty()).then(|| (start..start + old.len(), new.to_owned()))
}

/// The changes that lay out a document.
fn changes(snapshot: &Snapshot) -> Vec<Change> {
    let text = snapshot.text();
    let is_laid_out = matches!(snapshot.now.kind, Kind::Specification | Kind::Plant | Kind::Parameters);
    let name = snapshot.now.sources.file(snapshot.file).name();
    let Some(new) = is_laid_out.then(|| layout(name, text.to_owned()).ok()).flatten() else {
        return Vec::new();
    };
    // The editor knows how its lines end.
    let new = if text.contains("\r\n") { new.replace('\n', "\r\n") } else { new };
    between(text, &new)
}

fn applied(text: &str, changes: &[Change]) -> String {
    let mut new = String::with_capacity(text.len());
    let mut at = 0;
    for (place, change) in changes {
        new.push_str(&text[at..place.start]);
        new.push_str(change);
        at = place.end;
    }
    new.push_str(&text[at..]);
    new
}

/// Changes of a document's text as the protocol has them.
pub(super) fn edits(snapshot: &Snapshot, changes: Vec<Change>) -> Vec<TextEdit> {
    let (lines, text) = (snapshot.lines(), snapshot.text());
    let position = |at| lines.position(text, at, snapshot.encoding);
    let edit = |(place, new_text): Change| TextEdit {
        range: Range { start: position(place.start), end: position(place.end) },
        new_text,
    };
    changes.into_iter().map(edit).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_differs_changes() {
        let cases = [
            ("a\n    b: 1\nc\n", "a\n  b: 1\nc\n"),
            ("a: °\nb\n", "a: ²\nb\n"),
            ("a\n\n\n\nb\n", "a\n\nb\n"),
            ("a\r\n   b\r\n", "a\r\n  b\r\n"),
            ("a", "a\n"),
            ("", "a\n"),
            ("a\n", ""),
            ("a\nb\nc\nd\n", "x\nb\ny\nz\nd\n"),
        ];
        for (old, new) in cases {
            let changes = between(old, new);
            assert_eq!(applied(old, &changes), new, "{changes:?}");
            assert!(changes.windows(2).all(|pair| pair[0].0.end <= pair[1].0.start), "{changes:?}");
        }
        assert_eq!(between("a\n    b: 1\n", "a\n  b: 1\n"), [(4..6, String::new())]);
        assert_eq!(between("a\n", "a\n"), []);
    }
}
