//! The tables of the overview: the chapters, and all keys.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::tables::{explained, short_link};
use super::{CHAPTERS, anchors, key_tables};

/// Each chapter after the overview, with its first sentence.
pub(super) fn chapters() -> String {
    let mut out = String::from("| Chapter | About |\n| --- | --- |");
    for chapter in &CHAPTERS[1..] {
        let mut parts = chapter.text.split("\n\n");
        let title = parts.next().unwrap_or_default().trim_start_matches("# ");
        let anchor = anchors(chapter.text).next().unwrap_or_default();
        let _ = write!(out, "\n| [{title}](#{anchor}) | {} |", parts.next().unwrap_or_default());
    }
    out
}

/// Each key, with the maps that have it.
pub(super) fn keys() -> String {
    let mut maps: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for keys in key_tables() {
        for key in explained(keys) {
            maps.entry(key.name).or_default().push(short_link(keys));
        }
    }
    let mut out = String::from("| Key | Allowed in |\n| --- | --- |");
    for (key, links) in maps {
        let _ = write!(out, "\n| `{key}` | {} |", links.join(", "));
    }
    out
}
