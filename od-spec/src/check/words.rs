//! What an entry allows, in words.

use crate::model::{Entry, Value, format_value};

/// `0.0 °C to 40.0 °C`: the limits, or those of the data type.
pub(super) fn allowed(entry: &Entry) -> String {
    let (low, high) = entry.data_type.range().unwrap_or_default();
    let plain = Entry { special: Vec::new(), ..entry.clone() };
    let show = |raw: i128| format_value(&plain, &Value::Integer(raw));
    format!("{} to {}", show(entry.low.unwrap_or(low)), show(entry.high.unwrap_or(high)))
}
