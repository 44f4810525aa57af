//! Which changes lose what devices in the field have stored: the layout of the storage groups, before and after.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

use od_gen::plan::{self, Place as Lies};
use od_spec::diag::Diagnostics;
use od_spec::model::{Dictionary, EntryId, Fact, Storage};

use super::change::{Change, Class, Consequence, Place};
use super::words::WORDS;

/// The storage groups of a device.
pub(super) struct Groups {
    /// The number of each group's layout: a device restores a group only if it has the number of its own.
    layouts: BTreeMap<Storage, u32>,
    /// Type and size of each stored value.
    values: BTreeMap<EntryId, (Storage, u16, usize)>,
}

impl Groups {
    /// `None` where values cannot be laid out, so that nothing is stored.
    pub(super) fn of(device: &Dictionary) -> Option<Self> {
        let mut diagnostics = Diagnostics::new();
        let layout = plan::lay_out(device, &mut diagnostics);
        if diagnostics.has_errors() {
            return None;
        }
        let layouts = layout.regions.iter().map(|region| (region.storage, region.layout)).collect();
        let values = device.entries().filter_map(|(id, _, entry)| {
            let placed = layout.places.get(&id)?;
            let is_stored = entry.stored != Storage::No && matches!(placed.place, Lies::Image(_));
            is_stored.then_some((id, (entry.stored, entry.data_type.code(), placed.size)))
        });
        Some(Self { layouts, values: values.collect() })
    }
}

/// Facts from which the layout follows: those that decide it and, where none of them has changed, those that make a constant
/// of a value.
const CAUSES: &[&[Fact]] = &[
    &[Fact::Presence, Fact::Type, Fact::Capacity, Fact::Storage, Fact::Alias, Fact::ObjectType],
    &[Fact::Access, Fact::Default],
];

/// Adds to each change whose stored parameters it loses.
pub(super) fn judge(old: &Groups, new: &Groups, changes: &mut Vec<Change>) {
    // Where nothing was stored, nothing can be lost.
    let lost: BTreeSet<Storage> = old
        .layouts
        .iter()
        .filter(|(group, layout)| new.layouts.get(group) != Some(layout))
        .map(|(group, _)| *group)
        .collect();
    let mut unexplained = lost.clone();
    let ids: BTreeSet<EntryId> = old.values.keys().chain(new.values.keys()).copied().collect();
    for id in ids {
        let (before, after) = (old.values.get(&id), new.values.get(&id));
        if before == after {
            continue;
        }
        let groups: BTreeSet<Storage> =
            [before, after].into_iter().flatten().map(|(group, ..)| *group).collect();
        let places = [Place::entry(id), Place::Object(id.index)];
        for group in groups.intersection(&lost) {
            for facts in CAUSES {
                let is_cause =
                    |change: &&mut Change| places.contains(&change.place) && facts.contains(&change.fact);
                let mut has_cause = false;
                for cause in changes.iter_mut().filter(is_cause) {
                    cause.follows([consequence(*group)]);
                    has_cause = true;
                }
                if has_cause {
                    unexplained.remove(group);
                    break;
                }
            }
        }
    }
    changes.extend(unexplained.into_iter().map(|group| {
        Change::unsaid(Place::Device, Fact::Storage).part(WORDS.storage(group)).with([consequence(group)])
    }));
}

fn consequence(group: Storage) -> Consequence {
    let because = Cow::Owned(format!("another layout of what is kept: {}", WORDS.storage_group(group)));
    Consequence { class: Class::Stored, because }
}
