//! One table of values through the rules for a specification, the same rules for the settings of a DCF, and the run-time checks
//! of firmware-glue, so that the three stay of one mind.
//!
//! A case says what all three say. Where one of them legitimately knows more or less, an exception of the case says so with
//! its reason; an exception that nothing needs any more fails, and so does a reason that no case has.

#![expect(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

mod case;
mod communication;
mod device;
mod mapping;
mod reason;
mod settings;
mod specification;
mod values;

use std::collections::BTreeSet;

use od_spec::model::System;
use od_tests::compile_clean;

use case::{Case, Party, Said};
use reason::Reason;

/// The node that is configured.
const NODE: u8 = 5;
/// The specification with values that are right.
const CLEAN: &str = "tests/shared/agreement.od.yaml";

fn table() -> Vec<Case> {
    [values::cases(), communication::cases(), mapping::cases()].into_iter().flatten().collect()
}

fn said(party: Party, system: &System, case: &Case) -> Said {
    match party {
        Party::Specification => specification::said(system, case),
        Party::Settings => settings::said(system, case),
        Party::Device => device::said(system, case),
    }
}

#[test]
fn the_three_say_the_same_about_every_case() {
    let system = compile_clean(CLEAN).unwrap();
    let mut wrong = Vec::new();
    for case in table() {
        for party in Party::ALL {
            let (found, expected) = (said(party, &system, &case), case.expected(party));
            if found != expected {
                wrong.push(format!("{}\n  {party:?}: {found:?}, expected {expected:?}", case.title()));
            }
        }
    }
    assert!(wrong.is_empty(), "{} disagreements:\n{}", wrong.len(), wrong.join("\n"));
}

/// Without its exception, a case that has one fails; what it says is what the reason is about.
#[test]
fn every_exception_is_needed() {
    let system = compile_clean(CLEAN).unwrap();
    for case in table() {
        for exception in &case.exceptions {
            let common = case.common(exception.party);
            let found = said(exception.party, &system, &case);
            assert_ne!(found, common, "{}: {:?} needs no exception", case.title(), exception.party);
        }
    }
}

#[test]
fn every_reason_is_given_by_a_case() {
    let given: BTreeSet<Reason> =
        table().iter().flat_map(|case| case.exceptions.iter().map(|exception| exception.reason)).collect();
    for reason in Reason::ALL {
        assert!(given.contains(reason), "no case has the reason: {}", reason.text());
    }
}

#[test]
fn no_case_is_written_twice() {
    let table = table();
    let titles: BTreeSet<String> = table.iter().map(Case::title).collect();
    assert_eq!(titles.len(), table.len());
    assert!(table.len() >= 60, "{}", table.len());
    // Both verdicts, and each code of an abort that a value can cause.
    let aborts: BTreeSet<_> = table
        .iter()
        .filter_map(|case| Some(case.expected(Party::Device)).filter(|said| matches!(said, Said::Aborted(_))))
        .collect();
    assert!(aborts.len() >= 10, "{aborts:?}");
}
