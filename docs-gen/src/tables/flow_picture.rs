//! The picture of a block diagram: blocks in layers, arrows between them.
//!
//! A block stands in the layer behind the last that it takes from; one that takes nothing stands right before the first that takes
//! from it. Layers follow each other from left to right, or from top to bottom where that would be too wide. An arrow over several
//! layers has a place of its own in each of them, so that no arrow crosses a block; between two layers it turns in a lane.
//! Everything is computed along the way of the arrows (`along`) and across it; only at the end these become `x` and `y`.

use super::timing_picture::room;
use crate::view::{Align, FlowArrow, FlowBox, FlowPicture, PictureLine, PictureText};

/// A wider picture is tried from top to bottom: on paper it would be too small to be read.
const WIDEST: i64 = 700;
/// Characters of a line in a block, from the widest blocks to the narrowest.
const LIMITS: [usize; 3] = [26, 21, 17];
/// Height of a line.
pub(super) const LINE: i64 = 14;
/// Inside a block, at its sides and above and below its lines.
const PADDING: (i64, i64) = (8, 6);
/// Around everything.
const MARGIN: i64 = 6;
/// Between two blocks of a layer.
const GAP: i64 = 14;
/// Where an arrow passes a layer.
const PASSAGE: i64 = 8;
/// A line that would turn by less is straight. Two arrows at one side of a block are farther apart.
const NEAR: i64 = 6;
/// Between two lanes.
const LANE: i64 = 10;
/// From a block to the first lane, and from the last one to a tip.
const BEFORE: i64 = 12;
const BEHIND: i64 = 18;

/// A block with the texts of its language.
pub(super) struct DrawnBlock {
    /// What it is.
    pub name: String,
    /// Entries and bits.
    pub lines: Vec<DrawnLine>,
    /// The earlier blocks that it takes from, and what.
    pub from: Vec<(usize, String)>,
}

/// A line that may lead somewhere.
#[derive(Clone)]
pub(super) struct DrawnLine {
    /// The text.
    pub text: String,
    /// Where a link leads; may be empty.
    pub anchor: String,
    /// Page that has the anchor.
    pub page: String,
}

impl DrawnLine {
    /// This line in lines of at most so many characters; a word stays whole.
    fn wrapped(&self, limit: usize) -> impl Iterator<Item = Self> {
        let lines = wrapped(&self.text, limit).into_iter();
        lines.map(|text| Self { text, anchor: self.anchor.clone(), page: self.page.clone() })
    }
}

/// A text in lines of at most so many characters; a word stays whole.
pub(super) fn wrapped(text: &str, limit: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= limit => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// A name and its entries as the lines of a label, with the width that they need.
pub(super) fn label(name: &str, lines: &[DrawnLine], limit: usize) -> (Vec<(DrawnLine, bool)>, i64) {
    let name = DrawnLine { text: name.to_owned(), anchor: String::new(), page: String::new() };
    let lines = lines.iter().flat_map(|line| line.wrapped(limit)).map(|line| (line, false));
    let all: Vec<(DrawnLine, bool)> = name.wrapped(limit).map(|line| (line, true)).chain(lines).collect();
    let width = all.iter().map(|(line, _)| i64::from(room(&line.text))).max().unwrap_or_default();
    (all, width)
}

/// The lines of a label around `x`, the first at `y`.
pub(super) fn placed(lines: Vec<(DrawnLine, bool)>, x: i64, y: i64) -> Vec<PictureLine> {
    let lines = (0..).zip(lines).map(|(at, (line, is_name))| PictureLine {
        text: line.text,
        is_name,
        anchor: line.anchor,
        page: line.page,
        x: length(x),
        y: length(y + at * LINE),
    });
    lines.collect()
}

/// A length of a picture.
pub(super) fn length(value: i64) -> u32 {
    u32::try_from(value).unwrap_or_default()
}

/// Which way layers follow each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Way {
    Right,
    Down,
}

/// A place in a layer: a block, or the passage of arrows from a block to later layers.
struct Item {
    layer: usize,
    /// Its extent across the way.
    size: i64,
    /// Its beginning across the way.
    start: i64,
    /// The block that it is, or whose arrows pass.
    block: usize,
}

impl Item {
    const fn middle(&self) -> i64 {
        self.start + self.size / 2
    }
}

/// From a place to one of the next layer.
#[derive(Clone, Copy)]
struct Link {
    from: usize,
    to: usize,
}

/// Places and links of a diagram. The first items are the blocks, in their order.
struct Graph {
    items: Vec<Item>,
    links: Vec<Link>,
    /// The places of each layer, in order.
    layers: Vec<Vec<usize>>,
}

