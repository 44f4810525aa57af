//! The picture of switches with a hysteresis: below one another over one axis, each as the loop that its state runs through.
//!
//! The upper line is on, the lower one off. Between the value at which a switch goes on and that at which it goes off again
//! lies a band, in which it stays what it was; arrows at its edges say which way the state changes there.

use od_spec::model::{Ratio, SwitchPoints, SwitchSide};

use crate::diagrams::timing::room;
use crate::view::{Align, HysteresisPicture, PictureText, SwitchPicture, Target};

/// Width between the lowest and the highest value.
const SPAN: u32 = 360;
/// From a switch to the one below.
const PITCH: u32 = 74;
/// From the top of a switch to its upper and its lower line.
const LINES: (u32, u32) = (16, 44);

/// A switch with the texts of its language.
pub(crate) struct DrawnSwitch {
    /// What goes on.
    pub what: String,
    /// On which side of the first value it does.
    pub side: SwitchSide,
    /// The values.
    pub points: SwitchPoints,
    /// The value at which it goes on, with its unit.
    pub on_value: String,
    /// The value at which it goes off again, with its unit.
    pub off_value: String,
    /// Where the entry with the first value is described.
    pub on_target: Option<Target>,
    /// Where the entry with the second one is described.
    pub off_target: Option<Target>,
    /// That it is on, in a word.
    pub on: &'static str,
    /// That it is off, in a word.
    pub off: &'static str,
}

/// Where everything lies.
struct Scale {
    lowest: Ratio,
    range: Ratio,
    /// Where the lines begin, the lowest value lies, and the lines end.
    from: u32,
    start: u32,
    to: u32,
}

impl Scale {
    fn of(switches: &[DrawnSwitch]) -> Option<Self> {
        let mut values = switches.iter().flat_map(|one| [one.points.on, one.points.off]);
        let first = values.next()?;
        let (mut lowest, mut highest) = (first, first);
        for value in values {
            if value.compare(lowest)?.is_lt() {
                lowest = value;
            }
            if value.compare(highest)?.is_gt() {
                highest = value;
            }
        }
        let texts = switches.iter().flat_map(|one| [&one.on_value, &one.off_value]);
        // A value is next to its band, and a word of a state beyond it.
        let beside = texts.map(|text| room(text)).max()? + 40;
        let from = switches.iter().map(|one| room(&one.what)).max()? + 16;
        let start = from + beside;
        Some(Self { lowest, range: highest.checked_sub(lowest)?, from, start, to: start + SPAN + beside })
    }

    fn x(&self, value: Ratio) -> Option<u32> {
        let share = value.checked_sub(self.lowest)?.checked_div(self.range)?;
        let along = share.checked_mul(Ratio::whole(i128::from(SPAN)))?;
        Some(self.start + u32::try_from(along.floor()).ok()?)
    }
}

/// The picture; nothing where the values are too large to be computed exactly.
pub(crate) fn picture(switches: &[DrawnSwitch]) -> Option<HysteresisPicture> {
    let scale = Scale::of(switches)?;
    let drawn: Option<Vec<SwitchPicture>> =
        (0..).zip(switches).map(|(row, one)| switch(row, one, &scale)).collect();
    let drawn = drawn?;
    let axis = u32::try_from(drawn.len()).ok()? * PITCH + 4;
    Some(HysteresisPicture {
        width: scale.to + 12,
        height: axis + 8,
        axis: format!("M{} {axis}H{}", scale.from, scale.to),
        tip: format!("M{} {axis}l-8 -4v8z", scale.to + 8),
        switches: drawn,
    })
}

fn switch(row: u32, one: &DrawnSwitch, scale: &Scale) -> Option<SwitchPicture> {
    let (on, off) = (row * PITCH + LINES.0, row * PITCH + LINES.1);
    // What holds at low and at high values.
    let ((low, low_word), (high, high_word)) = match one.side {
        SwitchSide::Below => ((on, one.on), (off, one.off)),
        SwitchSide::Above => ((off, one.off), (on, one.on)),
    };
    // Where the state changes while the value falls, and while it rises.
    let ((falling, falling_text, falls_to), (rising, rising_text, rises_to)) = {
        let (goes_on, goes_off) = (scale.x(one.points.on)?, scale.x(one.points.off)?);
        match one.side {
            SwitchSide::Below => {
                ((goes_on, &one.on_value, &one.on_target), (goes_off, &one.off_value, &one.off_target))
            }
            SwitchSide::Above => {
                ((goes_off, &one.off_value, &one.off_target), (goes_on, &one.on_value, &one.on_target))
            }
        }
    };
    let (from, to, middle) = (scale.from, scale.to, u32::midpoint(on, off));
    let tip = |x: u32, target: u32| {
        if target > middle {
            format!("M{x} {}l-4 -8h8z", middle + 4)
        } else {
            format!("M{x} {}l-4 8h8z", middle - 4)
        }
    };
    let text = |text: &str, x: u32, y: u32, align: Align| PictureText {
        text: text.to_owned(),
        x,
        y,
        align,
        target: None,
    };
    Some(SwitchPicture {
        name: one.what.clone(),
        y: middle + 4,
        band: format!("M{falling} {on}H{rising}V{off}H{falling}Z"),
        line: format!("M{from} {low}H{rising}V{high}M{to} {high}H{falling}V{low}"),
        tips: vec![tip(rising, high), tip(falling, low)],
        texts: vec![
            text(low_word, from + 2, low - 4, Align::Left),
            text(high_word, to - 2, high - 4, Align::Right),
            PictureText {
                target: falls_to.clone(),
                ..text(falling_text, falling - 3, off + 14, Align::Right)
            },
            PictureText { target: rises_to.clone(), ..text(rising_text, rising + 3, off + 14, Align::Left) },
        ],
    })
}
