//! Cells read back into what they say.

use od_spec::model::{
    Access, DataType, Entry, EntryId, Index, PdoMapping, Ratio, SubIndex, Text, Unit, Value,
};

use crate::markdown::Table;

/// Reads what a Default cell says back into the raw value; `None` for an empty cell.
pub(super) fn default(entry: &Entry, cell: &str) -> Option<Value> {
    if cell.is_empty() {
        return None;
    }
    if let Some(offset) = cell.strip_suffix("h + node-ID") {
        return Some(Value::NodeId(u64::from_str_radix(offset, 16).unwrap()));
    }
    Some(match entry.data_type {
        DataType::VisibleString | DataType::UnicodeString if cell == "\"\"" => Value::Text(String::new()),
        DataType::VisibleString | DataType::UnicodeString => Value::Text(cell.to_owned()),
        DataType::OctetString => {
            Value::Bytes(cell.split(' ').map(|byte| u8::from_str_radix(byte, 16).unwrap()).collect())
        }
        DataType::Real32 | DataType::Real64 => Value::Real(cell.parse::<f64>().unwrap().into()),
        _ => Value::Integer(number(entry, cell)),
    })
}

/// The raw value that a cell gives: after a physical value in brackets, before the name of an enum's or special value,
/// or alone.
fn number(entry: &Entry, cell: &str) -> i128 {
    // A mapping parameter in its parts: 6040 00 10h.
    if let [index, sub, bits] = cell.split(' ').collect::<Vec<_>>()[..]
        && (index.len(), sub.len(), bits.len()) == (4, 2, 3)
    {
        return i128::from_str_radix(&cell.replace([' ', 'h'], ""), 16).unwrap();
    }
    let first = cell.split([' ', ':']).next().unwrap();
    if let Some(raw) = pattern(entry, first) {
        return raw;
    }
    match &entry.unit {
        Some(unit) if !entry.special.iter().any(|special| special.value.to_string() == first) => {
            physical(unit, cell)
        }
        _ => first.parse().unwrap_or_else(|_| panic!("{cell} of {}", entry.name)),
    }
}

/// The raw value of hexadecimal digits, which are as many as the type has: `00FFh`.
pub(super) fn pattern(entry: &Entry, text: &str) -> Option<i128> {
    let digits = text.strip_suffix('h')?;
    let raw = i128::from_str_radix(digits, 16).ok()?;
    let bits = entry.data_type.bits().unwrap();
    assert_eq!(digits.len(), usize::from(bits.div_ceil(4)), "{text}: as many digits as the type has");
    Some(if entry.data_type.is_signed() && raw >= 1 << (bits - 1) { raw - (1 << bits) } else { raw })
}

/// The raw value of `50.0 °C (500)` or `3000 mAh`, with a look at both numbers.
fn physical(unit: &Unit, cell: &str) -> i128 {
    let (shown, raw) = match cell.rsplit_once(" (") {
        Some((shown, raw)) => (shown, Some(raw.strip_suffix(')').unwrap().parse::<i128>().unwrap())),
        None => (cell, None),
    };
    let value = shown.strip_suffix(&unit.symbol).unwrap_or_else(|| panic!("{cell} in {}", unit.symbol));
    let steps =
        decimal(value.trim()).checked_div(unit.scale).unwrap().to_whole().expect("a whole number of steps");
    assert_eq!(raw.is_none(), unit.scale == Ratio::ONE, "{cell}: the raw value where it is another number");
    assert!(raw.is_none_or(|raw| raw == steps), "{cell}: {steps}");
    steps
}

pub(super) fn decimal(text: &str) -> Ratio {
    if let Some((number, step)) = text.split_once(" × ") {
        return decimal(number).checked_mul(decimal(step)).unwrap();
    }
    if let Some((upper, lower)) = text.split_once('/') {
        return decimal(upper).checked_div(decimal(lower)).unwrap();
    }
    let (whole, fraction) = text.split_once('.').unwrap_or((text, ""));
    let digits: i128 = format!("{whole}{fraction}").parse().unwrap();
    Ratio::new(digits, 10i128.pow(u32::try_from(fraction.len()).unwrap())).unwrap()
}

/// The limits that a Range cell gives.
pub(super) fn range(entry: &Entry, cell: &str) -> (Option<i128>, Option<i128>) {
    let end = |text: &str| match &entry.unit {
        Some(unit) => physical(unit, text),
        None => pattern(entry, text).unwrap_or_else(|| text.parse().unwrap()),
    };
    if let Some((low, high)) = cell.split_once(" to ") {
        return (Some(end(low)), Some(end(high)));
    }
    (cell.strip_prefix("≥ ").map(end), cell.strip_prefix("≤ ").map(end))
}

pub(super) fn access(cell: &str) -> (Access, bool) {
    match cell {
        "r(w)" => (Access::Rw, true),
        "(w)" => (Access::Wo, true),
        word => (Access::from_word(word).unwrap_or_else(|| panic!("access {word}")), false),
    }
}

pub(super) fn mapping(cell: &str) -> PdoMapping {
    match cell {
        "N" => PdoMapping::None,
        "Y (R)" => PdoMapping::Receive,
        "Y (T)" => PdoMapping::Transmit,
        "Y (RT)" => PdoMapping::Both,
        other => panic!("mapping {other}"),
    }
}

/// A text on one line, with arrows, as a table has it.
pub(super) fn flat(text: &str) -> String {
    text.replace('\n', " ").replace("->", "→")
}

/// A text as the English document shows it.
pub(super) fn reported(text: &Text) -> String {
    flat(text.get("en").unwrap_or_default())
}

pub(super) fn index(cell: &str) -> Index {
    Index(u16::from_str_radix(cell.strip_suffix('h').unwrap(), 16).unwrap())
}

/// `3020h.5`
pub(super) fn entry_id(cell: &str) -> EntryId {
    let (object, sub) = cell.split_once('.').unwrap_or((cell, "0"));
    EntryId { index: index(object), sub: SubIndex(sub.parse().unwrap()) }
}

/// A cell; nothing where no row has anything in its column.
pub(super) fn cell_if_there<'t>(table: &'t Table, row: &'t [String], column: &str) -> &'t str {
    table.columns.iter().position(|title| title == column).map_or("", |at| &row[at])
}
