//! What does not differ.

use od_diff::{Advice, Question, Scope, Unpaired, compare};

use crate::shipped::PITCH;
use crate::{FULLMO, PITCH_SYSTEM, difference, system};

#[test]
fn a_system_does_not_differ_from_itself() {
    for text in [&PITCH, &FULLMO] {
        let same = system(text);
        for scope in [Scope::Everything, Scope::WhatAnEdsStates, Scope::WhatADcfStates] {
            let found = difference(&same, &system(text), scope);
            assert_eq!(found.changes().collect::<Vec<_>>(), Vec::<&od_diff::Change>::new());
            assert_eq!(found.class(), None);
            assert!(!found.devices.is_empty());
            for device in &found.devices {
                assert_eq!(
                    (device.proposals.file.advice, device.proposals.revision.advice),
                    (Advice::Keep, Advice::Keep)
                );
                assert!(device.unknown.is_empty(), "{:?}", device.unknown);
            }
        }
    }
}

/// Blocks of the specification in another order: the two devices, the objects, the units.
#[test]
fn the_order_of_keys_and_objects_is_no_difference() {
    let mut parts: Vec<String> = PITCH.split("\n  0x").map(ToOwned::to_owned).collect();
    // The part after the last object holds the rest of the file; error codes and objects look alike, so that only a run
    // of objects is turned round.
    let first = parts.iter().position(|part| part.starts_with("3010:")).unwrap();
    let last = parts.iter().position(|part| part.starts_with("3013:")).unwrap();
    parts[first..=last].reverse();
    let text = parts.join("\n  0x");
    let text = text.replacen("  volt: {symbol: V}\n", "", 1).replacen(
        "  millivolt: {",
        "  volt: {symbol: V}\n  millivolt: {",
        1,
    );
    let text = text.replacen(
        "    type: PMM status\n    access: ro\n    pdo: transmit\n",
        "    pdo: transmit\n    access: ro\n    type: PMM status\n",
        1,
    );
    assert_ne!(text, *PITCH);
    assert_eq!(difference(&PITCH_SYSTEM, &system(&text), Scope::Everything).changes().count(), 0);
}

#[test]
fn a_device_that_is_not_there_is_named() {
    let pitch = &*PITCH_SYSTEM;
    let ask = |device| {
        compare(&Question {
            old: pitch,
            new: pitch,
            scope: Scope::Everything,
            device: Some(device),
            nodes: None,
        })
    };
    assert_eq!(ask("pmm").unwrap().devices.len(), 1);
    let keys = vec!["pmc".to_owned(), "pmm".to_owned()];
    assert_eq!(ask("pmx"), Err(Unpaired::NoSuchDevice { key: "pmx".to_owned(), keys }));
}
