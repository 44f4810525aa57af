//! The features of the built-in libraries, in the words of the libraries.

use std::fmt::Write as _;

use super::tables::cell;
use od_spec::yaml::Node;
use od_spec::{LIBRARIES, features_of_text};

/// One table for each library.
pub(super) fn features() -> String {
    let mut out = String::new();
    for (name, text) in LIBRARIES {
        out.push_str(if out.is_empty() { "" } else { "\n" });
        let _ =
            write!(out, "Of the library `{name}`:\n\n| Feature | Objects | Meaning |\n| --- | --- | --- |\n");
        for (feature, facts) in features_of_text(name, text) {
            let text = |key: &str| facts.get(key).and_then(Node::text).map_or("", |text| text.value);
            let objects: Vec<&str> = facts
                .get("objects")
                .map(Node::items)
                .unwrap_or_default()
                .iter()
                .filter_map(|index| index.text()?.value.strip_prefix("0x"))
                .collect();
            let objects = objects.iter().map(|index| format!("{index}h")).collect::<Vec<_>>().join(", ");
            let implied = if text("implied") == "yes" { ", implied" } else { "" };
            let number = if facts.get("channels").is_some() && facts.get("channels-of").is_none() {
                ": N"
            } else {
                ""
            };
            let about = facts.get("about").map(english).unwrap_or_default();
            let _ = writeln!(out, "| `{}{number}`{implied} | {objects} | {} |", feature, cell(about));
        }
    }
    out.truncate(out.trim_end().len());
    out
}

/// A text, or what it is in English.
fn english(words: &Node) -> &str {
    words.text().or_else(|| words.get("en")?.text()).map_or("", |text| text.value)
}
