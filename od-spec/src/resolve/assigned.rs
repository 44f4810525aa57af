//! Which objects of a specification are for which device: looked up once, and not by every device in all of them.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use super::refs::Broken;
use crate::ast::{ObjectDecl, Spec};
use crate::order::Arrange as _;

/// The objects that a specification declares, by device.
pub(super) struct Assigned<'a> {
    /// Those without `devices:`, with their positions.
    common: Vec<(usize, &'a ObjectDecl)>,
    /// Those that name a device, by its key.
    own: BTreeMap<&'a str, Vec<(usize, &'a ObjectDecl)>>,
    /// Those that name no device, or one which is not described: any may be meant.
    for_nobody: Arc<Broken>,
}

impl<'a> Assigned<'a> {
    pub(super) fn of(spec: &'a Spec) -> Self {
        let known: BTreeSet<&str> = spec.devices.iter().map(|device| device.key.value.as_str()).collect();
        let (mut common, mut own, mut for_nobody) = (Vec::new(), BTreeMap::new(), Broken::default());
        for (at, decl) in spec.objects.iter().enumerate() {
            let Some(on) = &decl.devices else {
                common.push((at, decl));
                continue;
            };
            let keys: BTreeSet<&str> = on.iter().map(|key| key.value.as_str()).collect();
            if keys.is_subset(&known) && !keys.is_empty() {
                for_nobody.own(decl.index, &decl.entry, on);
            } else {
                for_nobody.add(decl.index.value, decl.entry.names());
            }
            for key in keys {
                let of_device: &mut Vec<(usize, &'a ObjectDecl)> = own.entry(key).or_default();
                of_device.push((at, decl));
            }
        }
        Self { common, own, for_nobody: Arc::new(for_nobody) }
    }

    /// The objects of a device, as they are written.
    pub(super) fn to(&self, device: &str) -> Vec<&'a ObjectDecl> {
        let mut all = self.common.clone();
        if let Some(own) = self.own.get(device) {
            all.extend(own);
            all.arrange_by_key(|(at, _)| *at);
        }
        all.into_iter().map(|(_, decl)| decl).collect()
    }

    /// What is broken for every device: the objects of devices that are not described.
    pub(super) const fn for_nobody(&self) -> &Arc<Broken> {
        &self.for_nobody
    }
}
