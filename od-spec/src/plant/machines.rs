//! The machines of a plant, runs expanded, with their nodes and what each level says of them.

use std::collections::{BTreeMap, BTreeSet};

use super::{Level, Machine, Plant, PlantLayer, PlantNode};
use crate::ast::Name;
use crate::ast::plant::{LevelDecl, MachineDecl, MachineKey, NodeDecl, PlantDecl, SiteDecl, TypeDecl};
use crate::commissioning::TextOfNode;
use crate::diag::{Diagnostic, Diagnostics, codes};
use crate::limits::NODES_OF_PLANT;
use crate::order::Arrange as _;
use crate::parameters::Layer;
use crate::source::Spanned;

/// Makes machines, nodes and layers.
pub(super) fn expand(decl: &PlantDecl, plant: &mut Plant, diagnostics: &mut Diagnostics) {
    let types: Vec<Said> = decl
        .types
        .iter()
        .map(|one| Said::of(&one.level, &Level::Type(one.name.value.clone()), plant))
        .collect();
    let mut room = NODES_OF_PLANT;
    for (at, site) in decl.sites.iter().enumerate() {
        let of_site = Said::of(&site.level, &Level::Site(site.name.value.clone()), plant);
        let of_machines: Vec<Said> = site
            .machines
            .iter()
            .map(|machine| {
                let level = Level::Machines { site: site.name.value.clone(), machines: key_text(machine) };
                Said::of(&machine.level, &level, plant)
            })
            .collect();
        for (name, chain) in machines(site, diagnostics) {
            let last = |of: fn(&MachineDecl) -> Option<&Name>| {
                chain.iter().rev().find_map(|at| of(&site.machines[*at]))
            };
            let Some(name_of_type) = last(|machine| machine.of_type.as_ref()).or(site.of_type.as_ref())
            else {
                continue;
            };
            let is_named = |one: &TypeDecl| one.name.value == name_of_type.value;
            let Some(of_type) = decl.types.iter().position(is_named) else { continue };
            let type_decl = &decl.types[of_type];
            let Some(bit_rate) = last(|machine| machine.bit_rate.as_ref()).or(type_decl.bit_rate.as_ref())
            else {
                continue;
            };
            let said: Vec<(&LevelDecl, &Said)> =
                [(&type_decl.level, &types[of_type]), (&site.level, &of_site)]
                    .into_iter()
                    .chain(chain.iter().map(|at| (&site.machines[*at].level, &of_machines[*at])))
                    .collect();
            let first = plant.nodes.len();
            nodes(type_decl, &said, plant, diagnostics);
            let count = plant.nodes.len() - first;
            let Some(left) = room.checked_sub(count.max(1)) else {
                let message = format!("the plant has more than {NODES_OF_PLANT} nodes");
                diagnostics.push(
                    Diagnostic::new(codes::TOO_MANY_NODES, site.name.span, message)
                        .help("correct the runs, or make a plant file for each site"),
                );
                return;
            };
            room = left;
            let smallest = chain.last().map_or(site.name.span, |at| site.machines[*at].key.span);
            let net_name = last(|machine| machine.net_name.as_ref());
            let net_name = match net_name.map(|name| TextOfNode::Network.read("net-name:", &name.value)) {
                Some(Ok(text)) => text,
                Some(Err(diagnostic)) => {
                    let span = net_name.map_or(smallest, |name| name.span);
                    diagnostics.push(diagnostic.at(span));
                    String::new()
                }
                None => format!("{} {name}", site.name.value),
            };
            plant.machines.push(Machine {
                site: at,
                of_type,
                bit_rate: bit_rate.clone(),
                serial: last(|machine| machine.serial.as_ref()).cloned(),
                comment: last(|machine| machine.comment.as_ref()).map(|text| text.value.clone()),
                net_number: chain
                    .iter()
                    .rev()
                    .find_map(|at| site.machines[*at].net_number)
                    .map_or(1, |number| number.value),
                net_name,
                nodes: first..plant.nodes.len(),
                bus: 0,
                span: smallest,
                name,
            });
        }
    }
}

/// Where the layers of a level are, by position and device.
struct Said(BTreeMap<(Option<String>, String), usize>);

