//! The table of cases: one change of the pitch control system for each kind of fact and each direction, with its class.

mod device;
mod manual;
mod meanings;
mod objects;
mod relations;
mod values;

use std::collections::BTreeSet;
use std::sync::LazyLock;

use od_diff::{Change, Class, Difference, Kind, Place, Scope, short};
use od_spec::model::{Fact, System};

use crate::shipped::PITCH;
use crate::{Case, PITCH_SYSTEM, difference, system};

/// What is reported otherwise: the number of elements by the elements that came and went, remote frames by the COB-ID
/// that holds the flag. Strings with a capacity are not in the pitch control system; see the lamp. Nodes are in DCF
/// files; see the command. Modules and what a file says in its own words only files have; see `eds`. Transitions are those of
/// their machine.
const TOLD_OTHERWISE: [Fact; 7] = [
    Fact::Count,
    Fact::RemoteFrames,
    Fact::Capacity,
    Fact::Modules,
    Fact::Further,
    Fact::Node,
    Fact::Transitions,
];

/// The specification without what it says about the printed manual, which is more than half of the file.
static DEVICES: LazyLock<&str> = LazyLock::new(|| PITCH.split_once("\ndocument:\n").unwrap().0);
static DEVICES_SYSTEM: LazyLock<System> = LazyLock::new(|| system(&DEVICES));

/// Compares each case with the specification, in both directions.
fn check(text: &str, old: &System, cases: &[Case]) {
    for case in cases {
        let new = system(&case.applied(text));
        let found = difference(old, &new, Scope::Everything);
        let lines = short(&found);
        assert_eq!(lines.lines().collect::<Vec<_>>(), case.expected, "{}", case.name);
        let back = difference(&new, old, Scope::Everything);
        assert_eq!(mirrored(&found), plain(&back), "{}: back again", case.name);
    }
}

/// A change without its consequences, which depend on the direction, and without its name, which is that of the new side.
type Plain = (Place, Option<String>, Fact, Option<String>, Option<String>);

fn plain(difference: &Difference) -> Vec<Plain> {
    let plain = |change: &Change| {
        let Change { place, part, fact, before, after, .. } = change.clone();
        (place, part, fact, before, after)
    };
    let mut list: Vec<Plain> = difference.changes().map(plain).collect();
    list.sort_by_key(|one| format!("{one:?}"));
    list
}

/// The same with before and after changing places.
fn mirrored(difference: &Difference) -> Vec<Plain> {
    let mut list = plain(difference);
    for (_, _, _, before, after) in &mut list {
        std::mem::swap(before, after);
    }
    list.sort_by_key(|one| format!("{one:?}"));
    list
}

#[test]
fn objects_and_entries() {
    check(&DEVICES, &DEVICES_SYSTEM, objects::CASES);
}

#[test]
fn values_of_entries() {
    check(&DEVICES, &DEVICES_SYSTEM, values::CASES);
}

#[test]
fn meanings_of_values() {
    check(&DEVICES, &DEVICES_SYSTEM, meanings::CASES);
}

#[test]
fn the_device_as_a_whole() {
    check(&DEVICES, &DEVICES_SYSTEM, device::CASES);
}

#[test]
fn what_is_in_addition_to_the_objects() {
    check(&DEVICES, &DEVICES_SYSTEM, relations::CASES);
}

#[test]
fn the_printed_manual() {
    check(&PITCH, &PITCH_SYSTEM, manual::CASES);
}

/// A fact or a class without a case would not be noticed when it got lost.
#[test]
fn every_fact_and_every_class_has_a_case() {
    let lists =
        [objects::CASES, values::CASES, meanings::CASES, device::CASES, relations::CASES, manual::CASES];
    let lines: Vec<&str> = lists.into_iter().flatten().flat_map(|case| case.expected).copied().collect();
    for class in Class::ALL {
        let has_class = |line: &&&str| {
            let classes = line.rsplit_once('[').unwrap().1.trim_end_matches(']');
            classes.split(", ").any(|one| one == class.word())
        };
        assert!(lines.iter().any(|line| has_class(&line)), "no case is of the class {}", class.word());
    }
    for kind in [Kind::Added, Kind::Removed, Kind::Changed] {
        let sign = format!(": {} ", kind.sign());
        assert!(lines.iter().any(|line| line.contains(&sign)), "nothing is {}", kind.word());
    }
    let has_fact = |fact: &&Fact| lines.iter().any(|line| line.contains(&format!(": {}: ", fact.word())));
    let without: BTreeSet<&str> = Fact::ALL
        .iter()
        .filter(|fact| **fact != Fact::Presence && !has_fact(fact))
        .map(|f| f.word())
        .collect();
    assert_eq!(without, TOLD_OTHERWISE.iter().map(|fact| fact.word()).collect());
}
