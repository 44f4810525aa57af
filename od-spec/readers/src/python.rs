//! What Python's standard library makes of a text: numbers, and the INI files of its module `configparser`.

use std::borrow::Cow;
use std::collections::BTreeMap;

use super::refusal::{Cause, Place, Refusals, rows};

/// `int(text, base)`; what is larger than any number of an EDS is the largest. Base 0 lets the text say its base, as literals
/// of Python do, in which `010` is not a number.
pub(super) fn int(text: &str, base: u32) -> Option<i128> {
    let text = text.trim();
    let (negative, digits) = match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    };
    let prefix = digits.get(..2).unwrap_or_default().to_ascii_lowercase();
    let marked = match prefix.as_str() {
        "0x" => Some(16),
        "0o" => Some(8),
        "0b" => Some(2),
        _ => None,
    };
    let (base, digits) = match (base, marked) {
        (0, None) if digits.starts_with('0') && digits.bytes().any(|byte| !matches!(byte, b'0' | b'_')) => {
            return None;
        }
        (0, None) => (10, digits),
        (0, Some(marked)) => (marked, &digits[2..]),
        (base, Some(marked)) if base == marked => (base, &digits[2..]),
        (base, _) => (base, digits),
    };
    // An underscore may be between digits, and after a prefix.
    let digits = if marked.is_some() { digits.strip_prefix('_').unwrap_or(digits) } else { digits };
    if digits.is_empty() || digits.starts_with('_') || digits.ends_with('_') || digits.contains("__") {
        return None;
    }
    let mut number: i128 = 0;
    for digit in digits.chars().filter(|c| *c != '_') {
        let digit = digit.to_digit(base)?;
        number = number.saturating_mul(i128::from(base)).saturating_add(i128::from(digit));
    }
    Some(if negative { -number } else { number })
}

/// How names of sections and keys are compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Capitals {
    Matter,
    AreAlike,
}

/// An INI file as `configparser` reads it.
#[derive(Debug)]
pub(super) struct Ini<'t> {
    capitals: Capitals,
    pub sections: Vec<Section<'t>>,
    /// Lines below `[DEFAULT]`, which hold for every section.
    pub defaults: Vec<Place>,
    by_name: BTreeMap<Cow<'t, str>, usize>,
}

#[derive(Debug)]
pub(super) struct Section<'t> {
    pub name: &'t str,
    pub header: Place,
    capitals: Capitals,
    pub items: Vec<Item<'t>>,
    by_key: BTreeMap<Cow<'t, str>, usize>,
}

#[derive(Debug)]
pub(super) struct Item<'t> {
    pub key: &'t str,
    pub value: Cow<'t, str>,
    pub place: Place,
}

fn folded(name: &str, capitals: Capitals) -> Cow<'_, str> {
    match capitals {
        Capitals::Matter => Cow::Borrowed(name),
        Capitals::AreAlike => Cow::Owned(name.to_lowercase()),
    }
}

impl<'t> Ini<'t> {
    /// Reads a text. `remarks` are the signs that begin a comment after a space.
    pub(super) fn read(text: &'t str, remarks: &[char], capitals: Capitals, refusals: &mut Refusals) -> Self {
        let mut ini = Self { capitals, sections: Vec::new(), defaults: Vec::new(), by_name: BTreeMap::new() };
        let mut at = At { section: Where::Before, item: None, indent: 0 };
        for row in rows(text) {
            let is_comment = row.text.trim().starts_with(['#', ';']);
            let remark = remark_in(row.text, remarks);
            let text = row.text[..remark.unwrap_or(row.text.len())].trim();
            if text.is_empty() || is_comment {
                continue;
            }
            ini.line(text, row.text.len() - row.text.trim_start().len(), row.place(), &mut at, refusals);
        }
        ini
    }

    fn line(&mut self, text: &'t str, indent: usize, place: Place, at: &mut At, refusals: &mut Refusals) {
        if let (Where::In(section), Some(item)) = (at.section, at.item)
            && indent > at.indent
        {
            let value = self.sections[section].items[item].value.to_mut();
            value.push('\n');
            value.push_str(text);
            return;
        }
        at.indent = indent;
        if let Some(name) = text
            .strip_prefix('[')
            .and_then(|rest| Some(&rest[..rest.rfind(']')?]))
            .filter(|name| !name.is_empty())
        {
            at.section = self.open(name, place, refusals);
            at.item = None;
            return;
        }
        let section = match at.section {
            Where::Before => {
                refusals.add(place, Cause::Text, "something before the first section");
                return;
            }
            Where::InDefaults => {
                self.defaults.push(place);
                return;
            }
            Where::In(section) => &mut self.sections[section],
        };
        let Some((key, value)) = text.split_once(['=', ':']) else {
            refusals.add(place, Cause::Text, "a line without `=`");
            return;
        };
        let key = key.trim_end();
        if key.is_empty() {
            refusals.add(place, Cause::Text, "a value without a key");
            return;
        }
        at.item = Some(section.set(key, Cow::Borrowed(value.trim()), place, refusals));
    }

