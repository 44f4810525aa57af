//! Frames of a bus in words: what each says, by the dictionaries of the nodes.
//!
//! The identifiers and mappings of PDOs are the defaults of the devices, and follow what clients write in the trace. What
//! belongs to no node that is known is told as such, and never left out.

mod line;
mod node;
mod pdo;
mod sdo;
mod services;
mod transfer;

use std::fmt::Write as _;

use firmware_glue::frame::Frame;
use od_spec::model::Direction;

pub use self::line::{BadLine, Line, Seen, What, read};
pub use self::node::Node;
use self::node::{SdoSide, count, hexadecimal};
use crate::slcan::CanFrame;

/// Tells what frames say, one after the other.
#[derive(Debug)]
pub struct Decoder<'a> {
    nodes: Vec<Node<'a>>,
}

impl<'a> Decoder<'a> {
    /// One that knows some nodes, each with a node-ID of its own.
    pub fn new(nodes: Vec<Node<'a>>) -> Self {
        Self { nodes }
    }

    /// What was on the bus, on one line: identifier, sender or receiver, service, content.
    pub fn tell(&mut self, what: &What) -> String {
        match what {
            What::Frame(CanFrame::Standard(frame)) => self.frame(frame),
            What::Frame(CanFrame::Extended { id, length }) => {
                format!("{id:08X}h  unknown: an identifier of 29 bits, {}", count((*length).into()))
            }
            What::Fd(id) => format!("{id:03X}h  unknown: a frame of CAN FD"),
            What::Error => "error frame: the interface has seen an error on the bus".to_owned(),
        }
    }

    /// What a frame says.
    pub fn frame(&mut self, frame: &Frame) -> String {
        let id = frame.id().get();
        format!("{id:03X}h  {}", self.content(id, frame.bytes(), frame.length()))
    }

    fn content(&mut self, id: u16, bytes: Option<&[u8]>, length: u8) -> String {
        if let Some(text) = self.of_all(id, bytes) {
            return text;
        }
        if let Some(text) = self.of_a_node(id, bytes) {
            return text;
        }
        let content = match bytes {
            Some(bytes) => hexadecimal(bytes),
            None => format!("a remote frame for {}", count(length.into())),
        };
        let Some((service, node)) = predefined(id) else { return format!("unknown: {content}") };
        if self.nodes.iter().any(|known| known.id == node) {
            // Its device has no such PDO, or has given it another identifier.
            return format!("unknown: {service} that node {node} would have as predefined; {content}");
        }
        match (service, bytes) {
            ("heartbeat", Some([state])) => {
                format!("node {node} (no dictionary)  heartbeat  {}", services::state(*state))
            }
            ("EMCY", Some(bytes)) => {
                format!("node {node} (no dictionary)  EMCY  {}", services::emergency(None, bytes))
            }
            _ => format!("node {node} (no dictionary)  {service}  {content}"),
        }
    }

    /// What is for all nodes.
    fn of_all(&mut self, id: u16, bytes: Option<&[u8]>) -> Option<String> {
        match (id, bytes) {
            (0x000, Some(bytes)) => Some(self.nmt(bytes)),
            (0x7E5, Some(bytes)) => Some(format!("LSS master  {}", services::lss(bytes))),
            (0x7E4, Some(bytes)) => Some(format!("LSS slave  {}", services::lss(bytes))),
            (_, bytes) if self.is_shared(id, 0x1005, 0x080) => Some(match bytes {
                Some([]) => "SYNC".to_owned(),
                Some([counter]) => format!("SYNC  counter {counter}"),
                Some(more) => format!("SYNC  with {} bytes, where it has a counter or none", more.len()),
                None => "SYNC  as a remote frame".to_owned(),
            }),
            (_, Some(bytes)) if self.is_shared(id, 0x1012, 0x100) => {
                Some(format!("TIME  {}", services::time(bytes)))
            }
            _ => None,
        }
    }

