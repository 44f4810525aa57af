//! Values that are the number or the word of something, also where it is written in other words.

use super::number::{bare, lenient_integer};
use crate::model::{Access, DataType};
use crate::notation::words;

/// A value without a remark after it and quotation marks around it.
fn alone(text: &str) -> &str {
    bare(text, &mut Vec::new())
}

/// A data type by its number.
pub(crate) fn data_type_of(number: i128) -> Option<DataType> {
    DataType::from_code(u16::try_from(number).ok()?)
}

/// A data type by its number or its name.
pub(crate) fn data_type(text: &str) -> Option<DataType> {
    match lenient_integer(text) {
        Some(number) => data_type_of(number),
        None => words::data_type(alone(text)),
    }
}

/// The number of an object type, of which the name may be written there.
pub(crate) fn object_code(text: &str) -> Option<i128> {
    lenient_integer(text).or_else(|| words::object_code(alone(text)).map(i128::from))
}

/// An access type.
pub(crate) fn access(text: &str) -> Option<Access> {
    words::access(alone(text))
}

/// A bit rate of CiA 301 in kbit/s.
pub(crate) fn bit_rate(text: &str) -> Option<u16> {
    match lenient_integer(text) {
        Some(number) => words::bit_rate(&number.to_string()),
        None => words::bit_rate(alone(text)),
    }
}
