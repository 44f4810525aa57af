//! From words back to facts, in any notation: nothing here asks the code that made the words.

use od_spec::ascii::transliterate;
use od_spec::model::{DataType, Entry, PdoMapping, Ratio, Storage, TypeKind, Value};

use super::facts::Step;

/// A value in any notation.
pub(crate) fn value(entry: &Entry, text: &str) -> Value {
    if let Some(offset) = text.strip_prefix("$NODEID") {
        let digits = offset.strip_prefix("+0x").unwrap_or("0");
        return Value::NodeId(u64::from_str_radix(digits, 16).unwrap());
    }
    if let Some((offset, "node-ID" | "Node-ID")) = text.split_once("h + ") {
        return Value::NodeId(u64::from_str_radix(offset, 16).unwrap());
    }
    match entry.data_type {
        DataType::VisibleString | DataType::UnicodeString if text == "\"\"" => Value::Text(String::new()),
        DataType::VisibleString | DataType::UnicodeString => Value::Text(text.to_owned()),
        DataType::OctetString => {
            let digits = text.replace(' ', "");
            let bytes =
                (0..digits.len()).step_by(2).map(|at| u8::from_str_radix(&digits[at..at + 2], 16).unwrap());
            Value::Bytes(bytes.collect())
        }
        DataType::Real32 | DataType::Real64 => {
            Value::Real(text.replace(',', ".").parse::<f64>().unwrap().into())
        }
        _ => Value::Integer(number(entry, text)),
    }
}

/// A raw value in any notation: `255`, `00FFh`, `0x00FF`, `50.0 °C (500)`, `-113 (8Fh): motor heating`, `0 (off)`, a name. Where
/// a text says it twice, both have to be the same.
pub(crate) fn number(entry: &Entry, text: &str) -> i128 {
    if let Some(raw) = plain(entry, text) {
        return raw;
    }
    if let Some(raw) = named(entry, text) {
        return raw;
    }
    if let [index, sub, bits] = text.split(' ').collect::<Vec<_>>()[..]
        && (index.len(), sub.len(), bits.len()) == (4, 2, 3)
    {
        return i128::from_str_radix(&text.replace([' ', 'h'], ""), 16).unwrap();
    }
    if let Some((shown, name)) = text.split_once(": ") {
        let raw = number(entry, shown);
        assert_eq!(named(entry, name), Some(raw), "{text}: the name is another value's");
        return raw;
    }
    if let Some((shown, inside)) = text.strip_suffix(')').and_then(|text| text.split_once(" (")) {
        let raw = number(entry, shown);
        let again = plain(entry, inside).or_else(|| named(entry, inside));
        assert_eq!(again, Some(raw), "{text}: what is in brackets is another value");
        return raw;
    }
    physical(entry, text)
}

/// Digits alone: decimal, or hexadecimal and as wide as the type.
fn plain(entry: &Entry, text: &str) -> Option<i128> {
    let digits = text.strip_prefix("0x").or_else(|| text.strip_suffix('h'));
    let Some(digits) = digits else { return text.parse().ok() };
    let raw = i128::from_str_radix(digits, 16).ok()?;
    let bits = entry.data_type.bits()?;
    Some(if entry.data_type.is_signed() && raw >> (bits - 1) == 1 { raw - (1 << bits) } else { raw })
}

/// The raw value of a name, of an enum's or special value.
fn named(entry: &Entry, name: &str) -> Option<i128> {
    let special = entry.special.iter().find(|special| transliterate(&special.name) == transliterate(name));
    let values = match entry.named_type.as_ref().map(|named| &named.kind) {
        Some(TypeKind::Enum(values)) => &**values,
        Some(TypeKind::Bits(_)) | None => &[],
    };
    let value = values.iter().find(|value| transliterate(&value.name) == transliterate(name));
    special.map(|special| special.value).or_else(|| value.map(|value| value.value))
}

/// Signs of plane angle, which follow the number directly in the manual.
const ANGLES: [&str; 3] = ["°", "′", "″"];

