//! What is settled for one node of a network, beyond what its device is.

use crate::model::{Dictionary, NoSuchValue, Write, download};
use crate::parameters::ParameterValues;

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
    /// Values of single entries; every other entry keeps its default.
    pub values: ParameterValues,
}

impl Commissioning {
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
            values: ParameterValues::new(),
        }
    }

    /// The device as this node is: the values stand where the defaults were, and PDOs are what their parameters then say.
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
    pub fn download(&self, device: &Dictionary) -> Result<Vec<Write>, NoSuchValue> {
        download(device, &self.values, self.node)
    }
}
