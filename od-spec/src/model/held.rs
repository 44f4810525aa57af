//! The values that the entries of a device hold, as conditions ask for them.

use std::collections::BTreeMap;

use super::{Dictionary, EntryId, EntryRef, Ratio, System, Value, Values, convert};

/// The values of a device: its defaults, and what was written over them.
#[derive(Clone, Copy)]
pub(crate) struct Held<'a> {
    /// Everything that is described.
    pub system: &'a System,
    /// The device that a condition means where it names none.
    pub device: &'a Dictionary,
    /// Its node-ID, where it is known.
    pub node: Option<u8>,
    /// Raw values that entries of the device have instead of their defaults.
    pub written: &'a BTreeMap<EntryId, i128>,
}

impl<'a> Held<'a> {
    /// The device that a condition means.
    fn named(&self, entry: &EntryRef) -> Option<&'a Dictionary> {
        match &entry.device {
            Some(key) if *key != self.device.key => self.system.device(key),
            _ => Some(self.device),
        }
    }

    /// The raw number of a value, where it does not depend on an unknown node-ID.
    fn fixed(&self, value: &Value) -> Option<i128> {
        match self.node {
            Some(node) => value.integer_for(node),
            None => value.integer(),
        }
    }
}

/// In physical units.
impl Values for Held<'_> {
    fn value(&self, entry: &EntryRef) -> Option<Ratio> {
        let raw = self.raw(entry)?;
        match self.named(entry)?.entry(entry.id)?.unit.as_ref() {
            Some(unit) => unit.quantity(raw),
            None => Some(Ratio::whole(raw)),
        }
    }

    fn raw(&self, entry: &EntryRef) -> Option<i128> {
        let device = self.named(entry)?;
        let found = device.entry(entry.id)?;
        if let Some(alias) = &found.alias {
            let target = EntryRef { id: alias.target, ..entry.clone() };
            return convert(self.raw(&target)?, alias.factor, alias.rounding, alias.outside, found.data_type);
        }
        // Nothing is known about the node-ID of another device.
        if device.key != self.device.key {
            return found.default.as_ref()?.integer();
        }
        match self.written.get(&entry.id) {
            Some(raw) => Some(*raw),
            None => self.fixed(found.default.as_ref()?),
        }
    }
}