/// A physical value in the unit of the entry.
fn physical(entry: &Entry, text: &str) -> i128 {
    let unit = entry.unit.as_ref().unwrap_or_else(|| panic!("{text} of {}, which has no unit", entry.name));
    // The manual writes `87.00°`.
    let angle = ANGLES.iter().find_map(|sign| Some((text.strip_suffix(sign)?, *sign)));
    let parts = angle.filter(|(amount, _)| !amount.ends_with(' ')).or_else(|| text.rsplit_once(' '));
    let (amount, symbol) = parts.unwrap_or_else(|| panic!("{text} has no unit"));
    assert_eq!(transliterate(symbol), transliterate(&unit.symbol), "{text} of {}", entry.name);
    let steps = amount.split(" × ").map(ratio).reduce(|left, right| left.checked_mul(right).unwrap());
    steps.unwrap().checked_div(unit.scale).unwrap().to_whole().expect("a whole number of steps")
}

/// `0.5`, `0,5`, `1/3`.
fn ratio(text: &str) -> Ratio {
    if let Some((upper, lower)) = text.split_once('/') {
        return ratio(upper).checked_div(ratio(lower)).unwrap();
    }
    let text = text.replace(',', ".");
    let (whole, fraction) = text.split_once('.').unwrap_or((&text, ""));
    let digits: i128 = format!("{whole}{fraction}").parse().unwrap_or_else(|_| panic!("{text} is no number"));
    Ratio::new(digits, 10_i128.pow(u32::try_from(fraction.len()).unwrap())).unwrap()
}

/// One raw step: `0.1 °C`, or a symbol alone.
pub(crate) fn step(text: &str) -> Step {
    let is_number = |text: &str| text.starts_with(|first: char| first.is_ascii_digit());
    let angle = ANGLES.iter().find_map(|sign| Some((text.strip_suffix(sign)?, *sign)));
    let angle = angle.filter(|(amount, _)| !amount.ends_with(' '));
    match angle.or_else(|| text.split_once(' ')).filter(|(number, _)| is_number(number)) {
        Some((number, symbol)) => Step { scale: ratio(number), symbol: transliterate(symbol) },
        None => Step { scale: Ratio::ONE, symbol: transliterate(text) },
    }
}

/// The ends of a range.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Range {
    pub low: Option<i128>,
    pub high: Option<i128>,
}

/// A range: `a to b`, `a bis b`, `≥ a`, `at least a`, `≤ b`, `at most b`; `None` for anything else.
pub(crate) fn range(entry: &Entry, text: &str) -> Option<Range> {
    let end = |text: &str| Some(number(entry, text));
    if let Some((low, high)) = text.split_once(" to ").or_else(|| text.split_once(" bis ")) {
        return Some(Range { low: end(low), high: end(high) });
    }
    let low = text.strip_prefix("≥ ").or_else(|| text.strip_prefix("at least "));
    let high = text.strip_prefix("≤ ").or_else(|| text.strip_prefix("at most "));
    match (low, high) {
        (Some(low), _) => Some(Range { low: end(low), high: None }),
        (None, Some(high)) => Some(Range { low: None, high: end(high) }),
        (None, None) => None,
    }
}

/// A value with a name, as a list has it: `FFFFh: wire break`.
pub(crate) fn listed(entry: &Entry, line: &str) -> Option<Listed> {
    let (shown, name) = line.split_once(": ")?;
    let number = shown.split_once(" (").map_or(shown, |(number, _)| number);
    let raw = plain(entry, number)?;
    Some(Listed { raw, name: transliterate(name) })
}

/// One line of a list of values.
#[derive(Debug, Clone)]
pub(crate) struct Listed {
    pub raw: i128,
    /// In ASCII.
    pub name: String,
}

/// What keeps a value, in any words; `None` for what is no such word.
pub(crate) fn storage(words: &str) -> Option<Storage> {
    Some(match words {
        "" | "no" => Storage::No,
        "communication" | "Kommunikation" | "stored with the communication parameters" => {
            Storage::Communication
        }
        "application" | "Anwendung" | "stored with the application parameters" => Storage::Application,
        "manufacturer" | "Hersteller" | "stored with the manufacturer parameters" => Storage::Manufacturer,
        "by itself" | "von selbst" | "remanent" | "kept over power-off" => Storage::Remanent,
        _ => return None,
    })
}

/// The PDOs into which an entry may be mapped, in any words; `None` for what is no such word.
pub(crate) fn mapping(words: &str) -> Option<PdoMapping> {
    Some(match words {
        "N" | "none" => PdoMapping::None,
        "Y (R)" | "RPDO" | "receive" => PdoMapping::Receive,
        "Y (T)" | "TPDO" | "transmit" => PdoMapping::Transmit,
        "Y (RT)" | "RPDO and TPDO" | "both" => PdoMapping::Both,
        _ => return None,
    })
}