    /// Whether an identifier is that of a service which all nodes share: that of the nodes which say so, or else the usual one.
    fn is_shared(&self, id: u16, index: u16, usual: u16) -> bool {
        // Bits 30 and 31 tell who sends and who takes it.
        let stated = |node: &Node<'_>| {
            let cob_id = node.parameter(index, 0).filter(|cob_id| cob_id & 1 << 29 == 0)?;
            u16::try_from(cob_id & 0x7FF).ok()
        };
        let mut stated = self.nodes.iter().filter_map(stated).peekable();
        if stated.peek().is_none() { id == usual } else { stated.any(|cob_id| cob_id == id) }
    }

    fn nmt(&mut self, bytes: &[u8]) -> String {
        let [command, node] = *bytes else {
            return format!("NMT  {} where a command has 2", count(bytes.len()));
        };
        for known in self.nodes.iter_mut().filter(|known| node == 0 || known.id == node) {
            if matches!(command, 129 | 130) {
                known.reset();
            }
        }
        let whom = match self.nodes.iter().find(|known| known.id == node) {
            Some(known) => known.name(),
            None if node == 0 => "all nodes".to_owned(),
            None => format!("node {node} (no dictionary)"),
        };
        match services::nmt_command(command) {
            Some(word) => format!("NMT  {word}: {whom}"),
            None => format!("NMT  unknown command {command}: {whom}"),
        }
    }

    /// What comes from a node that is known, or is for it.
    fn of_a_node(&mut self, id: u16, bytes: Option<&[u8]>) -> Option<String> {
        if let Some(text) = self.pdo(id, bytes) {
            return Some(text);
        }
        for node in &mut self.nodes {
            let name = node.name();
            let own = u16::from(node.id);
            if let Some((channel, side)) = node.sdo_at(id) {
                let Some(bytes) = bytes else { return Some(format!("{name}  SDO as a remote frame")) };
                let arrow = match side {
                    SdoSide::Client => "SDO →",
                    SdoSide::Server => "SDO ←",
                };
                return Some(format!("{name}  {arrow}  {}", sdo::frame(node, channel, side, bytes)));
            }
            if node.cob_id(0x1014, 0) == Some(id) {
                return Some(match bytes {
                    Some(bytes) => format!("{name}  EMCY  {}", services::emergency(Some(node), bytes)),
                    None => format!("{name}  EMCY as a remote frame"),
                });
            }
            if id == 0x700 + own {
                return Some(match bytes {
                    Some([0]) => {
                        node.reset();
                        format!("{name}  boot-up")
                    }
                    Some([state]) => format!("{name}  heartbeat  {}", services::state(*state)),
                    Some(more) => format!("{name}  heartbeat  {} where it has 1", count(more.len())),
                    None => format!("{name}  node guarding  asked for its state"),
                });
            }
        }
        None
    }

    /// A PDO: of its sender, if that is known; and who else has it.
    fn pdo(&self, id: u16, bytes: Option<&[u8]>) -> Option<String> {
        let of_nodes = self.nodes.iter().flat_map(|node| node.pdos_at(id).map(move |pdo| (node, pdo)));
        let mut ends: Vec<_> = of_nodes.collect();
        ends.sort_by_key(|(_, pdo)| pdo.direction == Direction::Receive);
        let ((node, pdo), others) = ends.split_first()?;
        let label = |node: &Node<'_>, pdo: &od_spec::model::Pdo| {
            format!("{}  {}{}", node.name(), pdo.direction.pdo(), pdo.number)
        };
        let mut text = label(node, pdo);
        text.push_str("  ");
        match bytes {
            Some(bytes) => text.push_str(&pdo::fields(node, pdo, bytes)),
            None => text.push_str("asked for by a remote frame"),
        }
        for (node, pdo) in others {
            let _ = write!(text, "  [also {}]", label(node, pdo).replace("  ", " "));
        }
        Some(text)
    }
}

/// The service and the node that an identifier belongs to as long as nobody changes it (CiA 301 table 36).
fn predefined(id: u16) -> Option<(&'static str, u8)> {
    let node = u8::try_from(id & 0x7F).ok().filter(|node| *node > 0)?;
    let service = match id & 0x780 {
        0x080 => "EMCY",
        0x180 => "TPDO1",
        0x200 => "RPDO1",
        0x280 => "TPDO2",
        0x300 => "RPDO2",
        0x380 => "TPDO3",
        0x400 => "RPDO3",
        0x480 => "TPDO4",
        0x500 => "RPDO4",
        0x580 => "SDO ←",
        0x600 => "SDO →",
        0x700 => "heartbeat",
        _ => return None,
    };
    Some((service, node))
}
