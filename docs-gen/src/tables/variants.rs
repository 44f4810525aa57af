//! Devices for which an object is the same, and others for which it is not.

use od_spec::model::{Dictionary, Index, Object};

use crate::source::Source;

impl Source<'_> {
    /// The devices shown that have an object, in groups for which `of` gives the same.
    pub(crate) fn variants<T: PartialEq>(
        &self,
        index: Index,
        of: impl Fn(&Dictionary, &Object) -> T,
    ) -> Vec<Vec<&Dictionary>> {
        let mut variants: Vec<(T, Vec<&Dictionary>)> = Vec::new();
        for device in self.devices.iter().copied() {
            let Some(object) = device.objects.get(&index) else { continue };
            let facts = of(device, object);
            match variants.iter_mut().find(|(earlier, _)| *earlier == facts) {
                Some((_, devices)) => devices.push(device),
                None => variants.push((facts, vec![device])),
            }
        }
        variants.into_iter().map(|(_, devices)| devices).collect()
    }
}

/// Keys of devices, as they are in tables.
pub(crate) fn device_keys(devices: &[&Dictionary]) -> String {
    devices.iter().map(|device| device.key.to_uppercase()).collect::<Vec<_>>().join(", ")
}
