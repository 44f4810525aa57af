//! Which tables of the manual an erratum is about, read from the words of its place: `5.1.1.1, Table 38`,
//! `4.3.1.1, detail table`, `Tables 12 to 15`. A figure is the picture of a table.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::RangeInclusive;
use std::sync::LazyLock;

use crate::model::{Document, ErratumPlace, Index, TableContent, TableId};
use crate::wording::Language;

/// What the words of a place name.
pub(super) struct Named {
    /// Tables of the document.
    pub tables: Vec<TableId>,
    /// The first number of a table or figure that the document does not have.
    pub unknown: Option<(Kind, u32)>,
}

/// What has a number in a manual.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Table,
    Figure,
}

impl Kind {
    /// As its caption has it.
    pub(super) const fn title(self) -> &'static str {
        match self {
            Self::Table => "Table",
            Self::Figure => "Figure",
        }
    }

    /// In a sentence.
    pub(super) const fn word(self) -> &'static str {
        match self {
            Self::Table => "table",
            Self::Figure => "figure",
        }
    }

    /// The kind that a number after this word is of.
    fn of(word: &str) -> Option<Self> {
        if TABLE.contains(&word) {
            return Some(Self::Table);
        }
        FIGURE.contains(&word).then_some(Self::Figure)
    }
}

/// Where the parts of a document are.
#[derive(Default)]
pub(super) struct Places<'a> {
    /// The numbered tables; of one number, the first.
    numbered: BTreeMap<u32, TableId>,
    /// The tables with a figure, by its number; of one number, the first.
    figures: BTreeMap<u32, TableId>,
    /// The tables without a number that show an object.
    unnumbered: BTreeMap<Index, Vec<TableId>>,
    /// The positions of the numbered sections; of one number, the first.
    sections: BTreeMap<&'a str, usize>,
}

impl<'a> Places<'a> {
    pub(super) fn of(document: &'a Document) -> Self {
        let mut places = Self::default();
        for (position, section) in document.sections.iter().enumerate() {
            if !section.number.is_empty() {
                places.sections.entry(&section.number).or_insert(position);
            }
        }
        for (id, _, table) in document.tables() {
            if let Some(figure) = &table.figure {
                places.figures.entry(figure.number.into()).or_insert(id);
            }
            match (table.number, &table.content) {
                (Some(number), _) => {
                    places.numbered.entry(number.into()).or_insert(id);
                }
                (None, TableContent::Overview(list) | TableContent::Objects(list)) => {
                    for index in list {
                        places.unnumbered.entry(*index).or_default().push(id);
                    }
                }
                (None, _) => {}
            }
        }
        places
    }
}

/// Words of running texts in any language, in lower case.
type Meaning = LazyLock<Vec<&'static str>>;

static TABLE: Meaning = LazyLock::new(|| words_of(&["table", "tables"]));
static FIGURE: Meaning = LazyLock::new(|| words_of(&["figure", "figures"]));
static OVERVIEW: Meaning = LazyLock::new(|| words_of(&["overview"]));
static BELOW: Meaning = LazyLock::new(|| words_of(&["below"]));
static AND: Meaning = LazyLock::new(|| words_of(&["and"]));
static TO: Meaning = LazyLock::new(|| words_of(&["to"]));

