//! Mutants: texts that were changed by chance, as a seed decides.

use std::collections::BTreeSet;
use std::ops::Range;

use od_spec::encoding::{Encoding, decode, encode};

use super::notation::Notation;
use super::random::Random;
use super::values;

/// A text to begin with.
#[derive(Debug, Clone)]
pub struct Seed {
    /// Its file's name; the ending says what it is.
    pub name: String,
    /// Its bytes.
    pub bytes: Vec<u8>,
}

/// Of a text that is longer, so many bytes are taken at most.
const LONGEST_PART: usize = 12_000;
/// Of what grows, a mutant has at most so many bytes.
pub(super) const LARGEST: usize = 200_000;
/// What a text can be stored in.
const ENCODINGS: [Encoding; 7] = [
    Encoding::Utf8,
    Encoding::Utf8WithMark,
    Encoding::Utf16Le,
    Encoding::Utf16Be,
    Encoding::Windows1252,
    Encoding::Cp850,
    Encoding::Cp437,
];

/// A text that is being changed, as lines with their line breaks.
#[derive(Debug, Clone)]
pub(super) struct Page<'n> {
    pub(super) lines: Vec<String>,
    pub(super) notation: &'n Notation,
}

/// One change. `other` is a second text, to take parts from.
type Change = fn(&mut Page<'_>, other: &Page<'_>, random: &mut Random);

/// All changes of lines, each as likely as any other.
const CHANGES: [Change; 21] = [
    delete_lines,
    double_lines,
    move_lines,
    shuffle_lines,
    delete_section,
    double_section,
    move_section,
    many_sections,
    take_over_section,
    continue_as_other,
    put_line,
    put_header,
    indent_lines,
    values::replace,
    values::replace_word,
    values::swap,
    values::nudge,
    values::lengthen,
    values::misspell,
    values::move_place,
    other_breaks,
];

/// A mutant of the seeds, and the name of the one that it began with; `None` where there are no seeds.
pub fn mutant(seeds: &[Seed], notation: &Notation, random: &mut Random) -> Option<Seed> {
    let seed = random.pick(seeds)?;
    let read = |seed: &Seed| decode(seed.bytes.clone()).ok();
    let (text, encoding) = read(seed)?;
    let mut page = part(Page::new(&text, notation), random);
    for _ in 0..random.small(notation.most_changes) {
        let other = random.pick(seeds).and_then(read).map(|(other, _)| other).unwrap_or_default();
        let other = Page::new(&other, notation);
        if let Some(change) = random.pick(&CHANGES) {
            change(&mut page, &other, random);
        }
    }
    let encoding = if random.chance(10) { random.pick(&ENCODINGS).copied() } else { Some(encoding) };
    let text = page.lines.concat();
    let encoded = encode(&text, encoding.unwrap_or(Encoding::Utf8));
    let mut bytes = encoded.unwrap_or_else(|_| text.into_bytes());
    if random.chance(20) {
        for _ in 0..random.small(notation.most_changes) {
            change_byte(&mut bytes, random);
        }
    }
    Some(Seed { name: seed.name.clone(), bytes })
}

/// Of a long text the beginning, where the facts of the file as a whole are, and some sections in their order.
fn part<'n>(whole: Page<'n>, random: &mut Random) -> Page<'n> {
    let limit = LONGEST_PART / 4 + random.below(LONGEST_PART);
    if whole.size() <= limit {
        return whole;
    }
    let sections = whole.sections();
    let head = if random.chance(80) { sections.len().min(3) } else { 0 };
    let start = head + random.below(sections.len() - head);
    let mut from = start;
    let mut taken: BTreeSet<usize> = (0..head).collect();
    let is_frame = |section: &Range<usize>| {
        whole.lines.get(section.start).is_some_and(|line| whole.notation.is_frame(line))
    };
    taken.extend((0..sections.len()).filter(|at| sections.get(*at).is_some_and(is_frame)));
    let size = |at: usize| {
        let lines = sections.get(at).and_then(|section| whole.lines.get(section.clone()));
        lines.unwrap_or_default().iter().map(String::len).sum::<usize>()
    };
    let mut room = limit.saturating_sub(taken.iter().map(|at| size(*at)).sum());
    while from < sections.len() && room > 0 {
        if taken.insert(from) {
            room = room.saturating_sub(size(from));
        }
        // Mostly neighbours, now and then a gap.
        from += if random.chance(90) { 1 } else { random.small(40) };
    }
    let lines = taken.iter().filter_map(|at| whole.lines.get(sections.get(*at)?.clone()));
    let lines = lines.flatten().cloned().collect();
    Page { lines, ..whole }
}

impl<'n> Page<'n> {
    pub(super) fn new(text: &str, notation: &'n Notation) -> Self {
        let end = if text.contains('\n') { '\n' } else { '\r' };
        Self { lines: text.split_inclusive(end).map(ToOwned::to_owned).collect(), notation }
    }

