//! The language reference: chapters in Markdown, with the key tables in them.
//!
//! What a single key means stands in [`od_spec::keys`] and nowhere else; the chapters are about what several keys have to do
//! with each other. In their texts a mark in braces stands for a table: `{KEYS an object}` for the section about the keys
//! of an object, `{STORAGE}` for words of the language.

mod features;
mod tables;
mod words;

use crate::json_schema::{reachable, reachable_in_plants};
use od_spec::keys::PARAMETER_FILE;
use od_spec::model::DataType;
use words::WORD_TABLES;

/// The chapters, in order.
static CHAPTERS: [&str; 16] = [
    include_str!("chapters/introduction.md"),
    include_str!("chapters/reading.md"),
    include_str!("chapters/naming.md"),
    include_str!("chapters/file.md"),
    include_str!("chapters/devices.md"),
    include_str!("chapters/types.md"),
    include_str!("chapters/objects.md"),
    include_str!("chapters/aliases.md"),
    include_str!("chapters/libraries.md"),
    include_str!("chapters/pdos.md"),
    include_str!("chapters/errors.md"),
    include_str!("chapters/machines.md"),
    include_str!("chapters/constraints.md"),
    include_str!("chapters/manual.md"),
    include_str!("chapters/parameters.md"),
    include_str!("chapters/plants.md"),
];

/// Prints the language reference in Markdown.
pub fn reference() -> String {
    let text = CHAPTERS.join("\n");
    marks().into_iter().fold(text, |text, (mark, table)| text.replace(&mark, &table))
}

/// What stands for something else in the chapters, and for what.
fn marks() -> Vec<(String, String)> {
    let tables = reachable().into_iter().chain([&PARAMETER_FILE]).chain(reachable_in_plants());
    let keys = tables.map(|keys| (keys_mark(keys.name), tables::section(keys)));
    let words = WORD_TABLES.iter().map(|words| (words.mark.to_owned(), words.markdown()));
    let types = DataType::ALL.map(|data_type| format!("`{}`", data_type.name())).join(", ");
    let others = [("{NOTICE}", NOTICE.to_owned()), ("{TYPES}", types), ("{FEATURES}", features::features())];
    keys.chain(words).chain(others.map(|(mark, text)| (mark.to_owned(), text))).collect()
}

/// The mark of the section about one kind of map.
fn keys_mark(name: &str) -> String {
    format!("{{KEYS {name}}}")
}

/// For readers of the printed file, who would look for its text there.
const NOTICE: &str = "<!-- Printed by `cargo xtask generate` from the tables by which the compiler reads specifications. Do not edit. -->";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_table_is_in_one_chapter() {
        let chapters = CHAPTERS.concat();
        for (mark, _) in marks() {
            assert_eq!(chapters.matches(&mark).count(), 1, "{mark}");
        }
        // A mark that stands for nothing would be printed as it is. A map in an example has a colon.
        let text = reference();
        let is_mark = |inner: &&str| inner.starts_with(char::is_uppercase) && !inner.contains(':');
        let braces = text.split('{').skip(1).filter_map(|rest| rest.split('}').next());
        assert_eq!(braces.filter(is_mark).collect::<Vec<_>>(), [""; 0]);
    }

    #[test]
    fn every_chapter_is_printed() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/src/language/chapters");
        let files = std::fs::read_dir(folder).unwrap().map(|file| file.unwrap().path());
        let texts: Vec<String> = files.map(|path| std::fs::read_to_string(path).unwrap()).collect();
        assert!(texts.iter().all(|text| CHAPTERS.contains(&text.as_str())));
        assert_eq!(texts.len(), CHAPTERS.len());
    }

    #[test]
    fn every_link_leads_somewhere() {
        let text = reference();
        let anchor = |line: &str| {
            line.trim_start_matches('#').trim().to_lowercase().replace(' ', "-").replace('\'', "")
        };
        let anchors: Vec<String> = text.lines().filter(|line| line.starts_with('#')).map(anchor).collect();
        for link in text.split("](#").skip(1).filter_map(|rest| rest.split(')').next()) {
            assert!(anchors.iter().any(|anchor| anchor == link), "#{link}");
        }
    }
}
