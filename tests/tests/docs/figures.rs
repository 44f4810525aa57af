//! Numbered figures: block diagrams and axes of the HTML pages are read back as SVG, and the lists name what is printed.

use std::collections::BTreeSet;

use od_spec::model::{Axis, AxisReach, Flow, System, Table, TableContent};

use super::machines::pieces;
use super::svg::{Element, pictures};
use super::{FULLMO, PITCH, compile_clean, pages};

fn contents<T>(system: &System, of: impl Fn(&TableContent) -> Option<T>) -> Vec<T> {
    system.document.tables().filter_map(|(.., table): (_, _, &Table)| of(&table.content)).collect()
}

fn flows(system: &System) -> Vec<Flow> {
    contents(system, |content| match content {
        TableContent::Flow(flow) => Some(flow.clone()),
        _ => None,
    })
}

fn axes(system: &System) -> Vec<Axis> {
    contents(system, |content| match content {
        TableContent::Axis(axis) => Some(axis.clone()),
        _ => None,
    })
}

/// The manuals print their figures with these numbers. The second figure 3 of the drive has none here.
#[test]
fn every_figure_that_is_printed_is_there() {
    for (spec, last) in [(PITCH, 20), (FULLMO, 5)] {
        let system = compile_clean(spec).unwrap();
        let figures = system.document.tables().filter_map(|(.., table)| table.figure.as_ref());
        let numbers: Vec<u16> = figures.map(|figure| figure.number).collect();
        assert_eq!(numbers, (1..=last).collect::<Vec<u16>>());
        let (pages, index) = pages(spec);
        let list = pages["tables.md"]
            .tables
            .iter()
            .find(|table| table.columns.contains(&"Figure".to_owned()))
            .unwrap();
        let listed: Vec<u16> = list.rows.iter().map(|row| list.cell(row, "No.").parse().unwrap()).collect();
        assert_eq!(listed, numbers);
        let of_index =
            index["tables"].as_array().unwrap().iter().filter_map(|table| table["figure"]["number"].as_u64());
        assert_eq!(of_index.collect::<Vec<_>>(), numbers.into_iter().map(u64::from).collect::<Vec<_>>());
    }
}

/// Left, upper, right and lower edge.
type Edges = (i64, i64, i64, i64);

fn edges(one: &Element) -> Edges {
    let [x, y, width, height] = ["x", "y", "width", "height"].map(|name| one.number(name));
    (x, y, x + width, y + height)
}

/// The ends of a path.
fn ends(path: &str) -> ((i64, i64), (i64, i64)) {
    let (x, y) =
        path[1..].split_once(['H', 'V']).map_or(&path[1..], |(start, _)| start).split_once(' ').unwrap();
    let start: (i64, i64) = (x.parse().unwrap(), y.parse().unwrap());
    let mut pen = start;
    let spaced = path.replace('H', " H").replace('V', " V");
    for step in spaced.split(' ') {
        match (step.strip_prefix('H'), step.strip_prefix('V')) {
            (Some(x), _) => pen.0 = x.parse().unwrap(),
            (_, Some(y)) => pen.1 = y.parse().unwrap(),
            (None, None) => {}
        }
    }
    (start, pen)
}

fn is_in((x, y): (i64, i64), (left, top, right, bottom): Edges) -> bool {
    (left..=right).contains(&x) && (top..=bottom).contains(&y)
}

