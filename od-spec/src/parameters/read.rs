//! One setting: which entry, and which value of its type.

use super::Setting;
use super::entries::Entries;
use crate::ast::DefaultDecl;
use crate::ast::SettingDecl;
use crate::diag::{Diagnostic, Diagnostics, Suggestions, codes};
use crate::model::{Alias, DataType, Dictionary, Entry, EntryId, NamedType, Ratio, TypeKind, Value};
use crate::resolve::{bit_values, consumers, values};
use crate::source::{Span, Spanned};
use crate::wording::format_value;

/// Why a setting cannot be read.
pub(super) struct Unread {
    /// What is wrong with it.
    pub diagnostics: Diagnostics,
    /// The entry that it names, where that much is clear.
    pub id: Option<EntryId>,
}

impl Unread {
    fn one(diagnostic: Diagnostic, id: Option<EntryId>) -> Self {
        let mut diagnostics = Diagnostics::new();
        diagnostics.push(diagnostic);
        Self { diagnostics, id }
    }
}

/// Reads a setting.
pub(super) fn setting(
    device: &Dictionary,
    entries: &Entries<'_>,
    node: u8,
    decl: &SettingDecl,
    suggestions: &mut Suggestions,
) -> Result<Setting, Unread> {
    let (id, entry) =
        entries.find(&decl.reference, suggestions).map_err(|diagnostic| Unread::one(*diagnostic, None))?;
    let value = value(id, entry, &decl.value, suggestions)
        .map_err(|diagnostics| Unread { diagnostics, id: Some(id) })?;
    let (span, value_span) = (decl.span, decl.value.span);
    let holder = match &entry.alias {
        Some(alias) => {
            let raw = value.integer_for(node);
            if let Some(raw) = raw.filter(|raw| target_value(alias, *raw).is_none()) {
                return Err(Unread::one(no_whole_steps(device, id, alias, raw, value_span), Some(id)));
            }
            alias.target
        }
        None => id,
    };
    Ok(Setting { id, holder, value, span, value_span })
}

/// A value as it is written: one, the bits that are 1, or a heartbeat consumer by node and time.
fn value(
    id: EntryId,
    entry: &Entry,
    written: &Spanned<DefaultDecl>,
    suggestions: &mut Suggestions,
) -> Result<Value, Diagnostics> {
    let mut diagnostics = Diagnostics::new();
    let read = match (&written.value, entry.named_type.as_deref()) {
        (DefaultDecl::One(text), Some(NamedType { kind: TypeKind::Bits(fields), .. }))
            if let Some(bits) = listed(text, written.span) =>
        {
            bit_values::read(&bits, fields, entry.data_type, &mut diagnostics)
        }
        (DefaultDecl::One(text), _) => {
            // Spaces around a number are not part of it, but a text may not lose them unnoticed.
            let is_text = matches!(entry.data_type, DataType::VisibleString | DataType::UnicodeString);
            let text = if is_text { text } else { text.trim() };
            match values::read(text, written.span, expected(entry), suggestions) {
                Ok(value) => Some(value),
                Err(diagnostic) => {
                    diagnostics.push(*diagnostic);
                    None
                }
            }
        }
        (DefaultDecl::Each(bits), Some(NamedType { kind: TypeKind::Bits(fields), .. })) => {
            bit_values::read(bits, fields, entry.data_type, &mut diagnostics)
        }
        (DefaultDecl::ByDevice(keys), _) if consumers::are_meant(id.index, keys) => {
            consumers::raw(keys, written.span, &mut diagnostics).map(Value::Integer)
        }
        (DefaultDecl::Each(_) | DefaultDecl::ByDevice(_), _) => {
            diagnostics.push(no_such_form(id, entry, written));
            None
        }
    };
    read.ok_or(diagnostics)
}

/// A list of bits in one text, as on a command line: `[valve 1, valve 2]`.
fn listed(text: &str, span: Span) -> Option<Vec<Spanned<DefaultDecl>>> {
    let items = text.trim().strip_prefix('[')?.strip_suffix(']')?;
    let items = items.split(',').map(str::trim).filter(|item| !item.is_empty());
    Some(items.map(|item| Spanned::new(DefaultDecl::One(item.to_owned()), span)).collect())
}

/// A list for what has no bits, or a map for what has no entries.
fn no_such_form(id: EntryId, entry: &Entry, written: &Spanned<DefaultDecl>) -> Diagnostic {
    let name = &entry.name;
    let message = match &written.value {
        DefaultDecl::Each(_) => format!("a list names bits, and {id} ({name}) is not a bit field"),
        DefaultDecl::One(_) | DefaultDecl::ByDevice(_) => {
            format!("a map has the entries of an object, and {id} ({name}) is one value")
        }
    };
    Diagnostic::new(codes::BAD_VALUE, written.span, message).help("write one value")
}

/// Reads the value of a known entry.
pub(super) fn parameter(
    entry: &Entry,
    text: &Spanned<String>,
    suggestions: &mut Suggestions,
) -> Result<Value, Box<Diagnostic>> {
    values::read(&text.value, text.span, expected(entry), suggestions)
}

fn expected(entry: &Entry) -> values::Expected<'_> {
    values::Expected {
        data_type: entry.data_type,
        named: entry.named_type.as_deref(),
        unit: entry.unit.as_deref(),
        special: &entry.special,
    }
}

/// The raw value that the target of an alias gets; `None` when it would have to be rounded.
pub(super) fn target_value(alias: &Alias, raw: i128) -> Option<i128> {
    Ratio::whole(raw).checked_div(alias.factor)?.to_whole()
}

/// What is set through a view is a whole number of steps of the entry that it shows.
fn no_whole_steps(device: &Dictionary, id: EntryId, alias: &Alias, raw: i128, span: Span) -> Diagnostic {
    let name = |id| device.entry(id).map_or("", |entry| entry.name.as_str());
    let shown = device.entry(id).map(|entry| format_value(entry, &Value::Integer(raw)));
    let message = format!(
        "{id} ({}): {} is not a whole number of steps of {} ({})",
        name(id),
        shown.unwrap_or_default(),
        alias.target,
        name(alias.target)
    );
    Diagnostic::new(codes::INEXACT_VALUE, span, message).help(format!("set {} instead", alias.target))
}
