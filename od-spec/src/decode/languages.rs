//! Texts are in the languages that the specification lists: one in another language would never be shown, and one that lacks a
//! language is shown in another.

use super::shape::named_once;
use super::texts::WrittenText;
use crate::ast::Untranslated;
use crate::diag::{Diagnostic, Diagnostics, Repeated, codes, shorten};
use crate::source::Spanned;
use crate::yaml::{Node, NodeKind};

/// Checks that texts are in the languages that are listed; without `languages:`, in English.
pub(super) fn check(root: &Node, texts: &[WrittenText<'_>], diagnostics: &mut Diagnostics) {
    named_once(root.get("languages").map(Node::items).unwrap_or_default(), diagnostics);
    let listed = listed(root);
    let names: Vec<&str> =
        if listed.is_empty() { vec!["en"] } else { listed.iter().map(|name| name.value).collect() };
    for text in texts {
        unlisted(text.node, &names, diagnostics);
    }
}

/// The languages that are listed.
fn listed(root: &Node) -> Vec<Spanned<&str>> {
    root.get("languages").map(Node::items).unwrap_or_default().iter().filter_map(Node::text).collect()
}

/// The texts that lack a language, and says how many there are of each.
pub(super) fn untranslated(
    root: &Node,
    texts: &[WrittenText<'_>],
    diagnostics: &mut Diagnostics,
) -> Vec<Untranslated> {
    let (mut found, listed) = (Vec::new(), listed(root));
    let is_listed = |name: &str| listed.iter().any(|one| one.value == name);
    for (at, language) in listed.iter().enumerate() {
        if listed[..at].iter().any(|before| before.value == language.value) {
            continue;
        }
        let mut incomplete = Repeated::new();
        let mut plain = 0;
        for WrittenText { node, .. } in texts {
            let place = match &node.kind {
                NodeKind::Map(entries) => {
                    // One that is misspelt is reported as that.
                    if !entries.iter().all(|(name, _)| is_listed(&name.value)) {
                        continue;
                    }
                    let text = entries.iter().find(|(name, _)| name.value == language.value);
                    let (place, fault) = match text {
                        None => (node.span, "is missing"),
                        Some((_, node)) if is_empty(node) => (node.span, "is empty"),
                        Some(_) => continue,
                    };
                    let message = format!("`{}`, which `languages:` lists, {fault}", language.value);
                    incomplete.add(place, [], || {
                        Diagnostic::new(codes::NO_TRANSLATION, place, message)
                            .help("add the text; `odgen check --translations` lists all that is missing")
                    });
                    place
                }
                // A plain text is in the first language.
                NodeKind::Scalar { .. } if at > 0 => {
                    plain += 1;
                    node.span
                }
                _ => continue,
            };
            found.push(Untranslated { place, language: language.value.to_owned() });
        }
        incomplete.finish("texts", diagnostics);
        if plain > 0 {
            let texts = if plain == 1 { "text is" } else { "texts are" };
            let message = format!("{plain} {texts} not in `{}`", language.value);
            diagnostics
                .push(Diagnostic::new(codes::ONE_LANGUAGE, language.span, message).help(
                    "`odgen check --translations` lists them; documents show them in another language",
                ));
        }
    }
    found
}

/// Whether a text has nothing to read.
fn is_empty(node: &Node) -> bool {
    node.text().is_none_or(|text| text.value.trim().is_empty())
}

/// Reports languages of a text that are not listed.
fn unlisted(node: &Node, listed: &[&str], diagnostics: &mut Diagnostics) {
    for (name, _) in node.entries().iter().filter(|(name, _)| !listed.contains(&name.value.as_str())) {
        let message = format!("`languages:` does not list `{}`", shorten(&name.value));
        let diagnostic = Diagnostic::new(codes::UNKNOWN_REFERENCE, name.span, message);
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
