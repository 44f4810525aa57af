//! Blocks and arrows of a block diagram in layers: the order of each layer and where its places begin, with few crossings and short ways.

use crate::diagrams::label::DrawnLine;
use od_spec::order::Arrange as _;

/// Around everything.
pub(crate) const MARGIN: i64 = 6;
/// Between two blocks of a layer.
const GAP: i64 = 14;
/// Where an arrow passes a layer.
const PASSAGE: i64 = 8;
/// A line that would turn by less is straight. Two arrows at one side of a block are farther apart.
const NEAR: i64 = 6;

/// A block with the texts of its language.
pub(crate) struct DrawnBlock {
    /// What it is.
    pub name: String,
    /// Entries and bits.
    pub lines: Vec<DrawnLine>,
    /// The earlier blocks that it takes from, and what.
    pub from: Vec<(usize, String)>,
}

/// A place in a layer: a block, or the passage of arrows from a block to later layers.
pub(crate) struct Item {
    pub layer: usize,
    /// Its extent across the way.
    pub size: i64,
    /// Its beginning across the way.
    pub start: i64,
    /// The block that it is, or whose arrows pass.
    pub block: usize,
}

impl Item {
    pub(crate) const fn middle(&self) -> i64 {
        self.start + self.size / 2
    }
}

/// From a place to one of the next layer.
#[derive(Clone, Copy)]
pub(crate) struct Link {
    pub from: usize,
    pub to: usize,
}

/// Places and links of a diagram. The first items are the blocks, in their order.
pub(crate) struct Graph {
    pub items: Vec<Item>,
    pub links: Vec<Link>,
    /// The places of each layer, in order.
    pub layers: Vec<Vec<usize>>,
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
    pub(crate) fn of(blocks: &[DrawnBlock], sizes: &[i64]) -> Self {
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
        all.arrange_by_key(|item| graph.items[*item].block);
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
    pub(crate) fn order(&mut self) {
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
                ordered.arrange_by_key(|item| mean(*item));
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
        here.arrange_by_key(|at| positions[self.links[*at].from]);
        here
    }

    /// Where each link ends, from the start of the item there.
    pub(crate) fn ports(&self) -> Vec<i64> {
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
    pub(crate) fn straightened(&self, mut ports: Vec<i64>) -> Vec<i64> {
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
    pub(crate) fn place(&mut self) {
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