    fn open(&mut self, name: &'t str, header: Place, refusals: &mut Refusals) -> Where {
        if name == "DEFAULT" {
            return Where::InDefaults;
        }
        if let Some(known) = self.by_name.get(&folded(name, self.capitals)) {
            if self.sections[*known].name == name {
                refusals.add(header, Cause::Text, "a section that is written twice");
            }
            return Where::In(*known);
        }
        let at = self.sections.len();
        self.by_name.insert(folded(name, self.capitals), at);
        let capitals = self.capitals;
        self.sections.push(Section { name, header, capitals, items: Vec::new(), by_key: BTreeMap::new() });
        Where::In(at)
    }

    pub(super) fn section(&self, name: &str) -> Option<&Section<'t>> {
        self.by_name.get(&folded(name, self.capitals)).map(|at| &self.sections[*at])
    }

    /// The header of a section, or the beginning of the file.
    pub(super) fn place(&self, name: &str) -> Place {
        self.section(name).or(self.sections.first()).map_or(Place::default(), |section| section.header)
    }
}

impl<'t> Section<'t> {
    pub(super) fn item(&self, key: &str) -> Option<&Item<'t>> {
        self.by_key.get(&folded(key, self.capitals)).map(|at| &self.items[*at])
    }

    /// The value of a key, also an empty one.
    pub(super) fn value(&self, key: &str) -> Option<&str> {
        self.item(key).map(|item| item.value.as_ref())
    }

    /// The key, if its value is not empty.
    pub(super) fn filled(&self, key: &str) -> Option<&Item<'t>> {
        self.item(key).filter(|item| !item.value.is_empty())
    }

    /// Where a key is, or the section.
    pub(super) fn place(&self, key: &str) -> Place {
        self.item(key).map_or(self.header, |item| item.place)
    }

    /// Where a key is in another case, or the section.
    pub(super) fn place_in_any_capitals(&self, key: &str) -> Place {
        let found = self.items.iter().find(|item| item.key.eq_ignore_ascii_case(key));
        found.map_or(self.header, |item| item.place)
    }

    fn set(&mut self, key: &'t str, value: Cow<'t, str>, place: Place, refusals: &mut Refusals) -> usize {
        let item = Item { key, value, place };
        if let Some(at) = self.by_key.get(&folded(key, self.capitals)) {
            if self.items[*at].key == key {
                refusals.add(place, Cause::Text, "a key that is written twice");
            }
            self.items[*at] = item;
            return *at;
        }
        let at = self.items.len();
        self.by_key.insert(folded(key, self.capitals), at);
        self.items.push(item);
        at
    }
}

/// Where the reader of an INI file is.
struct At {
    section: Where,
    item: Option<usize>,
    indent: usize,
}

#[derive(Clone, Copy)]
enum Where {
    Before,
    In(usize),
    /// `[DEFAULT]` is not a section, but what all sections share.
    InDefaults,
}

/// Where a remark begins: a sign at the beginning of the line or after a space.
fn remark_in(line: &str, signs: &[char]) -> Option<usize> {
    let mut before = ' ';
    line.char_indices().find_map(|(at, c)| {
        let begins = signs.contains(&c) && before.is_whitespace();
        before = c;
        begins.then_some(at)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_as_literals_of_python() {
        for (text, base, number) in [
            ("0x1F", 0, Some(31)),
            (" -0x10 ", 0, Some(-16)),
            ("010", 0, None),
            ("000", 0, Some(0)),
            ("010", 10, Some(10)),
            ("0x10", 10, None),
            ("0X10", 16, Some(16)),
            ("ff", 16, Some(255)),
            ("1_000", 0, Some(1000)),
            ("1__0", 0, None),
            ("0b11", 0, Some(3)),
            ("2", 2, None),
            ("", 0, None),
            ("12 3", 0, None),
            ("0x1FUL", 0, None),
        ] {
            assert_eq!(int(text, base), number, "{text:?} in base {base}");
        }
    }
}
