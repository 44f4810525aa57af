//! What JavaScript makes of texts: numbers, and the INI files of the package `ini`.

use std::collections::BTreeMap;

use super::refusal::{Place, rows};

/// A value of an INI file.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value {
    Text(String),
    /// `true` or `false`, which the package takes for Booleans; a key without `=` is true.
    Boolean(bool),
    /// `null`.
    Null,
}

/// The keys of a section with their last value.
pub(super) type Keys = BTreeMap<String, (Value, Place)>;

/// Sections by name, and where their first header is.
pub(super) fn sections(text: &str) -> BTreeMap<String, (Place, Keys)> {
    let mut sections: BTreeMap<String, (Place, Keys)> = BTreeMap::new();
    let mut current: Option<String> = None;
    for row in rows(text) {
        if row.text.is_empty() || row.text.trim_start().starts_with([';', '#']) {
            continue;
        }
        // A header is a whole line; with a space after it, it is a key.
        if let Some(name) = row.text.strip_prefix('[').and_then(|text| text.strip_suffix(']'))
            && !name.contains(']')
        {
            let name = plain(name);
            sections.entry(name.clone()).or_insert_with(|| (row.place(), Keys::new()));
            current = Some(name);
            continue;
        }
        let (key, value) = match row.text.split_once('=') {
            Some(("", _)) => continue,
            Some((key, value)) => (key, value_of(value)),
            None => (row.text, Value::Boolean(true)),
        };
        if let Some((_, keys)) = current.as_ref().and_then(|section| sections.get_mut(section)) {
            keys.insert(plain(key), (value, row.place()));
        }
    }
    sections
}

fn value_of(text: &str) -> Value {
    let text = plain(text);
    match text.as_str() {
        "true" => Value::Boolean(true),
        "false" => Value::Boolean(false),
        "null" => Value::Null,
        _ => Value::Text(text),
    }
}

/// A text without quotation marks, or up to the first `;` or `#` that no backslash precedes.
fn plain(text: &str) -> String {
    let text = text.trim();
    for mark in ['"', '\''] {
        if let Some(inner) = text.strip_prefix(mark).and_then(|text| text.strip_suffix(mark)) {
            return inner.to_owned();
        }
    }
    let (mut out, mut escaped) = (String::new(), false);
    for c in text.chars() {
        match (escaped, c) {
            (true, '\\' | ';' | '#') => out.push(c),
            (true, _) => {
                out.push('\\');
                out.push(c);
            }
            (false, ';' | '#') => break,
            (false, '\\') => {
                escaped = true;
                continue;
            }
            (false, _) => out.push(c),
        }
        escaped = false;
    }
    if escaped {
        out.push('\\');
    }
    out.trim().to_owned()
}

/// `parseInt(text)`: what can be read in front; `None` for no number.
pub(super) fn parse_int(text: &str) -> Option<i128> {
    let text = text.trim_start();
    let (negative, text) = match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    };
    let (base, digits) = match text.get(..2) {
        Some("0x" | "0X") => (16, &text[2..]),
        _ => (10, text),
    };
    let mut number: Option<i128> = None;
    for digit in digits.chars().map_while(|c| c.to_digit(base)) {
        let before = number.unwrap_or(0).saturating_mul(i128::from(base));
        number = Some(before.saturating_add(i128::from(digit)));
    }
    number.map(|number| if negative { -number } else { number })
}

/// `Number(text)`, or `None` for what is not a number.
pub(super) fn number(text: &str) -> Option<f64> {
    let text = text.trim();
    if let Some(digits) = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X")) {
        // Precision is lost as there.
        #[expect(clippy::cast_precision_loss)]
        return u128::from_str_radix(digits, 16).ok().map(|number| number as f64);
    }
    if text.is_empty() {
        return Some(0.0);
    }
    let is_decimal = text.bytes().all(|byte| matches!(byte, b'0'..=b'9' | b'+' | b'-' | b'.' | b'e' | b'E'));
    is_decimal.then(|| text.parse().ok())?
}

/// `BigInt(text)`, or `None` where it throws; what is larger than any number of an EDS is the largest.
pub(super) fn big_int(text: &str) -> Option<i128> {
    let text = text.trim();
    if text.is_empty() {
        return Some(0);
    }
    if let Some(digits) = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X")) {
        let is_hexadecimal = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_hexdigit());
        return is_hexadecimal.then(|| i128::from_str_radix(digits, 16).unwrap_or(i128::MAX));
    }
    text.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_as_javascript_does() {
        assert_eq!(parse_int(" -0x10 bits"), Some(-16));
        assert_eq!(parse_int("010"), Some(10));
        assert_eq!(parse_int("$NODEID+1"), None);
        assert_eq!(number("-0x10"), None);
        assert_eq!(number("010"), Some(10.0));
        assert_eq!(number(""), Some(0.0));
        assert_eq!(number("1e3"), Some(1000.0));
        assert_eq!(big_int("0x1FLL"), None);
        assert_eq!(big_int("-5"), Some(-5));
        assert_eq!(big_int("1.0"), None);
    }

    #[test]
    fn a_value_ends_at_a_remark() {
        let text = "[a]\nb=1 ; c\nd=x\\;y\n[e] \nf=\"g\"\nh\n";
        let sections = sections(text);
        let (_, keys) = &sections["a"];
        let value = |key: &str| keys.get(key).map(|(value, _)| value.clone());
        assert_eq!(value("b"), Some(Value::Text("1".to_owned())));
        assert_eq!(value("d"), Some(Value::Text("x;y".to_owned())));
        assert_eq!(value("[e]"), Some(Value::Boolean(true)));
        assert_eq!(value("f"), Some(Value::Text("g".to_owned())));
        assert_eq!(value("h"), Some(Value::Boolean(true)));
    }
}
