//! The picture of a state machine: states below one another, transitions as lines next to them.
//!
//! A transition runs in a lane: to the right of the states where it leads down, to the left where it leads up. Lanes next to
//! the states are for short ways, and two transitions share a lane where their ways do not meet. A transition to the next
//! state, from there alone, is an arrow between the two.

use od_spec::model::{StateMachine, Transition};
use od_spec::order::Arrange as _;

use crate::view::{MachineLine, MachinePicture, MachineState, Target};

/// Width of a state, and of a character in it at most.
const STATE: (u32, u32) = (120, 7);
/// Least height of a state; its name and its bits need so much.
const HEIGHT: u32 = 38;
/// Between two states.
const GAP: u32 = 34;
/// Between two lanes, for a number of three digits.
const LANE: u32 = 30;
/// Between two lines that end at the same side of a state.
const SLOT: u32 = 13;
/// Above the first state.
const TOP: u32 = 30;

/// Where a line runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Side {
    /// Between a state and the next.
    Between,
    Left,
    Right,
}

/// A transition on its way.
struct Way<'a> {
    transition: &'a Transition,
    /// Positions of the states that it leaves, ascending; none for the start.
    from: Vec<usize>,
    to: usize,
    side: Side,
    /// Counted from the states outwards.
    lane: u32,
}

impl Way<'_> {
    /// The highest and the lowest state that it touches.
    fn span(&self) -> (usize, usize) {
        let ends = || self.from.iter().copied().chain([self.to]);
        (ends().min().unwrap_or(self.to), ends().max().unwrap_or(self.to))
    }

    /// The states that it touches, each once.
    fn ends(&self) -> Vec<usize> {
        let mut ends: Vec<usize> = self.from.iter().copied().chain([self.to]).collect();
        ends.sort_unstable();
        ends.dedup();
        ends
    }
}

/// A state machine, with the bits of its states as text, and the code of the command that takes a transition.
pub(crate) fn picture(
    machine: &StateMachine,
    patterns: &[String],
    status: Option<Target>,
    code_of: impl Fn(u8) -> String,
) -> MachinePicture {
    let ways = ways(machine);
    let lanes = |side| ways.iter().filter(|way| way.side == side).map(|way| way.lane + 1).max().unwrap_or(0);
    let characters =
        machine.states.iter().map(|state| state.name.chars().count()).chain(patterns.iter().map(String::len));
    let longest = u32::try_from(characters.max().unwrap_or(0)).unwrap_or(u32::MAX / 16);
    let width = STATE.0.max(longest * STATE.1 + 12);
    let left = lanes(Side::Left) * LANE + 12;

    let mut states = Vec::new();
    let mut y = TOP;
    for (at, state) in machine.states.iter().enumerate() {
        let slots = [Side::Left, Side::Right].map(|side| ends_at(&ways, at, side).len());
        let slots = u32::try_from(slots.into_iter().max().unwrap_or(0)).unwrap_or(0);
        let height = HEIGHT.max(slots * SLOT + 6);
        states.push(MachineState {
            name: state.name.clone(),
            pattern: patterns.get(at).cloned().unwrap_or_default(),
            x: left,
            y,
            width,
            height,
        });
        y += height + GAP;
    }
    let lines = ways.iter().map(|way| {
        // There is room for a code next to the way down, which is the way to operation.
        let code = if way.side == Side::Between { code_of(way.transition.number) } else { String::new() };
        MachineLine { code, ..line(way, &ways, &states) }
    });
    let lines = lines.collect();
    MachinePicture {
        width: left + width + lanes(Side::Right) * LANE + 12,
        height: y - GAP + 2,
        status,
        states,
        lines,
    }
}

