//! `order:` of a table: its rows as the manual prints them.

use std::collections::BTreeSet;

use crate::ast::{ContentDecl, PartDecl};
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::{System, TypeKind};
use crate::source::Spanned;

/// Checks that an order has each row of its table and nothing else; that something is listed twice is said of any list.
pub(super) fn check(
    decl: &PartDecl,
    content: &Spanned<ContentDecl>,
    system: &System,
    diagnostics: &mut Diagnostics,
) {
    let Some(order) = &decl.order else { return };
    if !has_numbers(&content.value) {
        diagnostics.push(
            Diagnostic::new(codes::CONFLICTING_KEYS, order.span, "nothing here has numbers to order")
                .with(content.span, "the content is here")
                .help("remove the key; it belongs to `values` and `bits`"),
        );
        return;
    }
    // What the table names and does not exist is reported there.
    let Some(rows) = rows(&content.value, system) else { return };
    for number in order.value.iter().filter(|number| !rows.contains(&number.value)) {
        let message = format!("the table has no row {}", number.value);
        diagnostics
            .push(Diagnostic::new(codes::UNKNOWN_REFERENCE, number.span, message).help("correct the number"));
    }
    let has = |row: &i128| order.value.iter().any(|number| number.value == *row);
    let missing: Vec<String> = rows.iter().filter(|row| !has(row)).take(3).map(i128::to_string).collect();
    if !missing.is_empty() {
        let message = format!("the order lacks the row {}", missing.join(", "));
        diagnostics
            .push(Diagnostic::new(codes::UNKNOWN_REFERENCE, order.span, message).help("list every row once"));
    }
}

/// Whether the rows of a table are known by numbers.
const fn has_numbers(content: &ContentDecl) -> bool {
    match content {
        ContentDecl::Values(_) | ContentDecl::Bits { .. } => true,
        ContentDecl::Prose(..)
        | ContentDecl::Errors(_)
        | ContentDecl::Reactions(_)
        | ContentDecl::Overview(_)
        | ContentDecl::Objects(_)
        | ContentDecl::States(_)
        | ContentDecl::Transitions(_)
        | ContentDecl::Commands(_)
        | ContentDecl::Ladder { .. }
        | ContentDecl::Timing(_)
        | ContentDecl::Hysteresis(_)
        | ContentDecl::Flow(_)
        | ContentDecl::Axis(_)
        | ContentDecl::Pdos { .. }
        | ContentDecl::Rows { .. }
        | ContentDecl::Glossary
        | ContentDecl::History => false,
    }
}

/// The numbers of the rows of a table.
fn rows(content: &ContentDecl, system: &System) -> Option<BTreeSet<i128>> {
    let of_type = |name: &str| {
        Some(match &system.types.get(name)?.kind {
            TypeKind::Enum(values) => values.iter().map(|value| value.value).collect(),
            TypeKind::Bits(fields) => fields.iter().map(|field| field.first.into()).collect(),
        })
    };
    match content {
        ContentDecl::Values(name) => of_type(&name.value),
        ContentDecl::Bits { named_type, .. } => of_type(&named_type.as_ref()?.value),
        _ => None,
    }
}
