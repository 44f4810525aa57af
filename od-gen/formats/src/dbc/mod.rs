//! DBC: the frames of a bus for trace and test tools.
//!
//! PDOs are messages and what they carry are signals, with the exact step of each unit, so that a tool shows what the manual
//! says. A bit field becomes one signal for each of its fields, as a format without nesting has to; the services that every
//! node has (NMT, SYNC, TIME, EMCY, heartbeat) are messages, too. Signals have the names of entries, in the characters and the
//! 32 of them that the format allows; where one is longer, the whole name is an attribute that tools know.

mod message;
mod messages;
mod names;
mod number;
mod services;
mod signals;
#[cfg(test)]
mod tests;
mod text;

use std::collections::BTreeMap;
use std::fmt;

use od_spec::model::{Dictionary, System};
use od_spec::order::Arrange as _;

use messages::{Traffic, messages};
use names::node_name;
use text::Text;

/// A node of the bus.
#[derive(Debug, Clone, Copy)]
pub struct Node<'a> {
    /// Node-ID, 1 to 127.
    pub id: u8,
    /// What its device belongs to.
    pub system: &'a System,
    /// Its device; of a configured node with its values as defaults.
    pub device: &'a Dictionary,
}

/// The file, and what the format could not hold.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Written {
    /// The bytes, in Windows-1252.
    pub bytes: Vec<u8>,
    /// How many messages there are.
    pub messages: usize,
    /// How many signals they have.
    pub signals: usize,
    /// What was left out, each with the reason.
    pub left_out: Vec<LeftOut>,
    /// PDOs that are never sent as the nodes are set, by node-ID.
    pub silent: BTreeMap<u8, Silent>,
}

/// The PDOs of a node that do not exist, or carry nothing, until their parameters are set.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Silent {
    /// `pmc (node 5)`.
    pub node: String,
    /// `TPDO2`.
    pub pdos: Vec<String>,
}

/// `pmc (node 5): TPDO2, RPDO3`.
impl fmt::Display for Silent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.node, self.pdos.join(", "))
    }
}

/// Something that the file does not hold.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct LeftOut {
    /// `TPDO1 of pmc (node 5)`.
    pub what: String,
    /// Why.
    pub why: Why,
}

/// Why something is left out.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Why {
    /// Another message has its identifier.
    TakenIdentifier {
        /// The identifier.
        id: u32,
        /// The message that has it.
        by: String,
    },
    /// It has more bits than a frame of classical CAN.
    TooLong {
        /// Its bits.
        bits: u32,
    },
}

/// `TPDO1 of pmc (node 5): the identifier 185h is that of TPDO2 of pmc (node 5)`.
impl fmt::Display for LeftOut {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.why {
            Why::TakenIdentifier { id, by } => {
                write!(f, "{}: the identifier {id:03X}h is that of {by}", self.what)
            }
            Why::TooLong { bits } => {
                write!(f, "{}: it has {bits} bits, more than the 64 of a frame", self.what)
            }
        }
    }
}

/// The DBC of a bus with these nodes, whose node-IDs differ. PDOs that are switched off or carry nothing are not
/// messages.
///
/// ```
/// use od_formats::dbc::{Node, write};
/// use od_spec::source::SourceMap;
/// use od_spec::{NoFiles, compile};
///
/// let mut sources = SourceMap::new();
/// let root = sources.add("lamp.od.yaml", "
/// od-spec: 1
/// title: Lamp
/// uses: [cia301]
/// devices:
///   lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer]}
/// units: {percent: {symbol: '%', scale: 1/2}}
/// objects:
///   0x2000: {name: brightness, type: unsigned8, unit: percent, access: rw, max: 100 %, pdo: receive}
/// pdos: {lamp: {receive: {1: {map: [brightness]}}}}
/// ");
/// let system = compile(&mut sources, root, &mut NoFiles).system.expect("no errors");
/// let written = write(&[Node { id: 5, system: &system, device: &system.devices[0] }]);
/// let text = String::from_utf8(written.bytes).expect("nothing but ASCII here");
/// assert!(text.contains("BO_ 517 lamp_5_RPDO1: 1 Vector__XXX"), "{text}");
/// assert!(text.contains("SG_ brightness : 0|8@1+ (0.5,0) [0|100] \"%\" lamp_5"), "{text}");
/// ```
pub fn write(nodes: &[Node<'_>]) -> Written {
    let mut ascending = nodes.to_vec();
    ascending.arrange_by_key(|node| node.id);
    let Traffic { messages, left_out, silent } = messages(&ascending);
    let mut text = Text::new();
    text.head();
    text.nodes(ascending.iter().map(|node| node_name(node)));
    for message in &messages {
        text.message(message);
    }
    for node in &ascending {
        text.node_comment(
            &node_name(node),
            &format!("{} (node {}): {}", node.device.key, node.id, node.device.name),
        );
    }
    for message in &messages {
        text.comments(message);
    }
    text.attribute_definitions();
    for node in &ascending {
        text.node_attributes(node);
    }
    for message in &messages {
        text.attributes(message);
    }
    for message in &messages {
        text.values(message);
    }
    for message in &messages {
        text.value_types(message);
    }
    Written {
        bytes: text.into_bytes(),
        messages: messages.len(),
        signals: messages.iter().map(|message| message.signals.len()).sum(),
        left_out,
        silent,
    }
}

impl Node<'_> {
    /// `pmc (node 5)`.
    fn name(&self) -> String {
        format!("{} (node {})", self.device.key, self.id)
    }
}
