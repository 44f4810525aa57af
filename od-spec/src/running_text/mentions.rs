//! Numbers of tables, figures and sections in running text, as people write them: `Table 13`, `sections 5.2, 5.3 and 5.4`,
//! `Kapitel 1 bis 3`.

use std::ops::Range;
use std::sync::LazyLock;

use crate::wording::Language;

/// What has a number in a manual.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Numbered {
    /// A table.
    Table,
    /// A figure.
    Figure,
    /// A chapter or section.
    Section,
}

impl Numbered {
    /// In a sentence.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Table => "table",
            Self::Figure => "figure",
            Self::Section => "section",
        }
    }
}

/// A number in a text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mention<'t> {
    /// Where it stands; the first of a list with its noun.
    pub range: Range<usize>,
    /// What is named.
    pub kind: Numbered,
    /// Its number, as a heading or caption has it.
    pub number: &'t str,
}

/// How many numbers a noun has behind it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Count {
    One,
    Many,
    /// German does not always tell one from many.
    Either,
}

/// The nouns in small letters.
static NOUNS: LazyLock<Vec<(&str, Numbered, Count)>> = LazyLock::new(|| {
    let nouns = [
        ("table", Numbered::Table, Count::One),
        ("tables", Numbered::Table, Count::Many),
        ("figure", Numbered::Figure, Count::One),
        ("figures", Numbered::Figure, Count::Many),
        ("section", Numbered::Section, Count::One),
        ("sections", Numbered::Section, Count::Many),
        ("section_or_sections", Numbered::Section, Count::Either),
    ];
    let words = |(key, kind, count)| Language::words_of_all(key).map(move |noun| (noun, kind, count));
    nouns.into_iter().flat_map(words).collect()
});
/// What stands before the last number of a list, or between the ends of a run.
static JOINTS: LazyLock<Vec<String>> = LazyLock::new(|| {
    let words = ["and", "or", "to"].into_iter().flat_map(Language::words_of_all);
    let spaced = words.flat_map(|word| [format!(" {word} "), format!(", {word} ")]);
    spaced.chain(["–".to_owned(), "-".to_owned()]).collect()
});
/// How the names of standards begin; a number follows.
const STANDARDS: [&str; 9] = ["CiA", "DSP", "DS", "IEC", "ISO", "EN", "DIN", "IEEE", "RFC"];
/// What leads from a number to the document that has it.
static OF: LazyLock<Vec<&str>> = LazyLock::new(|| Language::words_of_all("of").collect());
/// Other documents, in small letters: a standard, or another issue of the manual.
static OTHERS: LazyLock<Vec<&str>> = LazyLock::new(|| Language::words_of_all("other_documents").collect());

/// The numbers in a text that are not those of another document, in order.
pub fn mentions(text: &str) -> Vec<Mention<'_>> {
    let mut found = Vec::new();
    for (at, start) in number_places(text) {
        let Some((noun, kind, count)) = noun_before(text, at) else { continue };
        let Some(first) = number_at(text, start, kind) else { continue };
        let mut numbers = vec![first];
        if count != Count::One {
            while let Some(next) = next_number(text, numbers[numbers.len() - 1].end, kind, count) {
                numbers.push(next);
            }
        }
        let end = numbers[numbers.len() - 1].end;
        let is_part_of_more = text[end..].starts_with(['-', '–', '/']) && is_joined(&text[end..]);
        if is_part_of_more || is_of_another_document(&text[..noun], &text[end..]) {
            continue;
        }
        for (position, number) in numbers.into_iter().enumerate() {
            let start = if position == 0 { noun } else { number.start };
            found.push(Mention { range: start..number.end, kind, number: &text[number] });
        }
    }
    found
}

/// Where a number may begin after a space, each with the start of the space.
fn number_places(text: &str) -> impl Iterator<Item = (usize, usize)> {
    // Both spaces end with one of two bytes, and most words begin with a lower-case letter.
    let pairs = text.as_bytes().windows(2).zip(1..);
    pairs.filter(|(pair, _)| matches!(pair, [b' ' | 0xA0, b'0'..=b'9' | b'A'..=b'Z'])).filter_map(
        |(_, start)| {
            let space = text[..start].chars().next_back().filter(|c| matches!(c, ' ' | '\u{a0}'))?;
            may_be_number(&text[start..]).then(|| (start - space.len_utf8(), start))
        },
    )
}

/// The noun that ends at a place: where it begins, and what it names.
fn noun_before(text: &str, end: usize) -> Option<(usize, Numbered, Count)> {
    let before = text[..end].trim_end_matches(char::is_alphabetic);
    let word = text[before.len()..end].to_lowercase();
    // `bit-table` and `my_table` are other words.
    if before.ends_with(|sign: char| sign.is_alphanumeric() || matches!(sign, '-' | '_')) {
        return None;
    }
    let (_, kind, count) = NOUNS.iter().copied().find(|(noun, ..)| *noun == word)?;
    Some((before.len(), kind, count))
}

