//! Ranges.

use super::{Notation, Word, Wording};
use crate::model::{Entry, Index, Real, TypeKind};

/// The limits of an entry that say something: raw values, `None` where nothing limits that side.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Smallest allowed value, apart from the special values.
    pub low: Option<i128>,
    /// Largest allowed value, apart from the special values.
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
        let Limits { low, high } = Limits::of(entry);
        let end = |raw: i128| self.ordinary(Some(index), entry, raw);
        self.between(low.map(end), high.map(end)).or_else(|| self.real_range(entry))
    }

    /// The range of a REAL; `None` where it has no limits.
    pub(super) fn real_range(self, entry: &Entry) -> Option<String> {
        let end = |real: &Real| self.real(entry, real);
        self.between(entry.real_limits.low.as_ref().map(end), entry.real_limits.high.as_ref().map(end))
    }

    fn between(self, low: Option<String>, high: Option<String>) -> Option<String> {
        let (at_least, at_most) = match self.notation {
            Notation::Eds => ("at least", "at most"),
            Notation::Manual | Notation::Rust | Notation::Json | Notation::Diagnostic => ("≥", "≤"),
        };
        match (low, high) {
            (Some(low), Some(high)) => Some(format!("{low} {} {high}", self.word(Word::ToRange))),
            (Some(low), None) => Some(format!("{at_least} {low}")),
            (None, Some(high)) => Some(format!("{at_most} {high}")),
            (None, None) => None,
        }
    }
}
