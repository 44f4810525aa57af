//! Objects of one device have names of their own.

use std::collections::BTreeMap;

use crate::diag::{Code, Diagnostic, Diagnostics};
use crate::model::Dictionary;

pub(super) fn check(device: &Dictionary, diagnostics: &mut Diagnostics) {
    let mut names = BTreeMap::new();
    for object in device.objects.values() {
        if let Some(before) = names.insert(object.name.as_str(), object) {
            diagnostics.push(
                Diagnostic::new(
                    Code::DuplicateName,
                    object.span,
                    format!("{} and {} of `{}` are both named `{}`", before.index, object.index, device.key, object.name),
                )
                .label(object.index.to_string())
                .with(before.span, before.index.to_string())
                .help("give one of the two another name; PDO mappings and generated code refer to objects by name"),
            );
        }
    }
}
