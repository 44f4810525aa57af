//! The list of the nodes of a bus, `nodelist.cpj` (CiA 306-3): what a configuration tool opens to find the DCF files.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use od_spec::ascii::transliterate;
use od_spec::eds::GENERATED;
use od_spec::plant::{Machine, Plant, PlantNode};

use super::stem;

/// Longest value of a name.
const LONGEST: usize = 243;

/// The list of a machine. Node-IDs ascend; files are named relative to the list.
pub(super) fn write(plant: &Plant, machine: &Machine, nodes: &[PlantNode]) -> String {
    let by_id: BTreeMap<u8, &PlantNode> = nodes.iter().map(|node| (node.node.value, node)).collect();
    let mut text = format!("; {GENERATED}\r\n[Topology]\r\n");
    let _ = write!(text, "NetName={}\r\nNodes=0x{:02X}\r\n", plain(&machine.net_name), by_id.len());
    for (id, node) in by_id {
        let _ = write!(
            text,
            "Node{id}Present=0x01\r\nNode{id}Name={}\r\nNode{id}DCFName={}.dcf\r\n",
            plain(&node.node_name),
            stem(plant, node)
        );
    }
    text
}

/// A name as a line of the file can hold it.
fn plain(name: &str) -> String {
    let mut plain = transliterate(name);
    plain.truncate(LONGEST);
    plain.trim().to_owned()
}
