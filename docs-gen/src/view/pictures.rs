//! What templates draw: registers, state machines, signals, thresholds, blocks and axes, in the coordinates of their pictures.

use serde::Serialize;

use super::{Align, Target};

/// A register, to be drawn.
#[derive(Debug, Clone, Serialize)]
pub struct BitPicture {
    /// Name of the type.
    pub name: String,
    /// Rows of up to 16 bits, the highest first.
    pub rows: Vec<BitPictureRow>,
}

/// Up to 16 bits.
#[derive(Debug, Clone, Serialize)]
pub struct BitPictureRow {
    /// Highest bit.
    pub last: u8,
    /// Lowest bit.
    pub first: u8,
    /// Fields, the highest first.
    pub fields: Vec<BitBox>,
}

/// A field, or the part of it that lies in one row.
#[derive(Debug, Clone, Serialize)]
pub struct BitBox {
    /// Highest bit in this row.
    pub last: u8,
    /// Lowest bit in this row.
    pub first: u8,
    /// Bits.
    pub width: u8,
    /// Name; empty for bits without use.
    pub name: String,
    /// `used`, `reserved` or `unused`.
    pub usage: &'static str,
}

/// A state machine, to be drawn; all lengths are in the units of the picture.
#[derive(Debug, Clone, Serialize)]
pub struct MachinePicture {
    /// Width of the picture.
    pub width: u32,
    /// Height of the picture.
    pub height: u32,
    /// Where the entry that shows the state is described.
    pub status: Option<Target>,
    /// Its states, from the top.
    pub states: Vec<MachineState>,
    /// Its transitions.
    pub lines: Vec<MachineLine>,
}

/// A state in a picture.
#[derive(Debug, Clone, Serialize)]
pub struct MachineState {
    /// Name.
    pub name: String,
    /// Bits that show it.
    pub pattern: String,
    /// Left edge.
    pub x: u32,
    /// Upper edge.
    pub y: u32,
    /// Width.
    pub width: u32,
    /// Height.
    pub height: u32,
}

/// A transition in a picture.
#[derive(Debug, Clone, Serialize)]
pub struct MachineLine {
    /// Its number.
    pub number: u8,
    /// The code of the command that takes it, on the way down; may be empty.
    pub code: String,
    /// The line, as SVG writes it.
    pub path: String,
    /// The tip of its arrow, as SVG writes it.
    pub tip: String,
    /// Where the start is, for a transition from there.
    pub start: Option<(u32, u32)>,
    /// Where the number is.
    pub label: (u32, u32),
}

/// A sequence of events, to be drawn; all lengths are in the units of the picture.
#[derive(Debug, Clone, Serialize)]
pub struct TimingPicture {
    /// Width of the picture.
    pub width: u32,
    /// Height of the picture.
    pub height: u32,
    /// Its signals, from the top.
    pub signals: Vec<TimingSignal>,
    /// Its steps, in order.
    pub marks: Vec<TimingMark>,
    /// From causes to effects.
    pub arrows: Vec<TimingArrow>,
}

/// A signal in a picture.
#[derive(Debug, Clone, Serialize)]
pub struct TimingSignal {
    /// Name; may be empty.
    pub name: String,
    /// Where it is: `controlword, Bit 4` or `607Ah`.
    pub place: String,
    /// Where its entry or bit is described, if it is one alone.
    pub target: Option<Target>,
    /// The middle of its wave.
    pub y: u32,
    /// Where it is 0 or 1, as SVG writes it; may be empty.
    pub line: String,
    /// Where it has another level, as SVG writes it.
    pub bands: Vec<String>,
    /// Texts of its levels.
    pub levels: Vec<TimingLevel>,
}

/// The text of a level in a picture.
#[derive(Debug, Clone, Serialize)]
pub struct TimingLevel {
    /// The text.
    pub text: String,
    /// Its middle.
    pub x: u32,
    /// Its lower edge.
    pub y: u32,
}

/// A step in a picture.
#[derive(Debug, Clone, Serialize)]
pub struct TimingMark {
    /// Its number.
    pub number: u32,
    /// Where it lies.
    pub x: u32,
    /// What happens.
    pub event: String,
}

/// An arrow in a picture.
#[derive(Debug, Clone, Serialize)]
pub struct TimingArrow {
    /// The line, as SVG writes it.
    pub path: String,
    /// The tip, as SVG writes it.
    pub tip: String,
}

/// Switches with a hysteresis, to be drawn; all lengths are in the units of the picture.
#[derive(Debug, Clone, Serialize)]
pub struct HysteresisPicture {
    /// Width of the picture.
    pub width: u32,
    /// Height of the picture.
    pub height: u32,
    /// The axis of the values, as SVG writes it.
    pub axis: String,
    /// The tip of the axis, as SVG writes it.
    pub tip: String,
    /// The switches, from the top.
    pub switches: Vec<SwitchPicture>,
}

