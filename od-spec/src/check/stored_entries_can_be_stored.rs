//! What is stored has a command that stores it: 1010h.2, .3 or .4.

use super::own_place;
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::{Dictionary, EntryId, Index, Origin, Storage, SubIndex};

pub(super) fn check(device: &Dictionary, diagnostics: &mut Diagnostics) {
    for (group, sub) in [(Storage::Communication, 2), (Storage::Application, 3), (Storage::Manufacturer, 4)] {
        let command = EntryId { index: Index(0x1010), sub: SubIndex(sub) };
        if device.entry(command).is_some() {
            continue;
        }
        // The parameters of PDOs are said to be stored wherever a device can do that at all.
        let mut own = device.entries().filter(|(_, object, _)| object.origin != Origin::Pdo);
        if let Some((id, _, entry)) = own.find(|(.., entry)| entry.stored == group) {
            diagnostics.push(
                Diagnostic::new(
                    codes::STORED_WITHOUT_STORE,
                    own_place(device, entry.span),
                    format!("{id} is `stored: {}`, but `{}` has no {command}", group.word(), device.key),
                )
                .help("add the feature `store parameters` of `cia301`, or correct `stored:`"),
            );
        }
    }
}
