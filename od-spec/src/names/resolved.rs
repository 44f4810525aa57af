//! What names of entries mean on the devices of a model.

use std::cell::OnceCell;
use std::collections::BTreeMap;

use super::objects::Devices;
use crate::model::{Dictionary, EntryId, Fact, System};
use crate::resolve::NamesOfDevice;
use crate::source::Span;

/// The devices of a model, each with its names, which are looked up as compiling looks them up.
pub(super) struct Resolved<'a> {
    devices: Vec<(&'a Dictionary, OnceCell<NamesOfDevice<'a>>)>,
    /// The names of the types of values, by the places of the values.
    types: OnceCell<BTreeMap<Span, &'a str>>,
}

impl<'a> Resolved<'a> {
    pub(super) fn of(system: Option<&'a System>) -> Self {
        let devices = system.map(|system| system.devices.as_slice()).unwrap_or_default();
        Self {
            devices: devices.iter().map(|device| (device, OnceCell::new())).collect(),
            types: OnceCell::new(),
        }
    }

    /// The entries that a name means, each on its device.
    pub(super) fn named<'s>(
        &'s self,
        name: &'s str,
        scope: Devices<'s>,
    ) -> impl Iterator<Item = (&'a Dictionary, EntryId)> + use<'s, 'a> {
        let devices = self.devices.iter().filter(move |(device, _)| scope.has(&device.key));
        devices.filter_map(move |(device, names)| {
            let names = names.get_or_init(|| NamesOfDevice::new(device.objects.values()));
            Some((*device, names.get(name).one()?))
        })
    }

    /// The name of the named type of the value that is at a place, or in the list there.
    pub(super) fn type_of_value(&self, place: Span) -> Option<&'a str> {
        let types = self.types.get_or_init(|| {
            let entries = self.devices.iter().flat_map(|(device, _)| device.entries());
            entries
                .filter_map(|(_, _, entry)| Some((entry, entry.named_type.as_ref()?)))
                .flat_map(|(entry, named)| {
                    let facts = [Fact::Default, Fact::LowLimit, Fact::HighLimit];
                    let places = facts.into_iter().filter_map(|fact| entry.facts.get(fact));
                    places.map(|statement| (statement.span, named.name.as_str()))
                })
                .collect()
        });
        let (span, name) = types.range(..=Span { end: u32::MAX, ..place }).next_back()?;
        (span.file == place.file && place.end <= span.end).then_some(*name)
    }

    /// A device by its key.
    pub(super) fn device(&self, key: &str) -> Option<&'a Dictionary> {
        self.devices.iter().map(|(device, _)| *device).find(|device| device.key == key)
    }

    /// The devices.
    pub(super) fn devices<'s>(
        &'s self,
        scope: Devices<'s>,
    ) -> impl Iterator<Item = &'a Dictionary> + use<'s, 'a> {
        self.devices.iter().map(|(device, _)| *device).filter(move |device| scope.has(&device.key))
    }
}
