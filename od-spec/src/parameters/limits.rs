//! Limits of an entry and, for an alias, of the entry that holds its value.

use crate::diag::{Diagnostic, codes};
use crate::model::{Alias, DataType, Dictionary, Entry, EntryId, Ratio, TypeKind, Value, format_value};
use crate::resolve::allowed;
use crate::source::Span;

/// Checks the raw value that an entry gets on the node.
pub(super) fn check(
    device: &Dictionary,
    id: EntryId,
    entry: &Entry,
    raw: i128,
    span: Span,
) -> Result<(), Box<Diagnostic>> {
    let own = format!("{id} ({}): {}", entry.name, show(entry, raw));
    let target = entry.alias.as_ref().and_then(|alias| Some((alias, device.entry(alias.target)?)));
    if let Some((alias, target)) = target {
        // The target comes first: the limits of its alias follow from its own.
        let name = format!("{} ({})", alias.target, target.name);
        let value = target_value(alias, raw).ok_or_else(|| {
            let message = format!("{own} is no whole number of steps of {name}");
            Box::new(
                Diagnostic::new(codes::INEXACT_VALUE, span, message)
                    .help(format!("set {} instead", alias.target)),
            )
        })?;
        check_one(target, value, span, &format!("{own} is {} in {name}, which", show(target, value)))?;
    }
    check_one(entry, raw, span, &own)
}

/// The raw value that the target of an alias gets; `None` when it would have to be rounded.
pub(super) fn target_value(alias: &Alias, raw: i128) -> Option<i128> {
    Ratio::whole(raw).checked_div(alias.factor)?.to_whole()
}

fn show(entry: &Entry, raw: i128) -> String {
    format_value(entry, &Value::Integer(raw))
}

fn check_one(entry: &Entry, raw: i128, span: Span, what: &str) -> Result<(), Box<Diagnostic>> {
    let in_type = entry.data_type.range().is_none_or(|(low, high)| (low..=high).contains(&raw));
    if !in_type || (entry.data_type != DataType::Boolean && !entry.allows(raw)) {
        return Err(Box::new(
            Diagnostic::new(
                codes::VALUE_OUTSIDE_LIMITS,
                span,
                format!("{what} is outside {}", allowed(entry)),
            )
            .help("write a value within the limits; the device refuses any other"),
        ));
    }
    match entry.named_type.as_ref().map(|named| &named.kind) {
        Some(TypeKind::Enum(values)) if !values.iter().any(|value| value.value == raw) => Err(Box::new(
            Diagnostic::new(codes::UNKNOWN_ENUM_VALUE, span, format!("{what} is not a value of its enum"))
                .help("write the name of a value"),
        )),
        _ => Ok(()),
    }
}
