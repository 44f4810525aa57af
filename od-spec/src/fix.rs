//! Fixes what can be fixed without guessing.

use std::collections::BTreeMap;
use std::ops::Range;

use crate::compile::findings;
use crate::diag::{Code, Diagnostic, Diagnostics, Edit, Severity};
use crate::eds::check::BYTE_ORDER_MARK;
use crate::encoding::{self, Encoding, encode};
use crate::files::decode;
use crate::order::Arrange as _;
use crate::source::{FileId, SourceMap};

/// Most rounds of changes: each may make room for others, such as the first entry of a list that was missing.
const MOST_ROUNDS: usize = 64;

/// What [`fix`] has made of a file.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Fixed {
    /// The text, as the only file.
    pub sources: SourceMap,
    /// That file.
    pub file: FileId,
    /// How it is stored: as before, or as ASCII where nothing speaks against it any more.
    pub encoding: Encoding,
    /// What was changed, in the order of the new text.
    pub changes: Vec<Change>,
    /// What is left to say about it: what a person has to decide.
    pub left: Diagnostics,
}

/// One place that was changed.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Change {
    /// Where it is in the new text, in bytes; empty where something was taken out.
    pub place: Range<usize>,
    /// What was wrong.
    pub code: &'static Code,
}

impl Fixed {
    /// The new text.
    pub fn text(&self) -> &str {
        self.sources.file(self.file).text()
    }

    /// The bytes of the file.
    pub fn to_bytes(&self) -> Vec<u8> {
        // Changes bring only ASCII, which every encoding has.
        encode(self.text(), self.encoding).unwrap_or_else(|_| self.text().as_bytes().to_vec())
    }

    /// How many changes there were for each code.
    pub fn counts(&self) -> BTreeMap<&'static Code, usize> {
        let mut counts = BTreeMap::new();
        for change in &self.changes {
            *counts.entry(change.code).or_default() += 1;
        }
        counts
    }
}

/// Makes all changes of an EDS or DCF that fix something without guessing, and no others: every other byte stays.
///
/// Doing it twice changes nothing, and it never makes more errors than there were.
///
/// ```
/// use od_spec::fix;
///
/// let fixed = fix("lamp.eds", b"# nothing to say\n[comments]\nLines = 1\n").unwrap();
/// assert!(fixed.text().starts_with("; nothing to say\n[Comments]\nLines=0\n"));
/// let again = fix("lamp.eds", &fixed.to_bytes()).unwrap();
/// assert!(again.changes.is_empty());
/// ```
///
/// # Errors
/// The code page of the file is one that is not read (OD0102), or it is not one of CANopen (OD0121).
pub fn fix(name: &str, bytes: &[u8]) -> Result<Fixed, Box<Diagnostic>> {
    let (text, encoding) = decode(name, bytes.to_vec())?;
    let mut fixed = rounds(name, text, encoding, findings);
    // A mark in front of the text, or two bytes for each character, are not part of the text.
    if fixed.text().is_ascii() && fixed.encoding != Encoding::Ascii {
        let mark = fixed.left.iter().find(|one| one.code == BYTE_ORDER_MARK);
        fixed.changes.extend(mark.map(|one| Change { place: 0..0, code: one.code }));
        fixed.changes.arrange_by_key(|change| (change.place.start, change.code));
        fixed.encoding = Encoding::Ascii;
        let text = fixed.text().to_owned();
        fixed.sources = SourceMap::new();
        fixed.file = fixed.sources.add_decoded(name, text, Encoding::Ascii);
        fixed.left = findings(&fixed.sources, fixed.file);
    }
    Ok(fixed)
}

/// Changes a text as long as something is found that can be changed.
fn rounds(
    name: &str,
    text: String,
    encoding: Encoding,
    look: impl Fn(&SourceMap, FileId) -> Diagnostics,
) -> Fixed {
    let read = |text: String| {
        let mut sources = SourceMap::new();
        let file = sources.add_decoded(name, text, encoding);
        let left = look(&sources, file);
        Fixed { sources, file, encoding, changes: Vec::new(), left }
    };
    let mut fixed = read(text);
    for _ in 0..MOST_ROUNDS {
        let chosen = choose(&fixed);
        if chosen.is_empty() {
            break;
        }
        let mut next = read(apply(fixed.text(), &chosen));
        if errors(&next.left) > errors(&fixed.left) || !is_read_alike(next.text(), encoding) {
            break;
        }
        next.changes = moved(&fixed.changes, &chosen);
        fixed = next;
    }
    fixed
}

