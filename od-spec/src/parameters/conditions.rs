//! Constraints and `writable-when`, tried on the settings over the defaults.

use std::collections::BTreeMap;

use super::{Setting, holder, limits};
use crate::diag::{Code, Diagnostic, Diagnostics};
use crate::expr::{EntryRef, Outcome};
use crate::model::{Constraint, Dictionary, EntryId, System, convert};
use crate::resolve::{self, Lookup};

/// The values of one node: what is set, over the defaults.
pub(super) struct Configured<'a> {
    pub system: &'a System,
    pub device: &'a Dictionary,
    pub node: u8,
    /// By the entry that holds the value.
    values: BTreeMap<EntryId, i128>,
}

impl<'a> Configured<'a> {
    pub(super) fn new(system: &'a System, device: &'a Dictionary, node: u8, settings: &[Setting]) -> Self {
        let value = |setting: &Setting| {
            let alias = device.entry(setting.id).and_then(|entry| entry.alias.as_ref());
            let raw = setting.raw?;
            Some((setting.holder, alias.map_or(Some(raw), |alias| limits::target_value(alias, raw))?))
        };
        Self { system, device, node, values: settings.iter().filter_map(value).collect() }
    }

    /// The raw value of an entry of the device.
    pub(super) fn value(&self, id: EntryId) -> Option<i128> {
        self.raw_value(self.device, id)
    }
}

impl Lookup for Configured<'_> {
    fn device(&self) -> &Dictionary {
        self.device
    }
    fn other(&self, key: &str) -> Option<&Dictionary> {
        self.system.device(key)
    }
    fn raw_value(&self, device: &Dictionary, id: EntryId) -> Option<i128> {
        let entry = device.entry(id)?;
        if device.key != self.device.key {
            // Nothing is known about the node-ID of another device.
            return entry.default.as_ref()?.integer();
        }
        if let Some(alias) = &entry.alias {
            let target = self.raw_value(device, alias.target)?;
            return convert(target, alias.factor, alias.rounding, alias.outside, entry.data_type);
        }
        self.values.get(&id).copied().or_else(|| entry.default.as_ref()?.integer_for(self.node))
    }
}

/// Reports constraints that the settings break, and entries that cannot be written with these settings.
pub(super) fn check(configured: &Configured<'_>, settings: &[Setting], diagnostics: &mut Diagnostics) {
    let key = &configured.device.key;
    for constraint in
        configured.system.constraints.iter().filter(|constraint| constraint.devices.includes(key))
    {
        check_constraint(constraint, configured, settings, diagnostics);
    }
    for setting in settings {
        check_write_condition(setting, configured, diagnostics);
    }
}

fn check_constraint(
    constraint: &Constraint,
    configured: &Configured<'_>,
    settings: &[Setting],
    diagnostics: &mut Diagnostics,
) {
    let device = configured.device;
    let touches = |entry: &&EntryRef| {
        let own = entry.device.as_ref().is_none_or(|key| *key == device.key);
        settings.iter().find(|setting| own && setting.holder == holder(device, entry.id))
    };
    let when = constraint.when.iter().flat_map(|when| when.entries());
    let named = constraint.require.entries().into_iter().chain(when);
    let Some(setting) = named.into_iter().find_map(|entry| touches(&entry)) else { return };
    if let Outcome::Fails { left, op, right } = resolve::check_constraint(constraint, configured) {
        diagnostics.push(
            Diagnostic::new(
                Code::ConstraintBroken,
                setting.span,
                format!("the settings break `{}`", constraint.name),
            )
            .label(format!("{} is {}, {} is {}: not {}", left.0, left.1, right.0, right.1, op.sign()))
            .with(constraint.span, "the constraint")
            .help("set values that meet the condition; entries that are not set have their defaults"),
        );
    }
}

/// A value set through an alias has to meet the conditions of the alias and of its target.
fn check_write_condition(setting: &Setting, configured: &Configured<'_>, diagnostics: &mut Diagnostics) {
    let condition = [setting.id, setting.holder].into_iter().find_map(|id| {
        let condition = configured.device.entry(id)?.writable_when.as_ref()?;
        matches!(condition.evaluate(configured), Outcome::Fails { .. }).then_some((id, condition))
    });
    let Some((id, condition)) = condition else { return };
    let written = if id == setting.id { String::new() } else { format!(", which {} shows,", setting.id) };
    diagnostics.push(
        Diagnostic::new(
            Code::ConditionUnmet,
            setting.span,
            format!("the device accepts {id}{written} only while `{}`", condition.text),
        )
        .help("a download at boot will be refused unless the device is brought into that state first"),
    );
}
