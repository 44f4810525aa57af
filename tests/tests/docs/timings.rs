//! Sequences of events: the pictures of the HTML pages are read back as SVG, and show the levels, steps and causes of the model.

use od_spec::model::{Level, Signal, SignalCarrier, Table, TableContent, Timing, Value};

use super::machines::pieces;
use super::svg::{Element, pictures};
use super::{FULLMO, PITCH, compile_clean};

fn timings(spec: &str) -> Vec<Timing> {
    let system = compile_clean(spec).unwrap();
    let of = |table: &Table| match &table.content {
        TableContent::Timing(timing) => Some(timing.clone()),
        _ => None,
    };
    let found: Vec<Timing> = system.document.tables().filter_map(|(.., table)| of(table)).collect();
    assert!(!found.is_empty(), "{spec} has no sequence of events");
    found
}

/// A level as a picture shows it.
fn shown(level: &Level) -> String {
    match level {
        Level::Any => "x".to_owned(),
        Level::Letter(letter) => letter.to_string(),
        Level::Value(Value::Integer(raw)) => raw.to_string(),
        Level::Value(other) => panic!("{other:?}"),
    }
}

/// The middle of each row, from the top, and its elements: what is nearest to it.
fn rows(picture: &[Element], count: usize) -> Vec<(i64, Vec<&Element>)> {
    // The elements of a signal follow each other, beginning with its label.
    let first = picture.iter().position(|element| element.is("left")).unwrap();
    let mut rows: Vec<(i64, Vec<&Element>)> = Vec::new();
    for element in &picture[first..] {
        if element.is("left") && !element.is("number") {
            rows.push((element.number("y") + 2, Vec::new()));
        }
        rows.last_mut().unwrap().1.push(element);
    }
    assert_eq!(rows.len(), count);
    rows
}

/// The level that is drawn at a place: by the line whether it runs above or below the middle, by a band the text in it.
fn drawn(row: &[&Element], middle: i64, x: i64) -> String {
    let lines = row.iter().filter(|element| element.is("wave") && !element.is("band"));
    let level = lines
        .flat_map(|line| pieces(line.get("d")))
        .find(|piece| !piece.is_vertical && (piece.from..=piece.to).contains(&x));
    if let Some(piece) = level {
        assert_ne!(piece.level, middle);
        return if piece.level < middle { "1" } else { "0" }.to_owned();
    }
    let bands = row.iter().filter(|element| element.is("band"));
    let (from, to) = bands.map(|band| ends(band)).find(|(from, to)| (*from..=*to).contains(&x)).unwrap();
    let inside = |element: &&&Element| {
        element.name == "text" && !element.is("left") && (from..=to).contains(&element.number("x"))
    };
    let texts: Vec<&str> = row.iter().filter(inside).map(|element| element.text.as_str()).collect();
    assert_eq!(texts.len(), 1, "{texts:?}");
    texts[0].to_owned()
}

/// Where a band begins and ends.
fn ends(band: &Element) -> (i64, i64) {
    let numbers: Vec<i64> = band.get("d")[1..]
        .split(['L', 'H', 'Z', ' '])
        .filter(|part| !part.is_empty())
        .map(|part| part.parse().unwrap())
        .collect();
    // `M{from} {middle}L{left} {top}H{right}L{to} {middle}…`
    (numbers[0], numbers[5])
}

/// From where to where a signal keeps a level, as it is drawn.
fn drawn_runs(row: &[&Element]) -> Vec<(i64, i64)> {
    let lines = row.iter().filter(|element| element.is("wave") && !element.is("band"));
    let lines = lines.flat_map(|line| pieces(line.get("d"))).filter(|piece| !piece.is_vertical);
    let bands = row.iter().filter(|element| element.is("band")).map(|band| ends(band));
    let mut runs: Vec<(i64, i64)> = lines.map(|piece| (piece.from, piece.to)).chain(bands).collect();
    runs.sort_unstable();
    runs
}

/// The same as it is given: a level is kept from a step to the one at which it changes.
fn given_runs(levels: &[Level], edges: &[i64]) -> Vec<(i64, i64)> {
    let mut runs: Vec<(i64, i64)> = Vec::new();
    for (at, pair) in edges.windows(2).enumerate() {
        match runs.last_mut() {
            Some(run) if levels[at] == levels[at - 1] => run.1 = pair[1],
            Some(_) | None => runs.push((pair[0], pair[1])),
        }
    }
    runs
}