/// Whether a number may begin here, as [`number_at`] reads it: most words are none, and need no look at what is before them.
fn may_be_number(text: &str) -> bool {
    match text.as_bytes() {
        [first, second, ..] => first.is_ascii_digit() || first.is_ascii_uppercase() && *second == b'.',
        [only] => only.is_ascii_digit(),
        [] => false,
    }
}

/// The number that begins at a place: of a section with points, and perhaps with the letter of an appendix.
fn number_at(text: &str, start: usize, kind: Numbered) -> Option<Range<usize>> {
    let digits = |from: &str| from.bytes().take_while(u8::is_ascii_digit).count();
    let behind = text.get(start..)?;
    let mut length = match digits(behind) {
        0 if kind == Numbered::Section && behind.starts_with(|sign: char| sign.is_ascii_uppercase()) => 1,
        0 => return None,
        length => length,
    };
    let has_letter = !behind.starts_with(|sign: char| sign.is_ascii_digit());
    let of_letter = length;
    while kind == Numbered::Section && behind[length..].starts_with('.') {
        match digits(&behind[length + 1..]) {
            0 => break,
            more => length += 1 + more,
        }
    }
    let rest = &behind[length..];
    let goes_on = rest.starts_with(|sign: char| sign.is_alphanumeric() || sign == '_')
        || rest.starts_with(['.', ',']) && is_joined(rest);
    // `section A` may be anything.
    let is_lone_letter = has_letter && length == of_letter;
    (!goes_on && !is_lone_letter).then(|| start..start + length)
}

/// Whether a letter or digit stands directly behind the first sign.
fn is_joined(text: &str) -> bool {
    text.chars().nth(1).is_some_and(char::is_alphanumeric)
}

/// The next number of a list, behind the last one.
fn next_number(text: &str, end: usize, kind: Numbered, count: Count) -> Option<Range<usize>> {
    let behind = &text[end..];
    if let Some(number) = JOINTS.iter().find_map(|joint| {
        behind.starts_with(joint.as_str()).then(|| number_at(text, end + joint.len(), kind))?
    }) {
        // `Kapitel 2 und 3 Objekte` counts objects.
        let counts = count == Count::Either
            && text[number.end..].strip_prefix(' ').is_some_and(|word| word.starts_with(char::is_uppercase));
        return (!counts).then_some(number);
    }
    let number = number_at(text, end + behind.strip_prefix(", ").map(|_| 2)?, kind)?;
    let rest = &text[number.end..];
    // `Tables 30 and 31, 5 of them` counts, too.
    let is_of_list = text[number.clone()].contains('.')
        || !rest.starts_with(' ')
        || JOINTS.iter().any(|joint| rest.starts_with(joint.as_str()));
    is_of_list.then_some(number)
}

/// Whether a number belongs to another document: a standard is named before it in the sentence, or one or another issue is
/// named directly behind it.
fn is_of_another_document(before: &str, behind: &str) -> bool {
    let ends = ["; ", ". ", "! ", "? ", "\n"];
    let sentence =
        ends.iter().filter_map(|end| before.rfind(end).map(|at| at + end.len())).max().unwrap_or_default();
    if words(&before[sentence..]).any(|(word, next)| is_standard(word, next)) {
        return true;
    }
    let Some(behind) = behind.strip_prefix(' ') else { return false };
    let mut behind = behind.trim_start_matches('(').split(' ').skip_while(|word| OF.contains(word));
    let (word, next) = (behind.next().unwrap_or_default(), behind.next().unwrap_or_default());
    let word = word.trim_end_matches(|sign: char| !sign.is_alphanumeric());
    is_standard(word, next) || OTHERS.contains(&&*word.to_lowercase())
}

/// Whether a word with the one behind it is the name of a standard: `CiA 402`, `DS402`, `IEC 61131`.
fn is_standard(word: &str, next: &str) -> bool {
    STANDARDS.into_iter().any(|name| match word.strip_prefix(name) {
        Some("") => next.starts_with(|sign: char| sign.is_ascii_digit()),
        Some(number) => number.bytes().all(|digit| digit.is_ascii_digit()),
        None => false,
    })
}

