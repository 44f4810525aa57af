//! One setting as it is written: `607D.2=9000`, `target position = 90.00 °`.

use super::{Assignment, Setting};
use crate::diag::{Diagnostic, Suggestions, codes};
use crate::model::{Alias, DataType, Dictionary, Entry, EntryId, Ratio, Value};
use crate::resolve::{self, values};
use crate::source::{Span, Spanned};
use crate::visible::{is_hidden, turns_text};
use crate::wording::format_value;

/// Why a setting cannot be read.
pub(super) struct Unread {
    /// What is wrong with it.
    pub diagnostic: Box<Diagnostic>,
    /// The entry that it names, where that much is clear.
    pub id: Option<EntryId>,
}

impl From<Box<Diagnostic>> for Unread {
    fn from(diagnostic: Box<Diagnostic>) -> Self {
        Self { diagnostic, id: None }
    }
}

/// Reads a setting: which entry, and which value of its type.
pub(super) fn setting(
    entries: &Entries<'_>,
    node: u8,
    assignment: &Assignment,
    suggestions: &mut Suggestions,
) -> Result<Setting, Unread> {
    let device = entries.device;
    let span = assignment.span;
    if let Some((at, c)) = assignment.value.char_indices().find(|(_, c)| is_hidden(*c)) {
        return Err(Box::new(hidden(span.part(at, at + c.len_utf8()), c)).into());
    }
    let Some((name, text)) = assignment.value.split_once('=') else {
        return Err(Box::new(
            Diagnostic::new(
                codes::BAD_ASSIGNMENT,
                span,
                format!("found `{}`, expected ENTRY=VALUE", assignment.value),
            )
            .help("write an index or a name, `=`, and a value: `607D.2=9000`"),
        )
        .into());
    };
    let value_span = span.part(name.len() + 1, assignment.value.len());
    let (id, entry) = entries.find(name.trim(), span.part(0, name.len()), suggestions)?;
    // Blanks around a number are no part of it, but a text may not lose them unnoticed.
    let text = if matches!(entry.data_type, DataType::VisibleString | DataType::UnicodeString) {
        text
    } else {
        text.trim()
    };
    let value = values::read(text, value_span, expected(entry), suggestions)
        .map_err(|diagnostic| Unread { diagnostic, id: Some(id) })?;
    let holder = match &entry.alias {
        Some(alias) => {
            let raw = value.integer_for(node);
            if let Some(raw) = raw.filter(|raw| target_value(alias, *raw).is_none()) {
                let diagnostic = Box::new(no_whole_steps(device, id, alias, raw, value_span));
                return Err(Unread { diagnostic, id: Some(id) });
            }
            alias.target
        }
        None => id,
    };
    Ok(Setting { id, holder, value, span, value_span })
}

/// As in a specification, which cannot hold a control character without an escape.
fn hidden(span: Span, c: char) -> Diagnostic {
    let what = if turns_text(c) { "turns the text around it" } else { "nobody sees" };
    Diagnostic::new(codes::TURNED_TEXT, span, format!("found U+{:04X}, which {what}", u32::from(c)))
        .help("remove the character")
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

/// The entries of a device, as settings name them.
pub(super) struct Entries<'a> {
    device: &'a Dictionary,
    lookup: resolve::Lookup<'a>,
}

impl<'a> Entries<'a> {
    pub(super) const fn of(device: &'a Dictionary) -> Self {
        Self { device, lookup: resolve::Lookup::new(device) }
    }

    fn find(
        &self,
        name: &str,
        span: Span,
        suggestions: &mut Suggestions,
    ) -> Result<(EntryId, &'a Entry), Box<Diagnostic>> {
        let device = self.device;
        let id = self.lookup.find(name, suggestions).map_err(|why| {
            Box::new(match why {
                resolve::NotFound::Unknown { nearest } => {
                    let message = format!("`{}` has no entry `{name}`", device.key);
                    let diagnostic = Diagnostic::new(codes::UNKNOWN_ENTRY, span, message);
                    match nearest {
                        Some(word) => diagnostic.help(format!("did you mean `{word}`?")),
                        None => diagnostic.help(
                            "write an index in hexadecimal (`607D.2`), an object's name, or `object.entry`",
                        ),
                    }
                }
                resolve::NotFound::Ambiguous { decimal, hexadecimal } => Diagnostic::new(
                    codes::BAD_ASSIGNMENT,
                    span,
                    format!(
                        "sub-index {0} is {0} in decimal and {1} in hexadecimal, and behind a colon both are usual",
                        decimal.sub, hexadecimal.sub
                    ),
                )
                .help(format!("write `{0}.{1}` for sub-index {1}, or `{0}.{2}` for sub-index {2}",
                    format_args!("{:04X}", decimal.index.0), decimal.sub, hexadecimal.sub)),
            })
        })?;
        device.entry(id).map(|entry| (id, entry)).ok_or_else(|| {
            Box::new(
                Diagnostic::new(codes::UNKNOWN_ENTRY, span, format!("there is no entry {id}"))
                    .help("correct it"),
            )
        })
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
        "{id} ({}): {} is no whole number of steps of {} ({})",
        name(id),
        shown.unwrap_or_default(),
        alias.target,
        name(alias.target)
    );
    Diagnostic::new(codes::INEXACT_VALUE, span, message).help(format!("set {} instead", alias.target))
}
