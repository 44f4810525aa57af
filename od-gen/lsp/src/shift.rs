//! Places of an earlier text in the text of now.

use std::ops::Range;

/// What lies between two texts: equal beginnings, equal ends, and what changed between them.
///
/// While a text is edited it is often not a specification for a moment. Places before or after what was typed
/// are the same in the last text that was one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Shift {
    /// Bytes that are equal at the beginning.
    same_start: usize,
    /// Where the equal end begins in the earlier text, and in that of now.
    earlier_end: usize,
    now_end: usize,
}

impl Shift {
    /// Compares two texts.
    pub(super) fn between(earlier: &str, now: &str) -> Self {
        let (one, other) = (earlier.as_bytes(), now.as_bytes());
        let mut start = one.iter().zip(other).take_while(|(one, other)| one == other).count();
        while !earlier.is_char_boundary(start) {
            start -= 1;
        }
        let (one, other) = (&one[start..], &other[start..]);
        let mut same =
            one.iter().rev().zip(other.iter().rev()).take_while(|(one, other)| one == other).count();
        while !earlier.is_char_boundary(earlier.len() - same) {
            same -= 1;
        }
        Self { same_start: start, earlier_end: earlier.len() - same, now_end: now.len() - same }
    }

    /// Where a byte of the present text was earlier; what is new was at what it replaced.
    pub(super) fn earlier(self, now: usize) -> usize {
        if now >= self.now_end { now - self.now_end + self.earlier_end } else { now.min(self.earlier_end) }
    }

    /// What is now in the place of a range of the earlier text.
    pub(super) fn around(self, earlier: Range<usize>) -> (usize, usize) {
        let moved = |at: usize, changed: usize| {
            if at >= self.earlier_end { at - self.earlier_end + self.now_end } else { at.min(changed) }
        };
        (moved(earlier.start, self.same_start), moved(earlier.end, self.now_end))
    }

    /// Where a range of the earlier text is now; `None` if some of it changed.
    pub(super) fn now(self, earlier: Range<usize>) -> Option<Range<usize>> {
        if earlier.end <= self.same_start {
            Some(earlier)
        } else if earlier.start >= self.earlier_end {
            let moved = |at: usize| at - self.earlier_end + self.now_end;
            Some(moved(earlier.start)..moved(earlier.end))
        } else {
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_stands_beside_a_change_is_found_in_both_texts() {
        let (earlier, now) = ("a: 1°\nb: 2\nc: 3\n", "a: 1°\nb: \nx\nc: 3\n");
        let shift = Shift::between(earlier, now);
        let text = |range: Option<Range<usize>>| range.map(|range| &now[range]);
        assert_eq!(text(shift.now(0..1)), Some("a"));
        assert_eq!(text(shift.now(12..13)), Some("c"));
        assert_eq!(text(shift.now(10..11)), None);
        assert_eq!(&earlier[shift.earlier(now.find('c').unwrap())..][..1], "c");
        assert_eq!(shift.earlier(now.find('x').unwrap()), 11);
        assert_eq!(&now[shift.around(7..11).0..shift.around(7..11).1], "b: \nx");
    }

    #[test]
    fn equal_texts_and_halves_of_characters() {
        let shift = Shift::between("x", "x");
        assert_eq!((shift.now(0..1), shift.earlier(1)), (Some(0..1), 1));
        // The two signs have their first bytes in common.
        let shift = Shift::between("°", "²");
        assert_eq!(shift, Shift { same_start: 0, earlier_end: 2, now_end: 2 });
        // The two have their last byte in common.
        let shift = Shift::between("°", "ð");
        assert_eq!(shift, Shift { same_start: 0, earlier_end: 2, now_end: 2 });
        let shift = Shift::between("aa", "aaa");
        assert_eq!((shift.now(0..2), shift.earlier(3)), (Some(0..2), 2));
    }
}
