//! Changes of what is in a line: keys, values, numbers, and the places that headers name.

use std::ops::Range;

use super::mutate::{LARGEST, Page};
use super::random::Random;

/// A line in its parts: key, value, line break.
struct Parts<'l> {
    key: &'l str,
    value: &'l str,
    end: &'l str,
}

impl Page<'_> {
    fn parts(&self, at: usize) -> Option<Parts<'_>> {
        let line = self.lines.get(at)?;
        let text = line.trim_end_matches(['\r', '\n']);
        let (key, value) = text.split_once(self.notation.sign)?;
        Some(Parts { key, value, end: line.get(text.len()..)? })
    }

    /// The number of a line with a key.
    fn keyed(&self, random: &mut Random) -> Option<usize> {
        (0..20).map(|_| random.below(self.lines.len())).find(|at| self.parts(*at).is_some())
    }

    /// Gives a line another key or value.
    fn rewrite(&mut self, at: usize, new: impl Fn(&Parts<'_>) -> (String, String)) {
        let Some(parts) = self.parts(at) else { return };
        let (key, value) = new(&parts);
        let line = format!("{key}{}{value}{}", self.notation.sign, parts.end);
        if let Some(old) = self.lines.get_mut(at) {
            *old = line;
        }
    }
}

pub(super) fn replace(page: &mut Page<'_>, _: &Page<'_>, random: &mut Random) {
    for _ in 0..random.small(4) {
        let Some(at) = page.keyed(random) else { return };
        let value = random.pick(page.notation.values).copied().unwrap_or_default();
        page.rewrite(at, |parts| (parts.key.to_owned(), value.to_owned()));
    }
}

/// A word becomes one of another line, or a value.
pub(super) fn replace_word(page: &mut Page<'_>, other: &Page<'_>, random: &mut Random) {
    for _ in 0..random.small(4) {
        let at = random.below(page.lines.len());
        let Some(place) = page.lines.get(at).and_then(|line| random.pick(&words(line)).cloned()) else {
            continue;
        };
        let source = if random.chance(50) { other } else { &*page };
        let found = source.lines.get(random.below(source.lines.len())).and_then(|line| {
            let place = random.pick(&words(line)).cloned()?;
            line.get(place).map(str::to_owned)
        });
        let value = random.pick(page.notation.values).map(ToString::to_string);
        let new = if random.chance(70) { found.or(value) } else { value };
        if let Some((line, new)) = page.lines.get_mut(at).zip(new) {
            line.replace_range(place, &new);
        }
    }
}

/// Where the words of a line are.
fn words(line: &str) -> Vec<Range<usize>> {
    let is_part =
        |character: char| character.is_alphanumeric() || matches!(character, '_' | '-' | '.' | '$' | '%');
    let mut found = Vec::new();
    let mut begun = None;
    for (at, character) in line.char_indices().chain([(line.len(), '\n')]) {
        match begun {
            None if is_part(character) => begun = Some(at),
            Some(start) if !is_part(character) => {
                found.push(start..at);
                begun = None;
            }
            None | Some(_) => (),
        }
    }
    found
}

/// The values of two keys change places.
pub(super) fn swap(page: &mut Page<'_>, _: &Page<'_>, random: &mut Random) {
    let (Some(one), Some(other)) = (page.keyed(random), page.keyed(random)) else { return };
    let value = |page: &Page<'_>, at| page.parts(at).map_or_else(String::new, |parts| parts.value.to_owned());
    let (first, second) = (value(page, one), value(page, other));
    page.rewrite(one, |parts| (parts.key.to_owned(), second.clone()));
    page.rewrite(other, |parts| (parts.key.to_owned(), first.clone()));
}

/// A number becomes one more or less, or the same in another spelling.
pub(super) fn nudge(page: &mut Page<'_>, _: &Page<'_>, random: &mut Random) {
    let Some(at) = page.keyed(random) else { return };
    let Some(number) = page.parts(at).and_then(|parts| number(parts.value.trim())) else { return };
    let near = number.wrapping_add(random.below(3) as i128 - 1);
    let value = match random.below(8) {
        0 => format!("{near}"),
        1 => format!("0x{near:X}"),
        2 => format!("0X{near:08x}"),
        3 => format!("0{near:o}"),
        4 => format!("-{near}"),
        5 => format!("{near:o}h "),
        6 => format!(" {near}"),
        _ => format!(
            "{}",
            1_i128.checked_shl(u32::try_from(near.rem_euclid(128)).unwrap_or_default()).unwrap_or(near)
        ),
    };
    page.rewrite(at, |parts| (parts.key.to_owned(), value.clone()));
}

