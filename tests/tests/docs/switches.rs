//! Switches with a hysteresis: the pictures of the HTML pages are read back as SVG, and show the values of the defaults.

use od_spec::model::{Dictionary, EntryId, Ratio, Switch, SwitchBack, SwitchSide, System, TableContent};

use super::machines::{Piece, pieces};
use super::svg::{Element, pictures};
use super::{PITCH, compile_clean};

/// A default in the symbol of its unit; of a difference, what it differs by.
fn quantity(device: &Dictionary, id: EntryId) -> Ratio {
    let entry = device.entry(id).unwrap();
    let raw = entry.default.as_ref().unwrap().integer().unwrap();
    Ratio::whole(raw).checked_mul(entry.unit.as_ref().unwrap().scale).unwrap()
}

/// The values at which a switch goes on and off.
fn points(system: &System, switch: &Switch) -> (Ratio, Ratio) {
    let device = system.devices.iter().find(|device| device.entry(switch.threshold).is_some()).unwrap();
    let on = quantity(device, switch.threshold);
    let off = match (switch.back, switch.side) {
        (SwitchBack::At(id), _) => quantity(device, id),
        (SwitchBack::By(id), SwitchSide::Below) => on.checked_add(quantity(device, id)).unwrap(),
        (SwitchBack::By(id), SwitchSide::Above) => on.checked_sub(quantity(device, id)).unwrap(),
    };
    (on, off)
}

fn all_switches(system: &System) -> Vec<Vec<Switch>> {
    let contents = system.document.tables().map(|(.., table)| &table.content);
    let found = contents.filter_map(|content| match content {
        TableContent::Hysteresis(switches) => Some(switches.clone()),
        _ => None,
    });
    found.collect()
}

/// `-20.5 °C` in tenths.
fn tenths(text: &str) -> i128 {
    let number = text.split(' ').next().unwrap();
    let (whole, tenths) = number.split_once('.').unwrap_or((number, "0"));
    format!("{whole}{tenths}").parse().unwrap()
}

fn in_tenths(value: Ratio) -> i128 {
    value.checked_mul(Ratio::whole(10)).unwrap().to_whole().unwrap()
}

/// The elements of each switch, beginning with its band.
fn rows(picture: &[Element]) -> Vec<&[Element]> {
    let starts: Vec<usize> =
        picture.iter().enumerate().filter(|(_, element)| element.is("band")).map(|(at, _)| at).collect();
    let ends = starts.iter().skip(1).copied().chain([picture.len()]);
    starts.iter().zip(ends).map(|(start, end)| &picture[*start..end]).collect()
}

