//! The picture of a sequence of events: signals below one another, each a wave over numbered steps.
//!
//! A bit that is 0 or 1 is a line below or above; any other level is a band with its text. An arrow leads from what changes at
//! a step to what changes at the step that answers it: between the rows where these are two, else above the row.

use std::cmp::Ordering;

use od_spec::model::{Signal, Timing};

use crate::view::{Target, TimingArrow, TimingLevel, TimingMark, TimingPicture, TimingSignal};

/// Width of a character at most.
const CHARACTER: u32 = 7;
/// Characters beyond this are not given room: such a picture is not read.
const LONGEST: usize = 10_000;
/// Least width between two steps.
const INTERVAL: u32 = 56;
/// Height of a wave.
const WAVE: u32 = 24;
/// From a wave to the one below.
const PITCH: u32 = 52;
/// Above the first wave: the numbers of steps, and room for an arrow.
const TOP: u32 = 40;
/// How far the ends of a band are pointed.
const POINT: u32 = 4;

/// A level between two steps, as it is drawn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum DrawnLevel {
    /// A bit that is 0.
    Low,
    /// A bit that is 1.
    High,
    /// A band with a text.
    Value(String),
}

impl DrawnLevel {
    /// The level in words.
    pub(crate) fn text(&self) -> &str {
        match self {
            Self::Low => "0",
            Self::High => "1",
            Self::Value(text) => text,
        }
    }
}

/// A signal with the texts of its language.
pub(crate) struct DrawnSignal {
    /// Its name; may be empty.
    pub name: String,
    /// Where it is written: `controlword, Bit 4` or `607Ah`.
    pub place: String,
    /// Where that is described.
    pub target: Option<Target>,
    /// Its levels: before the first step, then after each.
    pub levels: Vec<DrawnLevel>,
}

impl DrawnSignal {
    /// Place and name in one line.
    pub(crate) fn title(&self) -> String {
        if self.name.is_empty() { self.place.clone() } else { format!("{}: {}", self.place, self.name) }
    }
}

/// Levels that are the same, one after the other.
struct Run<'a> {
    level: &'a DrawnLevel,
    /// Position of the first.
    first: u32,
    count: u32,
}

fn runs(levels: &[DrawnLevel]) -> Vec<Run<'_>> {
    let mut runs: Vec<Run<'_>> = Vec::new();
    for (at, level) in (0..).zip(levels) {
        match runs.last_mut() {
            Some(run) if run.level == level => run.count += 1,
            _ => runs.push(Run { level, first: at, count: 1 }),
        }
    }
    runs
}

/// Room for a text.
pub(crate) fn room(text: &str) -> u32 {
    u32::try_from(text.chars().count().min(LONGEST)).unwrap_or(u32::MAX / 16) * CHARACTER
}

/// Where everything lies.
struct Scale {
    left: u32,
    interval: u32,
}

impl Scale {
    fn of(signals: &[DrawnSignal]) -> Self {
        let labels = signals.iter().flat_map(|signal| [room(&signal.name), room(&signal.place)]);
        let runs = signals.iter().flat_map(|signal| runs(&signal.levels));
        let widths = runs.map(|run| (room(run.level.text()) + 4 * POINT).div_ceil(run.count));
        Self { left: labels.max().unwrap_or(0) + 12, interval: widths.max().unwrap_or(0).max(INTERVAL) }
    }

    /// Where a step lies; 0 is where the levels before the first step begin.
    fn step(&self, step: u32) -> u32 {
        self.left + step * self.interval
    }

    /// The top of a wave.
    fn top(row: usize) -> u32 {
        TOP + u32::try_from(row).unwrap_or_default() * PITCH
    }
}

/// The picture of a sequence whose signals and events have the texts of a language.
pub(crate) fn picture(timing: &Timing, signals: Vec<DrawnSignal>, events: Vec<String>) -> TimingPicture {
    let scale = Scale::of(&signals);
    let last = u32::try_from(timing.steps.len()).unwrap_or_default();
    let marks = (1..).zip(events).map(|(number, event)| TimingMark { number, x: scale.step(number), event });
    TimingPicture {
        width: scale.step(last + 1) + 8,
        height: Scale::top(signals.len()) - PITCH + WAVE + 12,
        marks: marks.collect(),
        arrows: arrows(timing, &scale),
        signals: signals.into_iter().enumerate().map(|(row, signal)| wave(row, signal, &scale)).collect(),
    }
}