    pub(super) fn size(&self) -> usize {
        self.lines.iter().map(String::len).sum()
    }

    /// The sections; what is before the first is a section too.
    fn sections(&self) -> Vec<Range<usize>> {
        let is_start = |(at, line): &(usize, &String)| *at == 0 || self.notation.is_header(line);
        let starts: Vec<usize> = self.lines.iter().enumerate().filter(is_start).map(|(at, _)| at).collect();
        let ends = starts.iter().skip(1).copied().chain([self.lines.len()]);
        starts.iter().zip(ends).map(|(start, end)| *start..end).collect()
    }

    fn section(&self, random: &mut Random) -> Range<usize> {
        random.pick(&self.sections()).cloned().unwrap_or_default()
    }

    /// Some lines that follow each other.
    fn range(&self, random: &mut Random) -> Range<usize> {
        let start = random.below(self.lines.len());
        start..(start + random.small(20)).min(self.lines.len())
    }

    /// A place between two lines.
    fn gap(&self, random: &mut Random) -> usize {
        random.below(self.lines.len() + 1)
    }

    fn insert(&mut self, at: usize, lines: Vec<String>) {
        let more: usize = lines.iter().map(String::len).sum();
        if self.size() + more <= LARGEST {
            let at = at.min(self.lines.len());
            self.lines.splice(at..at, lines);
        }
    }

    fn cut(&mut self, range: Range<usize>) -> Vec<String> {
        self.lines.drain(range).collect()
    }

    fn copy(&self, range: Range<usize>) -> Vec<String> {
        self.lines.get(range).unwrap_or_default().to_vec()
    }

    /// The line break that the text uses.
    fn line_break(&self) -> &'static str {
        match self.lines.first() {
            Some(line) if line.ends_with("\r\n") => "\r\n",
            Some(line) if line.ends_with('\r') => "\r",
            Some(_) | None => "\n",
        }
    }
}

fn delete_lines(page: &mut Page<'_>, _: &Page<'_>, random: &mut Random) {
    let range = page.range(random);
    page.cut(range);
}

fn double_lines(page: &mut Page<'_>, _: &Page<'_>, random: &mut Random) {
    let lines = page.copy(page.range(random));
    page.insert(page.gap(random), lines);
}

fn move_lines(page: &mut Page<'_>, _: &Page<'_>, random: &mut Random) {
    let range = page.range(random);
    let lines = page.cut(range);
    page.insert(page.gap(random), lines);
}

fn shuffle_lines(page: &mut Page<'_>, _: &Page<'_>, random: &mut Random) {
    let range = page.range(random);
    for at in range.clone() {
        page.lines.swap(at, range.start + random.below(range.len()));
    }
}

fn delete_section(page: &mut Page<'_>, _: &Page<'_>, random: &mut Random) {
    let section = page.section(random);
    page.cut(section);
}

fn double_section(page: &mut Page<'_>, _: &Page<'_>, random: &mut Random) {
    let lines = page.copy(page.section(random));
    let places = page.sections();
    let at = random.pick(&places).map_or(0, |place| place.start);
    page.insert(at, lines);
}

fn move_section(page: &mut Page<'_>, _: &Page<'_>, random: &mut Random) {
    let section = page.section(random);
    let lines = page.cut(section);
    let places = page.sections();
    let at = random.pick(&places).map_or(0, |place| place.start);
    page.insert(at, lines);
}

/// A section many times over: under its name, or each under a name of its own.
fn many_sections(page: &mut Page<'_>, _: &Page<'_>, random: &mut Random) {
    if !random.chance(20) {
        return;
    }
    let section = page.section(random);
    let lines = page.copy(section.clone());
    let size: usize = lines.iter().map(String::len).sum();
    let times = random.small((LARGEST / 2) / size.max(1)).min(2000);
    let same = random.chance(50);
    let mut number = 0x2000 + random.below(0x8000);
    let mut more = Vec::new();
    for _ in 0..times {
        let mut lines = lines.clone();
        if let Some(header) = lines.first_mut().filter(|_| !same) {
            *header = page.notation.numbered(header, number);
            number += 1;
        }
        more.append(&mut lines);
    }
    page.insert(section.end, more);
}

fn take_over_section(page: &mut Page<'_>, other: &Page<'_>, random: &mut Random) {
    let lines = other.copy(other.section(random));
    let places = page.sections();
    let at = random.pick(&places).map_or(0, |place| place.start);
    page.insert(at, lines);
}

/// The beginning of one text and the end of another.
fn continue_as_other(page: &mut Page<'_>, other: &Page<'_>, random: &mut Random) {
    let from = other.gap(random);
    let to = (from + random.small(200)).min(other.lines.len());
    page.lines.truncate(page.gap(random));
    page.insert(usize::MAX, other.copy(from..to));
}

