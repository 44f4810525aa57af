//! A constant states its value.

use super::own_place;
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::{Access, DataType, Dictionary, Origin};

pub(super) fn check(device: &Dictionary, diagnostics: &mut Diagnostics) {
    for (id, object, entry) in device.entries() {
        if entry.access == Access::Const && entry.default.is_none() && entry.data_type != DataType::Domain {
            let help = if object.origin == Origin::Profile {
                format!("write it among the objects: `0x{:04X}: {{from: cia301, default: …}}`", id.index.0)
            } else {
                "add `default:`, or make it `ro`".to_owned()
            };
            diagnostics.push(
                Diagnostic::new(
                    codes::CONST_WITHOUT_DEFAULT,
                    own_place(device, entry.span),
                    format!("{id} ({}) of `{}` is constant, but has no value", object.name, device.key),
                )
                .help(help),
            );
        }
    }
}
