//! What the nodes of a class are set to, and whether the device can be set to it.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

use super::bus::OnTheBus;
use super::{Member, Plant, PlantDevice, PlantLayer};
use crate::check::{self, Rules};
use crate::commissioning::Commissioning;
use crate::diag::{Diagnostic, Diagnostics};
use crate::model::{Constraint, Dictionary, Document, EntryId, Expr, System};
use crate::node_of_file::NodeOfFile;
use crate::parameters::{Assigned, Laid, Layer, SettingNames, lay_over};
use crate::standard;

/// What the nodes of a class are set to.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Settled {
    /// The node-ID, bit rate and values; the names are those of no node in particular.
    pub commissioning: Commissioning,
    /// Where each value is from. Layers are counted as in the class.
    pub assigned: Assigned,
    /// What the nodes have to do with others on their bus. The device with the values is much larger, and not kept.
    pub(super) on_the_bus: OnTheBus,
    /// What is wrong with the values.
    pub diagnostics: Diagnostics,
}

impl Plant {
    /// Works out what the nodes of a class are set to, and checks it by the rules of the language, as the other devices at their position
    /// are set. Classes depend on nothing but the plant: they may be settled in any order, and at the same time.
    pub fn settle(&self, class: usize) -> Option<Settled> {
        let rules = standard::rules(&check::RULES);
        let class = self.classes.get(class)?;
        let device = self.devices.get(class.own.device)?;
        let mut diagnostics = Diagnostics::new();
        let Laid { assigned, configured } = self.laid(rules, &class.own, &mut diagnostics)?;
        self.locks(device, &class.own, &assigned, &mut diagnostics);
        let mut unread = Diagnostics::new();
        let others: Vec<Dictionary> = class
            .others
            .iter()
            // What is wrong with them is said of them.
            .filter_map(|other| Some(self.laid(rules, other, &mut unread)?.configured))
            .collect();
        let around = surroundings(&device.system, &device.dictionary.key, others);
        check::configuration(rules, &around, &configured, class.own.node, &mut diagnostics);
        let mut commissioning =
            NodeOfFile::or_defaults(device.base.as_deref(), &device.dictionary, class.own.node);
        commissioning.bit_rate = class.own.bit_rate;
        commissioning.values.extend(assigned.values.clone());
        commissioning.unlocked.extend(assigned.unlocked.iter().copied());
        if let Some(warning) = device.base.as_ref().and_then(|base| base.left_behind(&commissioning)) {
            diagnostics.push(warning);
        }
        let on_the_bus = OnTheBus::of(&configured, class.own.node);
        Some(Settled { commissioning, assigned, on_the_bus, diagnostics })
    }

    /// The layers of a node, the first one first.
    pub fn layers_of(&self, member: &Member) -> impl Iterator<Item = &PlantLayer> {
        member.layers.iter().filter_map(|at| self.layers.get(*at))
    }

    fn laid(&self, rules: Rules<'_>, member: &Member, diagnostics: &mut Diagnostics) -> Option<Laid> {
        let device = self.devices.get(member.device)?;
        let layers: Vec<&Layer> = self.layers_of(member).map(|layer| &layer.layer).collect();
        let dictionary = device.as_node(member.node);
        Some(lay_over(rules, &device.system, &dictionary, member.node, &layers, diagnostics))
    }

    /// A locked entry is unlocked by the level that sets it: an unlock somewhere else was meant for another value.
    fn locks(
        &self,
        device: &PlantDevice,
        member: &Member,
        assigned: &Assigned,
        diagnostics: &mut Diagnostics,
    ) {
        let dictionary = &device.dictionary;
        let names = SettingNames::of(dictionary);
        let holder = |id: EntryId| {
            let alias = dictionary.entry(id).and_then(|entry| entry.alias.as_ref());
            alias.map_or(id, |alias| alias.target)
        };
        let opened: Vec<BTreeSet<EntryId>> = self
            .layers_of(member)
            .map(|layer| {
                let named = layer.layer.unlocked.iter();
                named.filter_map(|name| names.entry(&name.value)).map(holder).collect()
            })
            .collect();
        for id in &assigned.unlocked {
            let origins = assigned.origins.get(id).into_iter();
            for origin in origins.chain(assigned.overridden.get(id).into_iter().flatten()) {
                let level = self.layers_of(member).nth(origin.layer);
                let is_open = opened.get(origin.layer).is_some_and(|open| open.contains(&holder(*id)));
                if let Some(level) = level.filter(|_| !is_open) {
                    let name = dictionary.entry_name(*id).unwrap_or_default();
                    let message =
                        format!("{id} ({name}) is locked, and {} does not unlock it", level.words());
                    diagnostics.push(
                        Diagnostic::new(check::codes::LOCKED, origin.span, message)
                            .help("each level unlocks what it sets: name the entry under `unlock:` next to these parameters"),
                    );
                }
            }
        }
    }
}

/// The system as a node sees it: other devices as they are set on the same bus. Conditions with a device that is not
/// there, or of which it is unknown which one is meant, say nothing.
fn surroundings<'a>(system: &'a System, own: &str, others: Vec<Dictionary>) -> Cow<'a, System> {
    let is_there = |key: &str| key == own || others.iter().any(|other| other.key == key);
    let named = |constraint: &Constraint, is_fine: &dyn Fn(&str) -> bool| {
        let conditions = [Some(&constraint.require), constraint.when.as_ref()];
        let entries = conditions.into_iter().flatten().flat_map(Expr::entries);
        entries.filter_map(|entry| entry.device.as_deref()).all(is_fine)
    };
    // Most specifications have no condition between devices.
    if system.constraints.iter().all(|constraint| named(constraint, &|key| key == own)) {
        return Cow::Borrowed(system);
    }
    let constraints = system.constraints.iter().filter(|one| named(one, &is_there)).cloned().collect();
    let mut around = System {
        source: system.source,
        title: system.title.clone(),
        languages: system.languages.clone(),
        document: Document::default(),
        vendor: system.vendor.clone(),
        units: system.units.clone(),
        types: system.types.clone(),
        errors: system.errors.clone(),
        machines: system.machines.clone(),
        constraints: Vec::new(),
        errata: Vec::new(),
        devices: others,
        constraints_by_device: BTreeMap::new(),
    };
    around.devices.extend(system.device(own).cloned());
    around.constrain(constraints);
    Cow::Owned(around)
}