fn put_line(page: &mut Page<'_>, _: &Page<'_>, random: &mut Random) {
    for _ in 0..random.small(4) {
        let line = random.pick(page.notation.lines).copied().unwrap_or_default();
        let line = format!("{line}{}", page.line_break());
        page.insert(page.gap(random), vec![line]);
    }
}

fn put_header(page: &mut Page<'_>, _: &Page<'_>, random: &mut Random) {
    let name = random.pick(page.notation.headers).copied().unwrap_or_default();
    let header = page.notation.header(name) + page.line_break();
    let at = page.gap(random);
    match page.lines.get_mut(at).filter(|line| page.notation.is_header(line)) {
        Some(line) => *line = header,
        None => page.insert(at, vec![header]),
    }
}

/// Lines move to the right or to the left: what belongs together changes where indentation says it.
fn indent_lines(page: &mut Page<'_>, _: &Page<'_>, random: &mut Random) {
    let range = page.range(random);
    let to_the_right = random.chance(50);
    for line in page.lines.get_mut(range).unwrap_or_default() {
        match line.strip_prefix("  ") {
            Some(rest) if !to_the_right => *line = rest.to_owned(),
            Some(_) | None => line.insert_str(0, "  "),
        }
    }
}

/// Other line breaks: everywhere, or in one line.
fn other_breaks(page: &mut Page<'_>, _: &Page<'_>, random: &mut Random) {
    const BREAKS: [&str; 8] = ["\n", "\r\n", "\r", "\r\r\n", "\n\r", "\u{b}", "\u{2028}", ""];
    let new = random.pick(&BREAKS).copied().unwrap_or_default();
    let range = if random.chance(20) { 0..page.lines.len() } else { page.range(random) };
    for line in page.lines.get_mut(range).unwrap_or_default() {
        *line = format!("{}{new}", line.trim_end_matches(['\r', '\n']));
    }
}

/// A change that knows nothing of characters.
fn change_byte(bytes: &mut Vec<u8>, random: &mut Random) {
    let at = random.below(bytes.len());
    let any = u8::try_from(random.below(256)).unwrap_or_default();
    match random.below(6) {
        0 => {
            if let Some(byte) = bytes.get_mut(at) {
                *byte ^= 1 << random.below(8);
            }
        }
        1 => bytes.insert(at, any),
        2 => {
            if let Some(byte) = bytes.get_mut(at) {
                *byte = any;
            }
        }
        3 => drop(bytes.drain(at..(at + random.small(9)).min(bytes.len()))),
        4 => bytes.insert(at, 0),
        _ if random.chance(20) => bytes.truncate(at),
        _ => bytes.insert(at, *random.pick(b"[]=;#\r\n \t\"$").unwrap_or(&b'=')),
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::fuzz::EDS;

    fn seeds() -> Vec<Seed> {
        let section =
            |index: usize| format!("[{index:X}]\r\nParameterName=object {index}\r\nObjectType=7\r\n");
        let text = |count: usize| (0..count).map(|at| section(0x2000 + at)).collect::<String>();
        let seed = |name: &str, text: String| Seed { name: name.to_owned(), bytes: text.into_bytes() };
        vec![seed("a.eds", text(4)), seed("b.dcf", text(4000))]
    }

    #[test]
    fn a_seed_gives_the_same_mutant_again() {
        let seeds = seeds();
        let made = |seed| mutant(&seeds, &EDS, &mut Random::new(seed)).unwrap().bytes;
        let all: BTreeSet<Vec<u8>> = (0..60).map(made).collect();
        assert!(all.len() > 55, "{}", all.len());
        assert!((0..60).all(|seed| all.contains(&made(seed))));
        assert!(all.iter().all(|bytes| bytes.len() < 2 * LARGEST));
        assert!(mutant(&[], &EDS, &mut Random::new(1)).is_none());
    }

    /// Also of a text without any line, none fails; every one changes something sooner or later.
    #[test]
    fn every_change_changes_something() {
        let seeds = seeds();
        let text = String::from_utf8(seeds[0].bytes.clone()).unwrap();
        for (number, change) in CHANGES.iter().enumerate() {
            let changed = (0..60).any(|seed| {
                let mut random = Random::new(seed);
                let mut empty = Page::new("", &EDS);
                let other = Page::new("[1000]\nDefaultValue=5\n", &EDS);
                change(&mut empty, &Page::new("", &EDS), &mut random);
                let mut page = Page::new(&text, &EDS);
                change(&mut page, &other, &mut random);
                page.lines.concat() != text
            });
            assert!(changed, "change {number}");
        }
    }

    #[test]
    fn a_part_of_a_long_text_keeps_whole_sections() {
        let seeds = seeds();
        let text = String::from_utf8(seeds[1].bytes.clone()).unwrap();
        for seed in 0..50 {
            let page = part(Page::new(&text, &EDS), &mut Random::new(seed));
            assert!(page.size() < LONGEST_PART * 5 / 4 + 100 && page.size() > 30, "{}", page.size());
            assert!(page.sections().iter().all(|section| section.len() == 3));
        }
    }
}
