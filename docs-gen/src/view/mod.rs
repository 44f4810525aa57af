//! What templates see. [`Context`] is the whole of it; its format is described in `docs/book/formats/templates.md`.
//!
//! A table is data: columns, and rows of cells. A template only decides how a table looks, so that every format shows the same.

pub(crate) mod cell;
mod foreign;
pub(crate) mod long_list;
mod pictures;
pub(crate) mod workbench;

use std::collections::BTreeMap;

use serde::Serialize;

pub use pictures::{
    AxisMarkPicture, AxisPicture, AxisSpanPicture, BitBox, BitPicture, BitPictureRow, FlowArrow, FlowBox,
    FlowPicture, HysteresisPicture, Ladder, MachineLine, MachinePicture, MachineState, PictureLine,
    PictureLink, PictureText, Rung, SwitchPicture, TimingArrow, TimingLevel, TimingMark, TimingPicture,
    TimingSignal,
};

pub use crate::view::long_list::LongList;
pub use crate::view::workbench::{
    Whole, WorkEntry, WorkField, WorkFrame, WorkLimit, WorkMachine, WorkType, WorkValue, Workbench,
};

use crate::options::{Origin, Siblings};

/// Version of the format; raised when a template would have to change.
pub(crate) const FORMAT: u32 = 2;

/// Everything that a document can show.
#[derive(Debug, Clone, Serialize)]
pub struct Context {
    /// Version of this format: 2.
    pub format: u32,
    /// Code of the language.
    pub language: String,
    /// Fixed words by name, in that language.
    pub words: BTreeMap<&'static str, &'static str>,
    /// Phrases that a search takes for one another.
    pub synonyms: Vec<Vec<&'static str>>,
    /// Whether a printed manual shows where it differs from the issue that it takes the place of.
    pub errata: bool,
    /// The documents that it is printed with.
    pub siblings: Siblings,
    /// The file that the document is made from, if that is known.
    pub origin: Option<Origin>,
    /// Version of odgen.
    pub version: &'static str,
    /// The system.
    pub system: SystemView,
    /// Devices, in the order of the specification.
    pub devices: Vec<DeviceView>,
    /// Chapters of the manual with their sections and tables.
    pub chapters: Vec<Chapter>,
    /// What signs and abbreviations of the tables mean.
    pub notation: Table,
    /// Every warning with its places: of the chapters, then of the objects; nothing where there are none.
    pub warnings: Option<Table>,
    /// Tables over the whole system: error codes, aliases, units, storage, constraints, errata, index of tables.
    pub appendices: Vec<Appendix>,
    /// Number of entries of all devices, which bounds the work of templates.
    #[serde(skip)]
    pub entries: usize,
}

/// Title page.
#[derive(Debug, Clone, Serialize)]
pub struct SystemView {
    /// Title of the product or family.
    pub title: String,
    /// What the manual is about, below its title; may be empty.
    pub subtitle: Cell,
    /// Maker.
    pub vendor: String,
    /// The maker's address, in lines; may be empty.
    pub address: Vec<Cell>,
    /// The maker's logo, as an address that has it in itself (`data:`); may be empty.
    pub logo: String,
    /// Title and edition of the printed manual, or nothing.
    pub source: String,
    /// What the manual is.
    pub about: Cell,
    /// Issue that the specification holds, or nothing.
    pub revision: String,
    /// Its date, or nothing.
    pub date: String,
}

/// A chapter; it becomes a page of its own where pages are small.
#[derive(Debug, Clone, Serialize)]
pub struct Chapter {
    /// Number, as printed; may be empty.
    pub number: String,
    /// Heading.
    pub title: Cell,
    /// Name of its page.
    pub page: String,
    /// The chapter itself and the sections below it, in order.
    pub sections: Vec<Section>,
    /// That its texts are in another language, as a sentence; empty where all are in that of the document.
    pub untranslated: String,
}

/// A chapter or section.
#[derive(Debug, Clone, Serialize)]
pub struct Section {
    /// Number, as printed; may be empty.
    pub number: String,
    /// Heading.
    pub title: Cell,
    /// Where links lead.
    pub anchor: String,
    /// 1 for a chapter, 2 for `4.1`, and so on.
    pub level: usize,
    /// Tables in it.
    pub tables: Vec<Table>,
    /// What it contains, in order.
    pub content: Vec<Content>,
}

/// A table or a text of a section.
#[derive(Debug, Clone, Serialize)]
pub struct Content {
    /// `table`, `text`, `note`, `warning`, `steps`, `list`, `formula` or `gap`.
    pub kind: &'static str,
    /// Position of the table in the section's tables.
    pub table: Option<usize>,
    /// Paragraphs, formulas or the items of a list.
    pub items: Vec<Cell>,
    /// Where links to a warning lead; empty for anything else.
    pub anchor: String,
    /// The objects whose own warnings it says.
    pub objects: Vec<ObjectName>,
}

/// A table, or several grids under one caption.
#[derive(Debug, Clone, Serialize)]
pub struct Table {
    /// Where links lead: `table-19`.
    pub anchor: String,
    /// Number, as printed.
    pub number: Option<u16>,
    /// Caption; may be empty.
    pub title: Cell,
    /// Number and caption of its picture, where the manual numbers it.
    pub figure: Option<FigureView>,
    /// More about what it shows; may be empty.
    pub about: Cell,
    /// What fills it: `overview`, `objects`, `bits`, `values`, `errors`, `reactions`, `states`, `transitions`, `commands`,
    /// `ladder`, `timing`, `hysteresis`, `flow`, `axis`, `pdos`, `rows`, `glossary`, `history`, or the name of an appendix.
    pub kind: &'static str,
    /// Its grids.
    pub grids: Vec<Grid>,
    /// The thresholds of a `ladder`, to be drawn.
    pub ladder: Option<Ladder>,
    /// Errata about it as a whole.
    pub errata: Vec<Mark>,
}

