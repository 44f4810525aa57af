//! What templates see. [`Context`] is the whole of it; its format is described in `docs/book/formats/templates.md`.
//!
//! A table is data: columns, and rows of cells. A template only decides how a table looks, so that every format shows the same.

pub(crate) mod cell;
mod device;
mod foreign;
pub(crate) mod long_list;
mod manual;
mod object;
mod pictures;
mod table;
pub(crate) mod workbench;

use std::collections::BTreeMap;

use serde::Serialize;

pub use cell::{Cell, Part, PartKind, Stated};
pub use device::{DeviceView, Filters, GroupView, PdoField, PdoView, SearchWords};
pub use long_list::LongList;
pub use manual::{Appendix, Chapter, Content, ErratumView, Section, SystemView};
pub use object::{EntryView, ObjectName, ObjectView, Place, Target, Used};
pub use pictures::{
    AxisMarkPicture, AxisPicture, AxisSpanPicture, BitBox, BitPicture, BitPictureRow, FlowArrow, FlowBox,
    FlowPicture, HysteresisPicture, Ladder, MachineLine, MachinePicture, MachineState, PictureLine,
    PictureLink, PictureText, Rung, SwitchPicture, TimingArrow, TimingLevel, TimingMark, TimingPicture,
    TimingSignal,
};
pub use table::{Align, Column, FigureView, Grid, Mark, ObjectHead, Row, Table};
pub use workbench::{
    Whole, WorkEntry, WorkField, WorkFrame, WorkLimit, WorkMachine, WorkType, WorkValue, Workbench,
};

use crate::options::{Origin, Siblings};

/// Version of the format; raised when a template would have to change.
pub(crate) const FORMAT: u32 = 3;

/// Everything that a document can show.
#[derive(Debug, Clone, Serialize)]
pub struct Context {
    /// Version of this format: 3.
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
    /// Words by which readers look for chapters and sections.
    pub search: Vec<SearchWords>,
    /// Tables over the whole system: error codes, aliases, units, storage, constraints, errata, index of tables.
    pub appendices: Vec<Appendix>,
    /// Number of entries of all devices, which bounds the work of templates.
    #[serde(skip)]
    pub entries: usize,
}
