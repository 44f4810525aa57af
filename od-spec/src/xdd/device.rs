//! The file, the device and its node: `[FileInfo]`, `[DeviceInfo]`, `[DummyUsage]`, `[DynamicChannels]` and `[DeviceComissioning]`.

use roxmltree::Node;

use super::parameters::Parameters;
use super::tree::{Tree, child, children, is_named};
use crate::diag::{Diagnostic, Diagnostics, codes, shorten};
use crate::eds::Document;
use crate::eds::number::lenient_integer;
use crate::notation::words;
use crate::source::{Span, Spanned};

/// Writes what is said about the file, the device and its node.
pub(super) fn write<'x>(
    document: &mut Document<'static>,
    tree: Tree<'x>,
    parameters: &Parameters<'x>,
    diagnostics: &mut Diagnostics,
) {
    file_info(document, tree);
    device_info(document, tree, parameters, diagnostics);
    dummies(document, tree);
    channels(document, tree);
    commissioning(document, tree, diagnostics);
}

/// Adds keys to a section.
struct Keys<'d>(&'d mut Document<'static>);

impl Keys<'_> {
    fn add(&mut self, key: &str, value: Option<Spanned<impl AsRef<str>>>) {
        if let Some(value) = value {
            self.0.push_key(key, value.value.as_ref(), value.span);
        }
    }
}

/// Attributes of the device's profile; in some files those of the network's alone.
fn file_info(document: &mut Document<'static>, tree: Tree<'_>) {
    let bodies = || tree.xml.descendants().filter(|node| node.is_element() && is_named(*node, "ProfileBody"));
    let of_device = |body: &Node<'_, '_>| child(*body, "DeviceIdentity").is_some();
    let Some(body) = bodies().find(of_device).or_else(|| bodies().next()) else { return };
    document.push_header("FileInfo", tree.place(body), &[]);
    let text = |name: &str| tree.attribute(body, name);
    let mut keys = Keys(document);
    keys.add("FileName", text("fileName"));
    keys.add("CreatedBy", text("fileCreator"));
    keys.add("CreationDate", text("fileCreationDate"));
    keys.add("CreationTime", text("fileCreationTime").map(minutes));
    keys.add("ModifiedBy", text("fileModifiedBy"));
    keys.add("ModificationDate", text("fileModificationDate"));
    keys.add("ModificationTime", text("fileModificationTime").map(minutes));
    // Any text may be there; two numbers are version and revision.
    if let Some(version) = text("fileVersion") {
        let mut parts = version.value.splitn(2, '.');
        keys.add("FileVersion", parts.next().map(|part| Spanned::new(part, version.span)));
        keys.add("FileRevision", parts.next().map(|part| Spanned::new(part, version.span)));
    }
    let identity = child(body, "DeviceIdentity").and_then(|identity| child(identity, "productText"));
    keys.add("Description", identity.and_then(|text| tree.text(child(text, "description")?)));
}

/// `16:38` of `16:38:00.0000000+01:00`.
fn minutes(time: Spanned<&str>) -> Spanned<&str> {
    time.map(|time| time.get(..5).unwrap_or(time))
}

fn device_info<'x>(
    document: &mut Document<'static>,
    tree: Tree<'x>,
    parameters: &Parameters<'x>,
    diagnostics: &mut Diagnostics,
) {
    let place = tree.place(tree.xml.root_element());
    document.push_header("DeviceInfo", place, &[]);
    let mut keys = Keys(document);
    if let Some(identity) = tree.first("DeviceIdentity") {
        let text = |name: &str| tree.text(child(identity, name)?);
        for name in ["vendorID", "productID"] {
            if let Some(id) =
                text(name).filter(|id| !id.value.is_empty() && lenient_integer(id.value).is_none())
            {
                let message = format!("found `{}` as `{name}`, expected a number", shorten(id.value));
                let help = "write it in hexadecimal, such as `0x0000001F`";
                diagnostics.push(Diagnostic::new(codes::XDD_ATTRIBUTE, id.span, message).help(help));
            }
        }
        keys.add("VendorName", text("vendorName"));
        keys.add("VendorNumber", text("vendorID"));
        keys.add("ProductName", text("productName"));
        keys.add("ProductNumber", text("productID"));
        keys.add("OrderCode", text("orderNumber"));
    }
    keys.add("RevisionNumber", revision(tree, parameters));
    for rate in
        tree.xml.descendants().filter(|node| node.is_element() && is_named(*node, "supportedBaudRate"))
    {
        let Some(value) = tree.attribute(rate, "value") else { continue };
        if words::bit_rate(value.value).is_none() {
            diagnostics.push(no_bit_rate("value", value));
        }
        if let Some(kbit) = kbit(value.value) {
            keys.add(&format!("BaudRate_{kbit}"), Some(value.map(|_| "1")));
        }
    }
    if let Some(features) = tree.first("CANopenGeneralFeatures") {
        let number = |name: &str| tree.attribute(features, name);
        keys.add("Granularity", number("granularity"));
        keys.add("NrOfRXPDO", number("nrOfRxPDO"));
        keys.add("NrOfTXPDO", number("nrOfTxPDO"));
        keys.add("GroupMessaging", number("groupMessaging").map(flag));
        keys.add("SimpleBootUpSlave", number("bootUpSlave").map(flag));
        keys.add("LSS_Supported", number("layerSettingServiceSlave").map(flag));
        keys.add("DynamicChannelsSupported", number("dynamicChannels"));
    }
    if let Some(features) = tree.first("CANopenMasterFeatures") {
        keys.add("SimpleBootUpMaster", tree.attribute(features, "bootUpMaster").map(flag));
    }
}