impl Said {
    /// Takes what a level says into the plant.
    fn of(decl: &LevelDecl, level: &Level, plant: &mut Plant) -> Self {
        let mut said = Self(BTreeMap::new());
        let mut by_device: BTreeMap<&str, (Layer, Vec<&Name>)> = BTreeMap::new();
        for (device, settings) in &decl.parameters {
            let (layer, names) = by_device.entry(&device.value).or_default();
            layer.settings.clone_from(settings);
            names.push(device);
        }
        for (device, unlocked) in &decl.unlock {
            let (layer, names) = by_device.entry(&device.value).or_default();
            layer.unlocked.clone_from(unlocked);
            names.push(device);
        }
        for (_, (layer, names)) in by_device {
            if let Some(device) = names.first() {
                said.push(level, None, device, layer, plant);
            }
        }
        for position in &decl.positions {
            for node in &position.nodes {
                let layer = Layer { settings: node.settings.clone(), unlocked: node.unlock.clone() };
                if !layer.settings.is_empty() || !layer.unlocked.is_empty() {
                    said.push(level, Some(&position.name.value), &node.device, layer, plant);
                }
            }
        }
        said
    }

    fn push(
        &mut self,
        level: &Level,
        position: Option<&String>,
        device: &Name,
        layer: Layer,
        plant: &mut Plant,
    ) {
        let Some(at) = plant.devices.iter().position(|one| one.key == device.value) else { return };
        self.0.insert((position.cloned(), device.value.clone()), plant.layers.len());
        plant.layers.push(PlantLayer {
            level: level.clone(),
            position: position.cloned(),
            device: at,
            layer,
            span: device.span,
        });
    }

    /// What it says of a device at a position: of every position first.
    fn about(&self, position: &str, device: &str) -> impl Iterator<Item = usize> {
        let layer = |position: Option<String>| self.0.get(&(position, device.to_owned())).copied();
        [layer(None), layer(Some(position.to_owned()))].into_iter().flatten()
    }
}

fn key_text(machine: &MachineDecl) -> String {
    match &machine.key.value {
        MachineKey::Name(name) => name.clone(),
        MachineKey::Numbers { first, last, is_run: false } if first == last => first.to_string(),
        MachineKey::Numbers { first, last, .. } => format!("{first}..{last}"),
    }
}

/// The machines of a site by name, each with the declarations that it is in, the largest run first.
fn machines(site: &SiteDecl, diagnostics: &mut Diagnostics) -> Vec<(String, Vec<usize>)> {
    let mut runs: Vec<(u32, u32, usize)> = Vec::new();
    let mut named = Vec::new();
    for (at, machine) in site.machines.iter().enumerate() {
        match &machine.key.value {
            MachineKey::Name(name) => named.push((name.clone(), vec![at])),
            MachineKey::Numbers { first, last, .. } => runs.push((*first, *last, at)),
        }
    }
    refuse_crossing(site, &runs, diagnostics);
    warn_beside(site, diagnostics);
    // The larger run first; of two that are as large, none has a machine of the other.
    runs.arrange_by_key(|(first, last, at)| (std::cmp::Reverse(last - first), *first, *at));
    let mut numbered: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
    let mut room = NODES_OF_PLANT + 1;
    for (first, last, at) in runs {
        for number in first..=last {
            if room == 0 {
                break;
            }
            let chain = numbered.entry(number).or_insert_with(|| {
                room -= 1;
                Vec::new()
            });
            chain.push(at);
        }
    }
    let numbered = numbered.into_iter().map(|(number, chain)| (number.to_string(), chain));
    numbered.chain(named).collect()
}

/// Runs lie in each other, or apart.
fn refuse_crossing(site: &SiteDecl, runs: &[(u32, u32, usize)], diagnostics: &mut Diagnostics) {
    let mut sorted = runs.to_vec();
    sorted.arrange_by_key(|(first, last, at)| (*first, std::cmp::Reverse(*last), *at));
    // The runs that are open where the next one begins, the innermost last.
    let mut open: Vec<(u32, u32, usize)> = Vec::new();
    for (first, last, at) in sorted {
        open.retain(|(_, end, _)| *end >= first);
        let clash = open.iter().find(|(begin, end, _)| *end < last || (*begin, *end) == (first, last));
        if let Some((begin, end, before)) = clash {
            let (machine, other) = (&site.machines[at], &site.machines[*before]);
            let is_same = (*begin, *end) == (first, last);
            let message = if is_same {
                format!("machines {first}..{last} are declared twice")
            } else {
                format!("machines {first}..{last} and {begin}..{end} cross")
            };
            let (first_place, second_place) = if machine.key.span.start < other.key.span.start {
                (machine.key.span, other.key.span)
            } else {
                (other.key.span, machine.key.span)
            };
            diagnostics.push(
                Diagnostic::new(codes::OVERLAPPING_RUNS, second_place, message)
                    .with(first_place, "the other")
                    .help(if is_same {
                        "join the two"
                    } else {
                        "split one of them, so that one lies in the other or apart"
                    }),
            );
        }
        open.push((first, last, at));
    }
}