#[test]
fn diagrams_show_the_blocks_and_what_goes_between_them() {
    for (spec, language) in [(PITCH, "en"), (FULLMO, "de"), (FULLMO, "en")] {
        let system = compile_clean(spec).unwrap();
        let (flows, pictures) = (flows(&system), pictures(spec, language, "flow"));
        assert!(flows.len() == pictures.len() && flows.len() >= 5);
        for (flow, picture) in flows.iter().zip(&pictures) {
            let boxes: Vec<Edges> = picture.iter().filter(|one| one.name == "rect").map(edges).collect();
            assert_eq!(boxes.len(), flow.blocks.len());
            for (block, edges) in flow.blocks.iter().zip(&boxes) {
                let texts = picture.iter().filter(|one| one.name == "text");
                let inside: Vec<&str> = texts
                    .filter(|text| is_in((text.number("x"), text.number("y")), *edges))
                    .flat_map(|text| text.text.split(' '))
                    .collect();
                let inside = inside.join(" ");
                let name = block
                    .name
                    .get(language)
                    .or_else(|| block.name.iter().next().map(|(_, text)| text))
                    .unwrap();
                assert!(inside.starts_with(name), "{inside}");
                for id in &block.entries {
                    assert!(inside.contains(&id.to_string()), "{inside}");
                }
                if let Some(bits) = &block.bits {
                    assert!(inside.contains(&bits.name), "{inside}");
                }
            }
            // From the box of each block to that of the one that takes from it, and to no other.
            let expected: BTreeSet<(usize, usize)> = flow
                .blocks
                .iter()
                .enumerate()
                .flat_map(|(to, block)| block.from.iter().map(move |inflow| (inflow.block, to)))
                .collect();
            let lines = picture.iter().filter(|one| one.name == "path" && !one.is("tip") && !one.is("area"));
            let drawn: Vec<(usize, usize)> = lines
                .map(|line| {
                    let (start, end) = ends(line.get("d"));
                    let at = |place| boxes.iter().position(|edges| is_in(place, *edges)).unwrap();
                    (at(start), at(end))
                })
                .collect();
            assert_eq!(drawn.len(), expected.len());
            assert_eq!(drawn.into_iter().collect::<BTreeSet<_>>(), expected);
            // What is at the arrows is there, too.
            let texts: BTreeSet<&str> = picture.iter().map(|one| one.text.as_str()).collect();
            for inflow in flow.blocks.iter().flat_map(|block| &block.from) {
                let carries = inflow
                    .carries
                    .get(language)
                    .or_else(|| inflow.carries.iter().next().map(|(_, text)| text));
                assert!(carries.is_none_or(|carries| texts.contains(carries)), "{carries:?}");
            }
            // A printed page is some 650 units wide.
            assert!(picture[0].number("width") <= 700, "{}", picture[0].get("aria-label"));
        }
    }
}

#[test]
fn axes_show_from_where_to_where_spans_lead() {
    let system = compile_clean(PITCH).unwrap();
    let (axes, pictures) = (axes(&system), pictures(PITCH, "en", "axis"));
    assert!(axes.len() == pictures.len() && axes.len() >= 3);
    for (axis, picture) in axes.iter().zip(&pictures) {
        let marks: Vec<i64> =
            picture.iter().filter(|one| one.is("wave")).map(|one| pieces(one.get("d"))[0].level).collect();
        assert!(marks.len() == axis.marks.len() && marks.is_sorted());
        let width = picture[0].number("width");
        let lines: Vec<&Element> =
            picture.iter().filter(|one| one.name == "path" && one.get("class").is_empty()).collect();
        // The first is the axis itself.
        assert_eq!(lines.len(), axis.spans.len() + 1);
        for (span, line) in axis.spans.iter().zip(&lines[1..]) {
            let ((from, y), (to, _)) = ends(line.get("d"));
            match span.reach {
                AxisReach::Between(begin, end) => assert_eq!((from, to), (marks[begin], marks[end])),
                AxisReach::Above(mark) => assert!(from == marks[mark] && to > from && width - to < 10),
                AxisReach::Below(mark) => assert!(from == marks[mark] && to < 10),
            }
            // Its name is above it.
            let name = span.name.get("en").unwrap();
            let word = name.split(' ').next().unwrap();
            let is_near = |text: &&Element| {
                let x = text.number("x");
                text.text.starts_with(word)
                    && (from.min(to)..=from.max(to)).contains(&x)
                    && (0..60).contains(&(y - text.number("y")))
            };
            assert!(picture.iter().filter(|one| one.name == "text").any(|text| is_near(&text)), "{name}");
        }
    }
}
