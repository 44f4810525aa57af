//! Indices in running text, as people write them: `6040h`, and `3020h.5` for an entry.

use crate::model::{EntryId, Index, SubIndex};

/// An index in a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Written {
    /// Where in the text it begins.
    pub start: usize,
    /// Where the index ends; a sub-index follows it.
    pub index_end: usize,
    /// Where the sub-index ends, or else the index.
    pub end: usize,
    /// What is named; sub-index 0 where none is written.
    pub id: EntryId,
}

/// The indices in a text, in order.
pub fn indices(text: &str) -> impl Iterator<Item = Written> {
    text.match_indices('h').filter_map(|(at, _)| written_before(text, at))
}

/// The index whose `h` is at a place.
fn written_before(text: &str, at: usize) -> Option<Written> {
    let start = at.checked_sub(4)?;
    let digits = text.get(start..at)?;
    // As it is printed everywhere, with upper-case letters: `beach` and `each` end in small ones.
    if !digits.bytes().all(|digit| matches!(digit, b'0'..=b'9' | b'A'..=b'F')) {
        return None;
    }
    // `18041h` is longer than an index, and `x6040h` is a word.
    let joins = |sign: char| sign.is_alphanumeric() || sign == '_';
    if text[..start].ends_with(joins) || text[at + 1..].starts_with(joins) {
        return None;
    }
    let index = Index(u16::from_str_radix(digits, 16).ok()?);
    let (sub, length) = sub_index(&text[at + 1..]).unwrap_or((SubIndex(0), 0));
    Some(Written { start, index_end: at + 1, end: at + 1 + length, id: EntryId { index, sub } })
}

/// The sub-index after an index and how long it is with its point: `.5`.
fn sub_index(behind: &str) -> Option<(SubIndex, usize)> {
    let digits = behind.strip_prefix('.')?;
    let length = digits.bytes().take_while(u8::is_ascii_digit).count();
    let is_word = digits[length..].starts_with(|sign: char| sign.is_alphanumeric() || sign == '_');
    let sub = if is_word { None } else { digits[..length].parse().ok() };
    sub.map(|sub| (SubIndex(sub), length + 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(text: &str) -> Vec<(&str, String)> {
        indices(text).map(|one| (&text[one.start..one.end], one.id.to_string())).collect()
    }

    #[test]
    fn indices_are_found() {
        assert_eq!(
            found("6040h = 000Fh; see (60C1h.2), 3020h..3024h."),
            [
                ("6040h", "6040h".to_owned()),
                ("000Fh", "000Fh".to_owned()),
                ("60C1h.2", "60C1h.2".to_owned()),
                ("3020h", "3020h".to_owned()),
                ("3024h", "3024h".to_owned())
            ]
        );
    }

    #[test]
    fn what_only_looks_like_an_index_is_none() {
        assert_eq!(found("beach, 18041h, x6040h, 6040hex, 6040h_x, 0x6040, 40h, ü040h, h"), []);
        assert_eq!(found("6040h.300"), [("6040h", "6040h".to_owned())]);
        assert_eq!(found("6040h.3a"), [("6040h", "6040h".to_owned())]);
        assert_eq!(found("Zustand gemäß 6041h. 3 weitere"), [("6041h", "6041h".to_owned())]);
    }
}
