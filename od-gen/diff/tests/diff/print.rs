//! What people and programs read.

use insta::assert_snapshot;
use od_diff::{Difference, Scope, human, json, markdown, short};

use crate::lamp::LAMP;
use crate::{difference, system};

/// Something of each class, and a value that is too long for a line.
fn found() -> Difference {
    let new = LAMP
        .replace("title: Lamp", "title: Lamps")
        .replace("max: 100 %", "max: 90 %")
        .replace("count: 3", "count: 4")
        .replace("name: mode, type", "about: \"One of a few | modes, of which the first is steady, and the last one is blinking.\", name: mode, type")
        .replace("1: blinking}", "1: flashing, 2: dim}");
    difference(&system(LAMP), &system(&new), Scope::Everything)
}

#[test]
fn for_people() {
    assert_snapshot!(human(&found(), false));
    let coloured = human(&found(), true);
    assert!(coloured.contains("\u{1b}[1;31mBREAKS PLC projects\u{1b}[0m"), "{coloured}");
}

#[test]
fn a_line_for_each_change() {
    assert_snapshot!(short(&found()));
}

#[test]
fn for_documents() {
    assert_snapshot!(markdown(&found()));
}

#[test]
fn for_programs() {
    assert_snapshot!(json(&found()));
}

#[test]
fn nothing_is_short() {
    let none = difference(&system(LAMP), &system(LAMP), Scope::Everything);
    assert_eq!(human(&none, false), "0 changes\n");
    assert_eq!(short(&none), "");
    assert_eq!(markdown(&none), "# Differences\n\n0 changes.\n");
}
