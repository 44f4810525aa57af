//! Texts are in the languages that the specification lists: a text in another one would never be shown.

use super::shape::named_once;
use crate::diag::{Diagnostic, Diagnostics, codes, shorten};
use crate::keys::{Keys, Shape};
use crate::yaml::{Node, NodeKind};

/// Checks a specification; without `languages:` it has English only.
pub(super) fn check(root: &Node, keys: &Keys, diagnostics: &mut Diagnostics) {
    let languages = root.get("languages").map(Node::items).unwrap_or_default();
    named_once(languages, diagnostics);
    let listed: Vec<&str> = languages.iter().filter_map(text).collect();
    let listed = if listed.is_empty() { vec!["en"] } else { listed };
    in_map(root, keys, &listed, diagnostics);
}

fn text(node: &Node) -> Option<&str> {
    node.text().map(|text| text.value)
}

fn in_map(node: &Node, keys: &Keys, listed: &[&str], diagnostics: &mut Diagnostics) {
    // A scalar is in the first language, or in none.
    let parents = node.entries().iter().filter(|(_, value)| !matches!(value.kind, NodeKind::Scalar { .. }));
    for (name, value) in parents {
        if let Some(key) = keys.get(&name.value) {
            in_value(value, key.shape, listed, diagnostics);
        }
    }
}

fn in_value(node: &Node, shape: Shape, listed: &[&str], diagnostics: &mut Diagnostics) {
    match (shape, &node.kind) {
        (Shape::Words, NodeKind::Map(entries)) => {
            for (name, _) in entries.iter().filter(|(name, _)| !listed.contains(&name.value.as_str())) {
                let diagnostic = Diagnostic::new(
                    codes::UNKNOWN_REFERENCE,
                    name.span,
                    format!("`languages:` does not list `{}`", shorten(&name.value)),
                );
                let meant = diagnostics.suggestions.nearest(&name.value, listed.iter().copied());
                diagnostics.push(match meant {
                    Some(word) => {
                        let help = format!("add it to `languages:`, or did you mean `{word}`?");
                        diagnostic.help(help).meant(word)
                    }
                    None => diagnostic.help("add the language to `languages:` at the top of the file"),
                });
            }
        }
        (Shape::Map(keys) | Shape::ShortOr(_, keys), _) => in_map(node, keys, listed, diagnostics),
        (Shape::MapOf(_, value), NodeKind::Map(entries)) => {
            for (_, node) in entries {
                in_value(node, *value, listed, diagnostics);
            }
        }
        (Shape::List(item) | Shape::OneOrMore(item), NodeKind::List(items)) => {
            for node in items {
                in_value(node, *item, listed, diagnostics);
            }
        }
        (Shape::OneOrMore(item), _) => in_value(node, *item, listed, diagnostics),
        _ => {}
    }
}