/// The words of a text, each with the one behind it.
fn words(text: &str) -> impl Iterator<Item = (&str, &str)> {
    let split = |text| str::split(text, |sign: char| !sign.is_alphanumeric()).filter(|word| !word.is_empty());
    split(text).zip(split(text).skip(1).chain(std::iter::once("")))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is found, as `13` for a table, `(13)` for a figure and `[5.2]` for a section, each with its text.
    fn in_text(text: &str) -> Vec<String> {
        let shown = mentions(text).into_iter().map(|Mention { range, kind, number }| {
            let number = match kind {
                Numbered::Table => number.to_owned(),
                Numbered::Figure => format!("({number})"),
                Numbered::Section => format!("[{number}]"),
            };
            format!("{} = {number}", &text[range])
        });
        shown.collect()
    }

    #[test]
    fn one_number_is_found() {
        assert_eq!(in_text("see Table 13."), ["Table 13 = 13"]);
        assert_eq!(
            in_text("table 13, Figure 7 (section 5.2)"),
            ["table 13 = 13", "Figure 7 = (7)", "section 5.2 = [5.2]"]
        );
        assert_eq!(in_text("Chapter 5: see Abschnitt 5.2."), ["Chapter 5 = [5]", "Abschnitt 5.2 = [5.2]"]);
        assert_eq!(
            in_text("Tabelle\u{a0}13 und Bild 2; section A.1"),
            ["Tabelle\u{a0}13 = 13", "Bild 2 = (2)", "section A.1 = [A.1]"]
        );
        assert_eq!(in_text("ä section 5.2"), ["section 5.2 = [5.2]"]);
    }

    #[test]
    fn every_number_of_a_list_is_found() {
        assert_eq!(in_text("Tables 30 and 31."), ["Tables 30 = 30", "31 = 31"]);
        assert_eq!(
            in_text("sections 5.2, 5.3 and 5.4."),
            ["sections 5.2 = [5.2]", "5.3 = [5.3]", "5.4 = [5.4]"]
        );
        assert_eq!(
            in_text("sections 5.6.1.8 to 5.6.1.10"),
            ["sections 5.6.1.8 = [5.6.1.8]", "5.6.1.10 = [5.6.1.10]"]
        );
        assert_eq!(
            in_text("Figures 2–5, Tabellen 1-3"),
            ["Figures 2 = (2)", "5 = (5)", "Tabellen 1 = 1", "3 = 3"]
        );
        assert_eq!(
            in_text("Kapitel 1, 2, 3 und 7 mit"),
            ["Kapitel 1 = [1]", "2 = [2]", "3 = [3]", "7 = [7]"]
        );
        assert_eq!(in_text("Abschnitten 5.2, 5.3 dar"), ["Abschnitten 5.2 = [5.2]", "5.3 = [5.3]"]);
        assert_eq!(in_text("chapters 1 and Table 5"), ["chapters 1 = [1]", "Table 5 = 5"]);
    }

    #[test]
    fn what_only_counts_is_no_number_of_a_list() {
        assert_eq!(in_text("Table 6, 4 rows"), ["Table 6 = 6"]);
        assert_eq!(in_text("Table 6 and 4 others"), ["Table 6 = 6"]);
        assert_eq!(in_text("Tables 30 and 31, 5 of them"), ["Tables 30 = 30", "31 = 31"]);
        assert_eq!(in_text("Tables 6 and 4.1.1.7"), ["Tables 6 = 6"]);
        assert_eq!(in_text("Kapitel 2 und 3 Objekte"), ["Kapitel 2 = [2]"]);
    }

    #[test]
    fn what_only_looks_like_a_number_is_none() {
        let none: [&str; 0] = [];
        assert_eq!(in_text("Table 130")[..], ["Table 130 = 130"]);
        assert_eq!(
            in_text(
                "Table 13a, Table 13.5, Table 1,5, Table 13-2, Table 13_2, table of 13, Table x, Table  13"
            ),
            none
        );
        assert_eq!(
            in_text("subsection 5.2, bit-table 5, my_table 5, section A, section 5.2.x, Bild 3-phasig"),
            none
        );
        assert_eq!(in_text("section 6040h, Table 6040h, Figure"), none);
    }

    #[test]
    fn numbers_of_other_documents_are_none() {
        let none: [&str; 0] = [];
        assert_eq!(in_text("Only bit 0. (CiA 301 v4.02, 9.6.3, Tabelle 48)"), none);
        assert_eq!(in_text("as section 5.2 of CiA 402 says; Tabelle 48 aus DS301"), none);
        assert_eq!(
            in_text("sections 5.2 and 5.3 of the standard, Abschnitt 6 der Norm, Table 4 (CiA 301)"),
            none
        );
        assert_eq!(in_text("Table 4 of issue 1.08, Tabelle 4 der Ausgabe 2"), none);
        assert_eq!(in_text("CiA 402 has it. Table 5 and CiA 402 have not."), ["Table 5 = 5"]);
        assert_eq!(in_text("in Abbildung 2 und in CiA 402"), ["Abbildung 2 = (2)"]);
        assert_eq!(in_text("Tabelle 2 der Norm; Tabelle 3, Norm"), ["Tabelle 3 = 3"]);
    }
}
