//! A constant states its value.

use crate::diag::{Code, Diagnostic, Diagnostics};
use crate::model::{Access, DataType, Dictionary};

pub(super) fn check(device: &Dictionary, diagnostics: &mut Diagnostics) {
    for (id, _, entry) in device.entries() {
        if entry.access == Access::Const && entry.default.is_none() && entry.data_type != DataType::Domain {
            diagnostics.push(
                Diagnostic::new(Code::ConstWithoutDefault, entry.span, format!("{id} is constant, but has no value"))
                    .help("add `default:`, or make it `ro`"),
            );
        }
    }
}
