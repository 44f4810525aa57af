//! Parameter files and plants that refer to what gets another name.

use std::collections::BTreeMap;
use std::sync::Arc;

use od_spec::names::{Definition, DefinitionId};
use od_spec::source::Span;

use super::{edits, trial};
use crate::analysis::Analysis;
use crate::place::Place;
use crate::workspace::Workspace;

/// Changes of an analysis: places, and what is written there afterwards.
type Changes = (Arc<Analysis>, Vec<(Span, String)>);

/// The changes of each parameter file and plant. With all of them, none may have a message that it did not have.
pub(super) fn changes(
    now: &Analysis,
    renamed: &BTreeMap<DefinitionId, String>,
    of_spec: &[(Span, String)],
    workspace: &mut Workspace,
) -> Result<Vec<Changes>, String> {
    let Some(spec) = now.own_place() else { return Ok(Vec::new()) };
    let mut texts: BTreeMap<Place, String> = BTreeMap::new();
    add_changed(now, of_spec, &mut texts);
    let mut found = Vec::new();
    for satellite in workspace.satellites(spec) {
        let changes = in_file(&satellite, now, spec, renamed)?;
        add_changed(&satellite, &changes, &mut texts);
        found.push((satellite, changes));
    }
    for (satellite, _) in &found {
        let Some(place) = satellite.own_place() else { continue };
        let Some(after) = workspace.trial(place, &texts) else { continue };
        if let Some(news) = trial::news(&satellite.diagnostics, &after.diagnostics) {
            return Err(format!("with this name there would be a message in {place}: {}", news.message));
        }
    }
    found.retain(|(_, changes)| !changes.is_empty());
    Ok(found)
}

/// Notes the texts of files with their changes.
fn add_changed(analysis: &Analysis, changes: &[(Span, String)], texts: &mut BTreeMap<Place, String>) {
    for (span, _) in changes {
        if let Some(place) = analysis.place(span.file) {
            let text = || trial::changed(span.file, analysis.sources.file(span.file).text(), changes);
            texts.entry(place.clone()).or_insert_with(text);
        }
    }
}

/// The changes of one file.
fn in_file(
    satellite: &Analysis,
    now: &Analysis,
    spec: &Place,
    renamed: &BTreeMap<DefinitionId, String>,
) -> Result<Vec<(Span, String)>, String> {
    let at = satellite.described.iter().position(|one| satellite.place(one.root) == Some(spec));
    // Without a device there is nothing that its names could mean.
    let Some(at) = at.filter(|at| !satellite.described[*at].devices.is_empty()) else {
        let place = satellite.own_place().map(Place::name).unwrap_or_default();
        return Err(format!(
            "correct the errors here or in {place} first; until then, its references are not known"
        ));
    };
    let names = satellite.names_of(at);
    let key = |analysis: &Analysis, one: &Definition| {
        (analysis.place(one.key.file).cloned(), one.key.start, one.kind, one.name.clone())
    };
    let mut new_names: BTreeMap<_, &String> = BTreeMap::new();
    for (id, name) in renamed {
        new_names.insert(key(now, now.names().definition(*id)), name);
    }
    // Both have read the same texts; only the numbers of definitions differ.
    let same: BTreeMap<DefinitionId, String> = names
        .definitions()
        .filter_map(|(id, one)| Some((id, (*new_names.get(&key(satellite, one))?).clone())))
        .collect();
    let mut changes = edits::edits(&satellite.sources, names, &same)?;
    changes.retain(|(span, _)| Some(span.file) == satellite.root);
    Ok(changes)
}
