//! `[xxxxObjectLinks]` (CiA 306 4.6.4): the objects that belong together with one.

use std::collections::{BTreeMap, BTreeSet};

use crate::eds::number::lenient_integer;
use crate::eds::view::Part;
use crate::model::Index;
use crate::source::Spanned;

/// The linked objects in the order of their numbers, whatever the count says. What is not an index is for the rules
/// about the text to report.
pub(super) fn links(part: &Part<'_>) -> Vec<Spanned<Index>> {
    let numbered = part.entries().filter_map(|entry| {
        let is_number = entry.key.value.bytes().all(|byte| byte.is_ascii_digit());
        let number: u32 = entry.key.value.parse().ok().filter(|_| is_number)?;
        let index = u16::try_from(lenient_integer(entry.value.value)?).ok()?;
        Some((number, Spanned::new(Index(index), entry.value.span)))
    });
    // Of two lines with one number, both name an object. What is named twice is one link.
    let mut by_number: BTreeMap<u32, Vec<Spanned<Index>>> = BTreeMap::new();
    for (number, link) in numbered {
        by_number.entry(number).or_default().push(link);
    }
    let mut seen = BTreeSet::new();
    by_number.into_values().flatten().filter(|link| seen.insert(link.value)).collect()
}
