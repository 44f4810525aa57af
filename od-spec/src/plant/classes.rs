//! Which nodes are alike, and which machines.

use std::collections::{BTreeMap, BTreeSet};

use super::{BusKind, Class, Member, Plant, PlantNode};
use crate::commissioning;
use crate::diag::Diagnostics;
use crate::source::Span;

/// Finds the classes of the nodes, and the kinds of buses. A bit rate that a device does not have is said.
pub(super) fn find(plant: &mut Plant, diagnostics: &mut Diagnostics) {
    let mut said: BTreeSet<(Span, usize)> = BTreeSet::new();
    let mut classes: BTreeMap<(Member, Vec<Member>), usize> = BTreeMap::new();
    let mut buses: BTreeMap<(usize, Vec<usize>), usize> = BTreeMap::new();
    for at in 0..plant.machines.len() {
        let machine = &plant.machines[at];
        let range = machine.nodes.clone();
        let members: Vec<Member> = plant.nodes[range.clone()]
            .iter()
            .map(|node| {
                let dictionary = &plant.devices[node.device].dictionary;
                let bit_rate = match commissioning::bit_rate(dictionary, &machine.bit_rate.value) {
                    Ok(rate) => rate,
                    Err(diagnostic) => {
                        if said.insert((machine.bit_rate.span, node.device)) {
                            diagnostics.push(diagnostic.at(machine.bit_rate.span));
                        }
                        0
                    }
                };
                Member { device: node.device, node: node.node.value, layers: node.layers.clone(), bit_rate }
            })
            .collect();
        let mut of_nodes = Vec::with_capacity(members.len());
        for number in 0..members.len() {
            let others = others(plant, &plant.nodes[range.clone()], &members, number);
            let next = plant.classes.len();
            let class = *classes.entry((members[number].clone(), others.clone())).or_insert(next);
            if class == next {
                let own = members[number].clone();
                plant.classes.push(Class { own, others, first: range.start + number, count: 0 });
            }
            plant.classes[class].count += 1;
            plant.nodes[range.start + number].class = class;
            of_nodes.push(class);
        }
        let of_type = plant.machines[at].of_type;
        let next = plant.buses.len();
        let bus = *buses.entry((of_type, of_nodes)).or_insert(next);
        if bus == next {
            plant.buses.push(BusKind { of_type, first: at, count: 0 });
        }
        plant.buses[bus].count += 1;
        plant.machines[at].bus = bus;
    }
}

/// The other devices of a node's specification, each where conditions from this node look for it: at the same position, or
/// else where the machine has only one.
fn others(plant: &Plant, nodes: &[PlantNode], members: &[Member], number: usize) -> Vec<Member> {
    let own = &nodes[number];
    let device = &plant.devices[own.device];
    let mut by_key: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for (at, node) in nodes.iter().enumerate() {
        let other = &plant.devices[node.device];
        if other.file == device.file && other.dictionary.key != device.dictionary.key {
            by_key.entry(&other.dictionary.key).or_default().push(at);
        }
    }
    let chosen = by_key.into_values().filter_map(|found| {
        let mut here = found.iter().filter(|at| nodes[**at].position == own.position);
        match (here.next(), here.next(), found.as_slice()) {
            (Some(at), None, _) | (None, None, [at]) => Some(members[*at].clone()),
            (Some(_) | None, ..) => None,
        }
    });
    chosen.collect()
}
