//! Plants: the nodes of many machines, each with its values, from one file.
//!
//! A plant file names devices, types of machines with their positions, and sites with machines, each of which has a bus of its
//! own. What a level says of parameters lies over what the levels before it said: type, site, machine, of runs the smaller over the
//! larger; within a level what is said of a position over what is said of all. [`plant`] reads such a file. Nodes that are
//! alike – the same device with the same node-ID and the same levels – are one [`Class`]: its values are worked out and checked
//! once, by [`Plant::settle`], however many machines have it; and machines whose nodes are alike have one kind of bus.

mod bus;
mod classes;
mod findings;
mod levels;
mod machines;
mod read;
pub(crate) mod rules;
mod settle;

use std::borrow::Cow;
use std::sync::Arc;

use crate::ast::Name;
use crate::commissioning::Commissioning;
use crate::keys::{PLANT_VERSION, is_marked};
use crate::model::{Dictionary, System};
use crate::node_of_file::NodeOfFile;
use crate::parameters::Layer;
use crate::source::{Span, Spanned};

pub use crate::traffic::{Message, Traffic};
pub use bus::Bus;
pub use read::{PlantFile, plant};
pub use rules::shared_cob_id;
pub use settle::Settled;

/// A plant, every name looked up.
#[derive(Debug, Clone, Default)]
#[non_exhaustive]
pub struct Plant {
    /// What it is called.
    pub title: String,
    /// More about it.
    pub about: Option<String>,
    /// The devices, in the order of the file.
    pub devices: Vec<PlantDevice>,
    /// The types of machines, in the order of the file.
    pub types: Vec<MachineType>,
    /// The sites, in the order of the file.
    pub sites: Vec<Site>,
    /// The machines: by site, and within it numbers before names.
    pub machines: Vec<Machine>,
    /// The nodes, by machine, in the order of the type's positions.
    pub nodes: Vec<PlantNode>,
    /// What each level says about the parameters of a device.
    pub layers: Vec<PlantLayer>,
    /// Nodes that are alike.
    pub classes: Vec<Class>,
    /// Machines whose nodes are alike.
    pub buses: Vec<BusKind>,
}

/// A device of a plant.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct PlantDevice {
    /// Its key in the plant.
    pub key: String,
    /// What its file describes.
    pub system: Arc<System>,
    /// Position of its file in [`PlantFile::files`].
    pub file: usize,
    /// The device, with the values of a DCF where it is from one.
    pub dictionary: Arc<Dictionary>,
    /// Of a DCF: its node, whose values all nodes begin with.
    pub base: Option<Arc<NodeOfFile>>,
}

impl PlantDevice {
    /// The device as node `id`, with the values of a DCF where it is from one.
    pub(crate) fn as_node(&self, id: u8) -> Cow<'_, Dictionary> {
        match &self.base {
            Some(base) => Cow::Owned(base.at(Some(id)).configured(&self.dictionary)),
            None => Cow::Borrowed(&self.dictionary),
        }
    }
}

/// A type of machines.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct MachineType {
    /// Name.
    pub name: String,
    /// What it is.
    pub about: Option<String>,
    /// The master, where the file has one.
    pub master: Option<Master>,
    /// Where it is defined.
    pub span: Span,
}

/// What is on a bus in addition to the nodes.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Master {
    /// Its node-ID, where it has one.
    pub node: Option<Spanned<u8>>,
    /// COB-IDs of the PDOs that it sends.
    pub sends: Vec<Spanned<u32>>,
    /// COB-IDs of the PDOs that it receives.
    pub receives: Vec<Spanned<u32>>,
}

/// A site.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Site {
    /// Name, which is also that of its folder.
    pub name: String,
    /// What it is called.
    pub title: Option<String>,
    /// A remark.
    pub comment: Option<String>,
    /// Where it is declared.
    pub span: Span,
}

/// A machine, with a bus of its own.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Machine {
    /// Position of its site.
    pub site: usize,
    /// Name or number, which is also that of its folder.
    pub name: String,
    /// Position of its type.
    pub of_type: usize,
    /// Bit rate in kbit/s, as it is written.
    pub(crate) bit_rate: Name,
    /// Serial number.
    pub serial: Option<Name>,
    /// A remark.
    pub comment: Option<String>,
    /// Number of the network.
    pub net_number: u32,
    /// Name of the network.
    pub net_name: String,
    /// Positions of its nodes.
    pub nodes: std::ops::Range<usize>,
    /// Position of its kind of bus.
    pub bus: usize,
    /// Where it is declared: by itself, or in the smallest run that it is one of.
    pub span: Span,
}

