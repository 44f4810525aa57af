//! Parameter values for one device: what a DCF carries beyond the defaults.

use std::collections::BTreeMap;

use crate::diag::{Code, Diagnostic, Diagnostics};
use crate::expr::Outcome;
use crate::model::{DataType, Dictionary, Entry, EntryId, Ratio, System, Value, format_value};
use crate::resolve::{self, Lookup, values};
use crate::source::{Span, Spanned};

/// Values of single entries, by entry.
pub type ParameterValues = BTreeMap<EntryId, Value>;

/// A setting `ENTRY=VALUE` and its place.
pub type Assignment = Spanned<String>;

/// Reads settings for a device and checks them: entry, type, limits, locks, constraints. What is wrong goes to
/// `diagnostics`; use the values only if no error is among them.
pub fn assign(
    system: &System,
    device: &Dictionary,
    settings: &[Assignment],
    diagnostics: &mut Diagnostics,
) -> ParameterValues {
    let mut values = ParameterValues::new();
    let mut places: BTreeMap<EntryId, Span> = BTreeMap::new();
    for setting in settings {
        match read(device, setting) {
            Ok((id, value)) => {
                // An alias and its target are one value.
                let holder =
                    device.entry(id).and_then(|entry| entry.alias.as_ref()).map_or(id, |alias| alias.target);
                if let Some(before) = places.insert(holder, setting.span) {
                    diagnostics.push(
                        Diagnostic::new(Code::SetTwice, setting.span, format!("{holder} is set twice"))
                            .label(if holder == id {
                                "again here".to_owned()
                            } else {
                                format!("again here, as {id}")
                            })
                            .with(before, "first here")
                            .help("keep one of the two"),
                    );
                    continue;
                }
                values.insert(id, value);
            }
            Err(diagnostic) => diagnostics.push(*diagnostic),
        }
    }
    if !diagnostics.has_errors() {
        check_conditions(system, device, &values, &places, diagnostics);
    }
    values
}

fn read(device: &Dictionary, setting: &Assignment) -> Result<(EntryId, Value), Box<Diagnostic>> {
    let span = setting.span;
    let Some((name, text)) = setting.value.split_once('=') else {
        return Err(Box::new(
            Diagnostic::new(
                Code::BadAssignment,
                span,
                format!("found `{}`, expected ENTRY=VALUE", setting.value),
            )
            .help("write an index or a name, `=`, and a value: `607D.2=9000`"),
        ));
    };
    let value_span = span.part(name.len() + 1, setting.value.len());
    let name_span = span.part(0, name.len());
    let (name, text) = (name.trim(), text.trim());
    let id = resolve::lookup(device, name).map_err(|nearest| {
        let diagnostic =
            Diagnostic::new(Code::UnknownEntry, name_span, format!("`{}` has no entry `{name}`", device.key));
        Box::new(match nearest {
            Some(word) => diagnostic.help(format!("did you mean `{word}`?")),
            None => diagnostic
                .help("write an index in hexadecimal (`607D.2`), an object's name, or `object.entry`"),
        })
    })?;
    let entry = device.entry(id).ok_or_else(|| {
        Box::new(
            Diagnostic::new(Code::UnknownEntry, name_span, format!("there is no entry {id}"))
                .help("correct it"),
        )
    })?;
    check_access(id, entry, name_span)?;
    let unit = entry.unit.as_deref();
    let expected = values::Expected { data_type: entry.data_type, named: entry.named_type.as_deref(), unit };
    let value = values::read(text, value_span, expected)?;
    check_limits(id, entry, &value, value_span)?;
    Ok((id, value))
}