#[test]
fn pictures_show_the_levels_that_are_given() {
    for (spec, language) in [(PITCH, "en"), (FULLMO, "en"), (FULLMO, "de")] {
        let (timings, pictures) = (timings(spec), pictures(spec, language, "timing"));
        assert_eq!(timings.len(), pictures.len(), "{spec}");
        for (timing, picture) in timings.iter().zip(&pictures) {
            let marks: Vec<&Element> =
                picture.iter().filter(|element| element.is("number") && !element.is("left")).collect();
            let numbers: Vec<String> = marks.iter().map(|mark| mark.text.clone()).collect();
            let steps: Vec<String> = (1..=timing.steps.len()).map(|number| number.to_string()).collect();
            assert_eq!(numbers, steps);
            let at: Vec<i64> = marks.iter().map(|mark| mark.number("x")).collect();
            let width = picture[0].number("width");
            // Between two marks, before the first and after the last, each level is drawn once.
            let mut places: Vec<i64> = at.windows(2).map(|pair| i64::midpoint(pair[0], pair[1])).collect();
            let interval = at.get(1).map_or(40, |second| second - at[0]);
            places.insert(0, at[0] - interval / 2);
            places.push(at[at.len() - 1] + interval / 2);
            assert!(places.iter().all(|place| (0..width).contains(place)), "{places:?}");
            for (signal, (middle, row)) in timing.signals.iter().zip(rows(picture, timing.signals.len())) {
                let found: Vec<String> = places.iter().map(|place| drawn(&row, middle, *place)).collect();
                let given: Vec<String> = signal.levels.iter().map(shown).collect();
                assert_eq!(found, given, "{spec}: {:?}", signal.carrier);
                // It changes at the marks of its steps, and nowhere else.
                let edges: Vec<i64> = std::iter::once(at[0] - interval)
                    .chain(at.iter().copied())
                    .chain([at[at.len() - 1] + interval])
                    .collect();
                let given_runs = given_runs(&signal.levels, &edges);
                assert_eq!(drawn_runs(&row), given_runs, "{spec}: {:?}", signal.carrier);
                // The digits next to a line say the same.
                for (place, level) in places.iter().zip(&given) {
                    let near = |element: &&&Element| {
                        element.name == "text"
                            && !element.is("left")
                            && (element.number("x") - place).abs() < interval / 2
                    };
                    let texts: Vec<&String> = row.iter().filter(near).map(|element| &element.text).collect();
                    assert!(texts.iter().all(|text| *text == level), "{spec}: {level} is {texts:?}");
                }
                let name = match &signal.carrier {
                    SignalCarrier::Bits(bits) => bits.name.clone(),
                    SignalCarrier::Entry(id) => {
                        let system = compile_clean(spec).unwrap();
                        system.devices.iter().find_map(|device| device.entry_name(*id)).unwrap()
                    }
                };
                assert_eq!(row[0].text, name);
            }
        }
    }
}

#[test]
fn arrows_lead_from_causes_to_effects() {
    for spec in [PITCH, FULLMO] {
        for (timing, picture) in timings(spec).iter().zip(pictures(spec, "en", "timing")) {
            let marks: Vec<i64> = picture
                .iter()
                .filter(|element| element.is("number") && !element.is("left"))
                .map(|mark| mark.number("x"))
                .collect();
            let middles: Vec<i64> =
                rows(&picture, timing.signals.len()).iter().map(|(middle, _)| *middle).collect();
            // The step and the signal at a place.
            let place = |x: i64, y: i64| {
                let step = marks.iter().position(|mark| *mark == x).unwrap() + 1;
                let row = (0..middles.len()).min_by_key(|row| (middles[*row] - y).abs()).unwrap();
                (step, row)
            };
            let point = |path: &str| -> (i64, i64) {
                let mut numbers = path[1..].split([' ', 'C', 'l']).map(|part| part.parse().unwrap());
                (numbers.next().unwrap(), numbers.next().unwrap())
            };
            let mut drawn: Vec<((usize, usize), (usize, usize))> = Vec::new();
            for (at, tip) in picture.iter().enumerate().filter(|(_, element)| element.is("tip")) {
                let (from, to) = (point(picture[at - 1].get("d")), point(tip.get("d")));
                drawn.push((place(from.0, from.1), place(to.0, to.1)));
            }
            let mut expected = Vec::new();
            for (at, step) in timing.steps.iter().enumerate() {
                let Some(cause) = step.cause else { continue };
                let changing = |step: usize| {
                    let rows = timing.signals.iter().enumerate();
                    rows.filter(move |(_, signal): &(usize, &Signal)| {
                        let pair = &signal.levels[step - 1..=step];
                        pair[0] != pair[1] && !pair.contains(&Level::Any)
                    })
                    .map(move |(row, _)| (step, row))
                };
                expected.extend(changing(cause).flat_map(|from| changing(at + 1).map(move |to| (from, to))));
            }
            assert!(!expected.is_empty(), "{spec}");
            assert_eq!(drawn, expected, "{spec}");
        }
    }
}

#[test]
fn texts_of_pictures_are_whole_and_inside() {
    for (spec, language) in [(PITCH, "en"), (FULLMO, "de")] {
        for picture in pictures(spec, language, "timing") {
            let (width, height) = (picture[0].number("width"), picture[0].number("height"));
            let marks = picture.iter().filter(|element| element.is("at"));
            let first =
                marks.map(|mark| mark.get("d")[1..].split(' ').next().unwrap().parse::<i64>().unwrap()).min();
            for text in picture.iter().filter(|element| element.name == "text") {
                // A character is at most 7 wide.
                let room = i64::try_from(text.text.chars().count()).unwrap() * 7;
                let (x, y) = (text.number("x"), text.number("y"));
                let (from, to) = if text.is("left") { (x, x + room) } else { (x - room / 2, x + room / 2) };
                assert!(
                    !text.text.is_empty() && from >= 0 && to <= width && y >= 8 && y <= height,
                    "{text:?}"
                );
                // Labels end before the first wave begins.
                assert!(!text.is("left") || to < first.unwrap(), "{text:?}");
            }
        }
    }
}
