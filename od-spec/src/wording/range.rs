//! Ranges.

use super::{Notation, Word, Wording};
use crate::model::{Entry, Index, TypeKind};

/// The limits of an entry that say something: raw values, `None` where nothing limits that side.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Smallest allowed value, beside the special values.
    pub low: Option<i128>,
    /// Largest allowed value, beside the special values.
    pub high: Option<i128>,
}

impl Limits {
    /// The limits of an entry without those that its data type has anyhow; of an enum none, as its values say more. An end of
    /// the type stays where the other side has a limit: `0 to 100`.
    pub fn of(entry: &Entry) -> Self {
        if matches!(entry.named_type.as_ref().map(|named| &named.kind), Some(TypeKind::Enum(_))) {
            return Self { low: None, high: None };
        }
        let ends = entry.data_type.range();
        let narrows_below = entry.low.is_some() && entry.low != ends.map(|(lowest, _)| lowest);
        let narrows_above = entry.high.is_some() && entry.high != ends.map(|(_, highest)| highest);
        let narrows = narrows_below || narrows_above;
        Self { low: entry.low.filter(|_| narrows), high: entry.high.filter(|_| narrows) }
    }
}

impl Wording {
    /// The range of an entry: `0 to 100`, `≤ 90.0 °C (900)`; `None` where nothing narrows the data type.
    pub fn range(self, index: Index, entry: &Entry) -> Option<String> {
        let end = |raw: i128| self.ordinary(Some(index), entry, raw);
        let (at_least, at_most) = match self.notation {
            Notation::Eds => ("at least", "at most"),
            Notation::Manual | Notation::Rust | Notation::Json | Notation::Diagnostic => ("≥", "≤"),
        };
        match Limits::of(entry) {
            Limits { low: Some(low), high: Some(high) } => {
                Some(format!("{} {} {}", end(low), self.word(Word::ToRange), end(high)))
            }
            Limits { low: Some(low), high: None } => Some(format!("{at_least} {}", end(low))),
            Limits { low: None, high: Some(high) } => Some(format!("{at_most} {}", end(high))),
            Limits { low: None, high: None } => None,
        }
    }
}
