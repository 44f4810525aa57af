//! The files that a specification becomes for PLC tools and programs.

use std::borrow::Cow;
use std::num::NonZero;
use std::thread::available_parallelism;

use od_gen::Artifact;
use od_spec::Commissioning;
use od_spec::model::{Devices, Dictionary, System};

use crate::xdd;
use crate::{eds, json};

/// What [`artifacts`] makes.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Selection<'a> {
    /// Keys of the devices; empty for all.
    pub devices: &'a [String],
    /// Also a DCF of each device for this node-ID.
    pub node: Option<u8>,
    /// The node of the DCF that the system was read from, with its values; it has the node-ID above, if there is one.
    pub configured: Option<&'a Commissioning>,
    /// Also an XDD of each device, and an XDC next to each DCF.
    pub xdd: bool,
}

/// The files of one specification: an EDS per device, perhaps a DCF and the same in XML, and the JSON dump under the name `stem`.
pub fn artifacts(system: &System, stem: &str, selection: &Selection<'_>) -> Vec<Artifact> {
    let devices = Devices::listed(selection.devices);
    let wanted = |device: &&Dictionary| devices.includes(&device.key);
    let files = || {
        let mut list = Vec::new();
        let mut beside: Vec<Artifact> = Vec::new();
        for device in system.devices.iter().filter(wanted) {
            let path = format!("eds/{}.eds", device.key);
            let bytes = eds::write_eds(system, device);
            list.push(Artifact { path, bytes, purpose: "import this into the PLC tool".to_owned() });
            if selection.xdd {
                let path = format!("xdd/{}.xdd", device.key);
                let bytes = xdd::write_xdd(system, device);
                beside.push(Artifact { path, bytes, purpose: "the same for tools that read XML".to_owned() });
            }
            if let Some(node) = selection.node {
                let of_device = || Cow::Owned(Commissioning::of_node(device, node));
                let commissioning = selection.configured.map_or_else(of_device, Cow::Borrowed);
                let file = format!("{}.dcf", device.key);
                let bytes = eds::write_dcf(system, device, &commissioning, &file);
                let purpose = format!("the same for node {node} at {} kbit/s", commissioning.bit_rate);
                list.push(Artifact { path: format!("eds/{file}"), bytes, purpose });
                if selection.xdd {
                    let file = format!("{}.xdc", device.key);
                    let bytes = xdd::write_xdc(system, device, &commissioning, &file);
                    let purpose = format!("the DCF for node {node} for tools that read XML");
                    beside.push(Artifact { path: format!("xdd/{file}"), bytes, purpose });
                }
            }
        }
        list.append(&mut beside);
        list
    };
    let dump = || match selection.configured {
        Some(node) => json::dump_node(system, selection.devices, node, selection.node),
        None => json::dump(system, selection.devices),
    };
    let (mut list, bytes) = both(files, dump);
    list.push(Artifact {
        path: format!("{stem}.json"),
        bytes,
        purpose: "the resolved model, for programs".to_owned(),
    });
    list
}

/// Does two works that are independent of each other, at the same time where there are cores for it.
fn both<A: Send, B>(first: impl FnOnce() -> A + Send, second: impl FnOnce() -> B) -> (A, B) {
    if available_parallelism().map_or(1, NonZero::get) == 1 {
        return (first(), second());
    }
    std::thread::scope(|scope| {
        let first = scope.spawn(first);
        let second = second();
        (first.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)), second)
    })
}
