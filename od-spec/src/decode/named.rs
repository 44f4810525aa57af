//! What texts name: tables, figures and sections of the manual, and objects. Whether they exist is looked up later.

use std::sync::LazyLock;

use super::texts::WrittenText;
use crate::ast::{Named, TextMention};
use crate::running_text::{indices, mentions};
use crate::source::Span;
use crate::wording::Language;
use crate::yaml::{Node, NodeKind};

/// Parts whose texts are about what other issues of the manual print.
const ABOUT_OTHER_ISSUES: [&str; 4] = ["errata", "history", "revision", "source"];

/// What stands before an object that is meant, in small letters.
static POINTERS: LazyLock<Vec<&str>> =
    LazyLock::new(|| ["see", "object", "objects"].into_iter().flat_map(Language::words_of_all).collect());

/// What the texts of a specification name, in the order of its keys.
pub(super) fn read(texts: &[WrittenText<'_>]) -> Vec<TextMention> {
    let mut found = Vec::new();
    for text in texts.iter().filter(|text| !ABOUT_OTHER_ISSUES.contains(&text.part)) {
        in_text(text.node, &mut found);
    }
    found
}

fn in_text(node: &Node, found: &mut Vec<TextMention>) {
    if let NodeKind::Map(entries) = &node.kind {
        for (_, node) in entries {
            in_text(node, found);
        }
        return;
    }
    let Some(text) = node.text() else { return };
    let mut add = |place: Span, named: Named| found.push(TextMention { place, named });
    for one in mentions(text.value) {
        add(text.span, Named::Numbered(one.kind, one.number.to_owned()));
    }
    for one in indices(text.value).filter(|one| is_pointed_at(&text.value[..one.start])) {
        add(text.span, Named::Object(one.id.index));
    }
}

/// Whether the word before an index says that an object is meant: four digits with an `h` are often a value or an error code.
fn is_pointed_at(before: &str) -> bool {
    let before = before.trim_end_matches([' ', '\u{a0}', '(']);
    let word = before.rsplit(|sign: char| !sign.is_alphabetic()).next().unwrap_or_default().to_lowercase();
    POINTERS.contains(&word.as_str())
}
