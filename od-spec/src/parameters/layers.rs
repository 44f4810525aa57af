//! Settings in layers: what a type says, and who lays something over it.

use std::borrow::Borrow;
use std::collections::{BTreeMap, BTreeSet};

use super::entries::Entries;
use super::{Setting, overlay, read};
use crate::ast::Name;
use crate::ast::SettingDecl;
use crate::check;
use crate::commissioning::ParameterValues;
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::model::{Dictionary, EntryId, Fact, System};
use crate::source::Span;
use crate::standard;

/// Settings of one level, such as those of a type of turbine or of one blade. Within a layer each entry is set once; what a
/// later layer sets takes the place of what an earlier one did.
#[derive(Debug, Clone, Default)]
#[non_exhaustive]
pub struct Layer {
    /// The settings.
    pub settings: Vec<SettingDecl>,
    /// Locked entries that may be set all the same, in this layer or any other.
    pub unlocked: Vec<Name>,
}

impl Layer {
    /// A layer of settings, in which nothing is unlocked.
    pub const fn of(settings: Vec<SettingDecl>) -> Self {
        Self { settings, unlocked: Vec::new() }
    }
}

/// Where a value comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct Origin {
    /// Position of the layer.
    pub layer: usize,
    /// The entry that the setting names, which may be a view of the one that holds the value.
    pub id: EntryId,
    /// Where the setting is written.
    pub span: Span,
}

/// The values that settings in layers give.
#[derive(Debug, Clone, Default)]
#[non_exhaustive]
pub struct Assigned {
    /// The values, by the entry that is set.
    pub values: ParameterValues,
    /// The setting that each value is from.
    pub origins: BTreeMap<EntryId, Origin>,
    /// What earlier layers said about it, the first layer first.
    pub overridden: BTreeMap<EntryId, Vec<Origin>>,
    /// The locked entries among those that are set.
    pub unlocked: BTreeSet<EntryId>,
}

/// Reads settings in layers for the node of a device and checks what they amount to, as [`assign`](super::assign) does for one
/// list. What is wrong goes to `diagnostics`; use the values only if no error is among them.
pub fn assign_layers(
    system: &System,
    device: &Dictionary,
    node: u8,
    layers: &[Layer],
    diagnostics: &mut Diagnostics,
) -> Assigned {
    assign_layers_with(standard::rules(&check::RULES), system, device, node, layers, diagnostics)
}

/// A setting with its layer, and what it takes the place of.
struct Held {
    setting: Setting,
    layer: usize,
    before: Vec<Origin>,
}

impl Held {
    fn origin(&self) -> Origin {
        Origin { layer: self.layer, id: self.setting.id, span: self.setting.span }
    }
}

/// [`assign_layers`] under some of the rules.
pub(super) fn assign_layers_with(
    rules: check::Rules<'_>,
    system: &System,
    device: &Dictionary,
    node: u8,
    layers: &[Layer],
    diagnostics: &mut Diagnostics,
) -> Assigned {
    let laid = lay_over(rules, system, device, node, layers, diagnostics);
    check::configuration(rules, system, &laid.configured, node, diagnostics);
    laid.assigned
}

/// A device with settings laid over it, before rules looked at it.
pub(crate) struct Laid {
    /// The values.
    pub assigned: Assigned,
    /// The device that has them.
    pub configured: Dictionary,
}

