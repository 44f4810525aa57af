//! Pictures of state machines: each transition is one line, and no line lies on another.

use std::collections::BTreeSet;

use od_tests::documents;
use serde_json::Value;

use super::{FULLMO, PITCH, compile_clean};

/// The first picture of a state machine in what templates see.
fn picture(spec: &str) -> Value {
    let system = compile_clean(spec).unwrap();
    let mut rest = vec![documents::context(spec, system.language()).unwrap()];
    while let Some(value) = rest.pop() {
        match value {
            Value::Object(map) => {
                if let Some(found @ Value::Object(_)) = map.get("machine") {
                    return found.clone();
                }
                rest.extend(map.values());
            }
            Value::Array(list) => rest.extend(list),
            _ => {}
        }
    }
    panic!("{spec} has no state machine");
}

/// A straight piece of a line.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece {
    pub is_vertical: bool,
    /// What all its points share: x of a vertical piece, y of a horizontal one.
    pub level: i64,
    pub from: i64,
    pub to: i64,
}

/// The pieces of a path of `M`, `H` and `V`.
pub(super) fn pieces(path: &str) -> Vec<Piece> {
    let (mut x, mut y) = (0, 0);
    let mut pieces = Vec::new();
    let steps = path.matches(['M', 'H', 'V']).zip(path.split(['M', 'H', 'V']).skip(1));
    for (step, numbers) in steps {
        let numbers: Vec<i64> = numbers.split(' ').map(|number| number.parse().unwrap()).collect();
        match (step, numbers.as_slice()) {
            ("M", [to_x, to_y]) => (x, y) = (*to_x, *to_y),
            ("H", [to]) => {
                pieces.push(Piece { is_vertical: false, level: y, from: x.min(*to), to: x.max(*to) });
                x = *to;
            }
            ("V", [to]) => {
                pieces.push(Piece { is_vertical: true, level: x, from: y.min(*to), to: y.max(*to) });
                y = *to;
            }
            _ => panic!("{path}"),
        }
    }
    pieces
}

#[test]
fn every_transition_is_drawn_by_itself() {
    for spec in [PITCH, FULLMO] {
        let picture = picture(spec);
        let system = compile_clean(spec).unwrap();
        let machine = system.machines.values().next().unwrap();
        let lines = picture["lines"].as_array().unwrap();
        let drawn: BTreeSet<u64> = lines.iter().map(|line| line["number"].as_u64().unwrap()).collect();
        let all: BTreeSet<u64> = machine.transitions.iter().map(|one| u64::from(one.number)).collect();
        assert_eq!((drawn.len(), &drawn), (lines.len(), &all), "{spec}");

        let places: Vec<(u64, Vec<Piece>)> = lines
            .iter()
            .map(|line| (line["number"].as_u64().unwrap(), pieces(line["path"].as_str().unwrap())))
            .collect();
        for (at, (number, line)) in places.iter().enumerate() {
            for (other, beside) in &places[at + 1..] {
                for (one, two) in line.iter().flat_map(|one| beside.iter().map(move |two| (one, two))) {
                    let is_same_level = one.is_vertical == two.is_vertical && one.level == two.level;
                    let overlap = one.to.min(two.to) - one.from.max(two.from);
                    assert!(
                        !is_same_level || overlap <= 0,
                        "{spec}: {number} lies on {other}: {one:?}, {two:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn the_way_down_names_the_codes_that_enable_the_drive() {
    for (spec, codes) in [(PITCH, ["0106h", "0107h", "010Fh"]), (FULLMO, ["0006h", "0007h", "000Fh"])] {
        let picture = picture(spec);
        let lines = picture["lines"].as_array().unwrap();
        let code = |number: u64| lines.iter().find(|line| line["number"] == number).unwrap()["code"].as_str();
        assert_eq!([2, 3, 4].map(|number| code(number).unwrap()), codes, "{spec}");
        // The start is not commanded, and what leads up has no room.
        assert_eq!([0, 1, 8, 15].map(|number| code(number).unwrap()), [""; 4], "{spec}");
    }
}

#[test]
fn each_line_ends_at_the_state_that_its_transition_enters() {
    for spec in [PITCH, FULLMO] {
        let picture = picture(spec);
        let system = compile_clean(spec).unwrap();
        let machine = system.machines.values().next().unwrap();
        let states = picture["states"].as_array().unwrap();
        for line in picture["lines"].as_array().unwrap() {
            let number = line["number"].as_u64().unwrap();
            let transition = machine.transitions.iter().find(|one| u64::from(one.number) == number).unwrap();
            // `M120 52l…`: the point of the arrow.
            let tip = line["tip"].as_str().unwrap().trim_start_matches('M');
            let point: Vec<i64> =
                tip.split(['l', ' ']).take(2).map(|number| number.parse().unwrap()).collect();
            let is_at = |state: &&Value| {
                let side = |key: &str| state[key].as_i64().unwrap();
                let (right, bottom) = (side("x") + side("width"), side("y") + side("height"));
                (side("x")..=right).contains(&point[0]) && (side("y")..=bottom).contains(&point[1])
            };
            let entered =
                states.iter().find(is_at).unwrap_or_else(|| panic!("{spec}: {number} ends nowhere"));
            assert_eq!(entered["name"].as_str(), Some(&*transition.to), "{spec}: {number}");
        }
    }
}
