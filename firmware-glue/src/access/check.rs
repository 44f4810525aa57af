//! Whether an entry takes a value: its length, its type, its limits.

use crate::abort::AbortCode;
use crate::table::{Attributes, Flags, NONE, Place, Table};
use crate::value::data_type::{DataType, StringType};
use crate::value::number::number;
use crate::value::text::trimmed;

pub(crate) fn check_value(table: &Table<'_>, shared: &Attributes, data: &[u8]) -> Result<(), AbortCode> {
    let size = usize::from(shared.size);
    if shared.place == Place::Application {
        return Err(AbortCode::UNSUPPORTED_ACCESS);
    }
    if data.len() > size {
        return Err(AbortCode::TOO_LONG);
    }
    if let Some(string_type) = shared.data_type.string() {
        return check_text(string_type, data);
    }
    if data.len() < size {
        return Err(AbortCode::TOO_SHORT);
    }
    if shared.data_type == DataType::Boolean && data.iter().any(|byte| *byte > 1) {
        return Err(AbortCode::INVALID_VALUE);
    }
    if shared.limits == NONE && shared.values == NONE {
        return Ok(());
    }
    check_number(table, shared, data)
}

fn check_number(table: &Table<'_>, shared: &Attributes, data: &[u8]) -> Result<(), AbortCode> {
    let number = number(shared.data_type, data);
    let parts = table.parts();
    let listed =
        parts.values.get(usize::from(shared.values)).is_some_and(|list| list.binary_search(&number).is_ok());
    if listed {
        return Ok(());
    }
    if shared.flags.has(Flags::ONLY_VALUES) {
        return Err(AbortCode::INVALID_VALUE);
    }
    match parts.limits.get(usize::from(shared.limits)) {
        Some(limits) if number > limits.high => Err(AbortCode::TOO_HIGH),
        Some(limits) if number < limits.low => Err(AbortCode::TOO_LOW),
        _ => Ok(()),
    }
}

/// A VISIBLE_STRING holds 20h to 7Eh, a UNICODE_STRING whole units; zeros may pad both, but cannot be between
/// characters, because what is after them would be lost.
fn check_text(string_type: StringType, data: &[u8]) -> Result<(), AbortCode> {
    match string_type {
        StringType::Octet => return Ok(()),
        StringType::Unicode if data.len() % 2 == 1 => return Err(AbortCode::LENGTH),
        StringType::Unicode | StringType::Visible => {}
    }
    let Some((text, padding)) = data.split_at_checked(trimmed(string_type, data).len()) else {
        return Err(AbortCode::INTERNAL);
    };
    let is_character = |byte: &u8| string_type != StringType::Visible || (0x20..=0x7E).contains(byte);
    let is_text = text.iter().all(is_character) && padding.iter().all(|byte| *byte == 0);
    if is_text { Ok(()) } else { Err(AbortCode::INVALID_VALUE) }
}
