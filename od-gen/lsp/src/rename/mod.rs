//! Another name for something, in all files of a specification.
//!
//! A rename is tried before it is given out: the changed texts are compiled, and whatever is new about them – a message, a
//! reference that leads elsewhere – is a reason to refuse it.

mod edits;
mod nodes;
#[cfg(test)]
mod tests;
mod trial;

use std::collections::{BTreeMap, BTreeSet};

use lsp_types::{Position, PrepareRenameResponse, Range, TextEdit, Uri, WorkspaceEdit};
use od_spec::names::{By, Definition, DefinitionId, Found, Kind, Names, Spelling};
use od_spec::source::Span;

use super::analysis::{self, Analysis};
use super::cursor::Cursor;
use super::position::Encoding;
use super::snapshot::Snapshot;
use super::workspace::Workspace;

/// The range of the name at a position, and the name; or why it cannot be another one.
pub(super) fn prepare(snapshot: &Snapshot, position: Position) -> Result<PrepareRenameResponse, String> {
    let (cursor, span) = named(snapshot, position)?;
    let one = cursor.names.definition(meant(&cursor)?);
    Ok(PrepareRenameResponse::RangeWithPlaceholder {
        range: inner_range(snapshot, span),
        placeholder: one.name.clone(),
    })
}

/// The changes that give what is at a position another name, in the specification and in the parameter files and plants that
/// name it; or why it cannot have that.
pub(super) fn rename(
    snapshot: &Snapshot,
    position: Position,
    name: &str,
    workspace: &mut Workspace,
) -> Result<WorkspaceEdit, String> {
    let (cursor, _) = named(snapshot, position)?;
    let name = name.trim();
    let first = meant(&cursor)?;
    let names = cursor.names;
    let all = same(names, first);
    let one = names.definition(first);
    is_possible(names, one, &all, name)?;
    let renamed: BTreeMap<DefinitionId, String> = all.iter().map(|id| (*id, name.to_owned())).collect();
    let changes = edits::edits(&snapshot.now.sources, names, &renamed)?;
    trial::check(&snapshot.now, &changes)?;
    let mut edits = text_edits(&snapshot.now, changes.iter(), snapshot.encoding)?;
    for (analysis, changes) in nodes::changes(&snapshot.now, &renamed, &changes, workspace)? {
        edits.extend(text_edits(&analysis, changes.iter(), snapshot.encoding)?);
    }
    Ok(WorkspaceEdit { changes: Some(edits.into_iter().collect()), ..WorkspaceEdit::default() })
}

/// Changes of the files of an analysis, as the protocol has them.
fn text_edits<'c>(
    analysis: &Analysis,
    changes: impl Iterator<Item = &'c (Span, String)>,
    encoding: Encoding,
) -> Result<Vec<(Uri, Vec<TextEdit>)>, String> {
    let mut by_file: BTreeMap<_, Vec<TextEdit>> = BTreeMap::new();
    for (span, new_text) in changes {
        let edit = TextEdit { range: analysis.range(*span, encoding), new_text: new_text.clone() };
        by_file.entry(span.file).or_default().push(edit);
    }
    let edits = by_file.into_iter().map(|(file, edits)| {
        let uri = analysis.uri(file).cloned();
        uri.map(|uri| (uri, edits)).ok_or_else(|| "a file of the specification has no address".to_owned())
    });
    edits.collect()
}

/// The place with a name in it, and the name's.
fn named(snapshot: &Snapshot, position: Position) -> Result<(Cursor<'_>, Span), String> {
    let nothing = || "there is no name here".to_owned();
    let cursor = Cursor::of(snapshot, position).ok_or_else(nothing)?;
    let now = &snapshot.now;
    let broken = now.files().find(|file| now.is_yaml(*file) && now.tree(*file).is_none());
    if let Some(file) = broken {
        let name = snapshot.now.sources.file(file).name();
        return Err(format!(
            "`{name}` is not valid YAML at the moment; the references to a name are not known"
        ));
    }
    let span = match cursor.found().ok_or_else(nothing)? {
        Found::Reference(one) => match one.by {
            By::Name => one.span,
            By::Pattern => {
                return Err("this name has a number in it; rename it where it is defined".to_owned());
            }
            By::Identifier => {
                return Err("this is an identifier; edit it where it is defined".to_owned());
            }
            By::Number => return Err("this is a number; put the cursor on the name".to_owned()),
            By::Word => return Err("this word belongs to the language, or names a file".to_owned()),
        },
        Found::Definition(_, one) => {
            let is_name =
                one.span.file == snapshot.file && (one.span.start..=one.span.end).contains(&cursor.offset);
            if !is_name || one.spelling == Spelling::Elsewhere {
                return Err("this is a number; put the cursor on the name".to_owned());
            }
            one.span
        }
    };
    Ok((cursor, span))
}

