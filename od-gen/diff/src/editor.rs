//! What CANopenEditor keeps of objects.

use std::collections::BTreeMap;

use od_spec::model::{EntryId, Fact, Object, SubIndex};

use super::change::{Change, Class, Place};
use super::sides::{Values, sides};

/// What CANopenEditor keeps of an object that both devices have.
pub(super) fn editor(old: &Object, new: &Object) -> Vec<Change> {
    let of_object = |object: &Object| {
        let notes = object.editor.iter().flat_map(|notes| notes.of_object());
        notes.map(|(property, value)| (property.name(), value.to_owned())).collect::<BTreeMap<_, _>>()
    };
    let of_entry = |object: &Object, sub: SubIndex| {
        let (property, word) = object.editor.as_ref()?.of_entry(sub)?;
        Some((property.name(), word.to_owned()))
    };
    let own = sides(of_object(old), of_object(new)).into_iter();
    let own = own.map(|(property, values)| (Place::Object(new.index), property, values));
    let subs = old.entries.iter().map(|entry| entry.sub).filter(|sub| new.entry(*sub).is_some());
    let of_entries = subs.flat_map(|sub| {
        let place = Place::entry(EntryId { index: new.index, sub });
        let both = sides(of_entry(old, sub), of_entry(new, sub)).into_iter();
        both.map(move |(property, values)| (place.clone(), property, values)).collect::<Vec<_>>()
    });
    let change = |(place, property, (before, after)): (Place, &str, Values)| {
        let change = Change::of(place, Fact::Further, before, after)?;
        Some(change.part(property).so(Class::Firmware, "C for CANopenNode is made otherwise"))
    };
    own.chain(of_entries).filter_map(change).collect()
}