/// A mark of an erratum, at the fact that it is about.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Mark {
    /// Number of the erratum.
    pub number: usize,
    /// What kind of fact.
    pub kind: &'static str,
    /// Key of the column that has the fact; empty where none has it.
    pub column: &'static str,
}

/// A numbered figure.
#[derive(Debug, Clone, Serialize)]
pub struct FigureView {
    /// Number, as printed.
    pub number: u16,
    /// Where links lead: `figure-13`; the anchor of the table, where both are under one caption.
    pub anchor: String,
    /// Caption.
    pub title: Cell,
}

/// Columns and rows.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Grid {
    /// The object whose entries these are.
    pub object: Option<ObjectHead>,
    /// Columns.
    pub columns: Vec<Column>,
    /// Rows; each has a cell for every column.
    pub rows: LongList<Row>,
    /// A picture of the bits.
    pub bits: Option<BitPicture>,
    /// A picture of the state machine whose states these are.
    pub machine: Option<MachinePicture>,
    /// A picture of the sequence of events whose steps these are.
    pub timing: Option<TimingPicture>,
    /// A picture of the switches whose values these are.
    pub hysteresis: Option<HysteresisPicture>,
    /// A picture of the diagram whose blocks these are.
    pub flow: Option<FlowPicture>,
    /// A picture of the axis whose marks and spans these are.
    pub axis: Option<AxisPicture>,
}

/// Index, name and shape above the entries of an object.
#[derive(Debug, Clone, Serialize)]
pub struct ObjectHead {
    /// `6040h`.
    pub index: String,
    /// Where links lead: `6040`; empty where the object was shown before.
    pub anchor: String,
    /// Name.
    pub name: String,
    /// `VAR`, `ARRAY`, `RECORD`, `DOMAIN`.
    pub kind: &'static str,
    /// Meaning.
    pub about: Cell,
    /// Danger that comes from it as a whole.
    pub warning: Cell,
    /// Key of the device, where devices have different objects of this index.
    pub device: String,
}

/// A column.
#[derive(Debug, Clone, Serialize)]
pub struct Column {
    /// What it holds, the same in every language: `index`, `access`, …
    pub key: &'static str,
    /// Its title.
    pub title: String,
    /// How its cells are aligned.
    pub align: Align,
}

/// How the cells of a column are aligned.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Align {
    /// Texts.
    Left,
    /// Numbers.
    Right,
    /// Marks.
    Center,
}

/// A row.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Row {
    /// Where links lead: `3020.5`; may be empty.
    pub anchor: String,
    /// Where links to the same lead that name it otherwise: the bit of another entry of this type.
    pub also: Vec<String>,
    /// Cells, one for each column.
    pub cells: Vec<Cell>,
    /// Whether an entry of the row is stored; such rows are shaded.
    pub stored: bool,
    /// Errata about the row.
    pub errata: Vec<Mark>,
}

/// The contents of a cell, or another piece of text. A document has very many, most of them one plain text.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Cell {
    /// The text alone; lines are separated by line breaks.
    pub text: String,
    /// What its parts are; nothing where it is one plain text, or empty.
    pub(crate) spans: Vec<Span>,
    /// Who says it.
    pub stated: Stated,
}

/// Who says what is in a [`Cell`].
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Stated {
    /// The maker: the printed manual, or what follows from it.
    #[default]
    Manual,
    /// A standard, and the maker does not.
    Standard,
    /// Neither: it is assumed.
    Assumed,
}

/// What a part of a [`Cell`] is, and where it ends in the text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Span {
    pub end: usize,
    pub kind: PartKind,
    pub anchor: Box<str>,
    pub page: Box<str>,
    pub language: Box<str>,
}

/// A part of a [`Cell`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Part<'a> {
    /// What it is.
    pub kind: PartKind,
    /// The text; empty for a break.
    pub text: &'a str,
    /// Anchor that a link leads to.
    pub anchor: &'a str,
    /// Page that has the anchor, where pages are small.
    pub page: &'a str,
    /// Language of the text, where it is not that of the document.
    pub language: &'a str,
}

/// What a [`Part`] is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum PartKind {
    /// Running text.
    Text,
    /// Emphasized text.
    Strong,
    /// To be typed or read as it is.
    Code,
    /// A link.
    Link,
    /// A new line.
    Break,
}

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

/// Words by which readers look for an object, an entry, a bit, a value or an error code, in all languages.
#[derive(Debug, Clone, Serialize)]
pub struct SearchWords {
    /// Where links to it lead: `6064`, `6041.b7`, `error-8611`.
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
    /// Lower-case text that a search looks at.
    pub search: String,
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

/// An erratum.
#[derive(Debug, Clone, Serialize)]
pub struct ErratumView {
    /// Its number, in the order of the specification.
    pub number: usize,
    /// What kind of fact.
    pub kind: String,
    /// Where the manual prints it.
    pub place: Cell,
    /// What it prints.
    pub prints: Cell,
    /// What the specification says.
    pub reads: Cell,
    /// Why.
    pub because: Cell,
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

/// Tables over the whole system.
#[derive(Debug, Clone, Serialize)]
pub struct Appendix {
    /// `errors`, `aliases`, `units`, `storage`, `constraints`, `errata`, `tables`; also the name of its page.
    pub page: &'static str,
    /// Its letter, the same on every page.
    pub letter: String,
    /// Heading, with the letter.
    pub title: String,
    /// What it shows.
    pub intro: Cell,
    /// Its tables.
    pub tables: Vec<Table>,
    /// That its texts are in another language, as a sentence; empty where all are in that of the document.
    pub untranslated: String,
}
