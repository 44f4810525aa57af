//! The language reference: chapters in Markdown, with the key tables in them.
//!
//! What a single key means is in [`od_spec::keys`] and nowhere else; the chapters are about several keys together. In their
//! texts a mark in braces is replaced by a table: `{KEYS an object}` for the section about the keys of an object, `{STORAGE}`
//! for words of the language. A link names a heading of any chapter: `[an entry](#entry)`.

mod features;
mod index;
mod tables;
mod words;

use crate::json_schema::{reachable, reachable_in_plants};
use crate::page::{NOTICE, Page};
use od_spec::keys::{CONSUMER, Keys, PARAMETER_FILE};
use od_spec::model::DataType;
use words::WORD_TABLES;

/// A chapter: the name of its page, and its text with marks.
struct Chapter {
    page: &'static str,
    text: &'static str,
}

macro_rules! chapters {
    ($($page:literal)+) => {
        [$(Chapter { page: $page, text: include_str!(concat!("chapters/", $page)) },)+]
    };
}

/// The chapters, in order.
static CHAPTERS: [Chapter; 21] = chapters! {
    "index.md" "reading.md" "file.md" "names.md" "devices.md" "types.md" "objects.md" "arrays-and-records.md" "values.md"
    "aliases.md" "libraries.md" "pdos.md" "errors.md" "state-machines.md" "constraints.md" "texts.md" "eds.md" "manual.md"
    "errata.md" "parameter-files.md" "plants.md"
};

/// Prints the language reference as one text.
pub fn reference() -> String {
    let marks = marks();
    CHAPTERS.iter().map(|chapter| printed(chapter, &marks)).collect::<Vec<_>>().join("\n")
}

/// The pages of the language reference: an overview and one for each chapter.
pub fn language_pages() -> Vec<Page> {
    let marks = marks();
    let texts: Vec<String> = CHAPTERS.iter().map(|chapter| printed(chapter, &marks)).collect();
    let headings: Vec<(&str, String)> = CHAPTERS
        .iter()
        .zip(&texts)
        .flat_map(|(chapter, text)| anchors(text).map(move |anchor| (chapter.page, anchor)))
        .collect();
    let pages = CHAPTERS.iter().zip(&texts).map(|(chapter, text)| {
        let text = with_links_to_pages(text, chapter.page, &headings);
        Page { file: chapter.page.to_owned(), text: format!("{text}\n{NOTICE}\n") }
    });
    pages.collect()
}

/// A chapter with its tables.
fn printed(chapter: &Chapter, marks: &[(String, Table)]) -> String {
    marks.iter().fold(chapter.text.to_owned(), |text, (mark, table)| match table {
        Table::Text(table) => text.replace(mark, table),
        Table::Keys(keys) => {
            // A chapter with headings of its own has the sections of keys below them.
            let before = chapter.text.split(mark.as_str()).next().unwrap_or_default();
            let level = if before.contains("\n## ") { "###" } else { "##" };
            text.replace(mark, &tables::section(keys, level))
        }
    })
}

/// What replaces a mark in a chapter.
enum Table {
    /// A text.
    Text(String),
    /// The section about keys.
    Keys(&'static Keys),
}

/// The tables of keys that have a section.
fn key_tables() -> impl Iterator<Item = &'static Keys> {
    reachable().into_iter().chain([&CONSUMER, &PARAMETER_FILE]).chain(reachable_in_plants())
}

/// The marks, each with what replaces it.
fn marks() -> Vec<(String, Table)> {
    let keys = key_tables().map(|keys| (format!("{{KEYS {}}}", keys.name), Table::Keys(keys)));
    let words = WORD_TABLES.iter().map(|words| (words.mark, words.markdown()));
    let types = DataType::ALL.map(|data_type| format!("`{}`", data_type.name())).join(", ");
    let others = [
        ("{TYPES}", types),
        ("{FEATURES}", features::features()),
        ("{CHAPTERS}", index::chapters()),
        ("{INDEX}", index::keys()),
    ];
    let texts = words.chain(others).map(|(mark, text)| (mark.to_owned(), Table::Text(text)));
    keys.chain(texts).collect()
}

/// The anchors of the headings of a text.
fn anchors(text: &str) -> impl Iterator<Item = String> {
    let mut is_code = false;
    let headings = text.lines().filter(move |line| {
        is_code ^= line.starts_with("```");
        !is_code && line.starts_with('#')
    });
    headings.map(|line| {
        line.trim_start_matches('#').trim().to_lowercase().replace(' ', "-").replace(['\'', ','], "")
    })
}

/// A text in which a link to a heading of another chapter leads to the page of that chapter.
fn with_links_to_pages(text: &str, page: &str, headings: &[(&str, String)]) -> String {
    let mut parts = text.split("](#");
    let mut out = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let anchor = part.split(')').next().unwrap_or_default();
        let target =
            headings.iter().find(|(_, heading)| heading == anchor).map_or(page, |(target, _)| *target);
        out.push_str("](");
        out.push_str(if target == page { "" } else { target });
        out.push('#');
        out.push_str(part);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_table_is_in_one_chapter() {
        let chapters: String = CHAPTERS.iter().map(|chapter| chapter.text).collect();
        for (mark, _) in marks() {
            assert_eq!(chapters.matches(&mark).count(), 1, "{mark}");
        }
        // A mark without a meaning would be printed as it is. A map in an example has a colon.
        let text = reference();
        let is_mark = |inner: &&str| inner.starts_with(char::is_uppercase) && !inner.contains(':');
        let braces = text.split('{').skip(1).filter_map(|rest| rest.split('}').next());
        assert_eq!(braces.filter(is_mark).collect::<Vec<_>>(), [""; 0]);
    }

    #[test]
    fn every_chapter_is_printed() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/src/language/chapters");
        let files = std::fs::read_dir(folder).unwrap().map(|file| file.unwrap().file_name());
        let files: Vec<String> = files.map(|name| name.to_str().unwrap().to_owned()).collect();
        assert!(files.iter().all(|file| CHAPTERS.iter().any(|chapter| chapter.page == file)));
        assert_eq!(files.len(), CHAPTERS.len());
    }

    #[test]
    fn every_chapter_begins_with_a_sentence_and_an_example() {
        for Chapter { page, text } in &CHAPTERS {
            let mut parts = text.split("\n\n");
            assert!(parts.next().is_some_and(|title| title.starts_with("# ")), "{page}");
            assert!(
                parts.next().is_some_and(|about| about.ends_with('.') && !about.contains('\n')),
                "{page}"
            );
            assert!(parts.next().is_some_and(|example| example.starts_with("```yaml\n")), "{page}");
        }
    }

    #[test]
    fn every_link_leads_to_one_heading() {
        let text = reference();
        let anchors: Vec<String> = anchors(&text).collect();
        for link in text.split("](#").skip(1).filter_map(|rest| rest.split(')').next()) {
            assert_eq!(anchors.iter().filter(|anchor| *anchor == link).count(), 1, "#{link}");
        }
        let messages: Vec<&str> = text.split("](../messages/").skip(1).collect();
        for code in &messages {
            assert!(od_spec::code(&code[..6]).is_some() && code[6..].starts_with(".md)"), "{}", &code[..6]);
        }
        assert!(messages.len() >= 5);
    }
}