#[test]
fn pictures_show_where_switches_go_on_and_off() {
    let system = compile_clean(PITCH).unwrap();
    let (switches, pictures) = (all_switches(&system), pictures(PITCH, "en", "hysteresis"));
    assert!(switches.len() == pictures.len() && !switches.is_empty());
    // The shipped pictures have switches of both sides, and both ways to say where one goes off.
    let all: Vec<&Switch> = switches.iter().flatten().collect();
    assert!(
        [SwitchSide::Below, SwitchSide::Above].iter().all(|side| all.iter().any(|one| one.side == *side))
    );
    assert!(all.iter().any(|one| matches!(one.back, SwitchBack::At(_))));
    for (switches, picture) in switches.iter().zip(&pictures) {
        let rows = rows(picture);
        assert_eq!(switches.len(), rows.len());
        // Values and places of all edges, to see that they are to scale.
        let mut placed: Vec<(i128, i64)> = Vec::new();
        for (switch, row) in switches.iter().zip(rows) {
            let texts: Vec<&Element> = row.iter().filter(|element| element.name == "text").collect();
            assert_eq!(texts[0].text, switch.what.get("en").unwrap());
            let lines = row.iter().find(|element| element.is("wave")).unwrap();
            let pieces = pieces(lines.get("d"));
            let levels: Vec<&Piece> = pieces.iter().filter(|piece| !piece.is_vertical).collect();
            let edges: Vec<&Piece> = pieces.iter().filter(|piece| piece.is_vertical).collect();
            assert_eq!((levels.len(), edges.len()), (2, 2));
            let (upper, lower) = if levels[0].level < levels[1].level {
                (levels[0], levels[1])
            } else {
                (levels[1], levels[0])
            };
            // The upper line is on: it ends where the switch goes off, the lower one where it goes on.
            let (goes_on, goes_off) = match switch.side {
                SwitchSide::Below => (lower.from, upper.to),
                SwitchSide::Above => (lower.to, upper.from),
            };
            let mut at: Vec<i64> = edges.iter().map(|edge| edge.level).collect();
            at.sort_unstable();
            let mut expected = vec![goes_on, goes_off];
            expected.sort_unstable();
            assert_eq!(at, expected, "the state changes at the ends of the lines");
            let (on, off) = points(&system, switch);
            placed.extend([(in_tenths(on), goes_on), (in_tenths(off), goes_off)]);
            // Values are next to the edges, words next to the lines.
            let values = &texts[3..];
            assert_eq!(values.len(), 2);
            for (value, x) in [(on, goes_on), (off, goes_off)] {
                let near = values.iter().min_by_key(|text| (text.number("x") - x).abs()).unwrap();
                assert_eq!(tenths(&near.text), in_tenths(value), "{}", near.text);
            }
            for (word, line) in [("on", upper), ("off", lower)] {
                let text = texts[1..3].iter().find(|text| text.text == word).unwrap();
                assert!((1..10).contains(&(line.level - text.number("y"))), "{text:?}");
                assert!((line.from..=line.to).contains(&text.number("x")), "{text:?}");
            }
            // Tips point to where the line goes on: down to off, up to on.
            let tips: Vec<&str> =
                row.iter().filter(|element| element.is("tip")).map(|tip| tip.get("d")).collect();
            let tip_at = |x: i64| *tips.iter().find(|tip| tip.starts_with(&format!("M{x} "))).unwrap();
            assert!(
                tip_at(goes_on).ends_with("l-4 8h8z") && tip_at(goes_off).ends_with("l-4 -8h8z"),
                "{tips:?}"
            );
        }
        let (low, high) = (placed.iter().min().unwrap(), placed.iter().max().unwrap());
        for (value, x) in &placed {
            let share = (value - low.0) * i128::from(high.1 - low.1) / (high.0 - low.0);
            assert!((share - i128::from(x - low.1)).abs() <= 1, "{value} lies at {x}");
        }
    }
}

#[test]
fn texts_of_pictures_are_whole_and_inside() {
    for language in ["en", "de"] {
        for picture in pictures(PITCH, language, "hysteresis") {
            let (width, height) = (picture[0].number("width"), picture[0].number("height"));
            let words: Vec<&str> =
                picture.iter().filter(|one| one.name == "text").map(|one| one.text.as_str()).collect();
            assert!(words.contains(&if language == "de" { "aus" } else { "off" }), "{words:?}");
            for row in rows(&picture) {
                let line = row.iter().find(|element| element.is("wave")).unwrap();
                let pieces = pieces(line.get("d"));
                let levels = pieces.iter().filter(|piece| !piece.is_vertical);
                let first = levels.map(|piece| piece.from).min().unwrap();
                for text in row.iter().filter(|element| element.name == "text") {
                    let room = i64::try_from(text.text.chars().count()).unwrap() * 7;
                    let x = text.number("x");
                    let (from, to) = if text.is("end") { (x - room, x) } else { (x, x + room) };
                    assert!(from >= 0 && to <= width && (8..=height).contains(&text.number("y")), "{text:?}");
                    let is_name = text.text == row.iter().find(|one| one.name == "text").unwrap().text;
                    assert!(
                        if is_name { to < first } else { from >= first },
                        "{text:?} and lines from {first}"
                    );
                }
            }
        }
    }
}