fn number(text: &str) -> Option<i128> {
    let hexadecimal = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X"));
    hexadecimal.map_or_else(|| text.parse(), |digits| i128::from_str_radix(digits, 16)).ok()
}

/// A value, a key or a header that is very long.
pub(super) fn lengthen(page: &mut Page<'_>, _: &Page<'_>, random: &mut Random) {
    let at = random.below(page.lines.len());
    let room = LARGEST.saturating_sub(page.size());
    let Some(line) = page.lines.get_mut(at) else { return };
    let place = random.place(line);
    let text =
        *random.pick(&["x", "9", "F", " ", "=", "ä", "0x1,", "\"", "\t", "[", "]", ";"]).unwrap_or(&"x");
    let longest = if random.chance(20) { room / 4 } else { 600 };
    line.insert_str(place, &text.repeat(random.small(longest.max(1) / text.len())));
}

/// A character of a line becomes another, is lost or doubled.
pub(super) fn misspell(page: &mut Page<'_>, _: &Page<'_>, random: &mut Random) {
    const STRANGE: [char; 14] =
        ['\0', '\t', ' ', '=', '[', ']', ';', '"', '\u{7F}', '\u{85}', '\u{A0}', 'é', '\u{FFFD}', '𝄞'];
    for _ in 0..random.small(4) {
        let at = random.below(page.lines.len());
        let Some(line) = page.lines.get_mut(at) else { return };
        let place = random.place(line);
        let Some(old) = line.get(place..).and_then(|rest| rest.chars().next()) else { continue };
        match random.below(4) {
            0 => line.insert(place, old),
            1 => line.insert(place, *random.pick(&STRANGE).unwrap_or(&' ')),
            2 => drop(line.remove(place)),
            _ => {
                let other =
                    if old.is_lowercase() { old.to_ascii_uppercase() } else { old.to_ascii_lowercase() };
                line.replace_range(place..place + old.len_utf8(), other.encode_utf8(&mut [0; 4]));
            }
        }
    }
}

/// A header gets another index or sub-index: a digit becomes another, or a part of its name goes or comes.
pub(super) fn move_place(page: &mut Page<'_>, _: &Page<'_>, random: &mut Random) {
    let notation = page.notation;
    let mut found = (0..20).map(|_| random.below(page.lines.len()));
    let Some(at) = found.find(|at| page.lines.get(*at).is_some_and(|line| notation.is_header(line))) else {
        return;
    };
    let Some(line) = page.lines.get_mut(at) else { return };
    let digits: Vec<usize> = line
        .char_indices()
        .filter_map(|(at, character)| character.is_ascii_hexdigit().then_some(at))
        .collect();
    let digit =
        *random.pick(&["0", "1", "2", "9", "A", "f", "FF", "sub", "sub1", "Value", ""]).unwrap_or(&"");
    match random.pick(&digits) {
        Some(place) if random.chance(80) => line.replace_range(*place..=*place, digit),
        Some(place) => line.insert_str(*place, digit),
        None => line.insert_str(notation.name_start(line), digit),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fuzz::EDS;

    #[test]
    fn a_line_keeps_its_key_and_its_line_break() {
        let mut page = Page::new("Key=1\r\nno key\r\n", &EDS);
        page.rewrite(0, |parts| (parts.key.to_owned(), format!("<{}>", parts.value)));
        page.rewrite(1, |_| unreachable!("it has no key"));
        assert_eq!(page.lines.concat(), "Key=<1>\r\nno key\r\n");
    }

    #[test]
    fn words_end_at_signs() {
        let line = "  0x2000: {name: set-point, unit: m/s, default: $NODEID+1.5}";
        let found: Vec<&str> = words(line).into_iter().map(|place| &line[place]).collect();
        assert_eq!(found, ["0x2000", "name", "set-point", "unit", "m", "s", "default", "$NODEID", "1.5"]);
    }

    #[test]
    fn numbers_are_read_in_both_notations() {
        assert_eq!([number("0x1F"), number("-5"), number("x")], [Some(31), Some(-5), None]);
    }
}
