//! Layouts of random diagrams: boxes are apart, arrows lead from block to block around all others, texts are inside.

use super::*;
use crate::diagrams::label::DrawnLine;

/// Numbers that look random and are the same in every run.
struct Random(u64);

impl Random {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(self.0 >> 33).unwrap() % end
    }
}

fn random(seed: u64) -> Vec<DrawnBlock> {
    let mut random = Random(seed);
    let count = 2 + random.below(13);
    let words = ["ramp", "generator", "limit", "of", "the", "velocity", "Geschwindigkeitsregelung"];
    let text = |least: usize, random: &mut Random| {
        let count = least + random.below(4);
        (0..count).map(|_| words[random.below(words.len())]).collect::<Vec<_>>().join(" ")
    };
    let mut blocks: Vec<DrawnBlock> = Vec::new();
    for at in 0..count {
        let mut from: Vec<(usize, String)> = Vec::new();
        for other in 0..at {
            if random.below(at) < 2 {
                let label = if random.below(5) == 0 { text(0, &mut random) } else { String::new() };
                from.push((other, label));
            }
        }
        let line = |text: String| DrawnLine { text, target: None };
        let lines = (0..random.below(3)).map(|_| line(text(1, &mut random))).collect();
        blocks.push(DrawnBlock { name: text(1, &mut random), lines, from });
    }
    blocks
}

/// The straight pieces of a path: both ends of each.
fn pieces(path: &str) -> Vec<((i64, i64), (i64, i64))> {
    let spaced = path.replace('H', " H").replace('V', " V");
    let mut words = spaced.strip_prefix('M').unwrap().split(' ');
    let mut pen: (i64, i64) =
        (words.next().unwrap().parse().unwrap(), words.next().unwrap().parse().unwrap());
    let mut pieces = Vec::new();
    for step in words {
        let to: i64 = step[1..].parse().unwrap();
        let next = if step.starts_with('H') { (to, pen.1) } else { (pen.0, to) };
        pieces.push((pen, next));
        pen = next;
    }
    pieces
}

fn edges(one: &FlowBox) -> (i64, i64, i64, i64) {
    let [x, y, width, height] = [one.x, one.y, one.width, one.height].map(i64::from);
    (x, y, x + width, y + height)
}

fn check(blocks: &[DrawnBlock], picture: &FlowPicture) {
    let (width, height) = (i64::from(picture.width), i64::from(picture.height));
    for (at, one) in picture.boxes.iter().enumerate() {
        let (left, top, right, bottom) = edges(one);
        assert!(left >= 0 && top >= 0 && right <= width && bottom <= height, "{} is outside", one.name);
        for other in &picture.boxes[at + 1..] {
            let (other_left, other_top, other_right, other_bottom) = edges(other);
            let is_apart =
                right < other_left || other_right < left || bottom < other_top || other_bottom < top;
            assert!(is_apart, "{} and {} overlap", one.name, other.name);
        }
        // Nothing of a text is lost, and all of it is inside.
        let shown: Vec<&str> = one.lines.iter().flat_map(|line| line.text.split_whitespace()).collect();
        let block = &blocks[at];
        let reported = std::iter::once(&block.name).chain(block.lines.iter().map(|line| &line.text));
        assert_eq!(shown, reported.flat_map(|text| text.split_whitespace()).collect::<Vec<_>>());
        for line in &one.lines {
            let half = i64::from(room(&line.text)) / 2;
            let (x, y) = (i64::from(line.x), i64::from(line.y));
            assert!(
                x - half >= left && x + half <= right && y - 8 >= top && y + 3 <= bottom,
                "{}",
                line.text
            );
        }
    }
    let expected: Vec<(usize, usize)> = blocks
        .iter()
        .enumerate()
        .flat_map(|(to, block)| block.from.iter().map(move |(from, _)| (*from, to)))
        .collect();
    assert_eq!(picture.arrows.iter().map(|arrow| (arrow.from, arrow.to)).collect::<Vec<_>>(), expected);
    for arrow in &picture.arrows {
        let pieces = pieces(&arrow.path);
        let (first, last) = (pieces.first().unwrap().0, pieces.last().unwrap().1);
        let touches = |(x, y): (i64, i64), one: &FlowBox| {
            let (left, top, right, bottom) = edges(one);
            (left..=right).contains(&x) && (top..=bottom).contains(&y)
        };
        assert!(touches(first, &picture.boxes[arrow.from]), "{} begins elsewhere", arrow.path);
        assert!(touches(last, &picture.boxes[arrow.to]), "{} ends elsewhere", arrow.path);
        assert!(arrow.tip.starts_with(&format!("M{} {}l", last.0, last.1)), "{}", arrow.tip);
        for ((x, y), (to_x, to_y)) in pieces {
            assert!(x.min(to_x) >= 0 && x.max(to_x) <= width && y.min(to_y) >= 0 && y.max(to_y) <= height);
            for one in &picture.boxes {
                let (left, top, right, bottom) = edges(one);
                let crosses = x.min(to_x) < right && left < x.max(to_x) && top < y && y < bottom
                    || y.min(to_y) < bottom && top < y.max(to_y) && left < x && x < right;
                assert!(!crosses, "{} crosses {}", arrow.path, one.name);
            }
        }
        if let Some(label) = &arrow.label {
            let (x, room) = (i64::from(label.x), i64::from(room(&label.text)));
            let (from, to) = if label.align == Align::Right { (x - room, x) } else { (x, x + room) };
            assert!(from >= 0 && to <= width, "{}", label.text);
            for one in &picture.boxes {
                let (left, top, right, bottom) = edges(one);
                let y = i64::from(label.y);
                assert!(
                    to <= left || right <= from || y < top || bottom <= y - 8,
                    "{} on {}",
                    label.text,
                    one.name
                );
            }
        }
    }
}

#[test]
fn random_diagrams_have_room_for_everything() {
    let mut across = 0;
    for seed in 0..400 {
        let blocks = random(seed);
        let picture = picture(&blocks);
        check(&blocks, &picture);
        across += usize::from(picture.width > picture.height);
        for (way, limit) in [(Way::Right, 17), (Way::Down, 26)] {
            check(&blocks, &Layout::of(&blocks, way, limit).drawn(&blocks));
        }
    }
    assert!(across > 20 && across < 380, "{across}");
}

#[test]
fn a_chain_is_one_straight_line() {
    let block = |name: &str, from: &[usize]| DrawnBlock {
        name: name.to_owned(),
        lines: Vec::new(),
        from: from.iter().map(|from| (*from, String::new())).collect(),
    };
    let drawn = picture(&[block("a", &[]), block("b", &[0]), block("c", &[1])]);
    assert!(drawn.arrows.iter().all(|arrow| pieces(&arrow.path).len() == 1));
    assert!(drawn.dots.is_empty());
    // One that gives to two has a dot where its lines part; one that is needed late is right before it.
    let drawn = picture(&[block("a", &[]), block("b", &[0]), block("late", &[]), block("c", &[1, 2, 0])]);
    assert_eq!(drawn.dots.len(), 1);
    assert_eq!(drawn.boxes[2].x, drawn.boxes[1].x);
}
