//! Bit rates, features of the device in a network, and what is settled for a node.

use od_spec::Commissioning;
use od_spec::model::Direction;

use super::Subject;
use super::xml::{Element, Xml};

/// `TransportLayers` and `NetworkManagement`.
pub(super) fn write(xml: &mut Xml, subject: Subject<'_>) {
    let Subject { device, node, .. } = subject;
    let info = &device.info;
    xml.open(Element::new("TransportLayers"), |xml| {
        xml.open(Element::new("PhysicalLayer"), |xml| {
            xml.open(Element::new("baudRate"), |xml| {
                for rate in &info.bit_rates {
                    xml.empty(Element::new("supportedBaudRate").with("value", bit_rate(*rate)));
                }
            });
        });
    });
    xml.open(Element::new("NetworkManagement"), |xml| {
        let features = Element::new("CANopenGeneralFeatures")
            .with("groupMessaging", info.group_messaging)
            .with("dynamicChannels", info.dynamic_channels.len())
            .with("selfStartingDevice", false)
            .with("SDORequestingDevice", false)
            .with("granularity", info.granularity)
            .with("nrOfRxPDO", device.pdos_of(Direction::Receive).count())
            .with("nrOfTxPDO", device.pdos_of(Direction::Transmit).count())
            .with("bootUpSlave", info.boot_up_slave)
            .with("layerSettingServiceSlave", info.lss);
        xml.empty(features);
        xml.empty(Element::new("CANopenMasterFeatures").with("bootUpMaster", info.boot_up_master));
        if let Some(node) = node {
            xml.empty(commissioning(node));
        }
    });
}

fn commissioning(node: &Commissioning) -> Element {
    Element::new("deviceCommissioning")
        .with("NodeID", node.node)
        .with("nodeName", &node.node_name)
        .with("actualBaudRate", bit_rate(node.bit_rate))
        .with("networkNumber", node.net_number)
        .with("networkName", &node.net_name)
        .with("CANopenManager", node.manager)
}

fn bit_rate(kbit: u16) -> String {
    format!("{kbit} Kbps")
}
