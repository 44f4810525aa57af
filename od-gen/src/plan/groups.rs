//! Groups of accessors that several objects have in common: a device with a thousand equal channels has one, and not a thousand.

use std::collections::BTreeMap;

use od_spec::model::SubIndex;

use super::{Place, Plan, PlannedEntry, PlannedObject, Shape, ValueKind};

/// What a member of a group is, apart from its place.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct Member<'p> {
    sub: SubIndex,
    identifier: &'p str,
    name: &'p str,
    about: Option<&'p str>,
    kind: &'p ValueKind,
    size: usize,
    limited: bool,
}

/// The groups of a plan that more than one object has.
#[derive(Default)]
pub struct Groups {
    /// Positions of all objects that have a group, by the position of the first of them.
    alike: BTreeMap<usize, Vec<usize>>,
    /// The first, by the position of each.
    first: BTreeMap<usize, usize>,
}

impl Groups {
    /// The objects with one group, if `position` is the first of them.
    pub fn alike(&self, position: usize) -> Option<&[usize]> {
        self.alike.get(&position).map(Vec::as_slice)
    }

    /// The first object with the group of another one, or of the same; `None` where an object has a group for itself.
    pub fn first(&self, position: usize) -> Option<usize> {
        self.first.get(&position).copied()
    }
}

impl Plan<'_> {
    /// The groups that objects share: with the same members, which mean the same. The places of the values differ, and facts such
    /// as limits and defaults may.
    pub fn groups(&self) -> Groups {
        let mut alike: BTreeMap<Vec<Member<'_>>, Vec<usize>> = BTreeMap::new();
        for (position, object) in self.objects.iter().enumerate() {
            if let Some(members) = self.group_members(object) {
                alike.entry(members).or_default().push(position);
            }
        }
        let mut groups = Groups::default();
        for positions in alike.into_values().filter(|positions| positions.len() > 1) {
            let Some(first) = positions.first().copied() else { continue };
            groups.first.extend(positions.iter().map(|position| (*position, first)));
            groups.alike.insert(first, positions);
        }
        groups
    }

    /// The members of a group whose values all lie in the image.
    fn group_members(&self, object: &PlannedObject<'_>) -> Option<Vec<Member<'_>>> {
        matches!(object.shape, Shape::Group { .. }).then_some(())?;
        let language = self.system.language();
        self.accessible(object).map(|planned| member(planned, language)).collect()
    }

    /// The entries of an object.
    pub fn entries_of(&self, object: &PlannedObject<'_>) -> impl Iterator<Item = &PlannedEntry<'_>> {
        let first = usize::from(object.first_row);
        let rows = first..first.saturating_add(object.object.entries.len()).min(self.entries.len());
        self.entries.get(rows).unwrap_or_default().iter()
    }

    /// Whether an entry has values of the specification's own: no counts, no PDO parameters.
    pub fn is_stated(&self, entry: &PlannedEntry<'_>) -> bool {
        self.objects.get(entry.object).map(|planned| planned.object).is_some_and(|object| {
            let is_count = object.is_structured() && entry.id.sub == SubIndex(0);
            !object.role().is_pdo_parameter() && !is_count
        })
    }

    /// The entries of a group that have accessors.
    pub fn accessible(&self, object: &PlannedObject<'_>) -> impl Iterator<Item = &PlannedEntry<'_>> {
        self.entries_of(object).filter(|entry| is_accessible(entry))
    }
}

/// Whether an entry of a group has an accessor: a number of entries that never changes is a constant of the shape, not a value.
pub const fn is_accessible(entry: &PlannedEntry<'_>) -> bool {
    entry.id.sub.0 != 0 || !matches!(entry.place, Place::Constant(_))
}

/// What an entry is as a member of a group; `None` for a value that does not lie in the image.
fn member<'p>(planned: &'p PlannedEntry<'_>, language: &str) -> Option<Member<'p>> {
    let PlannedEntry { id, entry, member: identifier, place: Place::Image(_), size, kind, .. } = planned
    else {
        return None;
    };
    let about = entry.about.get(language);
    Some(Member {
        sub: id.sub,
        identifier,
        name: &entry.name,
        about,
        kind,
        size: *size,
        limited: entry.is_limited(),
    })
}
