//! The way from state to state.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use crate::model::{StateMachine, Transition};

/// The transitions that a machine begins with.
pub(super) fn starts(machine: &StateMachine) -> impl Iterator<Item = &Transition> {
    machine.transitions.iter().filter(|transition| transition.from.is_empty())
}

/// The transitions from a state to another one.
pub(super) fn leaving<'a>(
    machine: &'a StateMachine,
    state: &'a str,
) -> impl Iterator<Item = &'a Transition> + Clone {
    let leaves = move |transition: &&Transition| transition.from.iter().any(|from| from == state);
    machine.transitions.iter().filter(leaves).filter(move |transition| transition.to != state)
}

/// The states that can be reached from some, these among them, each with the one before it on a shortest way.
pub(super) struct Reach<'a> {
    before: BTreeMap<&'a str, Option<&'a str>>,
}

impl<'a> Reach<'a> {
    /// What can be reached over the transitions that count.
    pub(super) fn over(
        machine: &'a StateMachine,
        from: impl Iterator<Item = &'a str>,
        counts: impl Fn(&Transition) -> bool,
    ) -> Self {
        let mut before: BTreeMap<&str, Option<&str>> = from.map(|state| (state, None)).collect();
        let mut waiting: VecDeque<&str> = before.keys().copied().collect();
        while let Some(state) = waiting.pop_front() {
            for transition in leaving(machine, state).filter(|transition| counts(transition)) {
                if !before.contains_key(transition.to.as_str()) {
                    before.insert(&transition.to, Some(state));
                    waiting.push_back(&transition.to);
                }
            }
        }
        Self { before }
    }

    /// What can be reached at all.
    pub(super) fn of(machine: &'a StateMachine, from: impl Iterator<Item = &'a str>) -> Self {
        Self::over(machine, from, |_| true)
    }

    /// Whether a state is among them.
    pub(super) fn has(&self, state: &str) -> bool {
        self.before.contains_key(state)
    }

    /// The states, in the order of their names.
    pub(super) fn states(&self) -> impl Iterator<Item = &'a str> {
        self.before.keys().copied()
    }

    /// The states from where the way begins to this one.
    pub(super) fn path(&self, state: &'a str) -> Vec<&'a str> {
        let (mut path, mut seen, mut at) = (vec![state], BTreeSet::from([state]), state);
        while let Some(Some(before)) = self.before.get(at).copied() {
            if !seen.insert(before) {
                break;
            }
            path.push(before);
            at = before;
        }
        path.reverse();
        path
    }
}
