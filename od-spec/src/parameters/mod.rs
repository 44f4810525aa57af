//! Parameter values for one device: what a DCF carries beyond the defaults.

mod conditions;
mod eds_text;
mod limits;
mod pdos;

use std::collections::BTreeMap;

use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::{DataType, Dictionary, Entry, EntryId, System, Value};
use crate::resolve::{self, values};
use crate::source::{Span, Spanned};

pub use eds_text::problem as eds_text_problem;

/// Values of single entries, by entry.
pub type ParameterValues = BTreeMap<EntryId, Value>;

/// A setting `ENTRY=VALUE` and its place.
pub type Assignment = Spanned<String>;

/// A setting that was read.
struct Setting {
    /// The entry that it names.
    id: EntryId,
    /// The entry that holds the value: for an alias its target.
    holder: EntryId,
    /// The raw value on the node; `None` for texts and real numbers.
    raw: Option<i128>,
    /// Where it is written.
    span: Span,
}

/// Reads settings for the node of a device and checks them: entry, type, limits, locks, PDO parameters, constraints.
/// What is wrong goes to `diagnostics`; use the values only if no error is among them.
pub fn assign(
    system: &System,
    device: &Dictionary,
    node: u8,
    settings: &[Assignment],
    diagnostics: &mut Diagnostics,
) -> ParameterValues {
    let mut values = ParameterValues::new();
    let mut read_settings: Vec<Setting> = Vec::new();
    let (errors, _) = diagnostics.count();
    for assignment in settings {
        match read(device, node, assignment) {
            Ok((setting, value)) => {
                if let Some(before) = read_settings.iter().find(|other| other.holder == setting.holder) {
                    diagnostics.push(set_twice(&setting, before));
                    continue;
                }
                values.insert(setting.id, value);
                read_settings.push(setting);
            }
            Err(diagnostic) => diagnostics.push(*diagnostic),
        }
    }
    if diagnostics.count().0 == errors {
        let configured = conditions::Configured::new(system, device, node, &read_settings);
        pdos::check(&configured, &read_settings, diagnostics);
        conditions::check(&configured, &read_settings, diagnostics);
    }
    values
}

fn set_twice(again: &Setting, before: &Setting) -> Diagnostic {
    let Setting { id, holder, span, .. } = again;
    Diagnostic::new(codes::SET_TWICE, *span, format!("{holder} is set twice"))
        .label(if holder == id { "again here".to_owned() } else { format!("again here, as {id}") })
        .with(before.span, "first here")
        .help("keep one of the two")
}

fn read(device: &Dictionary, node: u8, setting: &Assignment) -> Result<(Setting, Value), Box<Diagnostic>> {
    let span = setting.span;
    let Some((name, text)) = setting.value.split_once('=') else {
        return Err(Box::new(
            Diagnostic::new(
                codes::BAD_ASSIGNMENT,
                span,
                format!("found `{}`, expected ENTRY=VALUE", setting.value),
            )
            .help("write an index or a name, `=`, and a value: `607D.2=9000`"),
        ));
    };
    let value_span = span.part(name.len() + 1, setting.value.len());
    let name_span = span.part(0, name.len());
    let (id, entry) = find(device, name.trim(), name_span)?;
    check_access(id, entry, name_span)?;
    // Blanks around a number are no part of it, but a text may not lose them unnoticed.
    let text = if matches!(entry.data_type, DataType::VisibleString | DataType::UnicodeString) {
        text
    } else {
        text.trim()
    };
    let unit = entry.unit.as_deref();
    let expected = values::Expected { data_type: entry.data_type, named: entry.named_type.as_deref(), unit };
    let value = values::read(text, value_span, expected)?;
    eds_text::check(id, entry, &value, value_span)?;
    let raw = value.integer_for(node);
    if let Some(raw) = raw {
        limits::check(device, id, entry, raw, value_span)?;
    }
    let holder = holder(device, id);
    Ok((Setting { id, holder, raw, span }, value))
}

/// The entry that holds the value of an entry: for an alias its target.
fn holder(device: &Dictionary, id: EntryId) -> EntryId {
    device.entry(id).and_then(|entry| entry.alias.as_ref()).map_or(id, |alias| alias.target)
}

fn find<'a>(device: &'a Dictionary, name: &str, span: Span) -> Result<(EntryId, &'a Entry), Box<Diagnostic>> {
    let id = resolve::lookup(device, name).map_err(|nearest| {
        let diagnostic =
            Diagnostic::new(codes::UNKNOWN_ENTRY, span, format!("`{}` has no entry `{name}`", device.key));
        Box::new(match nearest {
            Some(word) => diagnostic.help(format!("did you mean `{word}`?")),
            None => diagnostic
                .help("write an index in hexadecimal (`607D.2`), an object's name, or `object.entry`"),
        })
    })?;
    device.entry(id).map(|entry| (id, entry)).ok_or_else(|| {
        Box::new(
            Diagnostic::new(codes::UNKNOWN_ENTRY, span, format!("there is no entry {id}")).help("correct it"),
        )
    })
}

fn check_access(id: EntryId, entry: &Entry, span: Span) -> Result<(), Box<Diagnostic>> {
    let refuse =
        |code, message: String, help: &str| Err(Box::new(Diagnostic::new(code, span, message).help(help)));
    if !entry.access.is_writable() {
        return refuse(
            codes::NOT_WRITABLE,
            format!("{id} ({}) is `{}`", entry.name, entry.access.word()),
            "only entries that can be written over the bus can be set",
        );
    }
    if entry.locked {
        return refuse(
            codes::LOCKED_PARAMETER,
            format!("{id} ({}) is locked: factory-set, writable only in service", entry.name),
            "leave the entry out; a PLC cannot write it",
        );
    }
    if !entry.eds.access.is_writable() {
        return refuse(
            codes::NOT_WRITABLE,
            format!("{id} ({}) is `{}` in the EDS", entry.name, entry.eds.access.word()),
            "leave the entry out; what reads the DCF takes the entry for one that cannot be written",
        );
    }
    if entry.eds.no_write {
        return refuse(
            codes::NOT_FOR_DOWNLOAD,
            format!("{id} ({}) must not be written by configuration tools", entry.name),
            "leave the entry out; writing it triggers a command",
        );
    }
    Ok(())
}