fn check_access(id: EntryId, entry: &Entry, span: Span) -> Result<(), Box<Diagnostic>> {
    let refuse =
        |code, message: String, help: &str| Err(Box::new(Diagnostic::new(code, span, message).help(help)));
    if !entry.access.is_writable() {
        return refuse(
            Code::NotWritable,
            format!("{id} ({}) is `{}`", entry.name, entry.access.word()),
            "only entries that can be written over the bus can be set",
        );
    }
    if entry.locked {
        return refuse(
            Code::LockedParameter,
            format!("{id} ({}) is locked: factory-set, writable only in service", entry.name),
            "leave the entry out; a PLC cannot write it",
        );
    }
    if entry.eds.no_write {
        return refuse(
            Code::NotForDownload,
            format!("{id} ({}) must not be written by configuration tools", entry.name),
            "leave the entry out; writing it triggers a command",
        );
    }
    Ok(())
}

fn check_limits(id: EntryId, entry: &Entry, value: &Value, span: Span) -> Result<(), Box<Diagnostic>> {
    match value {
        Value::Integer(raw) if entry.data_type != DataType::Boolean && !entry.allows(*raw) => Err(Box::new(
            Diagnostic::new(
                Code::ValueOutsideLimits,
                span,
                format!(
                    "{id} ({}): {} is outside {}",
                    entry.name,
                    format_value(entry, value),
                    resolve::allowed(entry)
                ),
            )
            .help("write a value within the limits; the device refuses any other"),
        )),
        _ => Ok(()),
    }
}

/// The values set here over the defaults.
struct Configured<'a> {
    system: &'a System,
    device: &'a Dictionary,
    values: BTreeMap<EntryId, i128>,
}

impl Lookup for Configured<'_> {
    fn device(&self) -> &Dictionary {
        self.device
    }
    fn other(&self, key: &str) -> Option<&Dictionary> {
        self.system.device(key)
    }
    fn raw_value(&self, device: &Dictionary, id: EntryId) -> Option<i128> {
        let set = (device.key == self.device.key).then(|| self.values.get(&id)).flatten();
        set.copied().or_else(|| device.entry(id)?.default.as_ref()?.integer())
    }
}

fn check_conditions(
    system: &System,
    device: &Dictionary,
    values: &ParameterValues,
    places: &BTreeMap<EntryId, Span>,
    diagnostics: &mut Diagnostics,
) {
    let mut configured = Configured { system, device, values: BTreeMap::new() };
    for (id, value) in values {
        let Some(raw) = value.integer() else { continue };
        configured.values.insert(*id, raw);
        if let Some(alias) = device.entry(*id).and_then(|entry| entry.alias.as_ref())
            && let Some(target) = Ratio::whole(raw).checked_div(alias.factor)
        {
            configured.values.insert(alias.target, target.floor());
        }
    }
    for constraint in system.constraints.iter().filter(|constraint| constraint.devices.contains(&device.key))
    {
        let touched = constraint.require.entries().into_iter().find_map(|entry| {
            let own = entry.device.as_ref().is_none_or(|key| *key == device.key);
            places.get(&entry.id).filter(|_| own)
        });
        let Some(span) = touched else { continue };
        if let Outcome::Fails { left, op, right } = resolve::check_constraint(constraint, &configured) {
            diagnostics.push(
                Diagnostic::new(
                    Code::ConstraintBroken,
                    *span,
                    format!("the settings break `{}`", constraint.name),
                )
                .label(format!("{} is {}, {} is {}: not {}", left.0, left.1, right.0, right.1, op.sign()))
                .with(constraint.span, "the constraint")
                .help("set values that meet the condition; entries that are not set have their defaults"),
            );
        }
    }
    for (id, span) in places {
        let Some(condition) = device.entry(*id).and_then(|entry| entry.writable_when.as_ref()) else {
            continue;
        };
        if let Outcome::Fails { .. } = condition.evaluate(&configured) {
            diagnostics.push(
                Diagnostic::new(
                    Code::ConditionUnmet,
                    *span,
                    format!("the device accepts {id} only while `{}`", condition.text),
                )
                .help(
                    "a download at boot will be refused unless the device is brought into that state first",
                ),
            );
        }
    }
}