/// Whether the bytes of a text represent that text. How characters are stored is a guess where nothing says it, and may
/// become another guess when some of them are gone.
fn is_read_alike(text: &str, encoding: Encoding) -> bool {
    let stands_for_it = |bytes| encoding::decode(bytes).is_ok_and(|(again, _)| again == text);
    text.is_ascii() || encode(text, encoding).is_ok_and(stands_for_it)
}

fn errors(diagnostics: &Diagnostics) -> usize {
    diagnostics.iter().filter(|one| one.severity() == Severity::Error).count()
}

/// A change that will be made, and for what.
struct Chosen<'d> {
    edit: &'d Edit,
    code: &'static Code,
}

impl Chosen<'_> {
    const fn range(&self) -> Range<usize> {
        self.edit.span.start as usize..self.edit.span.end as usize
    }
}

/// The changes that can be made together, by place. All changes of a message are made, or none; of two messages that change
/// the same place, the first is heard.
fn choose(fixed: &Fixed) -> Vec<Chosen<'_>> {
    // End of each place that is taken, by its start.
    let mut taken: BTreeMap<u32, u32> = BTreeMap::new();
    let mut chosen = Vec::new();
    for diagnostic in &fixed.left {
        let fits = |edit: &Edit| is_inside(edit, fixed) && is_free(edit, &taken);
        if diagnostic.edits.iter().all(fits) && are_apart(&diagnostic.edits) {
            for edit in &diagnostic.edits {
                let end = taken.entry(edit.span.start).or_insert(edit.span.end);
                *end = edit.span.end.max(*end);
                chosen.push(Chosen { edit, code: diagnostic.code });
            }
        }
    }
    chosen.arrange_by_key(|chosen| (chosen.edit.span.start, chosen.edit.span.end));
    chosen
}

fn is_inside(edit: &Edit, fixed: &Fixed) -> bool {
    let (start, end) = (edit.span.start as usize, edit.span.end as usize);
    edit.span.file == fixed.file && fixed.text().get(start..end).is_some_and(|old| old != edit.text)
}

/// Whether the changes of a message can be made together.
fn are_apart(edits: &[Edit]) -> bool {
    let mut spans: Vec<_> = edits.iter().map(|edit| (edit.span.start, edit.span.end)).collect();
    spans.sort_unstable();
    spans.windows(2).all(|pair| pair[0].1 <= pair[1].0)
}

/// Whether no other change is made in or at a place. Two texts put in at one place would have no order.
fn is_free(edit: &Edit, taken: &BTreeMap<u32, u32>) -> bool {
    let (start, end) = (edit.span.start, edit.span.end);
    let before = taken.range(..=start).next_back();
    let behind = taken.range(start..).next();
    before.is_none_or(|(other, other_end)| *other_end <= start && *other != start)
        && behind.is_none_or(|(other, _)| *other >= end && *other != start)
}

