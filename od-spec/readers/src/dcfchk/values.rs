//! Values and limits.

use super::super::python::{Item, Section, int};
use super::super::refusal::{Cause, Refusals};

/// A value as the reader takes it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Value {
    Integer { number: i128, has_node: bool },
    Real(f64),
}

pub(super) const REAL32: i128 = 0x08;
pub(super) const REAL64: i128 = 0x11;

/// The bits of a number that a type has, and whether it is signed. Not of REAL.
pub(super) const fn integer(data_type: i128) -> Option<(u32, bool)> {
    Some(match data_type {
        0x01 => (1, false),
        0x02 => (8, true),
        0x03 => (16, true),
        0x04 => (32, true),
        0x05 => (8, false),
        0x06 => (16, false),
        0x07 => (32, false),
        0x10 => (24, true),
        0x12 => (40, true),
        0x13 => (48, true),
        0x14 => (56, true),
        0x15 => (64, true),
        0x16 => (24, false),
        0x18 => (40, false),
        0x19 => (48, false),
        0x1A => (56, false),
        0x1B => (64, false),
        _ => return None,
    })
}

/// Whether values of a type are numbers.
pub(super) const fn is_basic(data_type: i128) -> bool {
    integer(data_type).is_some() || matches!(data_type, REAL32 | REAL64)
}

/// A number, after a formula or alone: what the expression for values accepts.
fn formula(text: &str) -> Option<(&str, bool)> {
    let behind = text.get(..7).filter(|start| start.eq_ignore_ascii_case("$NODEID"));
    let (digits, has_node) = match behind {
        Some(_) => (text[7..].trim_start().strip_prefix('+')?.trim_start(), true),
        None => (text, false),
    };
    let bare = digits.strip_prefix('-').unwrap_or(digits);
    let hexadecimal = bare.strip_prefix("0x").or_else(|| bare.strip_prefix("0X"));
    let is_number = match hexadecimal {
        Some(hexadecimal) => {
            !hexadecimal.is_empty() && hexadecimal.bytes().all(|byte| byte.is_ascii_hexdigit())
        }
        None => !bare.is_empty() && bare.bytes().all(|byte| byte.is_ascii_digit()),
    };
    is_number.then_some((digits, has_node))
}

/// Whether a text can be kept as a value of a type; whether it can be read is another matter.
pub(super) fn can_be_kept(data_type: i128, text: &str) -> bool {
    !is_basic(data_type) || text.eq_ignore_ascii_case("$NODEID") || formula(text).is_some()
}

/// A value or limit of a type that is a number.
pub(super) fn value(data_type: i128, text: &str) -> Option<Value> {
    if matches!(data_type, REAL32 | REAL64) {
        return real(data_type, text).map(Value::Real);
    }
    if text.eq_ignore_ascii_case("$NODEID") {
        return Some(Value::Integer { number: 0, has_node: true });
    }
    let (digits, has_node) = formula(text)?;
    Some(Value::Integer { number: int(digits, 0)?, has_node })
}

/// The bit pattern of a REAL.
fn real(data_type: i128, text: &str) -> Option<f64> {
    let bits = int(text, 0)?;
    if data_type == REAL32 {
        return u32::try_from(bits).ok().map(|bits| f64::from(f32::from_bits(bits)));
    }
    u64::try_from(bits).ok().map(f64::from_bits)
}

const UNREADABLE: &str =
    "a value or limit in another notation than `10`, `0xA` or `$NODEID+0xA`, or a REAL in decimal";

/// `DataType` and the limits of a section.
pub(super) fn data_type(section: &Section<'_>, refusals: &mut Refusals) {
    let Some(item) = section.filled("DataType") else { return };
    let Some(data_type) = int(&item.value, 0) else {
        return refusals.add(item.place, Cause::Number, "a data type that is not a number");
    };
    for key in ["LowLimit", "HighLimit"] {
        let Some(limit) = section.filled(key) else { continue };
        if is_basic(data_type) {
            check_limit(data_type, limit, refusals);
        } else {
            refusals.add(limit.place, Cause::Value, "a limit of something that is not a number");
        }
    }
}