fn words_of(keys: &[&'static str]) -> Vec<&'static str> {
    keys.iter().flat_map(|key| Language::words_of_all(key)).collect()
}

/// Whether a word is between the numbers of a list or a run.
fn is_joint(word: &str) -> bool {
    AND.contains(&word) || TO.contains(&word)
}

/// The tables that a place names, by number or as the unnumbered tables with the erratum's objects in a named section.
pub(super) fn read(place: &str, at: &[ErratumPlace], places: &Places<'_>) -> Named {
    let mut named = Named { tables: Vec::new(), unknown: None };
    for segment in place.split(';') {
        let words = Words::of(segment, places);
        for (kind, numbers) in &words.numbers {
            let numbered = match kind {
                Kind::Table => &places.numbered,
                Kind::Figure => &places.figures,
            };
            let mut expected = *numbers.start();
            for (number, id) in numbered.range(numbers.clone()) {
                named.tables.push(*id);
                expected = if *number == expected { number.saturating_add(1) } else { expected };
            }
            // A document without figures says nothing about those of the manual.
            let is_described = *kind == Kind::Table || !numbered.is_empty();
            if expected <= *numbers.end() && is_described {
                named.unknown = named.unknown.or(Some((*kind, expected)));
            }
        }
        if words.unnumbered {
            for sections in &words.sections {
                named.tables.extend(about(places, sections, at));
            }
        }
    }
    let mut seen = BTreeSet::new();
    named.tables.retain(|id| seen.insert(*id));
    named
}

/// The unnumbered tables of some sections that show one of the objects, in order.
fn about(places: &Places<'_>, sections: &RangeInclusive<usize>, at: &[ErratumPlace]) -> BTreeSet<TableId> {
    let indices: BTreeSet<Index> = at.iter().map(|place| place.index()).collect();
    let showing = indices.iter().filter_map(|index| places.unnumbered.get(index));
    let of_sections = showing.flat_map(|tables| {
        // They are in the order of the document.
        let first = tables.partition_point(|id| id.section < *sections.start());
        let end = tables.partition_point(|id| id.section <= *sections.end());
        tables.get(first..end).unwrap_or_default()
    });
    of_sections.copied().collect()
}

/// What one segment of a place says.
struct Words {
    /// The numbers of tables and figures.
    numbers: Vec<(Kind, RangeInclusive<u32>)>,
    /// Positions of the sections.
    sections: Vec<RangeInclusive<usize>>,
    /// Whether the unnumbered tables of the sections are meant.
    unnumbered: bool,
}

impl Words {
    fn of(segment: &str, places: &Places<'_>) -> Self {
        // A run may be written `3-5`, too.
        let text =
            segment.to_lowercase().replace("table of contents", "contents").replace(['-', '–'], " to ");
        let words: Vec<&str> = text
            .split(|sign: char| sign.is_whitespace() || matches!(sign, ',' | '(' | ')' | ':'))
            .map(|word| word.trim_end_matches('.'))
            .filter(|word| !word.is_empty())
            .collect();
        let mut read = Self { numbers: Vec::new(), sections: Vec::new(), unnumbered: false };
        let (mut others, mut at) = (Vec::new(), 0);
        while let Some(word) = words.get(at) {
            let before = at.checked_sub(1).and_then(|before| words.get(before));
            at += 1;
            let kind = Kind::of(word).filter(|_| words.get(at).is_some_and(|next| number(next).is_some()));
            if let Some(kind) = kind {
                let near = before.is_some_and(|before| BELOW.contains(before));
                let used = numbers(&words[at..], |first, last| {
                    if !near {
                        read.numbers.push((kind, first..=last));
                    }
                });
                at += used;
            } else if let Some(section) = places.sections.get(word).copied() {
                let first = match (before, read.sections.last()) {
                    (Some(before), Some(last)) if TO.contains(before) => last.end() + 1,
                    _ => section,
                };
                read.sections.push(first.min(section)..=section);
            } else if !is_joint(word) {
                others.push(*word);
            }
        }
        read.unnumbered = if others.is_empty() {
            read.numbers.is_empty()
        } else {
            others.iter().any(|word| TABLE.contains(word) || OVERVIEW.contains(word))
        };
        read
    }
}

fn number(word: &str) -> Option<u32> {
    word.parse().ok()
}

/// Reads a list of numbers and says how many words it took.
fn numbers(words: &[&str], mut found: impl FnMut(u32, u32)) -> usize {
    let (mut used, mut last) = (0, None);
    while let Some(word) = words.get(used) {
        match (number(word), last) {
            (Some(one), Some(first)) if used > 0 && TO.contains(&words[used - 1]) && first < one => {
                found(first + 1, one);
                last = Some(one);
            }
            (Some(one), _) => {
                found(one, one);
                last = Some(one);
            }
            (None, _) if is_joint(word) => {
                // A connector counts only before a further number.
                if words.get(used + 1).is_none_or(|next| number(next).is_none()) {
                    break;
                }
            }
            (None, _) => break,
        }
        used += 1;
    }
    used
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Figure, Phrases, Section, Table, Text};

    fn document() -> Document {
        let table = |number: Option<u16>, indices: &[u16]| Table {
            number,
            title: Text::default(),
            // Figure 7 is the picture of Table 3.
            figure: number
                .filter(|number| *number == 3)
                .map(|_| Figure { number: 7, title: Text::default() }),
            columns: Vec::new(),
            order: Vec::new(),
            content: TableContent::Objects(indices.iter().map(|index| Index(*index)).collect()),
        };
        let section = |number: &str, tables| Section {
            number: number.to_owned(),
            title: Text::default(),
            tables,
            content: Vec::new(),
            search: Phrases::default(),
        };
        Document {
            sections: vec![
                section("1", vec![table(Some(1), &[0x2000])]),
                section("1.1", vec![table(None, &[0x2000]), table(Some(2), &[0x2000])]),
                section("1.2", vec![table(None, &[0x2000]), table(None, &[0x2001])]),
                section("1.3", vec![table(Some(3), &[0x2001])]),
            ],
            ..Document::default()
        }
    }

    fn tables(place: &str) -> String {
        let document = document();
        let named = read(place, &[ErratumPlace::Object(Index(0x2000))], &Places::of(&document));
        let tables = named.tables.iter().map(|id| format!("{}.{}", id.section, id.table));
        let unknown = named.unknown.map(|(kind, number)| match kind {
            Kind::Table => format!("?{number}"),
            Kind::Figure => format!("?figure {number}"),
        });
        tables.chain(unknown).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn numbers_name_numbered_tables() {
        assert_eq!(tables("1.1, Table 2"), "1.1");
        assert_eq!(tables("Tables 1 and 3, whole manual"), "0.0 3.0");
        assert_eq!(tables("1 and Tabellen 1 bis 3"), "0.0 1.1 3.0");
        assert_eq!(tables("caption of Table 2; Table 3"), "1.1 3.0");
        assert_eq!(tables("Table 9, and 1.2, text"), "?9");
        assert_eq!(tables("Tables 2 to 4294967295"), "1.1 3.0 ?4");
        assert_eq!(tables("Tables 1-3."), "0.0 1.1 3.0");
        assert_eq!(tables("1.1, text below Table 2"), "");
    }

    #[test]
    fn numbers_name_figures() {
        assert_eq!(tables("1.3, Figure. 7"), "3.0");
        assert_eq!(tables("Table 2 and Figure 7"), "1.1 3.0");
        assert_eq!(tables("Abbildung 7, Tabelle 1"), "3.0 0.0");
        assert_eq!(tables("Figures 7 and 8"), "3.0 ?figure 8");
        assert_eq!(tables("1.1, Abbildung der Pumpe"), "");
    }

    #[test]
    fn sections_name_their_unnumbered_tables_with_the_object() {
        assert_eq!(tables("1.2"), "2.0");
        assert_eq!(tables("1.2: detail table"), "2.0");
        assert_eq!(tables("1.1 to 1.3, detail tables"), "1.0 2.0");
        assert_eq!(tables("1.1 und 1.2, Übersichten"), "1.0 2.0");
        assert_eq!(tables("1.2, heading and table of contents"), "");
        assert_eq!(tables("1.2, text; 1.1, detail table"), "1.0");
        assert_eq!(tables("1.1, Table 2, and 1.2, detail table"), "1.1 1.0 2.0");
        assert_eq!(tables("title pages"), "");
    }
}
