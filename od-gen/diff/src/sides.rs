//! Values of two sides, side by side.

use std::collections::BTreeMap;

/// A value before and after.
pub(super) type Values = (Option<String>, Option<String>);

/// Values on both sides, by what has them.
pub(super) fn sides<'n>(
    old: impl IntoIterator<Item = (&'n str, String)>,
    new: impl IntoIterator<Item = (&'n str, String)>,
) -> BTreeMap<&'n str, Values> {
    let mut values: BTreeMap<&str, Values> = BTreeMap::new();
    for (name, value) in old {
        values.entry(name).or_default().0 = Some(value);
    }
    for (name, value) in new {
        values.entry(name).or_default().1 = Some(value);
    }
    values
}
