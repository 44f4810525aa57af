//! Which tables of the manual an erratum is about, read from the words of its place: `5.1.1.1, Table 38`,
//! `4.3.1.1, detail table`, `Tables 12 to 15`.

use std::collections::BTreeSet;

use crate::model::{Document, ErratumPlace, TableContent, TableId};

/// What the words of a place name.
pub(super) struct Named {
    /// Tables of the document.
    pub tables: Vec<TableId>,
    /// Numbers of tables that the document does not have.
    pub unknown: Vec<u32>,
}

/// Words for a numbered table, one or several.
const NUMBERED: [&str; 4] = ["table", "tables", "tabelle", "tabellen"];
/// Words for a table without a number.
const UNNUMBERED: [&str; 9] = [
    "table",
    "tables",
    "overview",
    "overviews",
    "tabelle",
    "tabellen",
    "objekttabelle",
    "übersicht",
    "übersichten",
];
/// What stands between the members of a list.
const AND: [&str; 2] = ["and", "und"];
const TO: [&str; 2] = ["to", "bis"];
/// What stands before a table that the place is only near to.
const NEAR: [&str; 2] = ["below", "unter"];

/// The tables that a place names, by number or as the unnumbered tables with the erratum's objects in a named section.
pub(super) fn read(place: &str, at: &[ErratumPlace], document: &Document) -> Named {
    let mut named = Named { tables: Vec::new(), unknown: Vec::new() };
    for segment in place.split(';') {
        let words = Words::of(segment, document);
        for number in &words.tables {
            match document.numbered(*number) {
                Some(id) => named.tables.push(id),
                None => named.unknown.push(*number),
            }
        }
        if words.unnumbered {
            for section in &words.sections {
                named.tables.extend(about(document, *section, at));
            }
        }
    }
    let mut seen = BTreeSet::new();
    named.tables.retain(|id| seen.insert(*id));
    named
}

/// The unnumbered tables of a section that show one of the objects.
fn about<'a>(
    document: &'a Document,
    section: usize,
    at: &'a [ErratumPlace],
) -> impl Iterator<Item = TableId> + 'a {
    let tables = document.sections.get(section).map_or(&[][..], |section| &section.tables);
    tables.iter().enumerate().filter_map(move |(table, content)| {
        let (TableContent::Overview(list) | TableContent::Objects(list)) = &content.content else {
            return None;
        };
        let shows = at.iter().any(|place| list.contains(&place.index()));
        (content.number.is_none() && shows).then_some(TableId { section, table })
    })
}

/// What one segment of a place says.
struct Words {
    tables: Vec<u32>,
    /// Positions of the sections.
    sections: Vec<usize>,
    /// Whether the unnumbered tables of the sections are meant.
    unnumbered: bool,
}

impl Words {
    fn of(segment: &str, document: &Document) -> Self {
        // A run may be written `3-5`, too.
        let text =
            segment.to_lowercase().replace("table of contents", "contents").replace(['-', '–'], " to ");
        let words: Vec<&str> = text
            .split(|sign: char| sign.is_whitespace() || matches!(sign, ',' | '(' | ')' | ':'))
            .map(|word| word.trim_end_matches('.'))
            .filter(|word| !word.is_empty())
            .collect();
        let mut read = Self { tables: Vec::new(), sections: Vec::new(), unnumbered: false };
        let (mut others, mut at) = (Vec::new(), 0);
        while let Some(word) = words.get(at) {
            let before = at.checked_sub(1).and_then(|before| words.get(before));
            at += 1;
            if NUMBERED.contains(word) && words.get(at).is_some_and(|next| number(next).is_some()) {
                let near = before.is_some_and(|before| NEAR.contains(before));
                let used = numbers(&words[at..], |first, last| {
                    if !near {
                        read.tables.extend(first..=last);
                    }
                });
                at += used;
            } else if let Some(section) = document.section_position(word) {
                let first = match (before, read.sections.last()) {
                    (Some(before), Some(last)) if TO.contains(before) => last + 1,
                    _ => section,
                };
                read.sections.extend(first.min(section)..=section);
            } else if !AND.contains(word) && !TO.contains(word) {
                others.push(*word);
            }
        }
        read.unnumbered = if others.is_empty() {
            read.tables.is_empty()
        } else {
            others.iter().any(|word| UNNUMBERED.contains(word))
        };
        read
    }
}

fn number(word: &str) -> Option<u32> {
    word.parse().ok()
}

/// Reads a list of table numbers and says how many words it took.
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
            (None, _) if AND.contains(word) || TO.contains(word) => {
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
    use crate::model::{Index, Section, Table, Text};

    fn document() -> Document {
        let table = |number, indices: &[u16]| Table {
            number,
            title: Text::default(),
            content: TableContent::Objects(indices.iter().map(|index| Index(*index)).collect()),
        };
        let section =
            |number: &str, tables| Section { number: number.to_owned(), title: Text::default(), tables };
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
        let named = read(place, &[ErratumPlace::Object(Index(0x2000))], &document());
        let tables = named.tables.iter().map(|id| format!("{}.{}", id.section, id.table));
        let unknown = named.unknown.iter().map(|number| format!("?{number}"));
        tables.chain(unknown).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn numbers_name_numbered_tables() {
        assert_eq!(tables("1.1, Table 2"), "1.1");
        assert_eq!(tables("Tables 1 and 3, whole manual"), "0.0 3.0");
        assert_eq!(tables("1 and Tabellen 1 bis 3"), "0.0 1.1 3.0");
        assert_eq!(tables("caption of Table 2; Table 3"), "1.1 3.0");
        assert_eq!(tables("Table 9, and 1.2, text"), "?9");
        assert_eq!(tables("Tables 1-3."), "0.0 1.1 3.0");
        assert_eq!(tables("1.1, text below Table 2"), "");
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
