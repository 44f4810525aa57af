//! `[DeviceInfo]`, `[DummyUsage]` (CiA 306 4.5 and 4.6.2) and `[DynamicChannels]`: what the device is and what it supports.

use od_spec::eds::Document;
use od_spec::model::{BIT_RATES, DataType, Dictionary, Direction, System};

use super::writer::SectionWriter;

/// `[DeviceInfo]`: whose device it is and what it can do.
pub(super) fn write(document: &mut Document<'_>, system: &System, device: &Dictionary) {
    let info = &device.info;
    let mut section = SectionWriter::new("DeviceInfo", &[]);
    section.text("VendorName", &system.vendor.name);
    section.key("VendorNumber", format_args!("0x{:08X}", system.vendor.number));
    section.text("ProductName", &info.product_name);
    section.key("ProductNumber", format_args!("0x{:08X}", info.product));
    section.key("RevisionNumber", format_args!("0x{:08X}", info.product_revision));
    section.text("OrderCode", &info.order_code);
    for rate in BIT_RATES {
        section.flag(&format!("BaudRate_{rate}"), info.bit_rates.contains(&rate));
    }
    section.flag("SimpleBootUpMaster", info.boot_up_master);
    section.flag("SimpleBootUpSlave", info.boot_up_slave);
    section.key("Granularity", info.granularity);
    section.flag("DynamicChannelsSupported", !info.dynamic_channels.is_empty());
    section.flag("GroupMessaging", info.group_messaging);
    section.key("NrOfRXPDO", device.pdos_of(Direction::Receive).count());
    section.key("NrOfTXPDO", device.pdos_of(Direction::Transmit).count());
    section.flag("LSS_Supported", info.lss);
    section.finish(device, document);
}

/// `[DynamicChannels]` (CiA 306-3), where there are any.
pub(super) fn write_channels(document: &mut Document<'_>, device: &Dictionary) {
    let channels = &device.info.dynamic_channels;
    if channels.is_empty() {
        return;
    }
    let mut section = SectionWriter::new("DynamicChannels", &[]);
    section.key("NrOfSeg", channels.len());
    for (number, channel) in (1..).zip(channels) {
        section.hexadecimal(&format!("Type{number}"), channel.data_type.code(), 4);
        section.key(&format!("Dir{number}"), channel.access.word());
        let (first, last) = (channel.first.0, channel.last.0);
        section.key(&format!("Range{number}"), format_args!("0x{first:04X}-0x{last:04X}"));
        let difference =
            channel.difference.map_or(String::new(), |difference| format!(",0x{difference:08X}"));
        section.key(&format!("PPOffset{number}"), format_args!("0x{:08X}{difference}", channel.offset));
    }
    section.finish(device, document);
}

/// `[DummyUsage]`: the placeholders that an RPDO takes. Readers want a key for each.
pub(super) fn write_dummies(document: &mut Document<'_>, device: &Dictionary) {
    let mut section = SectionWriter::new("DummyUsage", &[]);
    for data_type in DataType::ALL.into_iter().filter(|data_type| data_type.is_dummy()) {
        section.flag(&format!("Dummy{:04X}", data_type.code()), device.info.dummies.contains(&data_type));
    }
    section.finish(device, document);
}