/// The range of a name without the quotes around it.
fn inner_range(snapshot: &Snapshot, span: Span) -> Range {
    let text = snapshot.now.sources.text(span);
    let is_quoted = text.len() > 1 && text.starts_with(['"', '\'']) && text.ends_with(['"', '\'']);
    snapshot.range(if is_quoted { span.part(1, text.len() - 1) } else { span })
}

/// What is to be renamed.
fn meant(cursor: &Cursor<'_>) -> Result<DefinitionId, String> {
    let names = cursor.names;
    let first = cursor.definitions().first().copied();
    let first = first.ok_or_else(|| "nothing has this name".to_owned())?;
    let one = names.definition(first);
    let root = cursor.snapshot.now.root;
    for id in same(names, first) {
        let one = names.definition(id);
        if root.is_none_or(|root| !one.span.file.is_one_with(root)) {
            let file = cursor.snapshot.now.sources.file(one.span.file).name();
            return Err(match cursor.snapshot.now.kind {
                analysis::Kind::Specification => format!("`{}` is a name of the library {file}", one.name),
                _ => format!("`{}` is a name of {file}; rename it there", one.name),
            });
        }
    }
    match (one.spelling, one.kind) {
        (_, Kind::File | Kind::Library | Kind::Pdo | Kind::Transition) => {
            Err(format!("a {} has no name that could be another", one.kind.word()))
        }
        (Spelling::Written, _) => Ok(first),
        (Spelling::Pattern, _) => {
            Err(format!("`{}` means several names; edit it where it is written", one.name))
        }
        (Spelling::Elsewhere, _) => {
            Err(format!("the name of {} {} follows from something else", one.kind.word(), one.name))
        }
    }
}

/// What is one thing for those who refer to it: definitions that share a reference by name.
fn same(names: &Names, first: DefinitionId) -> BTreeSet<DefinitionId> {
    let mut all = BTreeSet::from([first]);
    loop {
        let before = all.len();
        for one in names.references().iter().filter(|one| one.by == By::Name) {
            if one.targets.iter().any(|id| all.contains(id)) {
                all.extend(&one.targets);
            }
        }
        if all.len() == before {
            return all;
        }
    }
}

/// Refuses a name that something of the same kind has, or that has another meaning there.
fn is_possible(
    names: &Names,
    one: &Definition,
    all: &BTreeSet<DefinitionId>,
    name: &str,
) -> Result<(), String> {
    if name.is_empty() {
        return Err("a name cannot be empty".to_owned());
    }
    let owners: BTreeSet<Option<DefinitionId>> = all.iter().map(|id| names.definition(*id).owner).collect();
    let clash = names.definitions().find(|(id, other)| {
        !all.contains(id)
            && other.kind == one.kind
            && other.name == name
            && other.spelling != Spelling::Elsewhere
            && owners.contains(&other.owner)
            && !matches!(one.kind, Kind::Block | Kind::Mark | Kind::Object | Kind::Error)
    });
    if clash.is_some() {
        return Err(format!("there is a {} `{name}` already", one.kind.word()));
    }
    let is_number = name.starts_with("0x") || name.starts_with(|c: char| c.is_ascii_digit());
    match one.kind {
        Kind::Device if !od_spec::is_device_key(name) => Err(format!(
            "`{name}` cannot be the key of a device: up to 32 lower-case letters, digits and hyphens"
        )),
        Kind::Type if od_spec::model::DataType::from_name(name).is_some() => {
            Err(format!("`{name}` is a data type"))
        }
        Kind::State if matches!(name, "start" | "any") => Err(format!("`{name}` is a word of transitions")),
        Kind::Bit if matches!(name, "reserved" | "unused") => {
            Err(format!("`{name}` is what bits without meaning are called"))
        }
        Kind::Object | Kind::Entry if is_number && od_spec::scalar::integer(name).is_ok() => {
            Err(format!("`{name}` would be a number where it is referred to"))
        }
        _ => Ok(()),
    }
}
