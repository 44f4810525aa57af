//! Where something is defined, and where it is referred to.

use lsp_types::{DocumentHighlight, DocumentHighlightKind, Location, Position};
use od_spec::model::EntryId;
use od_spec::names::{DefinitionId, Found, Kind, Names, Spelling, Spot};
use od_spec::source::Span;

use super::analysis;
use super::cursor::Cursor;
use super::eds::{referring, section_of};
use super::place::beside;
use super::snapshot::Snapshot;

/// Where the name at a position is defined; on a definition, that place itself.
pub(super) fn definition(snapshot: &Snapshot, position: Position) -> Vec<Location> {
    if snapshot.now.kind == analysis::Kind::Eds {
        let found =
            entry_of_eds(snapshot, position).and_then(|id| section_of(snapshot.file, snapshot.text(), id));
        return found.and_then(|span| snapshot.location(&snapshot.now, span)).into_iter().collect();
    }
    let Some(cursor) = Cursor::of(snapshot, position) else { return Vec::new() };
    let places = cursor.definitions().into_iter().map(|id| place(cursor.names, id));
    let found: Vec<Location> = places.filter_map(|span| cursor.location(span)).collect();
    if found.is_empty() { elsewhere(&cursor).into_iter().collect() } else { found }
}

/// The entry that a value of an EDS means.
fn entry_of_eds(snapshot: &Snapshot, position: Position) -> Option<EntryId> {
    let offset = u32::try_from(snapshot.offset(position)).ok()?;
    let mut all = referring(snapshot.file, snapshot.text()).into_iter();
    Some(all.find(|one| (one.value.start..=one.value.end).contains(&offset))?.id)
}

/// What a parameter file or a plant refers to, if no specification defines it: a file, or an entry of an EDS.
fn elsewhere(cursor: &Cursor<'_>) -> Option<Location> {
    let snapshot = cursor.snapshot;
    let sources = &snapshot.now.sources;
    if let Some(Found::Reference(one)) = cursor.found()
        && let (Some(id), Some(root)) = (one.entry, snapshot.root())
    {
        return cursor.location(section_of(root, sources.file(root).text(), id)?);
    }
    let Spot::Value { node, .. } = cursor.place()?.spot else { return None };
    let named = beside(sources.file(snapshot.file).name(), node.text()?.value);
    let (file, _) = sources.files().find(|(id, file)| *id != snapshot.file && file.name() == named)?;
    cursor.location(Span { file, start: 0, end: 0 })
}

/// The references to the name at a position, and its definition if that is wanted.
pub(super) fn references(snapshot: &Snapshot, position: Position, with_definition: bool) -> Vec<Location> {
    let Some(cursor) = Cursor::of(snapshot, position) else { return Vec::new() };
    let (definitions, references) = places(&cursor);
    let definitions = definitions.into_iter().filter(|_| with_definition);
    definitions.chain(references).filter_map(|span| cursor.location(span)).collect()
}

/// The places in the document itself.
pub(super) fn highlights(snapshot: &Snapshot, position: Position) -> Vec<DocumentHighlight> {
    let Some(cursor) = Cursor::of(snapshot, position) else { return Vec::new() };
    let (definitions, references) = places(&cursor);
    let marked = |kind: DocumentHighlightKind| {
        move |span: Span| DocumentHighlight { range: snapshot.range(span), kind: Some(kind) }
    };
    let is_here = |span: &Span| span.file == snapshot.file;
    let definitions = definitions.into_iter().filter(is_here).map(marked(DocumentHighlightKind::WRITE));
    definitions
        .chain(references.into_iter().filter(is_here).map(marked(DocumentHighlightKind::READ)))
        .collect()
}

/// Where a definition is shown: at its name, or at its key where the name is not written there.
fn place(names: &Names, id: DefinitionId) -> Span {
    let one = names.definition(id);
    match (one.spelling, one.kind) {
        (Spelling::Written | Spelling::Pattern, _) => one.span,
        (Spelling::Elsewhere, _) => one.key,
    }
}

/// The places of definitions and of references to them.
fn places(cursor: &Cursor<'_>) -> (Vec<Span>, Vec<Span>) {
    let names = cursor.names;
    let targets = cursor.definitions();
    let mut definitions: Vec<Span> = targets.iter().map(|id| place(names, *id)).collect();
    let refers = |id: &DefinitionId| targets.contains(id);
    let all = names.references().iter();
    let mut references: Vec<Span> =
        all.filter(|one| one.targets.iter().any(refers)).map(|one| one.span).collect();
    if targets.is_empty() {
        references.extend(words(cursor));
    }
    definitions.dedup();
    references.dedup();
    (definitions, references)
}

/// The same word of the language elsewhere, such as a data type.
fn words(cursor: &Cursor<'_>) -> Vec<Span> {
    let Some(Found::Reference(one)) = cursor.found() else { return Vec::new() };
    let sources = &cursor.snapshot.now.sources;
    let word = sources.text(one.span);
    let same = cursor.names.references().iter().filter(|other| {
        other.targets.is_empty() && other.kind == one.kind && sources.text(other.span) == word
    });
    if one.kind == Kind::Type { same.map(|other| other.span).collect() } else { Vec::new() }
}
