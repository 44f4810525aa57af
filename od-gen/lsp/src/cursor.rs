//! What is at the cursor.

use lsp_types::{Location, Position};
use od_spec::model::{Dictionary, EntryId, Index, SubIndex, System};
use od_spec::names::{Definition, DefinitionId, Found, Names, Place, Step};
use od_spec::scalar;
use od_spec::source::Span;

use super::analysis::Kind;
use super::snapshot::Snapshot;

/// A place of a document of a specification, and the names that all its files have.
pub(super) struct Cursor<'a> {
    pub snapshot: &'a Snapshot,
    pub names: &'a Names,
    pub offset: u32,
}

impl<'a> Cursor<'a> {
    /// The place at a position; `None` in a document that is not YAML of this language.
    pub(super) fn of(snapshot: &'a Snapshot, position: Position) -> Option<Self> {
        match snapshot.now.kind {
            Kind::Specification | Kind::Plant | Kind::Parameters => {}
            Kind::Eds | Kind::Xdd | Kind::Foreign | Kind::TooLarge => return None,
        }
        let offset = u32::try_from(snapshot.offset(position)).ok()?;
        Some(Self { snapshot, names: snapshot.names(), offset })
    }

    /// What is defined or referred to there.
    pub(super) fn found(&self) -> Option<Found<'a>> {
        self.names.at(self.snapshot.file, self.offset)
    }

    /// What is there by the table of keys.
    pub(super) fn place(&self) -> Option<Place<'a>> {
        Place::of(self.snapshot.now.outline(self.snapshot.file)?, self.offset)
    }

    /// The definitions that are meant there.
    pub(super) fn definitions(&self) -> Vec<DefinitionId> {
        match self.found() {
            Some(Found::Definition(id, _)) => vec![id],
            Some(Found::Reference(reference)) => reference.targets.clone(),
            None => Vec::new(),
        }
    }

    /// Where a span of the texts of now is.
    pub(super) fn location(&self, span: Span) -> Option<Location> {
        self.snapshot.location(&self.snapshot.now, span)
    }
}

/// The entries that a definition describes, each on its device. Of a run, the first one.
pub(super) fn entries_of<'a>(
    system: &'a System,
    names: &Names,
    definition: &Definition,
) -> Vec<(&'a Dictionary, EntryId)> {
    let object = definition.owner.map_or(definition, |owner| names.definition(owner));
    let Some((index, last)) = object.indices else { return Vec::new() };
    let sub = definition.subs.map_or(SubIndex(0), |(first, _)| first);
    let id = EntryId { index, sub };
    let of_device = |device: &&Dictionary| {
        object.devices.as_ref().is_none_or(|keys| keys.contains(&device.key))
            && (device.entry(id).is_some() || device.objects.range(index..=last).next().is_some())
    };
    system.devices.iter().filter(of_device).map(|device| (device, id)).collect()
}

/// The entry in whose description a place is, by the keys that lead there: `objects`, an index, `record` and a sub-index.
pub(super) fn entry_around(path: &[Step<'_>]) -> Option<EntryId> {
    let mut data = path.iter().filter_map(|step| match step {
        Step::Data { name, .. } => Some(name.value.as_str()),
        Step::Key { .. } | Step::Item { .. } => None,
    });
    let is_object = matches!(path.first(), Some(Step::Key { key, .. }) if key.name == "objects");
    let index = number(data.next().filter(|_| is_object)?)?;
    let is_element =
        |key: &str| path.iter().any(|step| matches!(step, Step::Key { key: one, .. } if one.name == key));
    let sub = if is_element("record") || is_element("elements") {
        number(data.next()?)?
    } else {
        // The first element is taken for all.
        u16::from(is_element("array"))
    };
    Some(EntryId { index: Index(index), sub: SubIndex(u8::try_from(sub).ok()?) })
}

/// A number, or the first of a run.
fn number(text: &str) -> Option<u16> {
    let first = text.split("..").next()?.trim();
    u16::try_from(scalar::integer(first).ok()?).ok()
}
