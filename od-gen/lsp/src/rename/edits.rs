//! The changes of the texts: each scalar stays as it is written, quotes included, as far as the new name allows.

use std::collections::BTreeMap;
use std::ops::Range;

use od_import::yaml::spelled;
use od_spec::diag::Diagnostics;
use od_spec::names::{By, DefinitionId, Names};
use od_spec::order::Arrange as _;
use od_spec::source::{SourceMap, Span};
use od_spec::yaml::{Node, parse};

/// A part of the text of a scalar, and what is written there afterwards; without a range, the whole.
type Part = (Option<Range<usize>>, String);

/// What is to be written in the place of scalars, or of parts of them.
pub(super) fn edits(
    sources: &SourceMap,
    names: &Names,
    renamed: &BTreeMap<DefinitionId, String>,
) -> Result<Vec<(Span, String)>, String> {
    let mut scalars: BTreeMap<Span, Vec<Part>> = BTreeMap::new();
    for (id, name) in renamed {
        scalars.entry(names.definition(*id).span).or_default().push((None, name.clone()));
    }
    for one in names.references().iter().filter(|one| one.by == By::Name) {
        let Some(name) = one.targets.iter().find_map(|id| renamed.get(id)) else { continue };
        scalars.entry(one.scalar).or_default().push((Some(one.range.clone()), name.clone()));
    }
    let mut edits = Vec::with_capacity(scalars.len());
    for (span, parts) in scalars {
        // An alias shows the value of its anchor, which is changed itself.
        let written = sources.text(span);
        if written.starts_with('*') {
            continue;
        }
        let new = rewritten(written, parts).ok_or_else(|| {
            format!("{}: the name is in a text of several lines; write that on one line", sources.place(span))
        })?;
        edits.push((span, new));
    }
    Ok(edits)
}

/// A scalar with other parts, as it is written.
fn rewritten(written: &str, mut parts: Vec<Part>) -> Option<String> {
    let text = text_of(written)?;
    parts.arrange_by_key(|(range, _)| std::cmp::Reverse(range.as_ref().map_or(0, |range| range.start)));
    parts.dedup();
    let mut new = text.clone();
    let whole = || 0..text.len();
    for (range, name) in &parts {
        new.replace_range(range.clone().unwrap_or_else(whole), name);
    }
    match written.chars().next() {
        Some('\'') if is_printable(&new) => Some(format!("'{}'", new.replace('\'', "''"))),
        Some('"') if is_printable(&new) => {
            Some(format!("\"{}\"", new.replace('\\', "\\\\").replace('"', "\\\"")))
        }
        Some('"' | '\'') => Some(spelled(&new)),
        _ if written == text => {
            // What is not in brackets is in lines, where more is allowed.
            let stays = if holds_in_brackets(&text) { holds_in_brackets(&new) } else { holds_in_lines(&new) };
            Some(if stays { new } else { spelled(&new) })
        }
        // Several lines, or a block scalar: the parts are written there as they are.
        _ => in_lines(written, &text, &parts),
    }
}

fn is_printable(text: &str) -> bool {
    !text.chars().any(char::is_control)
}

/// The text of a scalar as it is written; `None` where it has no end.
fn text_of(written: &str) -> Option<String> {
    let mut sources = SourceMap::new();
    let text = if written.starts_with(['"', '\'']) {
        format!("- {written}\n")
    } else {
        format!("- |-\n  {written}\n")
    };
    if !written.starts_with(['"', '\'']) && !written.contains('\n') {
        return Some(written.to_owned());
    }
    let file = sources.add("scalar", text);
    let tree = parse(file, sources.file(file), &mut Diagnostics::new())?;
    let text = tree.items().first()?.text()?.value.to_owned();
    // Lines that are folded where they are.
    Some(if written.starts_with(['"', '\'']) {
        text
    } else {
        text.split('\n').map(str::trim).collect::<Vec<_>>().join(" ")
    })
}

/// Whether a text can be written without quotes as a key and as a value in lines.
fn holds_in_lines(text: &str) -> bool {
    reads(&format!("a: {text}\n{text}: f\n"), |tree| is_text(tree.get("a"), text) && tree.get(text).is_some())
}

/// Whether this also holds in brackets.
fn holds_in_brackets(text: &str) -> bool {
    holds_in_lines(text)
        && reads(&format!("b: {{c: {text}, {text}: d, e: [{text}]}}\n"), |tree| {
            let Some(map) = tree.get("b") else { return false };
            let first = map.get("e").and_then(|list| list.items().first());
            is_text(map.get("c"), text) && map.get(text).is_some() && is_text(first, text)
        })
}

fn is_text(node: Option<&Node>, text: &str) -> bool {
    node.and_then(Node::text).is_some_and(|read| read.value == text)
}

/// Whether a document can be read, and is as it should be.
fn reads(document: &str, is_right: impl FnOnce(&Node) -> bool) -> bool {
    let mut sources = SourceMap::new();
    let file = sources.add("scalar", document);
    parse(file, sources.file(file), &mut Diagnostics::new()).is_some_and(|tree| is_right(&tree))
}

/// Replaces parts in several lines, if each of them is there as often as in the text.
fn in_lines(written: &str, text: &str, parts: &[Part]) -> Option<String> {
    let mut new = written.to_owned();
    // From the last to the first, as they are sorted.
    for (range, name) in parts {
        let range = range.clone()?;
        let old = text.get(range.clone())?;
        let number = text[..range.start].matches(old).count();
        let (is_same, at) = {
            let mut found = written.match_indices(old);
            (written.matches(old).count() == text.matches(old).count(), found.nth(number)?.0)
        };
        if !is_same {
            return None;
        }
        new.replace_range(at..at + old.len(), name);
    }
    Some(new)
}
