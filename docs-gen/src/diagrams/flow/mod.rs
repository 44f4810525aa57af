//! The picture of a block diagram: blocks in layers, arrows between them.
//!
//! A block is in the layer after the last that it takes from; one that takes nothing is right before the first that
//! takes from it. Layers follow each other from left to right, or from top to bottom where that would be too wide. An
//! arrow over several layers has a place of its own in each of them, so that no arrow crosses a block; between two
//! layers it turns in a lane. Everything is computed along the way of the arrows (`along`) and across it; only at the
//! end these become `x` and `y`.

pub(crate) mod graph;

use crate::diagrams::flow::graph::{DrawnBlock, Graph, MARGIN};
use crate::diagrams::label::{ASCENT, LINE, Lines, height_of, label, length, placed};
use crate::diagrams::timing::room;
use crate::view::{Align, FlowArrow, FlowBox, FlowPicture, PictureText};
use od_spec::order::Arrange as _;

/// A wider picture is tried from top to bottom: on paper it would be too small to be read.
const WIDEST: i64 = 700;
/// Characters of a line in a block, from the widest blocks to the narrowest.
const LIMITS: [usize; 3] = [26, 21, 17];
/// Inside a block, at its sides and above and below its lines.
const PADDING: (i64, i64) = (8, 6);
/// Between two lanes.
const LANE: i64 = 10;
/// From a block to the first lane, and from the last one to a tip.
const BEFORE: i64 = 12;
const BEHIND: i64 = 18;

/// Which way layers follow each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Way {
    Right,
    Down,
}

/// The lines from one place to the next layer.
struct Net {
    from: usize,
    /// Where it leaves.
    start: i64,
    /// The links, and where they end.
    ends: Vec<(usize, i64)>,
    /// The lane in which it turns; none where it is straight.
    lane: Option<i64>,
}

impl Net {
    fn span(&self) -> (i64, i64) {
        let all = || self.ends.iter().map(|(_, end)| *end).chain([self.start]);
        (all().min().unwrap_or(self.start), all().max().unwrap_or(self.start))
    }

    /// Whether it has to turn nearer to its place than another net: where it leaves, the other one ends.
    fn is_before(&self, other: &Self) -> bool {
        self.from != other.from && other.ends.iter().any(|(_, end)| *end == self.start)
    }
}

/// The nets between a layer and the next, with their lanes; and how many lanes there are.
fn nets(graph: &Graph, ports: &[i64], layer: usize) -> (Vec<Net>, i64) {
    let of = |from: &usize| {
        let links = graph.links.iter().zip(ports).enumerate().filter(|(_, (link, _))| link.from == *from);
        let ends: Vec<(usize, i64)> =
            links.map(|(at, (link, port))| (at, graph.items[link.to].start + port)).collect();
        Net { from: *from, start: graph.items[*from].middle(), ends, lane: None }
    };
    let mut nets: Vec<Net> = graph.layers[layer].iter().map(of).filter(|net| !net.ends.is_empty()).collect();
    let is_bent = |net: &Net| net.ends.iter().any(|(_, end)| *end != net.start);
    let mut left: Vec<usize> = (0..nets.len()).filter(|at| is_bent(&nets[*at])).collect();
    // Of lines that go down, the lowest turns first, and of those that go up the highest: so they do not cross.
    left.arrange_by_key(|at| {
        let net = &nets[*at];
        let (first, last) = net.span();
        let is_down = last - net.start >= net.start - first;
        (!is_down, if is_down { -net.start } else { net.start })
    });
    let mut lanes = 0;
    while !left.is_empty() {
        let is_free = |at: &usize| !left.iter().any(|other| nets[*other].is_before(&nets[*at]));
        let next = left.iter().position(is_free).unwrap_or(0);
        let at = left.remove(next);
        let (first, last) = nets[at].span();
        let behind = |net: &&Net| net.is_before(&nets[at]);
        let least = nets.iter().filter(behind).filter_map(|net| net.lane).max().map_or(0, |lane| lane + 1);
        let meets = |lane: i64| {
            nets.iter().any(|net| {
                let (other_first, other_last) = net.span();
                net.lane == Some(lane) && first <= other_last + 2 && other_first <= last + 2
            })
        };
        let lane = (least..lanes).find(|lane| !meets(*lane)).unwrap_or(lanes.max(least));
        nets[at].lane = Some(lane);
        lanes = lanes.max(lane + 1);
    }
    (nets, lanes)
}

