//! Which lines of a document can be folded away: by indentation, so that a broken text folds, too.

use lsp_types::{FoldingRange, FoldingRangeKind};
use od_spec::order::Arrange as _;

use super::analysis::Kind;
use super::snapshot::Snapshot;

/// The foldable parts of a document.
pub(super) fn ranges(snapshot: &Snapshot) -> Vec<FoldingRange> {
    let text = snapshot.text();
    let lines: Vec<&str> =
        (0..snapshot.lines().count()).map(|line| snapshot.lines().line(text, line).1).collect();
    match snapshot.now.kind {
        Kind::Eds => of_sections(&lines),
        Kind::Specification | Kind::Plant | Kind::Parameters | Kind::Xdd | Kind::Foreign | Kind::TooLarge => {
            by_depth(&lines)
        }
    }
}

/// Each line with the deeper lines after it, and comments of several lines.
fn by_depth(lines: &[&str]) -> Vec<FoldingRange> {
    let mut ranges = comments(lines, '#');
    // Lines that are followed by deeper ones, with their depths.
    let mut open: Vec<(usize, usize)> = Vec::new();
    let mut last = 0;
    let mut close = |open: &mut Vec<(usize, usize)>, least: usize, last: usize| {
        while let Some((line, _)) = open.pop_if(|(_, depth)| *depth >= least) {
            ranges.extend(range(line, last, None));
        }
    };
    for (number, line) in lines.iter().enumerate() {
        let content = line.trim_start_matches(' ');
        if content.trim().is_empty() {
            continue;
        }
        let depth = line.len() - content.len();
        // What closes a bracket is as deep as the line that opened it, and is folded with it.
        if content.starts_with(['}', ']']) {
            close(&mut open, depth + 1, last);
            last = number;
            continue;
        }
        // A comment between two objects belongs to what follows.
        if content.starts_with('#') {
            continue;
        }
        close(&mut open, depth, last);
        open.push((number, depth));
        last = number;
    }
    close(&mut open, 0, last);
    ranges.arrange_by_key(|range| (range.start_line, range.end_line));
    ranges
}

/// The sections of an EDS, each to the last line that is not empty.
fn of_sections(lines: &[&str]) -> Vec<FoldingRange> {
    let mut ranges = comments(lines, ';');
    let (mut start, mut last) = (None, 0);
    for (number, line) in lines.iter().enumerate() {
        let content = line.trim();
        if content.starts_with('[') {
            ranges.extend(start.replace(number).and_then(|start| range(start, last, None)));
            last = number;
        } else if !content.is_empty() && !content.starts_with(';') {
            last = number;
        }
    }
    ranges.extend(start.and_then(|start| range(start, last, None)));
    ranges.arrange_by_key(|range| (range.start_line, range.end_line));
    ranges
}

/// Comments of several lines.
fn comments(lines: &[&str], sign: char) -> Vec<FoldingRange> {
    let mut ranges = Vec::new();
    let mut start = None;
    for (number, line) in lines.iter().chain([&""]).enumerate() {
        match (line.trim_start().starts_with(sign), start) {
            (true, None) => start = Some(number),
            (false, Some(first)) => {
                ranges.extend(range(first, number - 1, Some(FoldingRangeKind::Comment)));
                start = None;
            }
            (true, Some(_)) | (false, None) => {}
        }
    }
    ranges
}

/// A range of more than one line.
fn range(first: usize, last: usize, kind: Option<FoldingRangeKind>) -> Option<FoldingRange> {
    let (start_line, end_line) = (u32::try_from(first).ok()?, u32::try_from(last).ok()?);
    (start_line < end_line).then(|| FoldingRange { start_line, end_line, kind, ..FoldingRange::default() })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folded(ranges: &[FoldingRange]) -> Vec<(u32, u32)> {
        ranges.iter().map(|range| (range.start_line, range.end_line)).collect()
    }

    #[test]
    fn a_line_folds_with_what_is_deeper() {
        let text = "# a\n# b\nunits:\n  volt: {}\n\nobjects:\n  0x2000:\n    name: x\n    record: {\n      1: y,\n    }\n\n  # next\n  0x2001: {\nbroken";
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(folded(&by_depth(&lines)), [(0, 1), (2, 3), (5, 13), (6, 10), (8, 10)]);
    }

    #[test]
    fn sections_of_an_eds_fold_to_their_last_key() {
        let text = "; a\n; b\n[FileInfo]\nFileName=x\n\n[Comments]\nLines=0\n; end";
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(folded(&of_sections(&lines)), [(0, 1), (2, 3), (5, 6)]);
    }
}
