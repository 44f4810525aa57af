//! What Python's standard library makes of a text: numbers, and the INI files of its module `configparser`.

use std::borrow::Cow;
use std::collections::BTreeMap;

use super::lines::{Line, Signs};
use super::refusal::{Cause, Place, Refusals};

/// `int(text, base)`; what is larger than any number of an EDS is the largest. Base 0 lets the text say its base, as literals
/// of Python do, in which `010` is not a number.
pub(super) fn int(text: &str, base: u32) -> Option<i128> {
    let text = text.trim();
    let (negative, digits) = match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    };
    let marked = match digits.as_bytes() {
        [b'0', b'x' | b'X', ..] => Some(16),
        [b'0', b'o' | b'O', ..] => Some(8),
        [b'0', b'b' | b'B', ..] => Some(2),
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
    let (mut number, mut before): (i128, u8) = (0, b'_');
    for byte in digits.bytes() {
        if byte != b'_' {
            let digit = char::from(byte).to_digit(base)?;
            number = number.saturating_mul(i128::from(base)).saturating_add(i128::from(digit));
        } else if before == b'_' {
            return None;
        }
        before = byte;
    }
    if before == b'_' {
        return None;
    }
    Some(if negative { -number } else { number })
}

/// How names of sections and keys are compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Capitals {
    Matter,
    AreAlike,
}

impl Capitals {
    fn folded(self, name: &str) -> Cow<'_, str> {
        match self {
            Capitals::Matter => Cow::Borrowed(name),
            Capitals::AreAlike => Cow::Owned(name.to_lowercase()),
        }
    }

    fn are_equal(self, one: &str, other: &str) -> bool {
        match self {
            Capitals::Matter => one == other,
            Capitals::AreAlike => {
                one.eq_ignore_ascii_case(other)
                    || !(one.is_ascii() && other.is_ascii()) && one.to_lowercase() == other.to_lowercase()
            }
        }
    }
}

/// What begins a remark after a space.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Remarks {
    /// `;`
    Semicolon,
    /// `;` and `#`.
    Both,
}

impl Remarks {
    const fn begin_with(self, sign: char) -> bool {
        matches!((self, sign), (_, ';') | (Remarks::Both, '#'))
    }
}

/// An INI file as `configparser` reads it.
#[derive(Debug)]
pub(super) struct Ini<'t> {
    capitals: Capitals,
    pub sections: Vec<Section<'t>>,
    /// Lines below `[DEFAULT]`, which hold for every section.
    pub defaults: Vec<Place>,
    /// Whether names of sections or keys are there that differ in case only.
    has_variants: bool,
    /// Whether a value has a `#` after a space.
    has_hashes: bool,
    /// What is refused while the text is divided into lines, keys and values.
    refused: Vec<(Place, &'static str)>,
    /// Sections of objects and sub-indices that have their plain names, where it was read without regard to case.
    by_number: Option<BTreeMap<Number, usize>>,
    /// The others.
    by_name: BTreeMap<Cow<'t, str>, usize>,
}

#[derive(Debug)]
pub(super) struct Section<'t> {
    pub name: &'t str,
    pub header: Place,
    /// Whose section it is, if it has the plain name of such a section.
    pub number: Option<Number>,
    capitals: Capitals,
    /// Whether a key may have characters that are not ASCII.
    has_foreign: bool,
    pub items: Vec<Item<'t>>,
    /// Of a section with many keys.
    by_key: BTreeMap<Cow<'t, str>, usize>,
}

/// An index, and the sub-index if it is not about the object.
pub(super) type Number = (u16, Option<u8>);

#[derive(Debug)]
pub(super) struct Item<'t> {
    pub key: &'t str,
    pub value: Cow<'t, str>,
    pub place: Place,
}

/// Keys of a section among which one is looked for one by one.
const FEW: usize = 16;

