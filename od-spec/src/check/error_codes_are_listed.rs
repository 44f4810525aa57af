//! Error codes that bits refer to stand in `errors:`, where a specification has such a list.

use crate::ast::Spec;
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::System;
use crate::source::Spanned;

pub(super) fn check(root: &Spec, system: &System, diagnostics: &mut Diagnostics) {
    if system.errors.is_empty() {
        return;
    }
    let of_types = root.types.iter().flat_map(|decl| decl.bits.iter().flatten()).flat_map(|bit| &bit.errors);
    let of_entries = root.objects.iter().flat_map(|object| {
        let elements = object.array.iter().flat_map(|array| array.elements.iter().map(|(_, entry)| entry));
        let members = object.record.iter().flat_map(|record| record.members.iter().map(|(_, entry)| entry));
        let own = object.array.iter().map(|array| &array.entry).chain([&object.entry]);
        elements.chain(members).chain(own).filter_map(|entry| entry.bit_errors.as_ref())
    });
    let of_entries = of_entries.flat_map(|list| &list.value).flat_map(|decl| &decl.codes);
    for Spanned { value: code, span } in of_types.chain(of_entries) {
        if !system.errors.iter().any(|error| i128::from(error.code) == *code) {
            diagnostics.push(
                Diagnostic::new(
                    codes::UNLISTED_ERROR_CODE,
                    *span,
                    format!("`errors:` does not list {code:04X}h"),
                )
                .help("add the code to `errors:`, or correct it"),
            );
        }
    }
}
