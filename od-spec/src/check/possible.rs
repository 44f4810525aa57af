//! The values that an entry can have, as far as type, limits, enum and access show.

use crate::model::{Access, BitUsage, DataType, Entry, TypeKind, Value};

/// Raw values from one to another, both included.
pub(in crate::check) type Run = (i128, i128);

/// An enum of more runs than these counts as one run.
const MOST_RUNS: usize = 64;

/// The raw values that an entry can have: runs in ascending order that neither meet nor overlap. None where they are
/// not whole numbers.
pub(in crate::check) fn possible(entry: &Entry) -> Option<Vec<Run>> {
    let (least, most) = entry.data_type.range()?;
    let stated = entry.default.as_ref().and_then(Value::integer);
    if let (Access::Const, Some(raw)) = (entry.access, stated) {
        return Some(vec![(raw, raw)]);
    }
    let mut runs: Vec<Run> = match entry.named_type.as_ref().map(|named| &named.kind) {
        Some(TypeKind::Enum(values)) => {
            let values = values.iter().filter(|value| value.supported && entry.allows(value.value));
            values.map(|value| (value.value, value.value)).collect()
        }
        Some(TypeKind::Bits(_)) | None => {
            vec![(entry.low.unwrap_or(least).max(least), entry.high.unwrap_or(most).min(most))]
        }
    };
    runs.retain(|(low, high)| low <= high);
    let single = entry.special.iter().map(|special| special.value).chain(stated);
    runs.extend(single.map(|raw| (raw, raw)));
    let mut joined: Vec<Run> = Vec::new();
    runs.sort_unstable();
    for (low, high) in runs {
        match joined.last_mut() {
            Some(last) if low <= last.1.saturating_add(1) => last.1 = last.1.max(high),
            Some(_) | None => joined.push((low, high)),
        }
    }
    match (joined.first(), joined.last()) {
        (Some(first), Some(last)) if joined.len() > MOST_RUNS => Some(vec![(first.0, last.1)]),
        // Limits in the wrong order leave nothing; that is said by itself.
        (None, _) => Some(vec![(least, most)]),
        (Some(_), _) => Some(joined),
    }
}

/// The least and the largest of these values.
pub(in crate::check) fn hull(entry: &Entry) -> Option<Run> {
    let runs = possible(entry)?;
    Some((runs.first()?.0, runs.last()?.1))
}

/// What a bit is in each of some runs of values.
pub(in crate::check) fn bits(runs: &[Run], bit: u8) -> Vec<Run> {
    let above = |raw: i128| raw >> u32::from(bit).min(i128::BITS - 1);
    let mut values: Vec<i128> = runs
        .iter()
        .flat_map(|(low, high)| if above(*low) == above(*high) { vec![above(*low) & 1] } else { vec![0, 1] })
        .collect();
    values.sort_unstable();
    values.dedup();
    values.into_iter().map(|value| (value, value)).collect()
}

/// Whether a bit is reserved, and 0 for ever: it cannot be written.
pub(in crate::check) fn is_reserved(entry: &Entry, bit: u8) -> bool {
    if entry.access.is_writable() {
        return false;
    }
    let Some(TypeKind::Bits(fields)) = entry.named_type.as_ref().map(|named| &named.kind) else {
        return false;
    };
    let field = fields.iter().find(|field| (field.first..=field.last).contains(&bit));
    field.is_some_and(|field| field.usage == BitUsage::Reserved)
}

/// Whether a value is one of a type.
pub(in crate::check) fn fits(raw: i128, data_type: DataType) -> bool {
    data_type.range().is_some_and(|(least, most)| (least..=most).contains(&raw))
}