fn check_limit(data_type: i128, limit: &Item<'_>, refusals: &mut Refusals) {
    if is_outside_type(data_type, limit) {
        return refusals.add(limit.place, Cause::Value, "a limit that its data type does not have");
    }
    // In a limit of an integer, what does not fit the expression at all is only warned of.
    let is_warned_of = integer(data_type).is_some() && formula(&limit.value).is_none();
    if value(data_type, &limit.value).is_none() && !is_warned_of {
        refusals.add(limit.place, Cause::Number, UNREADABLE);
    }
}

fn is_outside_type(data_type: i128, limit: &Item<'_>) -> bool {
    match (value(data_type, &limit.value), integer(data_type)) {
        (Some(Value::Integer { number, has_node }), Some((bits, is_signed))) => {
            let (low, high) = range(bits, is_signed);
            let (low, high) = if has_node { (low - 1, high - 127) } else { (low, high) };
            !(low..=high).contains(&number)
        }
        (Some(Value::Real(number)), _) => is_too_large(data_type, number),
        (Some(Value::Integer { .. }) | None, _) => false,
    }
}

const fn range(bits: u32, is_signed: bool) -> (i128, i128) {
    if is_signed { (-(1 << (bits - 1)), (1 << (bits - 1)) - 1) } else { (0, (1 << bits) - 1) }
}

fn is_too_large(data_type: i128, number: f64) -> bool {
    let largest = if data_type == REAL32 { f64::from(f32::MAX) } else { f64::MAX };
    number.abs() > largest
}

/// `DefaultValue` and `ParameterValue` of a section.
pub(super) fn values(section: &Section<'_>, refusals: &mut Refusals) {
    for item in ["DefaultValue", "ParameterValue"].into_iter().filter_map(|key| section.filled(key)) {
        check_value(section, item, refusals);
    }
}

/// A value, held against type and limits of a section.
pub(super) fn check_value(section: &Section<'_>, item: &Item<'_>, refusals: &mut Refusals) {
    let Some(data_type) = section.value("DataType").and_then(|text| int(text, 0)) else {
        return refusals.add(item.place, Cause::Missing, "the data type of a value");
    };
    // A limit that its type does not have is refused itself.
    if ["LowLimit", "HighLimit"]
        .iter()
        .filter_map(|key| section.filled(key))
        .any(|limit| is_outside_type(data_type, limit))
    {
        return;
    }
    let limit = |key| section.filled(key).map(|item| value(data_type, &item.value));
    let (low, high) = match (limit("LowLimit"), limit("HighLimit")) {
        (Some(None), _) | (_, Some(None)) if is_basic(data_type) => {
            return refusals.add(item.place, Cause::Number, "a value and a limit in different notations");
        }
        (low, high) => (low.flatten(), high.flatten()),
    };
    if !is_basic(data_type) {
        return;
    }
    // Alone, the node-ID is known in upper case only.
    let is_misspelled = item.value != "$NODEID" && item.value.eq_ignore_ascii_case("$NODEID");
    match value(data_type, &item.value).filter(|_| !is_misspelled) {
        None => refusals.add(item.place, Cause::Number, UNREADABLE),
        Some(Value::Integer { number, has_node }) => {
            let (smallest, largest) = integer(data_type).map_or((0, 0), |(bits, signed)| range(bits, signed));
            let bound = |limit, other| match limit {
                Some(Value::Integer { number, has_node }) => (number, has_node),
                Some(Value::Real(_)) | None => (other, false),
            };
            let ((low, low_has), (high, high_has)) = (bound(low, smallest), bound(high, largest));
            let low = low + i128::from(!has_node && low_has) - i128::from(has_node && !low_has);
            let high = high + 127 * (i128::from(!has_node && high_has) - i128::from(has_node && !high_has));
            if number < low || number > high {
                refusals.add(item.place, Cause::Value, "a value outside its limits or its data type");
            }
        }
        Some(Value::Real(number)) => {
            let outside = |limit, is_outside: fn(f64, f64) -> bool| match limit {
                Some(Value::Real(limit)) => is_outside(number, limit),
                Some(Value::Integer { .. }) | None => is_too_large(data_type, number),
            };
            if outside(low, |number, low| number < low) || outside(high, |number, high| number > high) {
                refusals.add(item.place, Cause::Value, "a value outside its limits or its data type");
            }
        }
    }
}