/// The layer of each block.
fn layers_of(blocks: &[DrawnBlock]) -> Vec<usize> {
    let mut layers: Vec<usize> = Vec::new();
    for block in blocks {
        layers.push(block.from.iter().map(|(from, _)| layers[*from] + 1).max().unwrap_or(0));
    }
    for (at, block) in blocks.iter().enumerate() {
        let takes = |other: &&DrawnBlock| other.from.iter().any(|(from, _)| *from == at);
        let first =
            blocks.iter().zip(&layers).filter(|(other, _)| takes(other)).map(|(_, layer)| *layer).min();
        if let (true, Some(first)) = (block.from.is_empty(), first) {
            layers[at] = first - 1;
        }
    }
    layers
}

impl Graph {
    fn of(blocks: &[DrawnBlock], sizes: &[i64]) -> Self {
        let of_blocks = layers_of(blocks);
        let items = of_blocks.iter().zip(sizes).enumerate();
        let items = items.map(|(block, (layer, size))| Item { layer: *layer, size: *size, start: 0, block });
        let mut graph = Self {
            items: items.collect(),
            links: Vec::new(),
            layers: vec![Vec::new(); of_blocks.iter().max().map_or(0, |last| last + 1)],
        };
        for (at, layer) in of_blocks.iter().enumerate() {
            let takers =
                blocks.iter().enumerate().filter(|(_, block)| block.from.iter().any(|(from, _)| *from == at));
            let takers: Vec<usize> = takers.map(|(taker, _)| taker).collect();
            let last = takers.iter().map(|taker| of_blocks[*taker]).max().unwrap_or(*layer);
            // The place of what it gives, in each layer that this reaches or passes.
            let mut place = at;
            for next in layer + 1..=last {
                let here = takers.iter().filter(|taker| of_blocks[**taker] == next);
                graph.links.extend(here.map(|taker| Link { from: place, to: *taker }));
                if next < last {
                    graph.items.push(Item { layer: next, size: PASSAGE, start: 0, block: at });
                    let passage = graph.items.len() - 1;
                    graph.links.push(Link { from: place, to: passage });
                    place = passage;
                }
            }
        }
        let mut all: Vec<usize> = (0..graph.items.len()).collect();
        all.sort_by_key(|item| graph.items[*item].block);
        for item in all {
            graph.layers[graph.items[item].layer].push(item);
        }
        graph
    }

    /// The position of each item in its layer.
    fn positions(&self) -> Vec<usize> {
        let mut positions = vec![0; self.items.len()];
        for layer in &self.layers {
            for (position, item) in layer.iter().enumerate() {
                positions[*item] = position;
            }
        }
        positions
    }

    /// How often lines cross between layers.
    fn crossings(&self) -> usize {
        let positions = self.positions();
        let count = |(at, one): (usize, &Link)| {
            let crosses = |other: &&Link| {
                let same_layers = self.items[other.from].layer == self.items[one.from].layer;
                let before = positions[one.from].cmp(&positions[other.from]);
                same_layers
                    && before.is_ne()
                    && positions[one.to].cmp(&positions[other.to]) == before.reverse()
            };
            self.links[at + 1..].iter().filter(crosses).count()
        };
        self.links.iter().enumerate().map(count).sum()
    }

    /// Orders the layers so that few lines cross.
    fn order(&mut self) {
        let mut best = (self.crossings(), self.layers.clone());
        for round in 0..8 {
            let is_down = round % 2 == 0;
            let layers: Vec<usize> = if is_down {
                (0..self.layers.len()).collect()
            } else {
                (0..self.layers.len()).rev().collect()
            };
            for layer in layers {
                let positions = self.positions();
                let mean = |item: usize| {
                    let neighbours: Vec<usize> = self
                        .links
                        .iter()
                        .filter_map(|link| match is_down {
                            true if link.to == item => Some(link.from),
                            false if link.from == item => Some(link.to),
                            _ => None,
                        })
                        .collect();
                    let sum: usize = neighbours.iter().map(|other| positions[*other] * 1000).sum();
                    sum.checked_div(neighbours.len()).unwrap_or(positions[item] * 1000)
                };
                let mut ordered = self.layers[layer].clone();
                ordered.sort_by_key(|item| mean(*item));
                self.layers[layer] = ordered;
            }
            let crossings = self.crossings();
            if crossings < best.0 {
                best = (crossings, self.layers.clone());
            }
        }
        self.layers = best.1;
    }

