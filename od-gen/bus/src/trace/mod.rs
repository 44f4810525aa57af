//! Frames of a bus in words: what each says, by the dictionaries of the nodes.
//!
//! The identifiers and mappings of PDOs are the defaults of the devices, and follow what clients write in the trace. What
//! belongs to no node that is known is reported as such, and never left out.

mod asc;
mod line;
mod lss;
mod node;
mod pdo;
mod reader;
mod sdo;
mod services;
mod transfer;
mod trc;

use std::fmt::Write as _;

use firmware_glue::frame::Frame;
use od_spec::model::{Direction, EntryId};
use od_spec::order::Arrange as _;

pub use self::line::{BadLine, Line, Seen, What};
pub use self::node::Node;
use self::node::{SdoSide, count, hexadecimal};
pub use self::reader::Reader;
pub(crate) use self::services::state;
use crate::slcan::CanFrame;

/// What a frame belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Service {
    /// A command of the master.
    Nmt,
    /// SYNC.
    Sync,
    /// TIME.
    Time,
    /// An emergency message.
    Emergency,
    /// A PDO.
    Pdo,
    /// A transfer of an entry.
    Sdo,
    /// Boot-up, heartbeat and node guarding.
    Heartbeat,
    /// Layer setting services.
    Lss,
    /// Nothing that is known.
    Unknown,
}

/// What a frame says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Described {
    /// What it belongs to.
    pub service: Service,
    /// The node that it comes from or is for, where it is about one.
    pub node: Option<u8>,
    /// All of it in words: identifier, sender or receiver, service, content.
    pub text: String,
}

impl Described {
    fn new(service: Service, node: Option<u8>, text: impl Into<String>) -> Self {
        Self { service, node, text: text.into() }
    }
}

/// Reports what frames say, one after the other.
#[derive(Debug)]
pub struct Decoder<'a> {
    nodes: Vec<Node<'a>>,
}

impl<'a> Decoder<'a> {
    /// One that knows some nodes, each with a node-ID of its own.
    pub fn new(nodes: Vec<Node<'a>>) -> Self {
        Self { nodes }
    }

    /// The nodes that it knows.
    pub fn nodes(&self) -> &[Node<'a>] {
        &self.nodes
    }

    /// Takes note of what a node has, in addition to what the trace shows.
    pub fn learn(&mut self, node: u8, entry: EntryId, bytes: &[u8]) {
        if let Some(known) = self.nodes.iter_mut().find(|known| known.id == node) {
            known.accept(entry.index.0, entry.sub.0, bytes);
        }
    }

    /// What was on the bus, on one line: identifier, sender or receiver, service, content.
    pub fn describe(&mut self, what: &What) -> String {
        self.described(what).text
    }

    /// [`describe`](Self::describe), with what it belongs to.
    pub fn described(&mut self, what: &What) -> Described {
        let unknown = |text| Described::new(Service::Unknown, None, text);
        match what {
            What::Frame(CanFrame::Standard(frame)) => self.of_frame(frame),
            What::Frame(CanFrame::Extended { id, length }) => {
                unknown(format!("{id:08X}h  unknown: an identifier of 29 bits, {}", count((*length).into())))
            }
            What::Fd(id) => unknown(format!("{id:03X}h  unknown: a frame of CAN FD")),
            What::Error => unknown("error frame: the interface has seen an error on the bus".to_owned()),
        }
    }

    /// What a frame says.
    pub fn frame(&mut self, frame: &Frame) -> String {
        self.of_frame(frame).text
    }

    fn of_frame(&mut self, frame: &Frame) -> Described {
        let id = frame.id().get();
        let content = self.content(id, frame.bytes(), frame.length());
        Described { text: format!("{id:03X}h  {}", content.text), ..content }
    }

    fn content(&mut self, id: u16, bytes: Option<&[u8]>, length: u8) -> Described {
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
        let Some((service, name, node)) = predefined(id) else {
            return Described::new(Service::Unknown, None, format!("unknown: {content}"));
        };
        if self.nodes.iter().any(|known| known.id == node) {
            // Its device has no such PDO, or has given it another identifier.
            let text = format!("unknown: {name} that node {node} would have as predefined; {content}");
            return Described::new(Service::Unknown, Some(node), text);
        }
        let content = match (service, bytes) {
            (Service::Heartbeat, Some([state])) => services::state(*state),
            (Service::Emergency, Some(bytes)) => services::emergency(None, bytes),
            _ => content,
        };
        Described::new(service, Some(node), format!("node {node} (no dictionary)  {name}  {content}"))
    }

