//! Every unit and type of a specification is used by an entry or a table.

use crate::ast::{Name, Spec};
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::{System, TableContent};

pub(super) fn check(root: &Spec, system: &System, diagnostics: &mut Diagnostics) {
    // A library defines for others.
    if root.profile.is_some() {
        return;
    }
    let entries = || system.devices.iter().flat_map(|device| device.entries().map(|(.., entry)| entry));
    let tables = || system.document.sections.iter().flat_map(|section| &section.tables);
    let mut unused = |name: &Name, what: &str| {
        diagnostics.push(
            Diagnostic::new(codes::UNUSED, name.span, format!("nothing uses {what} `{}`", name.value))
                .help("remove it, or did an entry lose its key?"),
        );
    };
    for decl in &root.units {
        if !entries().any(|entry| entry.unit.as_ref().is_some_and(|unit| unit.name == decl.name.value)) {
            unused(&decl.name, "unit");
        }
    }
    for decl in &root.types {
        let name = &decl.name.value;
        let by_entry =
            entries().any(|entry| entry.named_type.as_ref().is_some_and(|named| named.name == *name));
        let by_table = tables().any(|table| {
            matches!(&table.content, TableContent::Bits(one) | TableContent::Values(one) if one == name)
        });
        if !by_entry && !by_table {
            unused(&decl.name, "type");
        }
    }
}
