//! A specification in several files.
//!
//! `parts:` names files whose sections belong to the file that names them. They are joined as trees, before anything is read
//! from them: a section reads the same whichever file it is in, and every value keeps its place.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::decode;
use crate::diag::{Diagnostic, Diagnostics, codes, shorten};
use crate::files::{self, Loader};
use crate::keys::{Need, PART, PART_OF, PARTS};
use crate::source::{FileId, SourceMap, Span, Spanned};
use crate::yaml::{self, Node, NodeKind};

/// Joins the parts of a specification to it. `None` when one is missing or the tree is that of a part: without the whole,
/// everything that is elsewhere would be reported as missing. A tree that is kept is copied first.
pub(crate) fn join(
    sources: &mut SourceMap,
    root: &mut Arc<Node>,
    loader: &mut dyn Loader,
    diagnostics: &mut Diagnostics,
) -> Option<()> {
    let whole = root.span.file;
    let from = sources.file(whole).name().to_owned();
    let names = root.get(PARTS).map(Node::items).unwrap_or_default().iter().filter_map(Node::text);
    let names: Vec<Spanned<String>> =
        names.map(|name| Spanned::new(name.value.to_owned(), name.span)).collect();
    let (mut seen, mut complete) = (BTreeMap::new(), true);
    for name in &names {
        if let Some(first) = seen.insert(name.value.as_str(), name.span) {
            diagnostics.push(files::twice("part", first, name));
            continue;
        }
        match part(sources, name, (whole, &from), loader, diagnostics) {
            Some(part) => take(Arc::make_mut(root), Arc::unwrap_or_clone(part), diagnostics),
            None => complete = false,
        }
    }
    complete.then_some(())
}

/// The file that a text says it is a part of, from its lines alone, because a caller with many files should not have to
/// parse them all.
pub fn part_of(text: &[u8]) -> Option<&str> {
    let begins_a_line = |at: &usize| at.checked_sub(1).is_none_or(|before| text[before] == b'\n');
    let at = memchr::memmem::find_iter(text, PART_OF).find(begins_a_line)?;
    let line = text[at + PART_OF.len()..].split(|byte| *byte == b'\n').next()?;
    let value = std::str::from_utf8(line).ok()?.trim_start().strip_prefix(':')?;
    let plain = value.split(" #").next().unwrap_or(value).trim();
    let quoted = |quote| plain.strip_prefix(quote).and_then(|rest: &str| rest.strip_suffix(quote));
    let name = quoted('"').or_else(|| quoted('\'')).unwrap_or(plain);
    (!name.is_empty()).then_some(name)
}

/// Refuses a part that is read by itself.
pub(crate) fn refuse_alone(root: &Node, diagnostics: &mut Diagnostics) -> Option<()> {
    let Some(whole) = root.get(PART_OF) else { return Some(()) };
    let name = whole.text().map_or("the specification", |name| name.value);
    let message = format!("this file is a part of `{}`, and says nothing by itself", shorten(name));
    let help = format!("compile `{}`, which names its parts under `{PARTS}:`", shorten(name));
    diagnostics.push(Diagnostic::new(codes::PART_ALONE, whole.span, message).help(help));
    None
}

/// Reads a part, and says what is wrong with its keys.
fn part(
    sources: &mut SourceMap,
    name: &Spanned<String>,
    (whole, from): (FileId, &str),
    loader: &mut dyn Loader,
    diagnostics: &mut Diagnostics,
) -> Option<Arc<Node>> {
    let text = match files::read(name, from, loader, missing, |name| no_part(name, from)) {
        Ok(text) => text,
        Err(diagnostic) => {
            diagnostics.push(*diagnostic);
            return None;
        }
    };
    let file = sources.add_part(files::beside(from, &name.value), text, whole);
    let part = loader.tree(file, sources.file(file), diagnostics)?;
    let Some(stated) = part.get(PART_OF) else {
        diagnostics.push(no_part(name, from));
        return None;
    };
    say_whose(stated, name.span, from, diagnostics);
    decode::check(&part, &PART, diagnostics);
    Some(part)
}

