//! Sections about the file and the device.

use od_spec::model::{
    DataType, Date, DateTime, Dictionary, Direction, Entry, EntryId, Fact, Index, Storage, SubIndex, System,
    Value,
};

use super::Commissioning;
use super::ini::Ini;

/// Bit rates that an EDS has keys for, in kbit/s.
const BIT_RATES: [u16; 8] = [10, 20, 50, 125, 250, 500, 800, 1000];

/// `[FileInfo]` to `[Comments]`. A DCF names the EDS that it was made from.
pub(super) fn head(ini: &mut Ini, system: &System, device: &Dictionary, file: &str, last_eds: Option<&str>) {
    file_info(ini, device, file, last_eds);
    device_info(ini, system, device);
    ini.section("DummyUsage", &[]);
    for data_type in DataType::ALL.into_iter().filter(|data_type| data_type.is_dummy()) {
        ini.flag(&format!("Dummy{:04X}", data_type.code()), device.info.dummies.contains(&data_type));
    }
    comments(ini, system, device);
}

fn file_info(ini: &mut Ini, device: &Dictionary, file: &str, last_eds: Option<&str>) {
    let info = &device.file;
    ini.section("FileInfo", &[]);
    ini.key("FileName", file);
    ini.key("FileVersion", info.version);
    ini.key("FileRevision", info.revision);
    ini.key("EDSVersion", "4.0");
    ini.key("Description", &info.description);
    ini.key("CreationTime", time(info.created));
    ini.key("CreationDate", date(info.created.date));
    ini.key("CreatedBy", &info.created_by);
    ini.key("ModificationTime", time(info.modified));
    ini.key("ModificationDate", date(info.modified.date));
    ini.key("ModifiedBy", &info.modified_by);
    if let Some(last_eds) = last_eds {
        ini.key("LastEDS", last_eds);
    }
}

/// `mm-dd-yyyy`.
fn date(date: Date) -> String {
    format!("{:02}-{:02}-{:04}", date.month, date.day, date.year)
}

/// `hh:mmAM`.
fn time(at: DateTime) -> String {
    let half = if at.hour < 12 { "AM" } else { "PM" };
    let hour = match at.hour % 12 {
        0 => 12,
        hour => hour,
    };
    format!("{hour:02}:{:02}{half}", at.minute)
}

fn device_info(ini: &mut Ini, system: &System, device: &Dictionary) {
    let info = &device.info;
    ini.section("DeviceInfo", &[]);
    ini.key("VendorName", &system.vendor.name);
    ini.key("VendorNumber", format_args!("0x{:08X}", system.vendor.number));
    ini.key("ProductName", &info.product_name);
    ini.key("ProductNumber", format_args!("0x{:08X}", info.product));
    ini.key("RevisionNumber", format_args!("0x{:08X}", info.product_revision));
    ini.key("OrderCode", &info.order_code);
    for rate in BIT_RATES {
        ini.flag(&format!("BaudRate_{rate}"), info.bit_rates.contains(&rate));
    }
    ini.flag("SimpleBootUpMaster", info.boot_up_master);
    ini.flag("SimpleBootUpSlave", info.boot_up_slave);
    ini.key("Granularity", info.granularity);
    ini.key("DynamicChannelsSupported", 0);
    ini.flag("GroupMessaging", info.group_messaging);
    ini.key("NrOfRXPDO", device.pdos_of(Direction::Receive).count());
    ini.key("NrOfTXPDO", device.pdos_of(Direction::Transmit).count());
    ini.flag("LSS_Supported", info.lss);
}

fn comments(ini: &mut Ini, system: &System, device: &Dictionary) {
    let mut lines = vec![format!("{}: {}", system.title, device.name)];
    if let Some(source) = &system.document.source {
        lines.push(format!("Manual: {source}"));
    }
    if let Some(revision) = &system.document.revision {
        let Date { year, month, day } = revision.date;
        lines.push(format!("Holds issue {} of {year:04}-{month:02}-{day:02}", revision.number));
    }
    if system.vendor.number == 0 || device.info.product == 0 {
        lines.push(
            "Vendor number or product code is 0, not known: fill them in before a PLC checks identities."
                .to_owned(),
        );
    }
    let withheld = || device.entries().filter(|(.., entry)| entry.default.is_some() && !entry.eds.default);
    let kept = |entry: &Entry| entry.locked || entry.stored != Storage::No;
    let of_the_standard =
        withheld().filter(|(.., entry)| entry.is_only_standard(Fact::Default) && !kept(entry)).count();
    let own = withheld().count() - of_the_standard;
    if own > 0 {
        lines.push(format!(
            "{own} defaults of stored or locked parameters are left out, so that no PLC writes them back at boot."
        ));
    }
    if of_the_standard > 0 {
        lines.push(format!(
            "{of_the_standard} defaults are left out because only the standard states them; the device may have others."
        ));
    }
    if own + of_the_standard > 0 {
        lines.push("The comments above each section list them, with units and meanings.".to_owned());
    }
    ini.section("Comments", &[]);
    ini.key("Lines", lines.len());
    for (number, line) in (1..).zip(lines) {
        ini.key(&format!("Line{number}"), line.replace('=', ":"));
    }
}

/// `[DeviceComissioning]`, in the standard's spelling.
pub(super) fn commissioning(ini: &mut Ini, device: &Dictionary, commissioning: &Commissioning) {
    ini.section("DeviceComissioning", &[]);
    ini.key("NodeID", commissioning.node);
    ini.key("NodeName", &commissioning.node_name);
    ini.key("Baudrate", commissioning.bit_rate);
    ini.key("NetNumber", commissioning.net_number);
    ini.key("NetworkName", &commissioning.net_name);
    ini.flag("CANopenManager", false);
    let serial = EntryId { index: Index(0x1018), sub: SubIndex(4) };
    let serial = commissioning.values.get(&serial).or_else(|| device.entry(serial)?.default.as_ref());
    ini.key("LSS_SerialNumber", format_args!("0x{:08X}", serial.and_then(Value::integer).unwrap_or(0)));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn twelve_hour_clock() {
        let at = |hour, minute| time(DateTime { date: Date { year: 2009, month: 5, day: 27 }, hour, minute });
        assert_eq!(at(0, 0), "12:00AM");
        assert_eq!(at(9, 5), "09:05AM");
        assert_eq!(at(12, 30), "12:30PM");
        assert_eq!(at(23, 59), "11:59PM");
    }
}