/// A node of a machine.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct PlantNode {
    /// Position of its machine.
    pub machine: usize,
    /// Where it is on the machine.
    pub position: String,
    /// Position of its device.
    pub device: usize,
    /// Node-ID.
    pub node: Spanned<u8>,
    /// Name of the node.
    pub node_name: String,
    /// Serial number of the device.
    pub serial: Option<Spanned<u32>>,
    /// A remark.
    pub comment: Option<String>,
    /// Positions of the levels that state what it is set to, the first one first.
    pub layers: Vec<usize>,
    /// Position of its class.
    pub class: usize,
}

/// Nodes that are alike: what they are set to is the same.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Class {
    /// What a node of it is.
    pub own: Member,
    /// The other devices of the same specification that conditions between devices look at: those at its position, or
    /// else the only one of the machine.
    pub others: Vec<Member>,
    /// Position of the first node.
    pub first: usize,
    /// How many nodes it has.
    pub count: usize,
}

/// A device with a node-ID and the levels that state what it is set to.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub struct Member {
    /// Position of the device.
    pub device: usize,
    /// Node-ID.
    pub node: u8,
    /// Positions of the levels, the first one first.
    pub layers: Vec<usize>,
    /// Bit rate in kbit/s.
    pub bit_rate: u16,
}

/// Machines whose nodes are alike.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct BusKind {
    /// Position of their type.
    pub of_type: usize,
    /// Position of the first machine.
    pub first: usize,
    /// How many machines it has.
    pub count: usize,
}

/// What one level says about the parameters of a device.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct PlantLayer {
    /// The level.
    pub level: Level,
    /// The position that it is said of; `None` for all.
    pub position: Option<String>,
    /// Position of the device.
    pub device: usize,
    /// The settings.
    pub layer: Layer,
    /// Where it is said.
    pub span: Span,
}

/// A level of a plant.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Level {
    /// A type of machines.
    Type(String),
    /// A site.
    Site(String),
    /// Machines of a site: a name, a number or a run.
    Machines {
        /// The site.
        site: String,
        /// The machines.
        machines: String,
    },
}

impl PlantLayer {
    /// `type OAT-2, position B`, `machine Nordfeld 17`.
    pub fn words(&self) -> String {
        let level = match &self.level {
            Level::Type(name) => format!("type {name}"),
            Level::Site(name) => format!("site {name}"),
            Level::Machines { site, machines } if machines.contains("..") => {
                format!("machines {site} {machines}")
            }
            Level::Machines { site, machines } => format!("machine {site} {machines}"),
        };
        match &self.position {
            Some(position) => format!("{level}, position {position}"),
            None => level,
        }
    }
}

impl Plant {
    /// The site of a machine.
    pub fn site_of(&self, machine: &Machine) -> &str {
        self.sites.get(machine.site).map_or("", |site| &site.name)
    }

    /// What a person calls a node: `Nordfeld 17, position B, pmc (node 22)`.
    pub fn name_of(&self, node: &PlantNode) -> String {
        let machine = self.machines.get(node.machine);
        let place = machine.map(|machine| format!("{} {}", self.site_of(machine), machine.name));
        let device = self.devices.get(node.device).map_or("", |device| &device.key);
        format!(
            "{}, position {}, {device} (node {})",
            place.unwrap_or_default(),
            node.position,
            node.node.value
        )
    }

    /// The node as a DCF describes it, with the values of its class.
    pub fn commissioning(&self, node: &PlantNode, settled: &Settled) -> Commissioning {
        let mut commissioning = settled.commissioning.clone();
        commissioning.node_name.clone_from(&node.node_name);
        commissioning.serial_number = node.serial.map(|serial| serial.value);
        if let Some(machine) = self.machines.get(node.machine) {
            commissioning.net_number = machine.net_number;
            commissioning.net_name.clone_from(&machine.net_name);
        }
        commissioning
    }
}

/// Whether a text is a plant file: its first key says so.
pub fn is_plant(text: &str) -> bool {
    is_marked(text, PLANT_VERSION)
}
