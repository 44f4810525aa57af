//! Where something is defined, and where it is referred to.

use lsp_types::{DocumentHighlight, DocumentHighlightKind, Location, Position};
use od_spec::names::{DefinitionId, Found, Kind, Names, Spelling};
use od_spec::source::Span;

use super::cursor::Cursor;
use super::snapshot::Snapshot;

/// Where what stands at a position is defined; on a definition, that place itself.
pub(super) fn definition(snapshot: &Snapshot, position: Position) -> Vec<Location> {
    let Some(cursor) = Cursor::of(snapshot, position) else { return Vec::new() };
    let places = cursor.definitions().into_iter().map(|id| place(cursor.names, id));
    places.filter_map(|span| cursor.location(span)).collect()
}

/// What refers to what stands at a position, and where it is defined if that is wanted.
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
