//! What is settled for one node of a network, beyond what its device is.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use crate::check::codes as rule_codes;
use crate::check::names::texts_fit_eds::problem;
use crate::diag::{Diagnostic, codes};
use crate::model::{
    Dictionary, EdsPolicy, Entry, EntryId, Index, NoSuchValue, SubIndex, System, Value, Write, download,
};

/// Values of single entries, by entry.
pub type ParameterValues = BTreeMap<EntryId, Value>;

/// A node: its place in a network, and the values of its parameters. A DCF holds it, as a concise DCF and an XDC do.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Commissioning {
    /// Node-ID, 1 to 127.
    pub node: u8,
    /// Name of the node.
    pub node_name: String,
    /// Bit rate in kbit/s.
    pub bit_rate: u16,
    /// Number of the network.
    pub net_number: u32,
    /// Name of the network; may be empty.
    pub net_name: String,
    /// Serial number by which LSS finds the node, and which is not set over the bus; that of the identity (1018h.4)
    /// where none is stated.
    pub serial_number: Option<u32>,
    /// Whether the node is the CANopen manager of the network.
    pub manager: bool,
    /// Reference designation of the node, as in drawings of the plant; may be empty.
    pub reference: String,
    /// Reference designation of the network; may be empty.
    pub net_reference: String,
    /// Values of single entries; every other entry keeps its default.
    pub values: ParameterValues,
    /// Locked entries among the values: the device takes these only while it is unlocked for service.
    pub unlocked: BTreeSet<EntryId>,
    /// What objects and entries are called in the application, in addition to the names that the device gives them.
    pub denotations: BTreeMap<Denoted, String>,
    /// Reference designations of objects and entries.
    pub references: BTreeMap<Denoted, String>,
    /// The files of DOMAINs.
    pub files: BTreeMap<EntryId, DomainFiles>,
    /// What people say about the node: the titles of parameter files, and more.
    pub remarks: Vec<String>,
}

/// What has a name in the application: an object as a whole, or one of its entries.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Denoted {
    /// The object.
    pub index: Index,
    /// The entry of an ARRAY or RECORD; `None` for the object, which in a VAR or DOMAIN is its entry.
    pub sub: Option<SubIndex>,
}

impl Denoted {
    /// An object as a whole.
    pub const fn object(index: Index) -> Self {
        Self { index, sub: None }
    }

    /// An entry of an ARRAY or RECORD.
    pub const fn entry(id: EntryId) -> Self {
        Self { index: id.index, sub: Some(id.sub) }
    }

    /// Whether a device has it.
    pub(crate) fn is_in(self, device: &Dictionary) -> bool {
        let object = device.objects.get(&self.index);
        object.is_some_and(|object| self.sub.is_none_or(|sub| object.entry(sub).is_some()))
    }
}

/// `2000h`, `2001h.1`.
impl fmt::Display for Denoted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.sub {
            None => write!(f, "{}", self.index),
            Some(sub) => write!(f, "{}.{sub}", self.index),
        }
    }
}

/// The files between which and a node a DOMAIN goes, as paths.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct DomainFiles {
    /// Receives what is read from the node.
    pub upload: Option<String>,
    /// Holds what is written to the node.
    pub download: Option<String>,
}

impl Commissioning {
    /// What the file of the node shows of an entry to tools: of an unlocked one, what the device has while it is unlocked.
    pub fn shown(&self, id: EntryId, entry: &Entry) -> EdsPolicy {
        if self.unlocked.contains(&id) { entry.eds_while_unlocked() } else { entry.eds }
    }