/// Where machines are counted in runs, a single number next to them may be meant as one of them.
fn warn_beside(site: &SiteDecl, diagnostics: &mut Diagnostics) {
    let runs: Vec<(u32, u32)> = site
        .machines
        .iter()
        .filter_map(|machine| match machine.key.value {
            MachineKey::Numbers { first, last, is_run: true } => Some((first, last)),
            MachineKey::Numbers { .. } | MachineKey::Name(_) => None,
        })
        .collect();
    for machine in &site.machines {
        let MachineKey::Numbers { first, is_run: false, .. } = machine.key.value else { continue };
        if !runs.is_empty() && !runs.iter().any(|(from, to)| (*from..=*to).contains(&first)) {
            let all: Vec<String> = runs.iter().map(|(from, to)| format!("{from}..{to}")).collect();
            let message = format!("machine {first} is in none of the runs {}", all.join(", "));
            diagnostics.push(
                Diagnostic::new(codes::MACHINE_BESIDE_RUNS, machine.key.span, message).help(format!(
                    "correct the number; if there is one more machine, write `{first}..{first}`"
                )),
            );
        }
    }
}

/// The nodes of the next machine, those of its type.
fn nodes(of_type: &TypeDecl, said: &[(&LevelDecl, &Said)], plant: &mut Plant, diagnostics: &mut Diagnostics) {
    let machine = plant.machines.len();
    let mut seen = BTreeSet::new();
    for position in &of_type.level.positions {
        for node in &position.nodes {
            let (place, key) = (position.name.value.as_str(), node.device.value.as_str());
            let Some(device) = plant.devices.iter().position(|one| one.key == key) else { continue };
            if !seen.insert((place, key)) {
                continue;
            }
            let chain: Vec<&NodeDecl> =
                said.iter().filter_map(|(level, _)| node_of(level, place, key)).collect();
            let Some(id) = last(&chain, |node| node.node) else {
                if diagnostics.is_new(codes::MISSING_KEY, node.span) {
                    let message = format!("`{key}` at position `{place}` has no node-ID");
                    diagnostics.push(
                        Diagnostic::new(codes::MISSING_KEY, node.span, message)
                            .help(format!("write `{key}: 5`, or add `node:`")),
                    );
                }
                continue;
            };
            let stated = last(&chain, |node| node.node_name.clone());
            let node_name = match stated {
                None => {
                    let product = &plant.devices[device].dictionary.info.product_name;
                    format!("{product} {place}").trim().to_owned()
                }
                Some(name) => match TextOfNode::Node.read("node-name:", &name.value) {
                    Ok(text) => text,
                    Err(diagnostic) => {
                        diagnostics.push(diagnostic.at(name.span));
                        String::new()
                    }
                },
            };
            let layers: Vec<usize> = said.iter().flat_map(|(_, said)| said.about(place, key)).collect();
            plant.nodes.push(PlantNode {
                machine,
                position: place.to_owned(),
                device,
                node: id,
                node_name,
                serial: last(&chain, |node| node.serial),
                comment: last(&chain, |node| node.comment.clone()).map(|text: Name| text.value),
                class: 0,
                layers,
            });
        }
    }
}

fn node_of<'a>(level: &'a LevelDecl, position: &str, device: &str) -> Option<&'a NodeDecl> {
    let position = level.positions.iter().find(|one| one.name.value == position)?;
    position.nodes.iter().find(|node| node.device.value == device)
}

/// What the last level says about something.
fn last<T>(chain: &[&NodeDecl], of: impl Fn(&NodeDecl) -> Option<Spanned<T>>) -> Option<Spanned<T>> {
    chain.iter().rev().find_map(|node| of(node))
}
