//! The picture of an axis: marks on a line, and below it the spans, each an arrow with its name.
//!
//! Marks are equally far from each other: the picture says what is measured from where, and not how long it is. Spans
//! that do not meet share a row.

use od_spec::model::AxisReach;

use crate::diagrams::label::{DrawnLine, LINE, Lines, height_of, label, length, placed};
use crate::view::{AxisMarkPicture, AxisPicture, AxisSpanPicture};

/// A wider picture is tried with narrower texts.
const WIDEST: i64 = 700;
/// Characters of a line.
const LIMITS: [usize; 4] = [28, 22, 17, 12];
/// Least width between two marks, and next to the outermost ones.
const INTERVAL: i64 = 84;
/// Between two texts next to each other.
const APART: i64 = 14;
/// Half the height of a mark.
const TICK: i64 = 6;
/// Between the axis and the first row, and between two rows.
const ROW: i64 = 14;

/// A mark with the texts of its language.
pub(crate) struct DrawnMark {
    /// What is there.
    pub name: String,
    /// Its entries.
    pub lines: Vec<DrawnLine>,
}

/// A span with the texts of its language.
pub(crate) struct DrawnSpan {
    /// What it is.
    pub name: String,
    /// Its entries.
    pub lines: Vec<DrawnLine>,
    /// Where it lies.
    pub reach: AxisReach,
}

/// The lines of a text, and its width.
type Label = (Vec<Lines>, i64);

/// Where marks lie.
struct Scale {
    first: i64,
    interval: i64,
    end: i64,
}

impl Scale {
    fn of(marks: &[Label], spans: &[(AxisReach, Label)]) -> Self {
        let half = |mark: Option<&Label>| mark.map_or(0, |(_, width)| width / 2 + 4);
        let room = |wanted: fn(AxisReach) -> bool| {
            let widths =
                spans.iter().filter(|(reach, _)| wanted(*reach)).map(|(_, (_, width))| width + APART);
            widths.max().unwrap_or(INTERVAL / 2)
        };
        let before = room(|reach| matches!(reach, AxisReach::Below(_))).max(half(marks.first()));
        let behind = room(|reach| matches!(reach, AxisReach::Above(_))).max(half(marks.last()));
        let beside = marks.iter().map(|(_, width)| width + APART);
        let along = spans.iter().filter_map(|(reach, (_, width))| match reach {
            AxisReach::Between(from, to) => {
                let count = i64::try_from(from.abs_diff(*to)).ok()?;
                Some((width + APART + count - 1) / count)
            }
            AxisReach::Below(_) | AxisReach::Above(_) => None,
        });
        let interval = beside.chain(along).max().unwrap_or(0).max(INTERVAL);
        let last = before + interval * (i64::try_from(marks.len()).unwrap_or(1) - 1);
        Self { first: before, interval, end: last + behind }
    }

    fn x(&self, mark: usize) -> i64 {
        self.first + self.interval * i64::try_from(mark).unwrap_or_default()
    }

    /// Where an arrow begins, and where its tip is.
    fn ends(&self, reach: AxisReach) -> (i64, i64) {
        match reach {
            AxisReach::Between(from, to) => (self.x(from), self.x(to)),
            AxisReach::Below(mark) => (self.x(mark), 2),
            AxisReach::Above(mark) => (self.x(mark), self.end - 2),
        }
    }
}

/// The marks at which a span begins or ends.
fn touches(reach: AxisReach, mark: usize) -> bool {
    match reach {
        AxisReach::Between(from, to) => from == mark || to == mark,
        AxisReach::Below(one) | AxisReach::Above(one) => one == mark,
    }
}

/// The row of each span: the first in which it meets no other.
fn rows(spans: &[(AxisReach, Label)], scale: &Scale) -> Vec<usize> {
    let mut rows: Vec<usize> = Vec::new();
    let part = |reach: AxisReach| {
        let (from, to) = scale.ends(reach);
        (from.min(to), from.max(to))
    };
    for (reach, _) in spans {
        let (begin, end) = part(*reach);
        let is_free = |row: &usize| {
            let here = spans.iter().zip(&rows).filter(|(_, other)| *other == row);
            here.map(|((other, _), _)| part(*other))
                .all(|(other_begin, other_end)| end <= other_begin || other_end <= begin)
        };
        rows.push((0..spans.len()).find(is_free).unwrap_or_default());
    }
    rows
}

/// The picture of an axis whose texts are those of a language.
pub(crate) fn picture(marks: &[DrawnMark], spans: &[DrawnSpan]) -> AxisPicture {
    let mut drawn = AxisPicture::default();
    for limit in LIMITS {
        drawn = with_lines_of(limit, marks, spans);
        if i64::from(drawn.width) <= WIDEST {
            break;
        }
    }
    drawn
}

