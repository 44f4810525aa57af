//! A device with settings laid over its defaults.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

use super::{Setting, read};
use crate::model::{Alias, Author, Dictionary, Entry, EntryId, Outside, Statement, Value, convert};
use crate::source::Span;

/// The device as it is once the settings are downloaded to a node. A value that is set has its place in the setting; so have
/// the target of a view, and what follows from it.
pub(super) fn configured<'a>(
    device: &Dictionary,
    node: u8,
    settings: impl IntoIterator<Item = &'a Setting>,
) -> Dictionary {
    let mut configured = device.clone();
    let views = Views::of(device);
    for setting in settings {
        let place = Statement { span: setting.value_span, author: Author::Setting };
        let held = match device.entry(setting.id).and_then(|entry| entry.alias.as_ref()) {
            Some(alias) => {
                let raw = setting.value.integer_for(node);
                raw.and_then(|raw| read::target_value(alias, raw)).map(Value::Integer)
            }
            None => Some(setting.value.clone()),
        };
        let Some(held) = held else { continue };
        if setting.holder != setting.id {
            let statement = Statement { author: Author::Derived, ..place };
            set(&mut configured, setting.holder, held.clone(), statement);
        }
        set(&mut configured, setting.id, setting.value.clone(), place);
        follow(&mut configured, &views, setting, &held, node);
    }
    let objects = &configured.objects;
    for pdo in &mut configured.pdos {
        pdo.follow(objects);
    }
    configured
}

/// The device while some of its entries are unlocked for service.
pub(super) fn opened<'a>(device: &'a Dictionary, unlocked: &BTreeSet<EntryId>) -> Cow<'a, Dictionary> {
    if unlocked.is_empty() {
        return Cow::Borrowed(device);
    }
    let mut opened = device.clone();
    for id in unlocked {
        if let Some(entry) = entry_mut(&mut opened, *id) {
            entry.eds = entry.eds_while_unlocked();
            entry.locked = false;
        }
    }
    Cow::Owned(opened)
}

/// The device with one entry marked as set, its value as it was: to see whether it can be set at all.
pub(super) fn marked(device: &Dictionary, id: EntryId, place: Span) -> Dictionary {
    let mut marked = device.clone();
    if let Some(entry) = entry_mut(&mut marked, id) {
        let value = entry.default.take();
        entry.set_default(value, Statement { span: place, author: Author::Setting });
    }
    marked
}

/// An entry, to be changed.
pub(super) fn entry_mut(device: &mut Dictionary, id: EntryId) -> Option<&mut Entry> {
    device.objects.get_mut(&id.index)?.entries.iter_mut().find(|entry| entry.sub == id.sub)
}

fn set(device: &mut Dictionary, id: EntryId, value: Value, statement: Statement) {
    if let Some(entry) = entry_mut(device, id) {
        entry.set_default(Some(value), statement);
    }
}

/// The views of each entry, looked for once.
struct Views<'a>(BTreeMap<EntryId, Vec<(EntryId, &'a Entry, &'a Alias)>>);

impl<'a> Views<'a> {
    fn of(device: &'a Dictionary) -> Self {
        let mut views: BTreeMap<EntryId, Vec<(EntryId, &Entry, &Alias)>> = BTreeMap::new();
        for (id, _, entry) in device.entries() {
            if let Some(alias) = &entry.alias {
                views.entry(alias.target).or_default().push((id, entry, alias));
            }
        }
        Self(views)
    }
}

/// The other views of an entry show its new value, as far as they can.
fn follow(configured: &mut Dictionary, views: &Views<'_>, setting: &Setting, held: &Value, node: u8) {
    let Some(raw) = held.integer_for(node) else { return };
    let views = views.0.get(&setting.holder).into_iter().flatten();
    for (id, view, alias) in views.filter(|(id, ..)| *id != setting.id) {
        let shown = convert(raw, alias.factor, alias.rounding, Outside::Abort, view.data_type);
        if let Some(entry) = entry_mut(configured, *id) {
            let statement = Statement { span: setting.value_span, author: Author::Derived };
            entry.set_default(shown.map(Value::Integer), statement);
        }
    }
}