    /// The links that end at an item, in the order of their places there.
    fn links_to(&self, item: usize, positions: &[usize]) -> Vec<usize> {
        let mut here: Vec<usize> = (0..self.links.len()).filter(|at| self.links[*at].to == item).collect();
        here.sort_by_key(|at| positions[self.links[*at].from]);
        here
    }

    /// Where each link ends, from the start of the item there.
    fn ports(&self) -> Vec<i64> {
        let positions = self.positions();
        let mut ports = vec![0; self.links.len()];
        for (at, item) in self.items.iter().enumerate() {
            let here = self.links_to(at, &positions);
            let count = i64::try_from(here.len()).unwrap_or(1);
            for (slot, link) in (0..).zip(here) {
                ports[link] = item.size * (2 * slot + 1) / (2 * count);
            }
        }
        ports
    }

    /// The same, moved a little to where lines become straight.
    fn straightened(&self, mut ports: Vec<i64>) -> Vec<i64> {
        for (link, port) in self.links.iter().zip(&mut ports) {
            let (from, to) = (&self.items[link.from], &self.items[link.to]);
            let straight = from.middle() - to.start;
            let is_inside = to.size > PASSAGE && (4..=to.size - 4).contains(&straight);
            if is_inside && (straight - *port).abs() < NEAR {
                *port = straight;
            }
        }
        ports
    }

    /// Gives every item its place across the way: as near as the order allows to where its lines are straight.
    fn place(&mut self) {
        let ports = self.ports();
        for layer in 0..self.layers.len() {
            self.settle(layer, |_, _| None);
        }
        for round in 0..8 {
            let is_down = round % 2 == 0;
            let layers: Vec<usize> = if is_down {
                (0..self.layers.len()).collect()
            } else {
                (0..self.layers.len()).rev().collect()
            };
            for layer in layers {
                self.settle(layer, |graph, item| {
                    let wanted: Vec<i64> = graph
                        .links
                        .iter()
                        .zip(&ports)
                        .filter_map(|(link, port)| match is_down {
                            true if link.to == item => Some(graph.items[link.from].middle() - port),
                            false if link.from == item => {
                                Some(graph.items[link.to].start + port - graph.items[item].size / 2)
                            }
                            _ => None,
                        })
                        .collect();
                    wanted.iter().sum::<i64>().checked_div(i64::try_from(wanted.len()).ok()?)
                });
            }
        }
        let first = self.items.iter().map(|item| item.start).min().unwrap_or_default();
        for item in &mut self.items {
            item.start += MARGIN - first;
        }
    }

    /// Puts the items of a layer where they want to be, in their order and apart from each other.
    fn settle(&mut self, layer: usize, wanted: impl Fn(&Self, usize) -> Option<i64>) {
        let items = self.layers[layer].clone();
        // Without its distance to the first, no item may lie before the one above it: those that would, move together.
        let mut offset = 0;
        let mut offsets = Vec::new();
        let mut groups: Vec<(i64, i64)> = Vec::new();
        for item in &items {
            let start = wanted(self, *item).unwrap_or(self.items[*item].start);
            groups.push((start - offset, 1));
            while let [.., before, last] = groups.as_slice()
                && before.0.div_euclid(before.1) > last.0.div_euclid(last.1)
            {
                let joined = (before.0 + last.0, before.1 + last.1);
                groups.truncate(groups.len() - 2);
                groups.push(joined);
            }
            offsets.push(offset);
            offset += self.items[*item].size + GAP;
        }
        let starts = groups.iter().flat_map(|(sum, count)| (0..*count).map(|_| sum.div_euclid(*count)));
        for ((item, offset), start) in items.iter().zip(offsets).zip(starts) {
            self.items[*item].start = start + offset;
        }
    }
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
    left.sort_by_key(|at| {
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
    /// The nets behind each layer, and where their first lane is.
    gaps: Vec<(Vec<Net>, i64)>,
    lines: Vec<Vec<(DrawnLine, bool)>>,
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
            let (width, height) = (
                (width + 2 * PADDING.0).max(60),
                i64::try_from(text.len()).unwrap_or_default() * LINE + 2 * PADDING.1,
            );
            let arrows = i64::try_from(block.from.len()).unwrap_or_default();
            let (size, depth) = match way {
                // A label stands above the end of its arrow, or beside it.
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
            let text = i64::try_from(lines.len()).unwrap_or_default() * LINE;
            FlowBox {
                name: block.name.clone(),
                x: length(x),
                y: length(y),
                width: length(width),
                height: length(height),
                lines: placed(lines.clone(), x + width / 2, y + (height - text) / 2 + 11),
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
pub(super) fn picture(blocks: &[DrawnBlock]) -> FlowPicture {
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
#[path = "flow_picture_tests.rs"]
mod tests;
