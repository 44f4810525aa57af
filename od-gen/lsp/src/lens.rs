//! What is shown above an object: the PDOs that carry it, and how many places refer to it.

use std::collections::{BTreeMap, BTreeSet};

use lsp_types::{CodeLens, Command, Location};
use od_spec::model::Dictionary;
use od_spec::names::{DefinitionId, Kind};
use od_spec::source::Span;
use serde_json::json;

use super::analysis;
use super::cursor::entries_of;
use super::snapshot::Snapshot;

/// The lenses of a document. `command` is the client's command that shows places: it gets a URI, a position and locations.
pub(super) fn lenses(snapshot: &Snapshot, command: Option<&str>) -> Vec<CodeLens> {
    if snapshot.now.kind != analysis::Kind::Specification {
        return Vec::new();
    }
    let names = snapshot.names();
    let mut places: BTreeMap<DefinitionId, BTreeSet<Span>> = BTreeMap::new();
    for one in names.references() {
        for target in &one.targets {
            // What refers to an entry refers to its object.
            let owner =
                names.definition(*target).owner.filter(|owner| names.definition(*owner).kind == Kind::Object);
            for id in [Some(*target), owner].into_iter().flatten() {
                places.entry(id).or_default().insert(one.scalar);
            }
        }
    }
    let objects =
        names.definitions().filter(|(_, one)| one.kind == Kind::Object && one.key.file == snapshot.file);
    let lens = |(id, one): (DefinitionId, &od_spec::names::Definition)| {
        let refers = places.get(&id).into_iter().flatten().copied();
        // Its own description names it, too.
        let refers: Vec<Span> = refers.filter(|span| *span != one.span && *span != one.key).collect();
        let of = snapshot.system().map(|system| entries_of(system, names, one)).unwrap_or_default();
        let mut carriers: Vec<String> = Vec::new();
        for (device, id) in of {
            for name in pdos_with(device, id.index) {
                if !carriers.contains(&name) {
                    carriers.push(name);
                }
            }
        }
        let count = match refers.len() {
            0 => None,
            1 => Some("1 reference".to_owned()),
            count => Some(format!("{count} references")),
        };
        carriers.extend(count);
        if carriers.is_empty() {
            return None;
        }
        let range = snapshot.range(one.key);
        let locations: Vec<Location> =
            refers.iter().filter_map(|span| snapshot.location(&snapshot.now, *span)).collect();
        let arguments = command.map(|_| vec![json!(snapshot.uri()), json!(range.start), json!(locations)]);
        let command = Command {
            title: carriers.join(" · "),
            command: command.unwrap_or_default().to_owned(),
            arguments,
        };
        Some(CodeLens { range, command: Some(command), data: None })
    };
    objects.filter_map(lens).collect()
}

/// The PDOs that carry an entry of an object: `RPDO 1`.
fn pdos_with(device: &Dictionary, index: od_spec::model::Index) -> Vec<String> {
    let entries = device.objects.get(&index).into_iter().flat_map(|object| &object.entries);
    let carriers =
        entries.flat_map(|entry| device.pdos_with(od_spec::model::EntryId { index, sub: entry.sub }));
    carriers.map(|carrier| format!("{} {}", carrier.pdo.direction.pdo(), carrier.pdo.number)).collect()
}
