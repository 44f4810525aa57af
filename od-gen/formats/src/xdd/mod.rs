//! XDD and XDC files (CiA 311): what an EDS and a DCF say, in XML.
//!
//! Both show the same side of a device: the access, defaults and limits that its EDS shows. Beyond an EDS, texts are in
//! every language, and units, scales and named values have elements of their own. Elements that the schema declares at
//! its top are qualified, those inside are not, as other programs write them.

mod identity;
mod network;
mod objects;
mod parameters;
mod unique_id;
mod xml;

use od_spec::Commissioning;
use od_spec::eds::GENERATED;
use od_spec::model::{DateTime, Dictionary, EdsPolicy, Entry, EntryId, Object, System};

use xml::{Element, Xml};

const NAMESPACE: &str = "http://www.canopen.org/xml/1.1";

/// What a file is about.
#[derive(Clone, Copy)]
struct Subject<'a> {
    system: &'a System,
    device: &'a Dictionary,
    /// Of an XDC: the node.
    node: Option<&'a Commissioning>,
    /// What the file is called.
    file: &'a str,
}

impl Subject<'_> {
    /// What the file shows of an entry.
    fn shown(&self, object: &Object, entry: &Entry) -> EdsPolicy {
        let id = EntryId { index: object.index, sub: entry.sub };
        self.node.map_or(entry.eds, |node| node.shown(id, entry))
    }
}

/// The XDD of a device, in UTF-8.
///
/// ```
/// use od_spec::source::SourceMap;
/// use od_spec::{NoFiles, compile};
///
/// let mut sources = SourceMap::new();
/// let root = sources.add("lamp.od.yaml", "
/// od-spec: 1
/// title: Lamp
/// uses: [cia301]
/// devices:
///   lamp: {name: Lamp, bit-rates: [125], features: [heartbeat producer]}
/// objects:
///   0x2000: {name: brightness, type: unsigned8, access: rw, default: 80, max: 100, about: How bright.}
/// ");
/// let system = compile(&mut sources, root, &mut NoFiles).system.expect("no errors");
/// let bytes = od_formats::xdd::write_xdd(&system, &system.devices[0]);
/// let text = String::from_utf8(bytes).expect("UTF-8");
/// assert!(text.contains("<CANopenObject index=\"2000\" name=\"brightness\" objectType=\"7\" dataType=\"0005\" highLimit=\"100\" \
///     accessType=\"rw\" defaultValue=\"80\" PDOmapping=\"no\" uniqueIDRef=\"UID_OBJ_2000\"/>"), "{text}");
/// assert!(text.contains("<description lang=\"en\">How bright.</description>"), "{text}");
/// ```
pub fn write_xdd(system: &System, device: &Dictionary) -> Vec<u8> {
    write(Subject { system, device, node: None, file: &format!("{}.xdd", device.key) })
}

/// The XDC of a node under the name `file`: the device's XDD with node-ID, bit rate and parameter values filled in.
pub fn write_xdc(system: &System, device: &Dictionary, node: &Commissioning, file: &str) -> Vec<u8> {
    write(Subject { system, device, node: Some(node), file })
}

fn write(subject: Subject<'_>) -> Vec<u8> {
    // What people say about the node has no element: those that would hold it are about the product, and come back as such.
    let remarks = subject.node.iter().flat_map(|node| node.remarks.iter().map(String::as_str));
    let mut xml = Xml::new(&std::iter::once(GENERATED).chain(remarks).collect::<Vec<_>>());
    let container = Element::new("canopen:ISO15745ProfileContainer")
        .with("xmlns:canopen", NAMESPACE)
        .with("xmlns:xsi", "http://www.w3.org/2001/XMLSchema-instance");
    xml.open(container, |xml| {
        profile(xml, subject, "Device", |xml| {
            identity::write(xml, subject);
            parameters::write(xml, subject);
        });
        profile(xml, subject, "CommunicationNetwork", |xml| {
            xml.open(Element::new("ApplicationLayers"), |xml| objects::write(xml, subject));
            network::write(xml, subject);
        });
    });
    xml.into_bytes()
}

/// One of the two profiles of a file (ISO 15745).
fn profile(xml: &mut Xml, subject: Subject<'_>, class: &str, content: impl FnOnce(&mut Xml)) {
    let Subject { system, device, file, .. } = subject;
    xml.open(Element::new("canopen:ISO15745Profile"), |xml| {
        xml.open(Element::new("ProfileHeader"), |xml| {
            xml.text(Element::new("ProfileIdentification"), &device.key);
            xml.text(Element::new("ProfileRevision"), "1.1");
            xml.text(Element::new("ProfileName"), &device.info.product_name);
            xml.text(Element::new("ProfileSource"), &system.vendor.name);
            xml.text(Element::new("ProfileClassID"), class);
            xml.open(Element::new("ISO15745Reference"), |xml| {
                xml.text(Element::new("ISO15745Part"), "1");
                xml.text(Element::new("ISO15745Edition"), "1");
                xml.text(Element::new("ProfileTechnology"), "CANopen");
            });
        });
        let info = &device.file;
        let body = Element::new("ProfileBody")
            .with("xsi:type", format_args!("canopen:ProfileBody_{class}_CANopen"))
            .with("formatName", "CANopen")
            .with("formatVersion", "1.0")
            .with("fileName", file)
            .with("fileCreator", &info.created_by)
            .with("fileCreationDate", date(info.created))
            .with("fileCreationTime", time(info.created))
            .with("fileModifiedBy", &info.modified_by)
            .with("fileModificationDate", date(info.modified))
            .with("fileModificationTime", time(info.modified))
            .with("fileVersion", format_args!("{}.{}", info.version, info.revision))
            .with("supportedLanguages", languages(system).join(" "));
        xml.open(body, content);
    });
}

/// The languages of a system, the one of its short texts first.
fn languages(system: &System) -> Vec<&str> {
    if system.languages.is_empty() {
        return vec!["en"];
    }
    system.languages.iter().map(String::as_str).collect()
}

fn date(at: DateTime) -> String {
    format!("{:04}-{:02}-{:02}", at.date.year, at.date.month, at.date.day)
}

fn time(at: DateTime) -> String {
    format!("{:02}:{:02}:00", at.hour, at.minute)
}