fn with_lines_of(limit: usize, marks: &[DrawnMark], spans: &[DrawnSpan]) -> AxisPicture {
    let marks: Vec<Label> = marks.iter().map(|mark| label(&mark.name, &mark.lines, limit)).collect();
    let spans: Vec<(AxisReach, Label)> =
        spans.iter().map(|span| (span.reach, label(&span.name, &span.lines, limit))).collect();
    let scale = Scale::of(&marks, &spans);
    let rows = rows(&spans, &scale);
    let height = |label: &Label| height_of(&label.0);
    let axis = marks.iter().map(height).max().unwrap_or_default() + TICK + 8;
    // Where the arrows of each row lie, below the texts of the row.
    let (mut arrows, mut bottom) = (Vec::new(), axis + TICK);
    for row in 0..rows.iter().max().map_or(0, |last| last + 1) {
        let here = spans.iter().zip(&rows).filter(|(_, at)| **at == row);
        bottom += ROW + here.map(|((_, label), _)| height(label)).max().unwrap_or_default();
        arrows.push(bottom);
    }
    let mark_pictures = marks.into_iter().enumerate().map(|(at, (lines, _))| {
        let x = scale.x(at);
        let deepest = spans
            .iter()
            .zip(&rows)
            .filter(|((reach, _), _)| touches(*reach, at))
            .map(|(_, row)| arrows[*row])
            .max();
        let top = axis - TICK - 6 - (height_of(&lines) - LINE);
        AxisMarkPicture {
            line: format!("M{x} {}V{}", axis - TICK, axis + TICK),
            guide: deepest
                .map_or_else(String::new, |deepest| format!("M{x} {}V{}", axis + TICK, deepest + 4)),
            lines: placed(lines, x, top),
        }
    });
    let mark_pictures = mark_pictures.collect();
    let span_pictures = spans.into_iter().zip(rows).map(|((reach, (lines, _)), row)| {
        let (from, to) = scale.ends(reach);
        let y = arrows[row];
        let top = y - 5 - (height_of(&lines) - LINE);
        AxisSpanPicture {
            path: format!("M{from} {y}H{to}"),
            tip: format!("M{to} {y}{}", if from < to { "l-8 -4v8z" } else { "l8 -4v8z" }),
            lines: placed(lines, i64::midpoint(from, to), top),
        }
    });
    AxisPicture {
        spans: span_pictures.collect(),
        width: length(scale.end),
        height: length(bottom + 10),
        axis: format!("M2 {axis}H{}", scale.end - 2),
        tip: format!("M{} {axis}l-8 -4v8z", scale.end - 2),
        marks: mark_pictures,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagrams::timing::room;
    use crate::view::PictureLine;

    fn drawn() -> AxisPicture {
        let mark = |name: &str| DrawnMark { name: name.to_owned(), lines: Vec::new() };
        let span = |name: &str, reach| DrawnSpan { name: name.to_owned(), lines: Vec::new(), reach };
        picture(
            &[mark("the lower edge of the window"), mark("target"), mark("upper edge")],
            &[
                span("window", AxisReach::Between(1, 0)),
                span("window of the position", AxisReach::Between(1, 2)),
                span("outside, and a long text about it", AxisReach::Below(0)),
                span("all of it", AxisReach::Between(0, 2)),
                span("outside", AxisReach::Above(2)),
            ],
        )
    }

    #[test]
    fn spans_lie_between_their_marks() {
        let picture = drawn();
        let x = |at: usize| picture.marks[at].line.split(' ').next().unwrap()[1..].parse::<u32>().unwrap();
        let ends: Vec<(u32, u32)> = picture
            .spans
            .iter()
            .map(|span| {
                let (from, to) = span.path[1..].split_once('H').unwrap();
                (from.split(' ').next().unwrap().parse().unwrap(), to.parse().unwrap())
            })
            .collect();
        let end = picture.width - 2;
        assert_eq!(ends, [(x(1), x(0)), (x(1), x(2)), (x(0), 2), (x(0), x(2)), (x(2), end)]);
        // Those that do not meet share a row.
        let y = |at: usize| picture.spans[at].path.split(['H', ' ']).nth(1).unwrap().to_owned();
        assert!(y(0) == y(1) && y(0) == y(2) && y(0) == y(4) && y(0) != y(3));
        let tips: Vec<bool> = picture.spans.iter().map(|span| span.tip.contains("l-8")).collect();
        assert_eq!(tips, [false, true, false, true, true]);
    }

    #[test]
    fn texts_are_whole_inside_and_apart() {
        let picture = drawn();
        let all: Vec<&PictureLine> = picture
            .marks
            .iter()
            .flat_map(|mark| &mark.lines)
            .chain(picture.spans.iter().flat_map(|span| &span.lines))
            .collect();
        for (at, line) in all.iter().enumerate() {
            let half = room(&line.text) / 2;
            assert!(line.x >= half && line.x + half <= picture.width, "{}", line.text);
            assert!((8..=picture.height).contains(&line.y), "{}", line.text);
            for other in &all[at + 1..] {
                let is_apart = line.y.abs_diff(other.y) >= 14
                    || line.x.abs_diff(other.x) >= half + room(&other.text) / 2;
                assert!(is_apart, "{} on {}", line.text, other.text);
            }
        }
        let texts: Vec<&str> = all.iter().map(|line| line.text.as_str()).collect();
        assert!(texts.join(" ").contains("outside, and a long text about it"), "{texts:?}");
    }
}
