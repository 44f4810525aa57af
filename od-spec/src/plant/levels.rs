//! What levels speak of is there: devices, and the positions of types.

use std::collections::{BTreeMap, BTreeSet};

use crate::ast::Name;
use crate::ast::plant::{LevelDecl, PlantDecl, TypeDecl};
use crate::decode::is_device_key;
use crate::diag::{Diagnostic, Diagnostics, codes, shorten};

/// Looks up the names of devices, types and positions that the levels of a plant speak of.
pub(super) fn check(decl: &PlantDecl, diagnostics: &mut Diagnostics) {
    let devices: Vec<&str> = decl.devices.iter().map(|device| device.key.value.as_str()).collect();
    let names = Names { decl, devices: &devices };
    for one in &decl.types {
        let own = Positions::of([one]);
        names.devices_at_positions(&one.level, diagnostics);
        let what = format!("type `{}`", one.name.value);
        names.level(&one.level, &own, &what, diagnostics);
    }
    for site in &decl.sites {
        let of_site = site.of_type.as_ref().and_then(|name| names.type_named(name, diagnostics));
        let mut all = of_site.into_iter().collect::<Vec<_>>();
        for machine in &site.machines {
            let of_machine = match &machine.of_type {
                Some(name) => names.type_named(name, diagnostics),
                None => of_site,
            };
            if machine.of_type.is_none() && site.of_type.is_none() {
                let message = format!("the machines of site `{}` have no type", site.name.value);
                if diagnostics.is_new(codes::MISSING_KEY, site.name.span) {
                    diagnostics.push(
                        Diagnostic::new(codes::MISSING_KEY, site.name.span, message)
                            .help("add `type:` to the site, or to each machine"),
                    );
                }
            }
            let Some(of_machine) = of_machine else { continue };
            all.push(of_machine);
            names.devices_at_positions(&machine.level, diagnostics);
            let what = format!("type `{}`", of_machine.name.value);
            names.level(&machine.level, &Positions::of([of_machine]), &what, diagnostics);
        }
        // Without a type it is unknown what a machine has; that is reported.
        if !all.is_empty() {
            names.devices_at_positions(&site.level, diagnostics);
            let what = format!("every machine of site `{}`", site.name.value);
            names.level(&site.level, &Positions::of(all), &what, diagnostics);
        }
    }
}

/// The positions of types, each with its devices.
struct Positions<'a>(BTreeMap<&'a str, BTreeSet<&'a str>>);

impl<'a> Positions<'a> {
    fn of(types: impl IntoIterator<Item = &'a TypeDecl>) -> Self {
        let mut positions: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
        for position in types.into_iter().flat_map(|one| &one.level.positions) {
            let devices = position.nodes.iter().map(|node| node.device.value.as_str());
            positions.entry(&position.name.value).or_default().extend(devices);
        }
        Self(positions)
    }

    fn has_device(&self, key: &str) -> bool {
        self.0.values().any(|devices| devices.contains(key))
    }
}

struct Names<'a> {
    decl: &'a PlantDecl,
    devices: &'a [&'a str],
}

impl<'a> Names<'a> {
    fn type_named(&self, name: &Name, diagnostics: &mut Diagnostics) -> Option<&'a TypeDecl> {
        let found = self.decl.types.iter().find(|one| one.name.value == name.value);
        if found.is_none() {
            let known = self.decl.types.iter().map(|one| one.name.value.as_str());
            let message = format!("the plant has no type `{}`", shorten(&name.value));
            let diagnostic = Diagnostic::new(codes::UNKNOWN_IN_PLANT, name.span, message);
            report(diagnostic, &name.value, known, "its types are", diagnostics);
        }
        found
    }

    /// Whether the plant has a device; says so if not.
    fn knows(&self, name: &Name, diagnostics: &mut Diagnostics) -> bool {
        let is_known = self.devices.contains(&name.value.as_str());
        // A key that is not one is already reported.
        if !is_known && is_device_key(&name.value) {
            let message = format!("the plant has no device `{}`", shorten(&name.value));
            let diagnostic = Diagnostic::new(codes::UNKNOWN_DEVICE, name.span, message);
            report(diagnostic, &name.value, self.devices.iter().copied(), "its devices are", diagnostics);
        }
        is_known
    }

    fn devices_at_positions(&self, level: &LevelDecl, diagnostics: &mut Diagnostics) {
        for node in level.positions.iter().flat_map(|position| &position.nodes) {
            self.knows(&node.device, diagnostics);
        }
    }

    /// What a level speaks of has to be among the positions of its type.
    fn level(&self, level: &LevelDecl, of_type: &Positions<'_>, what: &str, diagnostics: &mut Diagnostics) {
        let by_device = level.parameters.iter().map(|(device, _)| device);
        for device in by_device.chain(level.unlock.iter().map(|(device, _)| device)) {
            if self.knows(device, diagnostics) && !of_type.has_device(&device.value) {
                let message = format!("no position of {what} has a `{}`", device.value);
                diagnostics
                    .push(Diagnostic::new(codes::UNKNOWN_IN_PLANT, device.span, message).help(
                        "name a device that a position has, or put this one at a position of the type",
                    ));
            }
        }
        for position in &level.positions {
            let Some(devices) = of_type.0.get(position.name.value.as_str()) else {
                let message = format!("{what} has no position `{}`", position.name.value);
                let known = of_type.0.keys().copied();
                let diagnostic = Diagnostic::new(codes::UNKNOWN_IN_PLANT, position.name.span, message);
                report(diagnostic, &position.name.value, known, "its positions are", diagnostics);
                continue;
            };
            for node in &position.nodes {
                let device = node.device.value.as_str();
                if self.devices.contains(&device) && !devices.contains(device) {
                    let message = format!("position `{}` of {what} has no `{device}`", position.name.value);
                    let diagnostic = Diagnostic::new(codes::UNKNOWN_IN_PLANT, node.device.span, message);
                    report(diagnostic, device, devices.iter().copied(), "it has", diagnostics);
                }
            }
        }
    }
}

/// Reports a name that is not known, with the nearest of those that are, or all of them.
fn report<'a>(
    diagnostic: Diagnostic,
    name: &str,
    known: impl Iterator<Item = &'a str> + Clone,
    words: &str,
    diagnostics: &mut Diagnostics,
) {
    let word = diagnostics.suggestions.nearest(name, known.clone());
    let listed = || {
        let known: Vec<String> = known.map(|word| format!("`{word}`")).collect();
        format!("{words} {}", known.join(", "))
    };
    diagnostics.push(diagnostic.did_you_mean_or(word, listed));
}
