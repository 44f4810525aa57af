//! `odgen check`.

use insta::assert_snapshot;

use crate::{LAMP, PITCH, Scratch, code, odgen, stderr, stdout};

#[test]
fn check_says_nothing_when_all_is_well() {
    let scratch = Scratch::new("check");
    scratch.file("lamp.od.yaml", LAMP);
    let output = odgen(&scratch.0, &["check", "lamp.od.yaml"]);
    assert_eq!((code(&output), stdout(&output), stderr(&output)), (0, String::new(), String::new()));
}

/// What departs from a standard is no mistake; people are told how much there is, and get the list when they ask.
#[test]
fn departures_from_a_standard_are_notes() {
    let scratch = Scratch::new("notes");
    let output = odgen(&scratch.0, &["check", PITCH, "--deny-warnings"]);
    assert_eq!((code(&output), stdout(&output)), (0, String::new()));
    let said = stderr(&output);
    assert!(said.starts_with("note: ") && said.lines().count() == 1, "{said}");
    let output = odgen(&scratch.0, &["check", PITCH, "--notes"]);
    let list = stderr(&output);
    assert_eq!(said.split(' ').nth(1).unwrap(), list.lines().count().to_string());
    assert!(list.contains("note[OD0811]: 1003h pre defined error field departs from cia301: name"), "{list}");
    let output = odgen(&scratch.0, &["check", PITCH, "--format", "json"]);
    assert_eq!(stderr(&output), "");
}

#[test]
fn warnings_fail_only_when_denied() {
    let scratch = Scratch::new("warn");
    scratch.file("lamp.od.yaml", LAMP.replace(", features: [heartbeat producer]", ""));
    let output = odgen(&scratch.0, &["check", "lamp.od.yaml", "--format", "short"]);
    assert_eq!(code(&output), 0);
    assert_snapshot!(stderr(&output));
    assert_eq!(code(&odgen(&scratch.0, &["check", "lamp.od.yaml", "--deny-warnings"])), 1);
}

#[test]
fn json_messages_are_one_object_a_line() {
    let scratch = Scratch::new("json");
    scratch.file("lamp.od.yaml", LAMP.replace("unsigned8", "unsigned9").replace("125, 500", "124"));
    let output = odgen(&scratch.0, &["--format", "json", "check", "lamp.od.yaml"]);
    assert_eq!(code(&output), 1);
    let text = stderr(&output);
    assert_eq!(text.lines().count(), 2, "{text}");
    assert!(text.lines().all(|line| line.starts_with("{\"code\":\"OD0") && line.ends_with('}')), "{text}");
}
