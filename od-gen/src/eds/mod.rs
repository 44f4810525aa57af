//! EDS and DCF files (CiA 306).
//!
//! The files keep to what every known reader takes: ASCII, CRLF, sections in the classical order and one blank line between
//! them, comments only directly above a section, signed values in decimal, `$NODEID` first, exact key spelling.

mod comments;
mod ini;
mod objects;
mod sections;

use od_spec::ParameterValues;
use od_spec::model::{Dictionary, System};

use ini::Ini;

/// The EDS of a device.
pub fn write_eds(system: &System, device: &Dictionary) -> Vec<u8> {
    let mut ini = Ini::new();
    let file = format!("{}.eds", device.key);
    sections::head(&mut ini, system, device, &file, None);
    objects::write(&mut ini, system, device, None);
    ini.into_bytes()
}

/// The DCF of a device under the name `file`: its EDS with node-ID, bit rate and parameter values filled in.
pub fn write_dcf(system: &System, device: &Dictionary, commissioning: &Commissioning, file: &str) -> Vec<u8> {
    let mut ini = Ini::new();
    let last_eds = format!("{}.eds", device.key);
    sections::head(&mut ini, system, device, file, Some(&last_eds));
    sections::commissioning(&mut ini, device, commissioning);
    objects::write(&mut ini, system, device, Some(commissioning));
    ini.into_bytes()
}

/// What a DCF adds to an EDS.
#[derive(Debug, Clone, PartialEq)]
pub struct Commissioning {
    /// Node-ID, 1 to 127.
    pub node: u8,
    /// Name of the node.
    pub node_name: String,
    /// Bit rate in kbit/s.
    pub bit_rate: u16,
    /// Number of the network.
    pub net_number: u32,
    /// Name of the network.
    pub net_name: String,
    /// Values of single entries.
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
}
