//! The messages on the bus of a machine: which node sends and which receives each COB-ID.

use super::{Plant, Settled};
use crate::model::{Dictionary, Index, Object};
use crate::source::Span;
use crate::traffic::{Message, Parameter, messages};

/// The bus of a machine.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Bus<'a> {
    /// The plant.
    pub plant: &'a Plant,
    /// Position of the machine.
    pub machine: usize,
    /// Its nodes: the position of each in the plant, and what it is set to.
    pub nodes: Vec<(usize, &'a Settled)>,
    /// What they send and receive.
    pub messages: Vec<Message>,
}

impl<'a> Bus<'a> {
    /// The bus of a machine, of whose plant every class is settled.
    pub fn of(plant: &'a Plant, settled: &'a [Settled], machine: usize) -> Option<Self> {
        let nodes = plant.machines.get(machine)?.nodes.clone();
        let nodes: Vec<(usize, &Settled)> =
            nodes.filter_map(|at| Some((at, settled.get(plant.nodes.get(at)?.class)?))).collect();
        let of_node = |(at, settled): &(usize, &'a Settled)| {
            let at = *at;
            settled.on_the_bus.messages.iter().map(move |message| Message { node: at, ..message.clone() })
        };
        let messages = nodes.iter().flat_map(of_node).collect();
        Some(Self { plant, machine, nodes, messages })
    }
}

/// What nodes of a class have to do with others on their bus.
#[derive(Debug, Clone)]
pub(super) struct OnTheBus {
    /// What they send and receive; of no node in particular.
    messages: Vec<Message>,
    /// How often they send a heartbeat (1017h).
    pub heartbeat: Option<Parameter>,
    /// Whose heartbeats they wait for (1016h).
    pub watched: Vec<Parameter>,
}

impl OnTheBus {
    /// Of a device with its values.
    pub(super) fn of(configured: &Dictionary, node: u8) -> Self {
        let consumers = configured.objects.get(&Index(0x1016)).into_iter().flat_map(Object::counted);
        Self {
            messages: messages(configured, node),
            heartbeat: Parameter::of(configured, node, 0x1017, 0),
            watched: consumers
                .filter_map(|entry| Parameter::of(configured, node, 0x1016, entry.sub.0))
                .collect(),
        }
    }
}

impl Message {
    /// Where it can be changed: where its identifier is set, or else where the node has its node-ID.
    pub(super) fn place(&self, plant: &Plant) -> Option<Span> {
        self.set_at.or_else(|| plant.nodes.get(self.node).map(|node| node.node.span))
    }

    /// `TPDO 1 of pmc at position B (node 22)`: a bus has one machine, which is named next to it.
    pub(super) fn short(&self, plant: &Plant) -> String {
        let Some(node) = plant.nodes.get(self.node) else { return self.traffic.words() };
        let key = plant.devices.get(node.device).map_or("", |device| &device.key);
        format!("{} of {key} at position {} (node {})", self.traffic.words(), node.position, node.node.value)
    }
}