/// The text after some changes, which are sorted and apart.
fn apply(text: &str, chosen: &[Chosen<'_>]) -> String {
    let mut new = String::with_capacity(text.len() + text.len() / 16);
    let mut at = 0;
    for one in chosen {
        let range = one.range();
        new.push_str(text.get(at..range.start).unwrap_or_default());
        new.push_str(&one.edit.text);
        at = range.end.max(at);
    }
    new.push_str(text.get(at..).unwrap_or_default());
    new
}

/// Earlier changes at their new places, together with those that are made now.
fn moved(earlier: &[Change], chosen: &[Chosen<'_>]) -> Vec<Change> {
    // Where each change begins in the new text.
    let mut starts = Vec::with_capacity(chosen.len());
    let (mut old, mut new) = (0, 0);
    for one in chosen {
        let range = one.range();
        new += range.start - old;
        starts.push(new);
        new += one.edit.text.len();
        old = range.end;
    }
    let place = |offset: usize| {
        let at = chosen.partition_point(|one| one.range().start < offset);
        let Some((one, start)) = at.checked_sub(1).and_then(|at| Some((chosen.get(at)?, starts.get(at)?)))
        else {
            return offset;
        };
        let range = one.range();
        match offset.checked_sub(range.end) {
            Some(behind) => start + one.edit.text.len() + behind,
            None => start + (offset - range.start).min(one.edit.text.len()),
        }
    };
    let earlier = earlier.iter().map(|change| Change {
        place: place(change.place.start)..place(change.place.end),
        code: change.code,
    });
    let now = chosen
        .iter()
        .zip(&starts)
        .map(|(one, start)| Change { place: *start..start + one.edit.text.len(), code: one.code });
    let mut changes: Vec<Change> = earlier.chain(now).collect();
    changes.arrange_by_key(|change| (change.place.start, change.code));
    changes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diag::Diagnostic;
    use crate::eds::codes;
    use crate::source::Span;

    /// In every case, two changes of one place are made one after the other, and the first by place comes first.
    #[test]
    fn changes_of_one_place_are_made_in_rounds() {
        let look = |sources: &SourceMap, file: FileId| {
            let mut said = Diagnostics::new();
            let text = sources.file(file).text();
            for (from, to, code) in
                [("b", "cc", codes::BAD_FLAG), ("ab", "b", codes::OCTAL), ("x", "", codes::BAD_COUNT)]
            {
                let Some(at) = text.find(from).and_then(|at| u32::try_from(at).ok()) else { continue };
                let span = Span { file, start: at, end: at + u32::try_from(from.len()).unwrap() };
                said.push(Diagnostic::new(code, span, "wrong").edit(span, to));
            }
            said.sort();
            said
        };
        let fixed = rounds("a", "x ab ab x".to_owned(), Encoding::Ascii, look);
        assert_eq!(fixed.text(), " cc cc ");
        assert!(fixed.left.is_empty());
        let changes: Vec<(Range<usize>, &str)> =
            fixed.changes.iter().map(|change| (change.place.clone(), change.code.id)).collect();
        assert_eq!(changes.first(), Some(&(0..0, codes::BAD_COUNT.id)));
        assert_eq!(changes.last(), Some(&(7..7, codes::BAD_COUNT.id)));
        assert!(changes.contains(&(1..3, codes::BAD_FLAG.id)), "{changes:?}");
    }

    /// What looks like a mark in front of a text is not one as long as the rest is no UTF-8.
    #[test]
    fn the_rest_of_a_text_is_read_as_before() {
        let bytes = b"\xEF\xBB\xBF[FileInfo]\nDescription=a lamp\n;\xE4\n".as_slice();
        let fixed = fix("lamp.eds", bytes).unwrap();
        assert_eq!(encoding::decode(fixed.to_bytes()).unwrap().0, fixed.text());
        assert!(fix("lamp.eds", &fixed.to_bytes()).unwrap().changes.is_empty());
    }

    #[test]
    fn changes_that_never_end_or_make_more_errors_are_not_made() {
        let growing = |sources: &SourceMap, file: FileId| {
            let mut said = Diagnostics::new();
            let whole = sources.whole(file);
            for at in 0..whole.end {
                let span = whole.part(at as usize, at as usize);
                said.push(Diagnostic::new(codes::BAD_FLAG, span, "wrong").edit(span, "x"));
            }
            said
        };
        assert_eq!(rounds("a", "ab".to_owned(), Encoding::Ascii, growing).text(), "ab");
        let endless = |sources: &SourceMap, file: FileId| {
            let mut said = Diagnostics::new();
            let start = sources.whole(file).part(0, 0);
            said.push(Diagnostic::new(codes::BAD_FLAG, start, "wrong").edit(start, "x"));
            said
        };
        assert_eq!(rounds("a", String::new(), Encoding::Ascii, endless).text().len(), MOST_ROUNDS);
    }
}
