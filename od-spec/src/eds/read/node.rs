//! `[DeviceComissioning]` and the values of a DCF (CiA 306 5): one node of a network.

use crate::ast::Name;
use crate::commissioning::Denoted;
use crate::eds::coded;
use crate::eds::names::Topic;
use crate::eds::number::lenient_integer;
use crate::eds::view::View;
use crate::model::EntryId;

/// Which way a DOMAIN goes between a node and a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FileUse {
    /// The file receives what is read from the node.
    Upload,
    /// What the file holds is written to the node.
    Download,
}

impl FileUse {
    pub(super) const ALL: [Self; 2] = [Self::Upload, Self::Download];

    pub(super) const fn key(self) -> &'static str {
        match self {
            Self::Upload => "UploadFile",
            Self::Download => "DownloadFile",
        }
    }
}

/// A node, as far as its DCF says.
#[derive(Debug, Default)]
pub(crate) struct NodeDecl {
    /// Node-ID, 1 to 127.
    pub node: Option<u8>,
    /// Name of the node.
    pub node_name: Option<String>,
    /// Bit rate in kbit/s.
    pub bit_rate: Option<u16>,
    /// Number of the network.
    pub net_number: Option<u32>,
    /// Name of the network.
    pub net_name: Option<String>,
    /// Serial number for LSS; 0 means that there is none.
    pub serial_number: Option<u32>,
    /// Whether it is the CANopen manager.
    pub manager: bool,
    /// Reference designation of the node.
    pub reference: Option<String>,
    /// Reference designation of the network.
    pub net_reference: Option<String>,
    /// Parameter values, as a specification would write them.
    pub values: Vec<(EntryId, Name)>,
    /// Names of objects and entries in the application.
    pub denotations: Vec<(Denoted, Name)>,
    /// Reference designations of objects and entries.
    pub references: Vec<(Denoted, Name)>,
    /// Files of DOMAINs.
    pub files: Vec<(EntryId, FileUse, Name)>,
}

/// What the file says about the node itself. What cannot be read counts as not said; the rules about the text report
/// it.
pub(super) fn read(view: &View<'_>) -> NodeDecl {
    let Some(section) = view.section(Topic::Commissioning) else { return NodeDecl::default() };
    let text = |key: &str| section.value(key).map(|text| text.value.to_owned());
    let number = |key: &str| section.value(key).and_then(|text| lenient_integer(text.value));
    NodeDecl {
        node: number("NodeID").and_then(|id| u8::try_from(id).ok()).filter(|id| (1..=127).contains(id)),
        node_name: text("NodeName"),
        bit_rate: section.value("Baudrate").and_then(|text| bit_rate(text.value)),
        net_number: number("NetNumber").and_then(|number| u32::try_from(number).ok()),
        net_name: text("NetworkName"),
        serial_number: number("LSS_SerialNumber")
            .and_then(|number| u32::try_from(number).ok())
            .filter(|number| *number != 0),
        manager: number("CANopenManager").is_some_and(|flag| flag != 0),
        reference: text("NodeRefd"),
        net_reference: text("NetRefd"),
        values: Vec::new(),
        denotations: Vec::new(),
        references: Vec::new(),
        files: Vec::new(),
    }
}

/// A bit rate in kbit/s: one of CiA 301 in any unit, or another one. 0 means that there is none.
fn bit_rate(text: &str) -> Option<u16> {
    let other = || u16::try_from(lenient_integer(text)?).ok().filter(|rate| *rate != 0);
    coded::bit_rate(text).or_else(other)
}
