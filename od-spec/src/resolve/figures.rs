//! Figures that are drawn from data: what their names mean.

use super::refs::{Broken, NamesOf};
use super::table_content::{Known, bit_fields};
use super::varied::Varied;
use crate::ast::{Name, Spec};
use crate::decode::lexical;
use crate::diag::Diagnostics;
use crate::model::{Devices, Entry, EntryId, System};

/// What figures are resolved against.
pub(super) struct Figures<'a, 'n> {
    pub(super) system: &'a System,
    names: &'a NamesOf<'n>,
    broken: &'a Broken,
    varied: Varied<'a>,
    pub(super) bit_fields: Known<'a>,
}

impl<'a, 'n> Figures<'a, 'n> {
    pub(super) fn of(root: &'a Spec, system: &'a System, names: &'a NamesOf<'n>, broken: &'a Broken) -> Self {
        Self { system, names, broken, varied: Varied::of(root), bit_fields: bit_fields(root, system) }
    }

    /// The entry that a reference names, as the first device has it.
    pub(super) fn entry(&self, reference: &Name, diagnostics: &mut Diagnostics) -> Option<(EntryId, &Entry)> {
        let find = |id: EntryId| {
            let objects = self.names.objects(&Devices::All, id.index);
            objects.into_iter().find_map(|object| object.entry(id.sub))
        };
        let by_index = lexical::entry_by_index(&reference.value).map(lexical::NumberedEntry::id);
        let id = match by_index.filter(|id| find(*id).is_some()) {
            Some(id) => id,
            None => self.names.find(&Devices::All, reference, self.broken, diagnostics)?,
        };
        let keys = self.names.each(&Devices::All).map(|(device, _)| device.key.as_str());
        let help = "name an entry that is the same on all devices";
        if self.varied.is_refused(id.index, reference.span, keys, help, diagnostics) {
            return None;
        }
        Some((id, find(id)?))
    }
}