/// The revision of the product has no element of its own: it is what 1018h.3 shows.
fn revision<'x>(tree: Tree<'x>, parameters: &Parameters<'x>) -> Option<Spanned<&'x str>> {
    let objects = tree.first("CANopenObjectList")?;
    let number = |node, name: &str| u16::from_str_radix(tree.attribute(node, name)?.value, 16).ok();
    let mut objects = children(objects, "CANopenObject");
    let identity = objects.find(|object| number(*object, "index") == Some(0x1018))?;
    let mut subs = children(identity, "CANopenSubObject");
    let revision = subs.find(|sub| number(*sub, "subIndex") == Some(3))?;
    let of_parameter = || parameters.referred(revision).ok()??.value("defaultValue");
    tree.attribute(revision, "defaultValue").or_else(of_parameter)
}

fn flag(text: Spanned<&str>) -> Spanned<&'static str> {
    text.map(|text| if matches!(text, "true" | "1") { "1" } else { "0" })
}

/// `250` of `250 Kbps`, also of a bit rate that CiA 301 does not have.
fn kbit(text: &str) -> Option<u16> {
    let other = || text.split_whitespace().next()?.parse().ok().filter(|rate| *rate != 0);
    words::bit_rate(text).or_else(other)
}

/// The finding about a bit rate that CANopen does not have.
fn no_bit_rate(name: &str, rate: Spanned<&str>) -> Diagnostic {
    let message =
        format!("found `{name}=\"{}\"`, expected a bit rate such as `250 Kbps`", shorten(rate.value));
    let help = "write 10, 20, 50, 125, 250, 500, 800 or 1000, with ` Kbps`";
    Diagnostic::new(codes::XDD_ATTRIBUTE, rate.span, message).help(help)
}

fn dummies(document: &mut Document<'static>, tree: Tree<'_>) {
    let Some(usage) = tree.first("dummyUsage") else { return };
    document.push_header("DummyUsage", tree.place(usage), &[]);
    let mut keys = Keys(document);
    for dummy in children(usage, "dummy") {
        let Some(entry) = tree.attribute(dummy, "entry") else { continue };
        if let Some((key, value)) = entry.value.split_once('=') {
            keys.add(key.trim(), Some(entry.map(|_| value.trim())));
        }
    }
}

fn channels(document: &mut Document<'static>, tree: Tree<'_>) {
    let Some(list) = tree.first("dynamicChannels") else { return };
    document.push_header("DynamicChannels", tree.place(list), &[]);
    let mut keys = Keys(document);
    let mut number = 0;
    for channel in children(list, "dynamicChannel") {
        number += 1;
        let text = |name: &str| tree.attribute(channel, name);
        let hexadecimal = |digits: &str| format!("0x{}", digits.trim_start_matches("0x"));
        keys.add(&format!("Type{number}"), text("dataType").map(|text| text.map(hexadecimal)));
        let access = text("accessType").map(|text| {
            text.map(|access| match access {
                "readOnly" => "ro",
                "writeOnly" => "wo",
                "readWriteOutput" => "rww",
                other => other,
            })
        });
        keys.add(&format!("Dir{number}"), access.map(|access| access.map(str::to_owned)));
        if let (Some(first), Some(last)) = (text("startIndex"), text("endIndex")) {
            let range = format!("{}-{}", hexadecimal(first.value), hexadecimal(last.value));
            keys.add(&format!("Range{number}"), Some(Spanned::new(range, first.span)));
        }
        keys.add(&format!("PPOffset{number}"), text("addressOffset"));
    }
    let place: Span = tree.place(list);
    keys.add("NrOfSeg", Some(Spanned::new(number.to_string(), place)));
}

/// Whether the text of an attribute is what it has to be.
type IsRight<'a> = &'a dyn Fn(&str) -> bool;

fn commissioning(document: &mut Document<'static>, tree: Tree<'_>, diagnostics: &mut Diagnostics) {
    let Some(node) = tree.first("deviceCommissioning") else { return };
    document.push_header("DeviceComissioning", tree.place(node), &[]);
    let text = |name: &str| tree.attribute(node, name);
    let mut keys = Keys(document);
    keys.add("NodeID", text("NodeID"));
    keys.add("NodeName", text("nodeName"));
    let rate = text("actualBaudRate");
    keys.add("Baudrate", rate.and_then(|rate| Some(Spanned::new(kbit(rate.value)?.to_string(), rate.span))));
    if let Some(rate) = rate.filter(|rate| words::bit_rate(rate.value).is_none()) {
        diagnostics.push(no_bit_rate("actualBaudRate", rate));
    }
    keys.add("NetNumber", text("networkNumber"));
    keys.add("NetworkName", text("networkName"));
    keys.add("CANopenManager", text("CANopenManager").map(flag));
    let is_number = |text: &str, fits: fn(&i128) -> bool| lenient_integer(text).as_ref().is_some_and(fits);
    let is_node_id = |text: &str| is_number(text, |id| matches!(id, 1..=127 | 255));
    let is_network = |text: &str| is_number(text, |number| u32::try_from(*number).is_ok());
    let is_rate = |text: &str| kbit(text).is_some();
    let expected: [(_, IsRight<'_>, _, _); 3] = [
        ("NodeID", &is_node_id, "a node-ID", "node-IDs are 1 to 127"),
        ("actualBaudRate", &is_rate, "a bit rate", "write it in kbit/s, such as `250 Kbps`"),
        ("networkNumber", &is_network, "a number", "write the number of the network"),
    ];
    for (name, is_right, expected, help) in expected {
        let Some(text) = text(name).filter(|text| !is_right(text.value)) else { continue };
        let message = format!("found `{name}=\"{}\"`, expected {expected}", shorten(text.value));
        diagnostics.push(Diagnostic::new(codes::XDD_ATTRIBUTE, text.span, message).help(help));
    }
}