/// Everything in its place, along and across the way of the arrows.
struct Layout {
    way: Way,
    graph: Graph,
    /// Where each layer begins and ends.
    columns: Vec<(i64, i64)>,
    /// The nets after each layer, and where their first lane is.
    gaps: Vec<(Vec<Net>, i64)>,
    lines: Vec<Vec<Lines>>,
    /// Where the last block or label ends across the way.
    end: i64,
}

impl Layout {
    fn of(blocks: &[DrawnBlock], way: Way, limit: usize) -> Self {
        let labels = blocks.iter().flat_map(|block| &block.from).map(|(_, label)| i64::from(room(label)));
        let longest = labels.max().unwrap_or_default();
        let (mut lines, mut across, mut along) = (Vec::new(), Vec::new(), Vec::new());
        for block in blocks {
            let (text, width) = label(&block.name, &block.lines, limit);
            let (width, height) = ((width + 2 * PADDING.0).max(60), height_of(&text) + 2 * PADDING.1);
            let arrows = i64::try_from(block.from.len()).unwrap_or_default();
            let (size, depth) = match way {
                // A label is above the end of its arrow, or next to it.
                Way::Right => (height.max(arrows * if longest > 0 { 18 } else { 12 }), width),
                Way::Down => (width.max(arrows * if longest > 0 { longest + 14 } else { 14 }), height),
            };
            lines.push(text);
            across.push(size);
            along.push(depth);
        }
        let mut graph = Graph::of(blocks, &across);
        graph.order();
        graph.place();
        let ports = graph.straightened(graph.ports());
        let (mut columns, mut gaps) = (Vec::new(), Vec::new());
        let ends_of_items = graph.items.iter().map(|item| item.start + item.size);
        let ends_of_labels = graph.links.iter().zip(&ports).filter_map(|(link, port)| {
            let (_, label) =
                blocks.get(link.to)?.from.iter().find(|(from, _)| *from == graph.items[link.from].block)?;
            let beside = matches!(way, Way::Down).then(|| i64::from(room(label)) + 6)?;
            Some(graph.items[link.to].start + port + beside)
        });
        let end = ends_of_items.chain(ends_of_labels).max().unwrap_or_default();
        let mut at = MARGIN;
        for (number, layer) in graph.layers.iter().enumerate() {
            let depth = layer.iter().filter_map(|item| along.get(*item)).max().copied().unwrap_or_default();
            columns.push((at, at + depth));
            at += depth;
            let (nets, lanes) = nets(&graph, &ports, number);
            let label = match way {
                _ if longest == 0 => 0,
                Way::Right => longest + 4,
                Way::Down => LINE,
            };
            gaps.push((nets, at + BEFORE));
            at += BEFORE + lanes * LANE + BEHIND + label;
        }
        Self { way, graph, columns, gaps, lines, end }
    }

    /// Width and height.
    fn extent(&self) -> (i64, i64) {
        let along = self.columns.last().map_or(0, |(_, end)| *end) + MARGIN;
        self.xy(along, self.end + MARGIN)
    }

    const fn xy(&self, along: i64, across: i64) -> (i64, i64) {
        match self.way {
            Way::Right => (along, across),
            Way::Down => (across, along),
        }
    }

    fn drawn(self, blocks: &[DrawnBlock]) -> FlowPicture {
        let (width, height) = self.extent();
        let arrows = self.arrows(blocks);
        let dots = self.dots();
        let boxes = blocks.iter().zip(&self.lines).enumerate().map(|(at, (block, lines))| {
            let item = &self.graph.items[at];
            let (begin, end) = self.columns[item.layer];
            let (x, y) = self.xy(begin, item.start);
            let (width, height) = self.xy(end - begin, item.size);
            let text = height_of(lines);
            FlowBox {
                name: block.name.clone(),
                x: length(x),
                y: length(y),
                width: length(width),
                height: length(height),
                lines: placed(lines.clone(), x + width / 2, y + (height - text) / 2 + ASCENT),
            }
        });
        FlowPicture { width: length(width), height: length(height), boxes: boxes.collect(), arrows, dots }
    }

