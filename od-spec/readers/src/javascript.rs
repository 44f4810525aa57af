//! What JavaScript makes of texts: numbers, and the INI files of the package `ini`.

use std::borrow::Cow;
use std::collections::BTreeMap;

use super::lines::{Line, Signs};
use super::refusal::Place;

/// A value of an INI file.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value<'t> {
    Text(Cow<'t, str>),
    /// `true` or `false`, which the package takes for Booleans; a key without `=` is true.
    Boolean(bool),
    /// `null`.
    Null,
}

/// A section: where its first header is, and its keys of which one asks, each as often as it is spelled in another way.
#[derive(Debug)]
pub(super) struct Section<'t> {
    pub header: Place,
    keys: Vec<Key<'t>>,
}

/// A key with its last value.
#[derive(Debug)]
struct Key<'t> {
    /// How it is spelled by the standard.
    known: &'static str,
    spelled: Cow<'t, str>,
    value: Value<'t>,
    place: Place,
}

impl<'t> Section<'t> {
    /// The value of a key that has the case of the standard, with its place.
    pub(super) fn get(&self, key: &str) -> Option<(&Value<'t>, Place)> {
        let found = self.keys.iter().find(|one| one.known == key && one.spelled == key)?;
        Some((&found.value, found.place))
    }

    /// Where a key is, also in another case, or the section.
    pub(super) fn place(&self, key: &str) -> Place {
        let alike = || self.keys.iter().filter(|one| one.known == key).min_by_key(|one| &one.spelled);
        self.get(key).map(|(_, place)| place).or_else(|| alike().map(|one| one.place)).unwrap_or(self.header)
    }

    fn set(&mut self, new: Key<'t>) {
        match self.keys.iter_mut().find(|one| one.known == new.known && one.spelled == new.spelled) {
            Some(key) => *key = new,
            None => self.keys.push(new),
        }
    }
}

/// Sections by name, of those of which one asks. `keys` are the keys of which one asks.
pub(super) fn sections<'t>(
    lines: &[Line<'t>],
    is_wanted: impl Fn(&str) -> bool,
    keys: &[&'static str],
) -> BTreeMap<Cow<'t, str>, Section<'t>> {
    let mut sections: BTreeMap<Cow<'t, str>, Section<'t>> = BTreeMap::new();
    let mut current: Option<&mut Section<'t>> = None;
    for line in lines {
        if line.text.is_empty() || line.text.trim_start().starts_with([';', '#']) {
            continue;
        }
        // A header is a whole line; with a space after it, it is a key.
        if let Some(name) = line.text.strip_prefix('[').and_then(|text| text.strip_suffix(']'))
            && !name.contains(']')
        {
            let name = plain(name, line);
            let section = || Section { header: line.place(), keys: Vec::with_capacity(keys.len()) };
            current =
                if is_wanted(&name) { Some(sections.entry(name).or_insert_with(section)) } else { None };
            continue;
        }
        let Some(section) = &mut current else { continue };
        let (key, value) = match line.pair() {
            Some(("", _)) => continue,
            Some((key, value)) => (plain(key, line), Some(value)),
            None => (plain(line.text, line), None),
        };
        if let Some(known) = keys.iter().copied().find(|known| known.eq_ignore_ascii_case(&key)) {
            let value = value.map_or(Value::Boolean(true), |value| value_of(value, line));
            section.set(Key { known, spelled: key, value, place: line.place() });
        }
    }
    sections
}

fn value_of<'t>(text: &'t str, line: &Line<'t>) -> Value<'t> {
    let text = plain(text, line);
    match &*text {
        "true" => Value::Boolean(true),
        "false" => Value::Boolean(false),
        "null" => Value::Null,
        _ => Value::Text(text),
    }
}

/// A text of a line without quotation marks, or up to the first `;` or `#` that no backslash precedes.
fn plain<'t>(text: &'t str, line: &Line<'t>) -> Cow<'t, str> {
    let text = text.trim();
    if !line.has(Signs::QUOTE) && !line.has(Signs::REMARK) {
        return Cow::Borrowed(text);
    }
    for mark in ['"', '\''] {
        if let Some(inner) = text.strip_prefix(mark).and_then(|text| text.strip_suffix(mark)) {
            return Cow::Borrowed(inner);
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
    Cow::Owned(out.trim().to_owned())
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
    use crate::lines::lines;

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
        let text = "[a]\nb=1 ; c\nd=x\\;y\n[e] \nf=\"g\"\nh\nB=2\nb=3\n[c]\nb=4\n";
        let sections = sections(&lines(text), |name| name == "a", &["b", "d", "[e]", "f", "h"]);
        assert_eq!(sections.keys().collect::<Vec<_>>(), ["a"]);
        let section = &sections["a"];
        let value = |key: &str| section.get(key).map(|(value, _)| value.clone());
        let text_of = |text: &'static str| Some(Value::Text(Cow::Borrowed(text)));
        assert_eq!(value("b"), text_of("3"));
        assert_eq!(value("d"), text_of("x;y"));
        assert_eq!(value("[e]"), Some(Value::Boolean(true)));
        assert_eq!(value("f"), text_of("g"));
        assert_eq!(value("h"), Some(Value::Boolean(true)));
        assert_eq!(value("B"), None);
    }
}
