//! How facts read in a report. Values are written as in a comment of an EDS, with the raw number that a project sends; words
//! are those of the specification.

use od_spec::model::{Entry, Fact, Index, Unit, Value};
use od_spec::wording::{Notation, Wording};

pub(super) const VALUES: Wording = Wording::english(Notation::Eds);
pub(super) const WORDS: Wording = Wording::english(Notation::Json);

/// A value of an entry; an empty text is seen as one.
pub(super) fn value(index: Index, entry: &Entry, value: &Value) -> String {
    VALUES.value(Some(index), entry, value)
}

/// A unit: what one raw step is worth, and what the symbol is in terms of a more basic one.
pub(super) fn unit(unit: &Unit) -> String {
    let step = VALUES.counted_step(unit);
    let base =
        unit.base.as_ref().map(|base| format!(", 1 {} is {} {}", unit.symbol, base.factor, base.symbol));
    let formula = unit.formula.as_ref().map(|formula| format!(", {}", formula.text));
    format!("{step}{}{}", base.unwrap_or_default(), formula.unwrap_or_default())
}

/// What an entry is, for one that came or went: `unsigned16 rw`.
pub(super) fn entry(entry: &Entry) -> String {
    let named = entry.named_type.as_ref().map(|named| format!(" ({})", named.name));
    format!("{}{} {}", entry.data_type.name(), named.unwrap_or_default(), WORDS.access(entry))
}

/// `yes`, `no`.
pub(super) const fn yes_no(yes: bool) -> &'static str {
    if yes { "yes" } else { "no" }
}

/// A kind of fact.
pub(super) fn fact(fact: Fact) -> &'static str {
    WORDS.fact(fact)
}

/// `1 entry`, `2 entries`.
pub(super) fn counted(number: usize, one: &str, several: &str) -> String {
    if number == 1 { format!("1 {one}") } else { format!("{number} {several}") }
}
