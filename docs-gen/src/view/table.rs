//! Tables: columns, and rows of cells.

use serde::Serialize;

use crate::view::{
    AxisPicture, BitPicture, Cell, FlowPicture, HysteresisPicture, Ladder, LongList, MachinePicture,
    TimingPicture,
};

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