/// The number of a section `[2000]` or `[2000sub1F]`, in upper or lower case.
fn number(name: &str) -> Option<Number> {
    let (digits, rest) = name.as_bytes().split_at_checked(4)?;
    let digit = |byte: &u8| char::from(*byte).to_digit(16);
    let mut index = 0;
    for byte in digits {
        index = index << 4 | digit(byte)?;
    }
    let sub = match rest {
        [] => None,
        [b's' | b'S', b'u' | b'U', b'b' | b'B', low] => Some(digit(low)?),
        [b's' | b'S', b'u' | b'U', b'b' | b'B', high, low] if *high != b'0' => {
            Some(digit(high)? << 4 | digit(low)?)
        }
        _ => return None,
    };
    Some((u16::try_from(index).ok()?, sub.and_then(|sub| u8::try_from(sub).ok())))
}

impl<'t> Ini<'t> {
    /// Reads a text.
    pub(super) fn read(lines: &[Line<'t>], remarks: Remarks, capitals: Capitals) -> Self {
        let mut ini = Self {
            capitals,
            sections: Vec::new(),
            defaults: Vec::new(),
            has_variants: false,
            has_hashes: false,
            refused: Vec::new(),
            by_number: (capitals == Capitals::AreAlike).then(BTreeMap::new),
            by_name: BTreeMap::new(),
        };
        let mut at = At { section: Where::Before, item: None, indent: 0 };
        for line in lines {
            let begun = line.text.trim_start();
            if begun.starts_with(['#', ';']) {
                continue;
            }
            let mut text = begun.trim_end();
            if line.has(Signs::REMARK) {
                ini.has_hashes |= remark_in(line.text, |sign| sign == '#').is_some();
                if let Some(remark) = remark_in(line.text, |sign| remarks.begin_with(sign)) {
                    text = line.text[..remark].trim();
                }
            }
            if !text.is_empty() {
                ini.line(text, line.text.len() - begun.len(), line, &mut at);
            }
        }
        ini
    }

    fn line(&mut self, text: &'t str, indent: usize, line: &Line<'t>, at: &mut At) {
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
            at.section = self.open(name, line.place());
            at.item = None;
            return;
        }
        let section = match at.section {
            Where::Before => {
                self.refused.push((line.place(), "something before the first section"));
                return;
            }
            Where::InDefaults => {
                self.defaults.push(line.place());
                return;
            }
            Where::In(section) => section,
        };
        let divided = match line.pair() {
            // The text may end before the sign.
            Some((key, _)) if !line.has(Signs::COLON) && key.len() < indent + text.len() => {
                Some((key[indent..].trim_end(), text[key.len() - indent + 1..].trim_start()))
            }
            _ => text.split_once(['=', ':']).map(|(key, value)| (key.trim_end(), value.trim_start())),
        };
        match divided {
            None => self.refused.push((line.place(), "a line without `=`")),
            Some(("", _)) => self.refused.push((line.place(), "a value without a key")),
            Some((key, value)) => {
                let item = Item { key, value: Cow::Borrowed(value), place: line.place() };
                at.item = Some(self.set(section, item, line.has(Signs::FOREIGN)));
            }
        }
    }

    fn open(&mut self, name: &'t str, header: Place) -> Where {
        if name == "DEFAULT" {
            return Where::InDefaults;
        }
        if let Some(known) = self.place_of(name) {
            if self.sections[known].name == name {
                self.refused.push((header, "a section that is written twice"));
            } else {
                self.has_variants = true;
            }
            return Where::In(known);
        }
        let (at, capitals, number) = (self.sections.len(), self.capitals, number(name));
        match (&mut self.by_number, number) {
            (Some(by_number), Some(number)) => by_number.insert(number, at),
            _ => self.by_name.insert(capitals.folded(name), at),
        };
        let (items, by_key) = (Vec::with_capacity(FEW), BTreeMap::new());
        self.sections.push(Section { name, header, number, capitals, has_foreign: false, items, by_key });
        Where::In(at)
    }

    fn set(&mut self, section: usize, item: Item<'t>, is_foreign: bool) -> usize {
        let section = &mut self.sections[section];
        section.has_foreign |= is_foreign;
        if let Some(at) = section.place_of(item.key) {
            if section.items[at].key == item.key {
                self.refused.push((item.place, "a key that is written twice"));
            } else {
                self.has_variants = true;
            }
            section.items[at] = item;
            return at;
        }
        let at = section.items.len();
        section.items.push(item);
        if at == FEW {
            section.note_keys();
        } else if at > FEW {
            section.by_key.insert(section.capitals.folded(section.items[at].key), at);
        }
        at
    }

