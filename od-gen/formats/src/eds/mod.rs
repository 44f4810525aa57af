//! EDS and DCF files (CiA 306).
//!
//! The files keep to what every known reader takes: ASCII, CRLF, sections in the classical order and one blank line between
//! them, comments only directly above a section, signed values in decimal, `$NODEID` first, exact key spelling.

mod about;
pub(crate) mod comments;
mod commissioning;
mod device_info;
mod entry;
mod file_info;
mod objects;
pub(crate) mod value;
mod withheld;
mod writer;

use std::sync::Arc;

use od_gen::Pool;
use od_spec::Commissioning;
use od_spec::eds::Document;
use od_spec::model::{Dictionary, System};

/// The EDS of a device, as bytes of ASCII.
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
/// let bytes = od_formats::eds::write_eds(&system, &system.devices[0]);
/// let text = String::from_utf8(bytes).expect("ASCII").replace("\r\n", "\n");
/// assert!(text.ends_with("
/// ; How bright.
/// [2000]
/// ParameterName=brightness
/// ObjectType=0x7
/// DataType=0x0005
/// HighLimit=100
/// AccessType=rw
/// DefaultValue=80
/// PDOMapping=0
/// "), "{text}");
/// ```
pub fn write_eds(system: &System, device: &Dictionary) -> Vec<u8> {
    eds_document(system, device).to_bytes()
}

/// The EDS of a device as a document, to look at or to change before it is written.
pub fn eds_document(system: &System, device: &Dictionary) -> Document<'static> {
    let mut document = Document::default();
    head(&mut document, system, device, &format!("{}.eds", device.key), None);
    objects::write(&mut document, system, device, None);
    document
}

/// The DCF of a node under the name `file`, as bytes of ASCII: the device's EDS with node-ID, bit rate and parameter values
/// filled in.
pub fn write_dcf(system: &System, device: &Dictionary, node: &Commissioning, file: &str) -> Vec<u8> {
    dcf_document(system, device, node, file).to_bytes()
}

/// The DCF of a node as a document.
pub fn dcf_document(
    system: &System,
    device: &Dictionary,
    node: &Commissioning,
    file: &str,
) -> Document<'static> {
    let mut document = Document::default();
    head(&mut document, system, device, file, Some(&format!("{}.eds", device.key)));
    commissioning::write(&mut document, device, node);
    objects::write(&mut document, system, device, Some(node));
    document
}

/// A DCF in pieces: nodes that are set to the same values differ in `[DeviceComissioning]` alone, and those of a device with other
/// values in the objects that these are of.
#[derive(Debug, Clone)]
pub struct DcfPieces {
    before: Arc<[u8]>,
    /// An object with its entries each.
    after: Vec<Arc<[u8]>>,
}

impl DcfPieces {
    /// What nodes with the values of this one have in common, in files of this name. Pieces that others have too are those of the pool.
    pub fn new(system: &System, device: &Dictionary, node: &Commissioning, file: &str, pool: &Pool) -> Self {
        let (mut before, mut after) = (Document::default(), Document::default());
        head(&mut before, system, device, file, Some(&format!("{}.eds", device.key)));
        objects::write(&mut after, system, device, Some(node));
        let mut before = before.to_bytes();
        before.extend_from_slice(BETWEEN_SECTIONS);
        let after = [BETWEEN_SECTIONS, &after.to_bytes()].concat();
        Self {
            before: pool.piece(&before),
            after: by_object(&after).into_iter().map(|piece| pool.piece(piece)).collect(),
        }
    }

    /// The DCF of a node, byte for byte what [`write_dcf`] gives.
    pub fn dcf(&self, device: &Dictionary, node: &Commissioning) -> Vec<Arc<[u8]>> {
        let mut own = Document::default();
        commissioning::write(&mut own, device, node);
        let before = [Arc::clone(&self.before), own.to_bytes().into()];
        before.into_iter().chain(self.after.iter().cloned()).collect()
    }
}

/// Divides sections before each that is an object's own.
fn by_object(mut text: &[u8]) -> Vec<&[u8]> {
    let mut pieces = Vec::new();
    let mut end = 0;
    while let Some(next) = end_of_section(&text[end..]) {
        let is_object = header(&text[end + next..]).is_some_and(|name| name.len() == INDEX_DIGITS);
        end += next;
        if is_object {
            let (piece, rest) = text.split_at(end);
            pieces.push(piece);
            (text, end) = (rest, 0);
        }
    }
    pieces.push(text);
    pieces
}

/// `1A00`, and not `1A00sub1`.
const INDEX_DIGITS: usize = 4;

/// Where the section after the first blank line begins.
fn end_of_section(text: &[u8]) -> Option<usize> {
    let blank = text.windows(BLANK_LINE.len()).position(|window| window == BLANK_LINE)?;
    Some(blank + BLANK_LINE.len())
}

const BLANK_LINE: &[u8] = b"\r\n\r\n";

/// The name of the first section.
fn header(text: &[u8]) -> Option<&[u8]> {
    let line = text.split(|byte| *byte == b'\n').find(|line| line.first() == Some(&b'['))?;
    line.strip_prefix(b"[")?.split(|byte| *byte == b']').next()
}

/// The blank line between two sections.
const BETWEEN_SECTIONS: &[u8] = b"\r\n";

/// `[FileInfo]` to `[Comments]`. A DCF names the EDS that it was made from.
fn head(
    document: &mut Document<'_>,
    system: &System,
    device: &Dictionary,
    file: &str,
    last_eds: Option<&str>,
) {
    file_info::write(document, device, file, last_eds);
    device_info::write(document, system, device);
    device_info::write_dummies(document, device);
    device_info::write_channels(document, device);
    about::write(document, system, device);
}