/// A signal as lines and bands.
fn wave(row: usize, signal: DrawnSignal, scale: &Scale) -> TimingSignal {
    let top = Scale::top(row);
    let (middle, bottom) = (top + WAVE / 2, top + WAVE);
    let (mut line, mut bands, mut levels) = (Vec::new(), Vec::new(), Vec::new());
    // The y at which the line goes on.
    let mut pen: Option<u32> = None;
    for run in runs(&signal.levels) {
        let (from, to) = (scale.step(run.first), scale.step(run.first + run.count));
        let y = match run.level {
            DrawnLevel::Low => bottom,
            DrawnLevel::High => top,
            DrawnLevel::Value(text) => {
                if pen.is_some_and(|pen| pen != middle) {
                    line.push(format!("V{middle}"));
                }
                let (left, right) = (from + POINT, to - POINT);
                bands.push(format!(
                    "M{from} {middle}L{left} {top}H{right}L{to} {middle}L{right} {bottom}H{left}Z"
                ));
                levels.push(TimingLevel { text: text.clone(), x: u32::midpoint(from, to), y: middle + 4 });
                pen = None;
                continue;
            }
        };
        line.push(match pen {
            Some(_) => format!("V{y}H{to}"),
            None if run.first > 0 => format!("M{from} {middle}V{y}H{to}"),
            None => format!("M{from} {y}H{to}"),
        });
        pen = Some(y);
        // One for each step: a line has no other text.
        levels.extend((run.first..run.first + run.count).map(|at| TimingLevel {
            text: run.level.text().to_owned(),
            x: scale.step(at) + 12,
            y: middle + 4,
        }));
    }
    TimingSignal {
        name: signal.name,
        place: signal.place,
        target: signal.target,
        y: middle,
        line: line.concat(),
        bands,
        levels,
    }
}

/// An arrow for each pair of signals that change at a step and at its cause.
fn arrows(timing: &Timing, scale: &Scale) -> Vec<TimingArrow> {
    let changing = |step: usize| {
        let rows = timing.signals.iter().enumerate();
        rows.filter(move |(_, signal): &(usize, &Signal)| signal.changes_at(step)).map(|(row, _)| row)
    };
    let x = |step: usize| scale.step(u32::try_from(step).unwrap_or_default());
    let mut arrows = Vec::new();
    for (before, step) in timing.steps.iter().enumerate() {
        let number = before + 1;
        let Some(cause) = step.cause else { continue };
        for (from, to) in changing(cause).flat_map(|from| changing(number).map(move |to| (from, to))) {
            arrows.push(arrow((x(cause), from), (x(number), to)));
        }
    }
    arrows
}

/// An arrow from a change to a change; each is the x of its step and its row.
fn arrow((from_x, from): (u32, usize), (to_x, to): (u32, usize)) -> TimingArrow {
    let (from_top, to_top) = (Scale::top(from), Scale::top(to));
    // Where it begins, where it turns, where its tip begins and ends.
    let (start, turn, neck, end, tip) = match from.cmp(&to) {
        Ordering::Less => {
            let turn = u32::midpoint(from_top + WAVE, to_top);
            (from_top + WAVE, turn, to_top - 7, to_top - 1, "l-4 -7h8z")
        }
        Ordering::Equal => (from_top - 1, from_top - 18, to_top - 7, to_top - 1, "l-4 -7h8z"),
        Ordering::Greater => {
            let bottom = to_top + WAVE;
            (from_top, u32::midpoint(from_top, bottom), bottom + 7, bottom + 1, "l-4 7h8z")
        }
    };
    TimingArrow {
        path: format!("M{from_x} {start}C{from_x} {turn} {to_x} {turn} {to_x} {neck}"),
        tip: format!("M{to_x} {end}{tip}"),
    }
}
