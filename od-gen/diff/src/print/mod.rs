//! A difference for people and for programs.

mod advice;
mod changelog;
mod human;
mod json;
mod line;
mod markdown;
mod row;

pub use self::human::{human, short};
pub use self::json::json;
pub use self::markdown::markdown;
pub use self::row::{Row, row};

use std::fmt::Write as _;

use super::words::counted;
use super::{Class, Difference, Scope, Unknown};

/// What was compared, where that is not everything.
fn scope(scope: Scope) -> Option<&'static str> {
    match scope {
        Scope::Everything => None,
        Scope::WhatAnEdsStates => Some(
            "compared is what an EDS states: no units, meanings, special values, storage, conditions and texts, \
             and nothing that follows from them for firmware and stored parameters",
        ),
        Scope::WhatADcfStates => Some(
            "compared is what a DCF states: no units, meanings, special values, storage, conditions and texts, \
             nothing that follows from them for firmware and stored parameters, and no formula of the node-ID",
        ),
    }
}

/// What could not be judged.
const fn unknown(unknown: Unknown) -> &'static str {
    match unknown {
        Unknown::Firmware => {
            "firmware code was not compared: no code can be generated from one side; `odgen check --rust` says why"
        }
        Unknown::Stored => {
            "stored parameters were not compared: one side has strings without a capacity; `odgen check --rust` lists them"
        }
    }
}

/// How many changes there are of each class, the heaviest first: `2 changes: 1 breaks PLC projects, 1 concerns documents only`.
fn summary(difference: &Difference) -> String {
    let total = difference.changes().count();
    let mut text = counted(total, "change", "changes");
    let classes = Class::ALL.iter().rev().filter_map(|class| {
        let number = difference.changes().filter(|change| change.classes().contains(class)).count();
        (number > 0).then_some((number, class))
    });
    for (at, (number, class)) in classes.enumerate() {
        let before = if at == 0 { ": " } else { ", " };
        let _ = write!(text, "{before}{number} {}", does(*class, number));
    }
    text
}

/// What so many changes do.
const fn does(class: Class, number: usize) -> &'static str {
    match (class, number) {
        (Class::Plc, 1) => "breaks PLC projects",
        (Class::Plc, _) => "break PLC projects",
        (Class::Stored, 1) => "breaks stored parameters",
        (Class::Stored, _) => "break stored parameters",
        (Class::Firmware, 1) => "breaks firmware code",
        (Class::Firmware, _) => "break firmware code",
        (Class::Behaviour, 1) => "changes behaviour",
        (Class::Behaviour, _) => "change behaviour",
        (Class::Addition, 1) => "is a compatible addition",
        (Class::Addition, _) => "are compatible additions",
        (Class::Documents, 1) => "concerns documents only",
        (Class::Documents, _) => "concern documents only",
    }
}