/// A switch in a picture.
#[derive(Debug, Clone, Serialize)]
pub struct SwitchPicture {
    /// What goes on.
    pub name: String,
    /// Where that is described.
    pub y: u32,
    /// The values at which it stays what it was, as SVG writes them.
    pub band: String,
    /// On and off, as SVG writes it.
    pub line: String,
    /// Which way the state changes at the edges of the band, as SVG writes it.
    pub tips: Vec<String>,
    /// On and off in words, and the values at the edges of the band.
    pub texts: Vec<PictureText>,
}

/// A text in a picture.
#[derive(Debug, Clone, Serialize)]
pub struct PictureText {
    /// The text.
    pub text: String,
    /// Where it begins or ends.
    pub x: u32,
    /// Its lower edge.
    pub y: u32,
    /// Whether it begins there (`left`) or ends there (`right`).
    pub align: Align,
    /// Where the entry that states it is described, if there is one.
    pub target: Option<Target>,
}

/// A block diagram, to be drawn; all lengths are in the units of the picture.
#[derive(Debug, Clone, Default, Serialize)]
pub struct FlowPicture {
    /// Width of the picture.
    pub width: u32,
    /// Height of the picture.
    pub height: u32,
    /// Its blocks, in order.
    pub boxes: Vec<FlowBox>,
    /// What goes from block to block.
    pub arrows: Vec<FlowArrow>,
    /// Where arrows of one block part.
    pub dots: Vec<(u32, u32)>,
}

/// A block in a picture.
#[derive(Debug, Clone, Serialize)]
pub struct FlowBox {
    /// What it is, in one line.
    pub name: String,
    /// Left edge.
    pub x: u32,
    /// Upper edge.
    pub y: u32,
    /// Width.
    pub width: u32,
    /// Height.
    pub height: u32,
    /// Its name, entries and bits.
    pub lines: Vec<PictureLine>,
}

/// A line of a text in a picture, around its middle.
#[derive(Debug, Clone, Serialize)]
pub struct PictureLine {
    /// The text.
    pub text: String,
    /// Whether it belongs to the name.
    pub is_name: bool,
    /// The link that begins with this line.
    pub link: Option<PictureLink>,
    /// Its middle.
    pub x: u32,
    /// Its lower edge.
    pub y: u32,
}

/// A link over lines of a text in a picture.
#[derive(Debug, Clone, Serialize)]
pub struct PictureLink {
    /// Where it leads.
    pub target: Target,
    /// How many lines it has.
    pub lines: usize,
    /// Left edge of what can be touched.
    pub x: u32,
    /// Upper edge.
    pub y: u32,
    /// Width.
    pub width: u32,
    /// Height.
    pub height: u32,
}

/// An arrow in a block diagram.
#[derive(Debug, Clone, Serialize)]
pub struct FlowArrow {
    /// Position of the block that it leaves.
    pub from: usize,
    /// Position of the block to which it leads.
    pub to: usize,
    /// The line, as SVG writes it.
    pub path: String,
    /// The tip, as SVG writes it.
    pub tip: String,
    /// What goes this way.
    pub label: Option<PictureText>,
}

/// An axis with marks and spans, to be drawn; all lengths are in the units of the picture.
#[derive(Debug, Clone, Default, Serialize)]
pub struct AxisPicture {
    /// Width of the picture.
    pub width: u32,
    /// Height of the picture.
    pub height: u32,
    /// The axis, as SVG writes it.
    pub axis: String,
    /// The tip of the axis, as SVG writes it.
    pub tip: String,
    /// The marks, from the left.
    pub marks: Vec<AxisMarkPicture>,
    /// The spans.
    pub spans: Vec<AxisSpanPicture>,
}

/// A mark in a picture.
#[derive(Debug, Clone, Serialize)]
pub struct AxisMarkPicture {
    /// The mark on the axis, as SVG writes it.
    pub line: String,
    /// From there to the spans that begin or end there, as SVG writes it; may be empty.
    pub guide: String,
    /// Its name and entries.
    pub lines: Vec<PictureLine>,
}

/// A span in a picture.
#[derive(Debug, Clone, Serialize)]
pub struct AxisSpanPicture {
    /// The line, as SVG writes it.
    pub path: String,
    /// The tip, as SVG writes it.
    pub tip: String,
    /// Its name and entries.
    pub lines: Vec<PictureLine>,
}

/// Thresholds in their order.
#[derive(Debug, Clone, Serialize)]
pub struct Ladder {
    /// Symbol of the common unit.
    pub unit: String,
    /// From the lowest to the highest.
    pub rungs: Vec<Rung>,
}

/// One threshold.
#[derive(Debug, Clone, Serialize)]
pub struct Rung {
    /// Its default, with the unit.
    pub value: String,
    /// Where it lies between the lowest (0) and the highest (1000).
    pub position: u32,
    /// How it compares with the one below: `<`, `≤`; empty at the lowest.
    pub relation: &'static str,
    /// `30FAh.3`; empty for a number.
    pub entry: String,
    /// Where links lead.
    pub anchor: String,
    /// Name.
    pub name: String,
    /// Where its entry is described, if anywhere.
    pub target: Option<Target>,
}