    /// An arrow for everything that a block takes.
    fn arrows(&self, blocks: &[DrawnBlock]) -> Vec<FlowArrow> {
        let mut arrows = Vec::new();
        for (to, block) in blocks.iter().enumerate() {
            for (from, label) in &block.from {
                let mut points: Vec<(i64, i64)> = Vec::new();
                self.lead(*from, to, &mut points);
                arrows.push(self.arrow((*from, to), &points, label));
            }
        }
        arrows
    }

    /// The corners of the way from a place to a block; nothing where no way leads there.
    fn lead(&self, from: usize, to: usize, points: &mut Vec<(i64, i64)>) -> bool {
        let layer = self.graph.items[from].layer;
        let (nets, first) = &self.gaps[layer];
        let Some(net) = nets.iter().find(|net| net.from == from) else { return false };
        let before = points.len();
        let links = || net.ends.iter().map(|(link, end)| (self.graph.links[*link].to, *end));
        // A passage is tried where the block itself is not reached.
        let direct = links().find(|(place, _)| *place == to);
        let passage = links().find(|(place, _)| *place >= self.lines.len());
        let Some((place, end)) = direct.or(passage) else { return false };
        points.push((self.columns[layer].1, net.start));
        if let Some(lane) = net.lane.filter(|_| end != net.start) {
            let lane = first + lane * LANE;
            points.extend([(lane, net.start), (lane, end)]);
        }
        points.push((self.columns[layer + 1].0, end));
        if direct.is_some() || self.lead(place, to, points) {
            return true;
        }
        points.truncate(before);
        false
    }

    fn arrow(&self, (from, to): (usize, usize), points: &[(i64, i64)], label: &str) -> FlowArrow {
        let mut path = String::new();
        let mut pen: Option<(i64, i64)> = None;
        for (along, across) in points {
            let (x, y) = self.xy(*along, *across);
            let step = match pen {
                None => format!("M{x} {y}"),
                Some(before) if before == (x, y) => String::new(),
                Some((_, before)) if before == y => format!("H{x}"),
                Some(_) => format!("V{y}"),
            };
            path.push_str(&step);
            pen = Some((x, y));
        }
        let (x, y) = pen.unwrap_or_default();
        let (tip, at) = match self.way {
            Way::Right => ("l-8 -4v8z", (x - 11, y - 3)),
            Way::Down => ("l-4 -8h8z", (x + 5, y - 11)),
        };
        let label = (!label.is_empty()).then(|| PictureText {
            text: label.to_owned(),
            x: length(at.0),
            y: length(at.1),
            align: if self.way == Way::Right { Align::Right } else { Align::Left },
            target: None,
        });
        FlowArrow { from, to, path, tip: format!("M{x} {y}{tip}"), label }
    }

    /// Where lines of one block part: lines that only cross have no dot.
    fn dots(&self) -> Vec<(u32, u32)> {
        let mut dots = Vec::new();
        for (nets, first) in &self.gaps {
            for net in nets {
                let Some(lane) = net.lane else { continue };
                let (begin, end) = net.span();
                let mut corners: Vec<i64> = net.ends.iter().map(|(_, end)| *end).chain([net.start]).collect();
                corners.sort_unstable();
                corners.dedup();
                for corner in corners {
                    let arms = [
                        corner == net.start,
                        net.ends.iter().any(|(_, end)| *end == corner),
                        corner > begin,
                        corner < end,
                    ];
                    if arms.into_iter().filter(|arm| *arm).count() > 2 {
                        let (x, y) = self.xy(first + lane * LANE, corner);
                        dots.push((length(x), length(y)));
                    }
                }
            }
        }
        dots
    }
}

/// The picture of blocks whose texts are those of a language.
pub(crate) fn picture(blocks: &[DrawnBlock]) -> FlowPicture {
    let ways = [Way::Right, Way::Down];
    let mut narrowest: Option<Layout> = None;
    for (way, limit) in ways.into_iter().flat_map(|way| LIMITS.map(|limit| (way, limit))) {
        let layout = Layout::of(blocks, way, limit);
        let width = layout.extent().0;
        if width <= WIDEST {
            return layout.drawn(blocks);
        }
        if narrowest.as_ref().is_none_or(|other| width < other.extent().0) {
            narrowest = Some(layout);
        }
    }
    narrowest.map_or_else(FlowPicture::default, |layout| layout.drawn(blocks))
}

#[cfg(test)]
mod tests;