    /// What is for all nodes.
    fn of_all(&mut self, id: u16, bytes: Option<&[u8]>) -> Option<Described> {
        let (service, text) = match (id, bytes) {
            (0x000, Some(bytes)) => return Some(self.nmt(bytes)),
            (0x7E5, Some(bytes)) => (Service::Lss, format!("LSS master  {}", lss::request(bytes))),
            (0x7E4, Some(bytes)) => (Service::Lss, format!("LSS slave  {}", lss::answer(bytes))),
            (_, bytes) if self.is_shared(id, 0x1005, 0x080) => {
                let text = match bytes {
                    Some([]) => "SYNC".to_owned(),
                    Some([counter]) => format!("SYNC  counter {counter}"),
                    Some(more) => format!("SYNC  with {} bytes, where it has a counter or none", more.len()),
                    None => "SYNC  as a remote frame".to_owned(),
                };
                (Service::Sync, text)
            }
            (_, Some(bytes)) if self.is_shared(id, 0x1012, 0x100) => {
                (Service::Time, format!("TIME  {}", services::time(bytes)))
            }
            _ => return None,
        };
        Some(Described::new(service, None, text))
    }

    /// Whether an identifier is that of a service which all nodes share: that of the nodes which say so, or else the usual one.
    fn is_shared(&self, id: u16, index: u16, usual: u16) -> bool {
        // Bits 30 and 31 show who sends and who takes it.
        let stated = |node: &Node<'_>| {
            let cob_id = node.parameter(index, 0).filter(|cob_id| cob_id & 1 << 29 == 0)?;
            u16::try_from(cob_id & 0x7FF).ok()
        };
        let mut stated = self.nodes.iter().filter_map(stated).peekable();
        if stated.peek().is_none() { id == usual } else { stated.any(|cob_id| cob_id == id) }
    }

    fn nmt(&mut self, bytes: &[u8]) -> Described {
        let [command, node] = *bytes else {
            let text = format!("NMT  {} where a command has 2", count(bytes.len()));
            return Described::new(Service::Nmt, None, text);
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
        let text = match services::nmt_command(command) {
            Some(word) => format!("NMT  {word}: {whom}"),
            None => format!("NMT  unknown command {command}: {whom}"),
        };
        Described::new(Service::Nmt, Some(node).filter(|node| *node != 0), text)
    }

    /// What comes from a node that is known, or is for it.
    fn of_a_node(&mut self, id: u16, bytes: Option<&[u8]>) -> Option<Described> {
        if let Some(described) = self.pdo(id, bytes) {
            return Some(described);
        }
        for node in &mut self.nodes {
            let name = node.name();
            let own = u16::from(node.id);
            let described = |service, text| Some(Described::new(service, u8::try_from(own).ok(), text));
            if let Some((channel, side)) = node.sdo_at(id) {
                let Some(bytes) = bytes else {
                    return described(Service::Sdo, format!("{name}  SDO as a remote frame"));
                };
                let arrow = match side {
                    SdoSide::Client => "SDO →",
                    SdoSide::Server => "SDO ←",
                };
                let content = sdo::frame(node, channel, side, bytes);
                return described(Service::Sdo, format!("{name}  {arrow}  {content}"));
            }
            if node.cob_id(0x1014, 0) == Some(id) {
                let text = match bytes {
                    Some(bytes) => format!("{name}  EMCY  {}", services::emergency(Some(node), bytes)),
                    None => format!("{name}  EMCY as a remote frame"),
                };
                return described(Service::Emergency, text);
            }
            if id == 0x700 + own {
                let text = match bytes {
                    Some([0]) => {
                        node.reset();
                        format!("{name}  boot-up")
                    }
                    Some([state]) => format!("{name}  heartbeat  {}", services::state(*state)),
                    Some(more) => format!("{name}  heartbeat  {} where it has 1", count(more.len())),
                    None => format!("{name}  node guarding  asked for its state"),
                };
                return described(Service::Heartbeat, text);
            }
        }
        None
    }

    /// A PDO: of its sender, if that is known; and who else has it.
    fn pdo(&self, id: u16, bytes: Option<&[u8]>) -> Option<Described> {
        let of_nodes = self.nodes.iter().flat_map(|node| node.pdos_at(id).map(move |pdo| (node, pdo)));
        let mut ends: Vec<_> = of_nodes.collect();
        ends.arrange_by_key(|(_, pdo)| pdo.direction == Direction::Receive);
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
        Some(Described::new(Service::Pdo, Some(node.id), text))
    }
}

/// The service, its name and the node that an identifier belongs to as long as it is not changed (CiA 301 table 36).
fn predefined(id: u16) -> Option<(Service, &'static str, u8)> {
    let node = u8::try_from(id & 0x7F).ok().filter(|node| *node > 0)?;
    let (service, name) = match id & 0x780 {
        0x080 => (Service::Emergency, "EMCY"),
        0x180 => (Service::Pdo, "TPDO1"),
        0x200 => (Service::Pdo, "RPDO1"),
        0x280 => (Service::Pdo, "TPDO2"),
        0x300 => (Service::Pdo, "RPDO2"),
        0x380 => (Service::Pdo, "TPDO3"),
        0x400 => (Service::Pdo, "RPDO3"),
        0x480 => (Service::Pdo, "TPDO4"),
        0x500 => (Service::Pdo, "RPDO4"),
        0x580 => (Service::Sdo, "SDO ←"),
        0x600 => (Service::Sdo, "SDO →"),
        0x700 => (Service::Heartbeat, "heartbeat"),
        _ => return None,
    };
    Some((service, name, node))
}
