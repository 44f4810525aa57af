//! Whose device it is, and what for.

use od_spec::model::DeviceInfo;

use super::Subject;
use super::xml::{Element, Xml};

/// `DeviceIdentity` and `DeviceFunction`.
pub(super) fn write(xml: &mut Xml, subject: Subject<'_>) {
    let Subject { system, device, .. } = subject;
    let info = &device.info;
    xml.open(Element::new("canopen:DeviceIdentity"), |xml| {
        xml.text(Element::new("canopen:vendorName"), &system.vendor.name);
        xml.text(Element::new("canopen:vendorID"), &format!("0x{:08X}", system.vendor.number));
        xml.text(Element::new("canopen:productName"), &info.product_name);
        xml.text(Element::new("canopen:productID"), &format!("0x{:08X}", info.product));
        if !device.file.description.is_empty() {
            xml.open(Element::new("canopen:productText"), |xml| {
                let text = Element::new("description").with("lang", system.language());
                xml.text(text, &device.file.description);
            });
        }
        if !info.order_code.is_empty() {
            xml.text(Element::new("canopen:orderNumber"), &info.order_code);
        }
        let revision = info.product_revision;
        let version = Element::new("canopen:version").with("versionType", "FW");
        xml.text(version, &format!("{}.{}", revision >> 16, revision & 0xFFFF));
    });
    xml.open(Element::new("canopen:DeviceFunction"), |xml| {
        xml.open(Element::new("canopen:capabilities"), |xml| {
            xml.open(Element::new("canopen:characteristicsList"), |xml| {
                xml.open(Element::new("canopen:characteristic"), |xml| {
                    let label = || Element::new("label").with("lang", "en");
                    xml.open(Element::new("canopen:characteristicName"), |xml| {
                        xml.text(label(), "device profile");
                    });
                    xml.open(Element::new("canopen:characteristicContent"), |xml| {
                        xml.text(label(), &profile(info));
                    });
                });
            });
        });
    });
}

/// The device profile, as the device type names it.
fn profile(info: &DeviceInfo) -> String {
    match info.device_type & 0xFFFF {
        0 => "none".to_owned(),
        number => format!("CiA {number}"),
    }
}
