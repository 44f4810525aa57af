//! `[DeviceComissioning]` of a DCF (CiA 306 5.3): node-ID, bit rate and names.

use od_spec::Commissioning;
use od_spec::eds::Document;
use od_spec::model::{Dictionary, EntryId, Index, SubIndex, Value};

use super::writer::SectionWriter;

/// `[DeviceComissioning]`, in the standard's spelling. What people say about the node is above it.
pub(super) fn write(document: &mut Document<'_>, device: &Dictionary, commissioning: &Commissioning) {
    let mut section = SectionWriter::new("DeviceComissioning", &commissioning.remarks);
    section.key("NodeID", commissioning.node);
    section.text("NodeName", &commissioning.node_name);
    if !commissioning.reference.is_empty() {
        section.text("NodeRefd", &commissioning.reference);
    }
    section.key("Baudrate", commissioning.bit_rate);
    section.key("NetNumber", commissioning.net_number);
    section.text("NetworkName", &commissioning.net_name);
    if !commissioning.net_reference.is_empty() {
        section.text("NetRefd", &commissioning.net_reference);
    }
    section.flag("CANopenManager", commissioning.manager);
    let serial = EntryId { index: Index(0x1018), sub: SubIndex(4) };
    let serial = commissioning.values.get(&serial).or_else(|| device.entry(serial)?.default.as_ref());
    let of_identity = serial.and_then(Value::integer).unwrap_or(0);
    let serial = commissioning.serial_number.map_or(of_identity, i128::from);
    section.key("LSS_SerialNumber", format_args!("0x{serial:08X}"));
    section.finish(device, document);
}