    fn place_of(&self, name: &str) -> Option<usize> {
        match (&self.by_number, number(name)) {
            (Some(by_number), Some(number)) => {
                let is_equal = |at: &&usize| self.capitals.are_equal(self.sections[**at].name, name);
                by_number.get(&number).filter(is_equal).copied()
            }
            _ => self.by_name.get(&self.capitals.folded(name)).copied(),
        }
    }

    /// As a reader sees it for which case matters. Of a text in which no names differ in case only.
    pub(super) fn with_capitals(mut self) -> Self {
        self.capitals = Capitals::Matter;
        let named = std::mem::take(&mut self.by_name).into_values();
        self.by_name = named.map(|at| (Cow::Borrowed(self.sections[at].name), at)).collect();
        for section in &mut self.sections {
            section.capitals = Capitals::Matter;
            if !section.by_key.is_empty() {
                section.note_keys();
            }
        }
        self
    }

    /// Whether there are names of sections or keys that differ in case only.
    pub(super) const fn has_variants(&self) -> bool {
        self.has_variants
    }

    /// Whether a `#` begins a remark for who takes it for that.
    pub(super) const fn has_hashes(&self) -> bool {
        self.has_hashes
    }

    /// Adds what is refused while the text is divided into lines, keys and values.
    pub(super) fn refuse(&self, refusals: &mut Refusals) {
        for &(place, what) in &self.refused {
            refusals.add(place, Cause::Text, what);
        }
    }

    pub(super) fn section(&self, name: &str) -> Option<&Section<'t>> {
        self.place_of(name).map(|at| &self.sections[at])
    }

    /// The header of a section, or the beginning of the file.
    pub(super) fn place(&self, name: &str) -> Place {
        self.section(name).or(self.sections.first()).map_or(Place::default(), |section| section.header)
    }

    /// The section of an object.
    pub(super) fn object(&self, index: u16) -> Option<&Section<'t>> {
        self.numbered((index, None))
    }

    /// The section of a sub-index.
    pub(super) fn sub(&self, index: u16, sub: u8) -> Option<&Section<'t>> {
        self.numbered((index, Some(sub)))
    }

    fn numbered(&self, number: Number) -> Option<&Section<'t>> {
        self.by_number.as_ref()?.get(&number).map(|at| &self.sections[*at])
    }

    /// The sections of the sub-indices of an object up to FEh, in their order.
    pub(super) fn subs(&self, index: u16) -> impl Iterator<Item = (u8, &Section<'t>)> {
        let all = (index, Some(0))..=(index, Some(0xFE));
        let known = self.by_number.iter().flat_map(move |by_number| by_number.range(all.clone()));
        known.filter_map(|((_, sub), at)| Some(((*sub)?, &self.sections[*at])))
    }
}

impl<'t> Section<'t> {
    pub(super) fn item(&self, key: &str) -> Option<&Item<'t>> {
        self.place_of(key).map(|at| &self.items[at])
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

    fn place_of(&self, key: &str) -> Option<usize> {
        if !self.by_key.is_empty() {
            return self.by_key.get(&self.capitals.folded(key)).copied();
        }
        let mut keys = self.items.iter().map(|item| item.key);
        match self.capitals {
            Capitals::AreAlike if !self.has_foreign => keys.position(|one| one.eq_ignore_ascii_case(key)),
            capitals => keys.position(|one| capitals.are_equal(one, key)),
        }
    }

    fn note_keys(&mut self) {
        let keys = self.items.iter().enumerate();
        self.by_key = keys.map(|(at, item)| (self.capitals.folded(item.key), at)).collect();
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
fn remark_in(line: &str, is_sign: impl Fn(char) -> bool) -> Option<usize> {
    let mut before = ' ';
    line.char_indices().find_map(|(at, c)| {
        let begins = is_sign(c) && before.is_whitespace();
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
