//! Specifications with one mistake, each with the code of the rule that has to find it; and the right specifications that are
//! nearest to them, about which nothing at all is said. A case may also be about settings of a node.
//!
//! A specification is written as in the examples of the rules: what it leaves out of version, title, `uses:` and
//! `devices:` is above it. Its devices have the features `heartbeat producer` and `emergency`, unless it says
//! otherwise.

mod case;
mod cob_ids;
mod pdo;
mod settings;
mod standard_objects;
mod start_values;
mod values;

use std::collections::BTreeSet;

use case::{Case, Right, said, said_of_eds};

fn wrong() -> Vec<Case> {
    [
        cob_ids::wrong(),
        standard_objects::wrong(),
        values::wrong(),
        start_values::wrong(),
        pdo::wrong(),
        settings::wrong(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

fn right() -> Vec<Right> {
    [
        cob_ids::right(),
        standard_objects::right(),
        values::right(),
        start_values::right(),
        pdo::right(),
        settings::right(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Every mistake is found, and nothing else is said about it.
#[test]
fn what_is_wrong_is_found() {
    let missed: Vec<String> = wrong()
        .iter()
        .filter_map(|case| {
            let found = said(&case.specification, case.set);
            let is_found = found.iter().any(|(code, _)| *code == case.code)
                && found.iter().all(|(code, _)| *code == case.code);
            (!is_found).then(|| format!("{}: expected {}, found {found:#?}", case.name, case.code))
        })
        .collect();
    assert!(missed.is_empty(), "{} cases:\n{}", missed.len(), missed.join("\n"));
}

/// No warning and no note, either.
#[test]
fn what_is_right_passes_without_a_word() {
    let blamed: Vec<String> = right()
        .iter()
        .filter_map(|case| {
            let found = said(&case.specification, case.set);
            (!found.is_empty()).then(|| format!("{}: {found:#?}", case.name))
        })
        .collect();
    assert!(blamed.is_empty(), "{} cases:\n{}", blamed.len(), blamed.join("\n"));
}

/// What a specification may say, its EDS may say, too.
#[test]
fn what_is_right_is_right_in_an_eds() {
    let blamed: Vec<String> = right()
        .iter()
        .filter_map(|case| {
            let found = said_of_eds(&case.specification);
            (!found.is_empty()).then(|| format!("{}: {found:#?}", case.name))
        })
        .collect();
    assert!(blamed.is_empty(), "{} cases:\n{}", blamed.len(), blamed.join("\n"));
}

#[test]
fn every_case_has_a_name_of_its_own() {
    let names: Vec<&str> =
        wrong().iter().map(|case| case.name).chain(right().iter().map(|case| case.name)).collect();
    let distinct: BTreeSet<&str> = names.iter().copied().collect();
    assert_eq!(distinct.len(), names.len());
}
