//! A device, with what its page has around its objects.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::view::{Appendix, Cell, LongList, ObjectName, ObjectView, Table, Target, Workbench};

/// A device.
#[derive(Debug, Clone, Serialize)]
pub struct DeviceView {
    /// Key in the specification; also the name of its page.
    pub key: String,
    /// Full name.
    pub name: String,
    /// Name of its EDS file; empty where the document is made from an EDS.
    pub eds: String,
    /// Meaning.
    pub about: Cell,
    /// Facts of `[DeviceInfo]`.
    pub facts: Table,
    /// Where a PLC may create network variables; `None` where it may nowhere.
    pub dynamic_channels: Option<Table>,
    /// The modules that a bus coupler takes; `None` of any other device.
    pub modules: Option<Table>,
    /// Overview of all objects.
    pub overview: Table,
    /// The objects.
    pub objects: LongList<ObjectView>,
    /// The objects by what they are for: the manual's functions in its order, then what it has no chapter for, and the communication objects last.
    pub groups: Vec<GroupView>,
    /// The objects and PDOs that no chapter shows in detail, by anchor: their names.
    pub details: BTreeMap<String, String>,
    /// Factory PDOs.
    pub pdos: Vec<PdoView>,
    /// Error codes, aliases, units, storage and constraints of this device alone.
    pub appendices: Vec<Appendix>,
    /// Data types, units, groups and accesses that occur, for filters.
    pub filters: Filters,
    /// That its texts are in another language, as a sentence; empty where all are in that of the document.
    pub untranslated: String,
    /// What its page calculates with.
    pub workbench: Workbench,
    /// Words by which readers look for something and which its texts do not have.
    pub search: Vec<SearchWords>,
}

/// Words by which readers look for an object, an entry, a bit, a value, an error code or a section, in all languages.
#[derive(Debug, Clone, Serialize)]
pub struct SearchWords {
    /// Where links to it lead: `6064`, `6041.b7`, `error-8611`, `section-4.3`.
    pub anchor: String,
    /// Words and phrases.
    pub phrases: Vec<String>,
}

/// Objects that belong together.
#[derive(Debug, Clone, Serialize)]
pub struct GroupView {
    /// The chapter or section of the manual that describes them, or the area of the object dictionary.
    pub title: String,
    /// The objects, ascending.
    pub objects: LongList<ObjectName>,
}

/// What a filter can offer.
#[derive(Debug, Clone, Serialize)]
pub struct Filters {
    /// Data types.
    pub types: Vec<String>,
    /// Accesses.
    pub access: Vec<String>,
    /// Unit symbols.
    pub units: Vec<String>,
    /// Storage groups: word of the specification and text.
    pub stored: Vec<(&'static str, String)>,
    /// Directions of mapping: word of the specification and text.
    pub mappable: Vec<(&'static str, &'static str)>,
}

/// A PDO.
#[derive(Debug, Clone, Serialize)]
pub struct PdoView {
    /// `RPDO 1`.
    pub name: String,
    /// Where links lead: `rpdo-1`.
    pub anchor: String,
    /// `receive` or `transmit`.
    pub direction: &'static str,
    /// CAN-ID, as `200h + node-ID`.
    pub cob_id: String,
    /// Whether the PDO exists after start-up.
    pub valid: bool,
    /// Lines about it.
    pub facts: Table,
    /// What travels in it.
    pub fields: Vec<PdoField>,
    /// Bits in all.
    pub bits: u32,
    /// Meaning.
    pub about: Cell,
}

/// What travels in a PDO.
#[derive(Debug, Clone, Serialize)]
pub struct PdoField {
    /// First bit in the frame.
    pub start: u32,
    /// Bits.
    pub width: u32,
    /// `6040h`; empty for a placeholder.
    pub entry: String,
    /// Where links lead; empty for a placeholder.
    pub anchor: String,
    /// Name.
    pub name: String,
    /// Where its entry is described, if anywhere.
    pub target: Option<Target>,
}
