//! Something for each storage group.

use crate::table::Storage;

/// Storage groups that can be stored.
pub(super) const STORED: [Storage; 4] =
    [Storage::Communication, Storage::Application, Storage::Manufacturer, Storage::Remanent];

/// Something for each storage group that can be stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct PerGroup<T>([T; STORED.len()]);

impl<T: Copy> PerGroup<T> {
    /// The same for each.
    pub(super) const fn all(value: T) -> Self {
        Self([value; STORED.len()])
    }

    /// What a group has; `None` of [`Storage::No`].
    pub(super) fn of(&self, storage: Storage) -> Option<T> {
        STORED.iter().zip(&self.0).find(|(stored, _)| **stored == storage).map(|(_, value)| *value)
    }

    pub(super) fn set(&mut self, storage: Storage, value: T) {
        let places = STORED.iter().zip(&mut self.0);
        places.filter(|(stored, _)| **stored == storage).for_each(|(_, place)| *place = value);
    }
}