/// Reads settings in layers and lays them over a device.
pub(crate) fn lay_over<L: Borrow<Layer>>(
    rules: check::Rules<'_>,
    system: &System,
    device: &Dictionary,
    node: u8,
    layers: &[L],
    diagnostics: &mut Diagnostics,
) -> Laid {
    let layers: Vec<&Layer> = layers.iter().map(Borrow::borrow).collect();
    let layers = layers.as_slice();
    let opened = unlocked(device, layers, diagnostics);
    let device = &*overlay::opened(device, &opened);
    let entries = Entries::of(device);
    let mut held: Vec<Held> = Vec::new();
    let mut by_holder: BTreeMap<EntryId, usize> = BTreeMap::new();
    for (layer, Layer { settings, .. }) in layers.iter().copied().enumerate() {
        for decl in settings {
            let setting = match read::setting(device, &entries, node, decl, &mut diagnostics.suggestions) {
                Ok(setting) => setting,
                // What cannot be set at all needs no better value.
                Err(unread) => {
                    let refusal =
                        unread.id.and_then(|id| refused(rules, system, device, node, id, decl.span));
                    diagnostics.append(refusal.unwrap_or(unread.diagnostics));
                    continue;
                }
            };
            match by_holder.get(&setting.holder).and_then(|at| held.get_mut(*at)) {
                Some(before) if before.layer == layer => {
                    diagnostics.push(set_twice(&setting, &before.setting));
                }
                Some(before) => {
                    let origin = before.origin();
                    before.before.push(origin);
                    (before.setting, before.layer) = (setting, layer);
                }
                None => {
                    by_holder.insert(setting.holder, held.len());
                    held.push(Held { setting, layer, before: Vec::new() });
                }
            }
        }
    }
    let configured = overlay::configured(device, node, held.iter().map(|held| &held.setting));
    let mut assigned = Assigned::default();
    for one in held {
        let (id, origin) = (one.setting.id, one.origin());
        if opened.contains(&id) {
            assigned.unlocked.insert(id);
        }
        assigned.origins.insert(id, origin);
        if !one.before.is_empty() {
            assigned.overridden.insert(id, one.before);
        }
        assigned.values.insert(id, one.setting.value);
    }
    Laid { assigned, configured }
}

/// The entries whose lock is lifted: those that are named, and what shows the same value.
fn unlocked(device: &Dictionary, layers: &[&Layer], diagnostics: &mut Diagnostics) -> BTreeSet<EntryId> {
    let entries = Entries::of(device);
    let mut opened = BTreeSet::new();
    for name in layers.iter().flat_map(|layer| &layer.unlocked) {
        let (id, entry) = match entries.whole(name, &mut diagnostics.suggestions) {
            Ok(found) => found,
            Err(diagnostic) => {
                diagnostics.push(*diagnostic);
                continue;
            }
        };
        if !entry.locked {
            let message = format!("{id} ({}) is not locked", entry.name);
            diagnostics.push(
                Diagnostic::new(codes::NOTHING_TO_UNLOCK, name.span, message)
                    .about((id, Fact::Access))
                    .help("remove it, or name the entry whose lock is meant"),
            );
            continue;
        }
        let holder = entry.alias.as_ref().map_or(id, |alias| alias.target);
        let views = device
            .entries()
            .filter(|(.., one)| one.alias.as_ref().is_some_and(|alias| alias.target == holder));
        let same = views.map(|(id, ..)| id).chain([id, holder]);
        opened.extend(same.filter(|id| device.entry(*id).is_some_and(|entry| entry.locked)));
    }
    opened
}

/// What the rules say about setting an entry at all, whatever the value; `None` if nothing.
fn refused(
    rules: check::Rules<'_>,
    system: &System,
    device: &Dictionary,
    node: u8,
    id: EntryId,
    place: Span,
) -> Option<Diagnostics> {
    let marked = overlay::marked(device, id, place);
    let about_setting: Vec<&check::Rule> =
        rules.list.iter().copied().filter(|rule| rule.is_about_setting()).collect();
    let mut refusal = Diagnostics::new();
    let rules = check::Rules { list: &about_setting, ..rules };
    check::configuration(rules, system, &marked, node, &mut refusal);
    refusal.has_errors().then_some(refusal)
}

fn set_twice(again: &Setting, before: &Setting) -> Diagnostic {
    let Setting { id, holder, span, .. } = again;
    Diagnostic::new(codes::SET_TWICE, *span, format!("{holder} is set twice"))
        .label(if holder == id { "again here".to_owned() } else { format!("again here, as {id}") })
        .with(before.span, "first here")
        .help("keep one of the two")
}
