//! An object with its entries, and where it is described and used.

use serde::Serialize;

use crate::view::{Cell, ErratumView, LongList, Table};

/// An object with everything that is known about it.
#[derive(Debug, Clone, Serialize)]
pub struct ObjectView {
    /// `6040h`.
    pub index: String,
    /// Where links lead: `6040`.
    pub anchor: String,
    /// Name.
    pub name: String,
    /// `VAR`, `ARRAY`, `RECORD`, `DOMAIN`.
    pub kind: &'static str,
    /// `manual`, `profile` or `pdo`.
    pub origin: &'static str,
    /// Meaning.
    pub about: Cell,
    /// Danger that comes from it as a whole; that of an entry is in its row.
    pub warning: Cell,
    /// Lines about the object: standard, category, issue.
    pub notes: Vec<Cell>,
    /// Since which specification it is another, and where that is described; empty if it is the same, or nothing was compared.
    pub changed: Cell,
    /// Detail table.
    pub table: Table,
    /// Bit and value tables of its types.
    pub types: Vec<Table>,
    /// What refers to it: heading and lines.
    pub used: Vec<Used>,
    /// Where the manual has it.
    pub places: Vec<Place>,
    /// Errata about it.
    pub errata: Vec<ErratumView>,
    /// Its entries, in the order of the detail table.
    pub entries: LongList<EntryView>,
    /// For filters, each once: accesses.
    pub access: Vec<String>,
    /// For filters: data types.
    pub data_types: Vec<String>,
    /// For filters: units.
    pub units: Vec<String>,
    /// For filters: storage groups.
    pub stored: Vec<String>,
    /// For filters: `receive`, `transmit`.
    pub mappable: Vec<String>,
    /// By what else than its own name a search finds it: the names of its entries, bits and values, each once.
    pub names: String,
}

/// What an object is called.
#[derive(Debug, Clone, Serialize)]
pub struct ObjectName {
    /// `6040h`.
    pub index: String,
    /// Where links lead: `6040`.
    pub anchor: String,
    /// Name.
    pub name: String,
}

/// An entry as plain facts, for lists of one's own.
#[derive(Debug, Clone, Serialize)]
pub struct EntryView {
    /// Index, `6040h`.
    pub index: String,
    /// Sub-index.
    pub sub: u8,
    /// Name.
    pub name: String,
    /// Where links lead.
    pub anchor: String,
    /// Data type, as a specification writes it.
    #[serde(rename = "type")]
    pub data_type: &'static str,
    /// `ro`, `wo`, `rw`, `r(w)`, …
    pub access: String,
    /// `none`, `receive`, `transmit`, `both`.
    pub pdo: &'static str,
    /// Raw default: a number, or a text; empty where there is none.
    pub default: String,
    /// Raw lower limit; empty where there is none.
    pub low: String,
    /// Raw upper limit; empty where there is none.
    pub high: String,
    /// One raw step: `0.1 °C`; may be empty.
    pub unit: String,
    /// Symbol of its unit: `°C`; may be empty.
    pub symbol: String,
    /// `no`, `communication`, `application`, `manufacturer`, `remanent`; empty where an EDS does not say it.
    pub stored: &'static str,
    /// `0x6040:00`, both hexadecimal.
    pub path: String,
    /// Call of the accessor in generated Rust; empty where there is none.
    pub rust: String,
    /// The constant with its index in generated C; empty where there is none.
    pub c: String,
    /// The constant with its index in generated Structured Text; empty where there is none.
    pub structured_text: String,
}

/// Where a name in a picture leads.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Target {
    /// Anchor.
    pub anchor: String,
    /// Page that has it, where pages are small.
    pub page: String,
}

/// A place in the manual.
#[derive(Debug, Clone, Serialize)]
pub struct Place {
    /// `5.8.2.1 Object 6040h: Controlword`.
    pub text: String,
    /// Where links lead.
    pub anchor: String,
    /// Page that has it, where pages are small.
    pub page: String,
}

/// Lines of one kind of use.
#[derive(Debug, Clone, Serialize)]
pub struct Used {
    /// `pdos`, `aliases`, `constraints`, `conditions`, `errors`, `reactions`, `machines`.
    pub kind: &'static str,
    /// Heading.
    pub title: String,
    /// Lines.
    pub lines: Vec<Cell>,
}