/// All transitions with their lanes.
fn ways(machine: &StateMachine) -> Vec<Way<'_>> {
    let position = |name: &String| machine.states.iter().position(|state| &state.name == name);
    let placed = machine.transitions.iter().filter_map(|transition| {
        let mut from: Vec<usize> = transition.from.iter().filter_map(position).collect();
        from.sort_unstable();
        let to = position(&transition.to)?;
        let side = match from.as_slice() {
            [] if to == 0 => Side::Between,
            [from] if from + 1 == to => Side::Between,
            [from, ..] if *from < to => Side::Right,
            _ => Side::Left,
        };
        Some(Way { transition, from, to, side, lane: 0 })
    });
    let mut ways: Vec<Way<'_>> = placed.collect();
    // Two arrows between the same states would be one.
    for at in 1..ways.len() {
        let is_taken = ways[..at].iter().any(|way| way.side == Side::Between && way.to == ways[at].to);
        if ways[at].side == Side::Between && is_taken {
            ways[at].side = Side::Right;
        }
    }
    let mut shortest_first: Vec<usize> =
        (0..ways.len()).filter(|at| ways[*at].side != Side::Between).collect();
    shortest_first.arrange_by_key(|at| {
        let (first, last) = ways[*at].span();
        (last - first, first, ways[*at].transition.number)
    });
    let mut placed: Vec<usize> = Vec::new();
    for at in shortest_first {
        let (first, last) = ways[at].span();
        // Where one ends at a state from which the other goes on, they do not meet: each has its place at the state.
        let meets = |other: &usize| {
            let (other_first, other_last) = ways[*other].span();
            first < other_last && other_first < last || (first, last) == (other_first, other_last)
        };
        let taken: Vec<u32> = placed
            .iter()
            .filter(|other| ways[**other].side == ways[at].side && meets(other))
            .map(|other| ways[*other].lane)
            .collect();
        let outermost = taken.iter().max().map_or(0, |lane| lane + 1);
        ways[at].lane = (0..outermost).find(|lane| !taken.contains(lane)).unwrap_or(outermost);
        placed.push(at);
    }
    ways
}

/// The ways that touch a state at a side, in the order of their places there, so that lines cross as little as they can: those
/// that go up above those that go down, and the inner lanes outermost.
fn ends_at<'w, 'm>(ways: &'w [Way<'m>], state: usize, side: Side) -> Vec<&'w Way<'m>> {
    let mut here: Vec<&Way<'_>> =
        ways.iter().filter(|way| way.side == side && way.ends().contains(&state)).collect();
    here.arrange_by_key(|way| {
        let goes_up = way.span().0 < state;
        let lane = i64::from(way.lane);
        (!goes_up, if goes_up { lane } else { -lane }, way.transition.number)
    });
    here
}

/// A transition as a line with a tip.
fn line(way: &Way<'_>, ways: &[Way<'_>], states: &[MachineState]) -> MachineLine {
    let number = way.transition.number;
    let entered = &states[way.to];
    if way.side == Side::Between {
        let x = entered.x + entered.width / 2;
        let start = match way.from.first() {
            Some(from) => states[*from].y + states[*from].height,
            None => entered.y - TOP + 6,
        };
        return MachineLine {
            number,
            code: String::new(),
            path: format!("M{x} {start}V{}", entered.y),
            tip: format!("M{x} {}l-4 -8h8z", entered.y),
            start: way.from.is_empty().then_some((x, start)),
            label: (x + 6, u32::midpoint(start, entered.y) + 4),
        };
    }
    let edge = |state: &MachineState| if way.side == Side::Left { state.x } else { state.x + state.width };
    let out = (way.lane + 1) * LANE;
    let x = if way.side == Side::Left { entered.x - out } else { entered.x + entered.width + out };
    let place = |at: usize| {
        let here = ends_at(ways, at, way.side);
        let slot = here.iter().position(|other| std::ptr::eq(*other, way)).unwrap_or_default();
        let (slot, count) = (u32::try_from(slot).unwrap_or_default(), u32::try_from(here.len()).unwrap_or(1));
        states[at].y + states[at].height * (2 * slot + 1) / (2 * count)
    };
    let arrival = place(way.to);
    let leaving = way.from.iter().filter(|from| **from != way.to);
    let leaving = leaving.map(|from| format!("M{} {}H{x}V{arrival}", edge(&states[*from]), place(*from)));
    let leaving: String = leaving.collect();
    // From the start, or from a state into itself, it begins in its lane.
    let beginning = if leaving.is_empty() { format!("M{x} {arrival}") } else { leaving };
    let tip = if way.side == Side::Left { "l-8 -4v8z" } else { "l8 -4v8z" };
    MachineLine {
        number,
        code: String::new(),
        path: format!("{beginning}H{}", edge(entered)),
        tip: format!("M{} {arrival}{tip}", edge(entered)),
        start: way.from.is_empty().then_some((x, arrival)),
        label: (if way.side == Side::Left { x + 3 } else { x - 17 }, arrival - 3),
    }
}
