//! Every access to the generated dictionaries, against the JSON dump.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

#[path = "../../shared/cases.rs"]
mod cases;

use firmware_glue::Dictionary;
use od_generated::{fullmo, pmc, pmm};
use od_tests::{access_cases, root};

fn try_device(stem: &str, key: &str, dictionary: &mut impl Dictionary<'static>, least: usize) {
    let dump = std::fs::read(root().join(format!("generated/{stem}.json"))).unwrap();
    let dump = serde_json::from_slice(&dump).unwrap();
    let made = access_cases::of_device(&dump, key).unwrap();
    match cases::run(dictionary, &made.bytes) {
        Ok(count) => assert_eq!(count, made.count),
        Err((number, (kind, index, sub), code)) => {
            panic!("{key}: case {number} (kind {kind}) at {index:04X}h.{sub}: {code:08X}h came")
        }
    }
    assert!(made.count >= least, "{} cases only", made.count);
}

#[test]
fn every_entry_of_the_pmc_answers_as_the_dump_says() {
    try_device("pitch-control-system", "pmc", &mut pmc::Pmc::new(cases::NODE), 56_000);
}

#[test]
fn every_entry_of_the_pmm_answers_as_the_dump_says() {
    try_device("pitch-control-system", "pmm", &mut pmm::Pmm::new(cases::NODE), 50_000);
}

#[test]
fn every_entry_of_the_fullmo_drive_answers_as_the_dump_says() {
    try_device("fullmo-drive", "fullmo", &mut fullmo::Fullmo::new(cases::NODE), 10_000);
}