fn no_part(name: &Spanned<String>, from: &str) -> Diagnostic {
    let message = format!("`{}` does not say that it is a part", shorten(&name.value));
    let help = format!("write `{PART_OF}: {}` at its top; a library is named under `uses:`", file_name(from));
    Diagnostic::new(codes::NOT_A_PART, name.span, message).help(help)
}

fn missing(name: &Spanned<String>, reason: &str) -> Diagnostic {
    let message = format!("cannot read the part `{}`: {reason}", shorten(&name.value));
    Diagnostic::new(codes::MISSING_PART, name.span, message).help("name a file relative to this one")
}

/// A part names the file that it is read for, so that a person who opens it finds the rest.
fn say_whose(part_of: &Node, named: Span, from: &str, diagnostics: &mut Diagnostics) {
    let stated = part_of.text().map_or("", |name| name.value);
    if file_name(stated) != file_name(from) {
        let message = format!("this part says that it belongs to `{}`", shorten(stated));
        let help = format!("write `{PART_OF}: {}`", file_name(from));
        let diagnostic = Diagnostic::new(codes::NOT_A_PART, part_of.span, message);
        diagnostics.push(diagnostic.with(named, "it is read for this file").help(help));
    }
}

fn file_name(path: &str) -> &str {
    path.rsplit(['/', '\\', ':']).next().unwrap_or(path)
}

/// Puts the sections of a part after those of the specification. What is not a section was refused already.
fn take(root: &mut Node, part: Node, diagnostics: &mut Diagnostics) {
    let (NodeKind::Map(sections), NodeKind::Map(taken)) = (&mut root.kind, part.kind) else { return };
    let is_section = |key: &str| PART.get(key).is_some_and(|key| key.need != Need::Required);
    for (name, node) in taken.into_iter().filter(|(name, _)| is_section(&name.value)) {
        match sections.iter_mut().find(|(section, _)| section.value == name.value) {
            Some((_, section)) => extend(section, node, diagnostics),
            None => sections.push((name, node)),
        }
    }
}

/// Puts what a section of a part holds after what the section of the specification holds.
fn extend(section: &mut Node, more: Node, diagnostics: &mut Diagnostics) {
    match (&mut section.kind, more.kind) {
        (NodeKind::Map(entries), NodeKind::Map(more)) => {
            let mut first: BTreeMap<String, Span> =
                entries.iter().map(|(name, _)| (name.value.clone(), name.span)).collect();
            for (name, node) in more {
                match first.get(&name.value) {
                    Some(first) => diagnostics.push(yaml::stands_twice(&name, *first)),
                    None => {
                        first.insert(name.value.clone(), name.span);
                        entries.push((name, node));
                    }
                }
            }
        }
        (NodeKind::List(items), NodeKind::List(more)) => items.extend(more),
        (NodeKind::Null, more) => *section = Node { span: section.span, kind: more },
        // An empty section adds nothing, and what is of the wrong kind was said to be.
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::part_of;

    #[test]
    fn a_part_is_known_by_its_line() {
        assert_eq!(part_of(b"od-spec: 1\npart-of: ../lamp.od.yaml # the lamp\n"), Some("../lamp.od.yaml"));
        assert_eq!(part_of(b"part-of : 'a lamp.od.yaml'"), Some("a lamp.od.yaml"));
        assert_eq!(part_of(b"part-of:\t\"x\"\r\nunits:"), Some("x"));
        for nothing in [
            &b"title: part-of: x\n"[..],
            b"  part-of: x",
            b"part-of:\n",
            b"part-of-it: x",
            b"part-of: \xff",
            b"",
        ] {
            assert_eq!(part_of(nothing), None);
        }
    }
}
