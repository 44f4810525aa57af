//! What parameter files and plants refer to: devices, their entries, and the values of these.

use std::collections::BTreeMap;

use super::collector::{At, Collector};
use super::objects::Devices;
use super::walk::Step;
use super::{By, Kind};
use crate::diag::Suggestions;
use crate::keys::{KeyKind, Shape};
use crate::model::{Dictionary, EntryId, Index, SubIndex};
use crate::resolve::Lookup;
use crate::scalar;
use crate::source::Spanned;

/// What a parameter file or a plant calls the devices of a specification: its key, and that of the specification. In a
/// parameter file there is one device, without a key.
pub type DeviceKeys = BTreeMap<String, String>;

/// A setting of a parameter file or plant.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct SettingOf<'t> {
    /// The device, as the file calls it; empty in a parameter file.
    pub device: &'t str,
    /// The keys that lead to the value: an entry, or an object and its entry.
    pub keys: Vec<&'t Spanned<String>>,
}

impl<'t> SettingOf<'t> {
    /// The setting that a path leads into.
    pub(super) fn around(path: &[Step<'t>]) -> Option<Self> {
        let at = path.iter().rposition(|step| matches!(step, Step::Key { .. }))?;
        if !is_settings(path) {
            return None;
        }
        let mut keys = Vec::new();
        for step in &path[at..] {
            match step {
                Step::Data { kind: KeyKind::Name, name, .. } => keys.push(*name),
                // A list of bits is a value.
                Step::Item { .. } => break,
                Step::Data { .. } | Step::Key { .. } => {}
            }
        }
        Some(Self { device: device_around(path), keys })
    }

    /// The entry that is set on a device.
    pub fn entry(&self, device: &Dictionary) -> Option<EntryId> {
        let lookup = Lookup::new(device);
        match self.keys.as_slice() {
            [entry] => lookup.find(&entry.value, &mut Suggestions::default()).ok(),
            [object, entry, ..] => {
                let index = lookup.object(&object.value)?;
                Some(EntryId { index, sub: sub_index(device, index, &entry.value)? })
            }
            [] => None,
        }
    }

    /// The object whose entries are set, if the keys lead to one.
    pub fn object(&self, device: &Dictionary) -> Option<Index> {
        Lookup::new(device).object(&self.keys.first()?.value)
    }
}

/// The entry of an object by its number or its name.
fn sub_index(device: &Dictionary, index: Index, text: &str) -> Option<SubIndex> {
    let object = device.objects.get(&index)?;
    let number = scalar::integer(text).ok().and_then(|number| u8::try_from(number).ok());
    let numbered = number.map(SubIndex).filter(|sub| object.entry(*sub).is_some());
    numbered.or_else(|| Some(object.entries.iter().find(|entry| entry.is_called(text))?.sub))
}

/// The device of a plant that a place speaks of.
fn device_around<'t>(path: &[Step<'t>]) -> &'t str {
    let key = path.iter().rev().find_map(|step| match step {
        Step::Data { kind: KeyKind::DeviceKey, name, .. } => Some(name.value.as_str()),
        Step::Data { .. } | Step::Key { .. } | Step::Item { .. } => None,
    });
    key.unwrap_or_default()
}

/// Whether a path leads into the settings of a parameter file or plant.
pub(super) fn is_settings(path: &[Step<'_>]) -> bool {
    let inner = path.iter().rev().find_map(|step| match step {
        Step::Key { key, .. } => Some(key.shape),
        Step::Data { .. } | Step::Item { .. } => None,
    });
    match inner {
        Some(Shape::MapOf(_, Shape::Setting)) => true,
        Some(Shape::MapOf(_, Shape::MapOf(_, inner))) => matches!(inner, Shape::Setting),
        _ => false,
    }
}

/// Whether a path leads to a locked entry that may be set.
pub(super) fn is_unlock(path: &[Step<'_>]) -> bool {
    matches!(path, [.., Step::Key { key, .. }, Step::Item { .. }] if key.name == "unlock")
        || matches!(path, [.., Step::Key { key, .. }, Step::Data { .. }, Step::Item { .. }] if key.name == "unlock")
}

impl<'a, 't> Collector<'a, 't> {
    /// The device whose settings a place is in, by its key in the specification.
    fn device_of_settings(&self, at: At<'_, 't>) -> Option<&'a Dictionary> {
        self.resolved.device(self.devices.get(device_around(at.path))?)
    }

    /// A device as a plant calls it.
    pub(super) fn device_of_plant(&mut self, at: At<'_, 't>) {
        let Some(key) = self.devices.get(at.text.value) else { return };
        let device = self.known.named(Kind::Device, super::known::Scope::Everywhere, key, at.file());
        self.whole(at, Kind::Device, By::Identifier, device);
    }

    /// An entry, or an object or one of its entries, as a setting names it; or a run of bits in a list.
    pub(super) fn setting_key(&mut self, at: At<'_, 't>) {
        let Some(device) = self.device_of_settings(at) else { return };
        let text = at.text.value;
        let is_in_list = matches!(at.path, [.., Step::Item { .. }, Step::Data { .. }]);
        let setting = SettingOf::around(at.path).filter(|_| !is_in_list);
        let devices = [device.key.as_str()];
        match setting.as_ref().map(|setting| setting.keys.as_slice()) {
            _ if is_in_list => self.setting_value(at),
            Some([object, _]) => {
                let Some(index) = Lookup::new(device).object(&object.value) else { return };
                let Some(sub) = sub_index(device, index, text) else { return };
                let id = EntryId { index, sub };
                let is_name = device.entry(id).is_some_and(|entry| entry.name == text);
                let is_number = scalar::integer(text).is_ok();
                if self.is_new(at) {
                    let targets = self.known.entries(at.file(), (index, sub, sub), Devices::Only(&devices));
                    let by = match (is_number, is_name) {
                        (true, _) => By::Number,
                        (false, true) => By::Name,
                        (false, false) => By::Identifier,
                    };
                    let before = self.len();
                    self.add(at, 0..text.len(), Kind::Entry, by, targets);
                    self.are(before, id);
                }
            }
            // `unlock:`, or the first key of a setting.
            None | Some([_]) => {
                let lookup = Lookup::new(device);
                let object = || lookup.object(text).map(|index| EntryId { index, sub: SubIndex(0) });
                let found = lookup.find(text, &mut Suggestions::default()).ok().or_else(object);
                if self.is_new(at) {
                    match found.filter(|_| lookup.is_by_index(text)) {
                        Some(id) => self.numbered(at, (id.index, id.sub), 0..text.len(), &devices),
                        None => self.named_entry(at, 0..text.len(), text, &devices),
                    }
                }
            }
            Some(_) => {}
        }
    }

    /// The name of a value or bit, where the entry that is set has a named type.
    pub(super) fn setting_value(&mut self, at: At<'_, 't>) {
        let Some(device) = self.device_of_settings(at) else { return };
        let Some(entry) = SettingOf::around(at.path).and_then(|setting| device.entry(setting.entry(device)?))
        else {
            return;
        };
        let owner = entry.named_type.as_ref().and_then(|named| self.type_of(&named.name, at.file()));
        if let Some(owner) = owner {
            self.value_of(at, owner);
        }
    }
}