    /// A node with the device's defaults, at 250 kbit/s or, where the device cannot do that, at its highest bit rate.
    pub fn of_node(device: &Dictionary, node: u8) -> Self {
        let rates = &device.info.bit_rates;
        let bit_rate = if rates.contains(&250) { 250 } else { rates.last().copied().unwrap_or(250) };
        Self {
            node,
            node_name: format!("{} {node}", device.info.product_name),
            bit_rate,
            net_number: 1,
            net_name: String::new(),
            serial_number: None,
            manager: false,
            reference: String::new(),
            net_reference: String::new(),
            values: ParameterValues::new(),
            unlocked: BTreeSet::new(),
            denotations: BTreeMap::new(),
            references: BTreeMap::new(),
            files: BTreeMap::new(),
            remarks: Vec::new(),
        }
    }

    /// The device as this node is: the values are where the defaults were, and PDOs are what their parameters then say.
    pub fn configured(&self, device: &Dictionary) -> Dictionary {
        let mut configured = device.clone();
        for (id, value) in &self.values {
            let object = configured.objects.get_mut(&id.index);
            let entry = object.and_then(|object| object.entries.iter_mut().find(|entry| entry.sub == id.sub));
            if let Some(entry) = entry {
                entry.default = Some(value.clone());
            }
        }
        let objects = &configured.objects;
        for pdo in &mut configured.pdos {
            pdo.follow(objects);
        }
        configured
    }

    /// The writes that bring the values into the node, in the order in which a device takes them; see [`download`].
    ///
    /// # Errors
    /// A value that no entry of the device can have.
    pub fn download(&self, system: &System, device: &Dictionary) -> Result<Vec<Write>, NoSuchValue> {
        download(system, device, &self.values, self.node)
    }

    /// Leaves out the values that a device has anyway; how many those are.
    pub fn keep_differences(&mut self, device: &Dictionary) -> usize {
        let (before, node) = (self.values.len(), self.node);
        self.values.retain(|id, value| {
            let default = device.entry(*id).and_then(|entry| entry.default.as_ref());
            default.is_none_or(|default| !is_same(default, value, node))
        });
        let values = &self.values;
        self.unlocked.retain(|id| values.contains_key(id));
        before - self.values.len()
    }
}

/// Whether two values are one on a node, where a formula is a number.
pub(crate) fn is_same(one: &Value, other: &Value, node: u8) -> bool {
    one == other || one.integer_for(node).is_some_and(|raw| other.integer_for(node) == Some(raw))
}

/// A text of `[DeviceComissioning]`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TextOfNode {
    /// `NodeName`.
    Node,
    /// `NetworkName`.
    Network,
}

impl TextOfNode {
    /// How long it may be: a line has 255 characters.
    const fn longest(self) -> usize {
        match self {
            TextOfNode::Node => 246,
            TextOfNode::Network => 243,
        }
    }

    /// The text without spaces around it; `option` is where it was said.
    ///
    /// # Errors
    /// A line of a DCF cannot hold it.
    pub fn read(self, option: &str, text: &str) -> Result<String, Diagnostic> {
        let text = text.trim();
        match problem(text, self.longest()) {
            None => Ok(text.to_owned()),
            Some(problem) => {
                let message = format!("the text of `{option}` {problem}");
                Err(Diagnostic::without_place(rule_codes::NOT_FOR_EDS, message).help("choose another text"))
            }
        }
    }
}

/// A bit rate in kbit/s that a device supports.
///
/// # Errors
/// The device does not support it, or it is not a number.
pub fn bit_rate(device: &Dictionary, text: &str) -> Result<u16, Diagnostic> {
    let rates = device.info.bit_rates.iter().map(u16::to_string).collect::<Vec<_>>().join(", ");
    let rate = text.trim().parse::<u16>().ok().filter(|rate| device.info.bit_rates.contains(rate));
    rate.ok_or_else(|| {
        Diagnostic::without_place(
            codes::BIT_RATE_UNSUPPORTED,
            format!("`{}` does not support a bit rate of `{text}` kbit/s", device.key),
        )
        .help(if rates.is_empty() {
            "its bit rates are not stated; state them in its specification".to_owned()
        } else {
            format!("it supports {rates} kbit/s")
        })
    })
}
